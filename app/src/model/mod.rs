//! Data model of the window: document, commands, settings and measurements, without widgets.

mod command;
mod document;
mod edit;
mod factor_curve;
mod grid_lists;
mod history;
mod latency;
pub mod own_volume;
mod paths;
mod settings;
pub mod stats;
mod window;
mod work;

pub use command::{Answer, Command, Purpose};
pub use document::{Document, Source};
pub use edit::{WallEdit, edited};
pub use factor_curve::FactorCurve;
pub use grid_lists::GridLists;
pub use history::History;
pub use latency::{Latency, Recent};
pub use paths::{rebase, resolved};
pub use settings::Settings;
pub use stats::Stats;
pub use window::{Arrangement, Layer, Pair, WindowDoc};
pub use work::{Work, work_after};
