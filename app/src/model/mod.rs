//! What the window edits and remembers; no widgets here.

mod document;
mod history;
pub mod own_volume;
mod paths;
mod settings;
mod work;

pub use document::{Document, Source};
pub use history::History;
pub use paths::{rebase, resolved};
pub use settings::Settings;
pub use work::{Work, work_after};
