//! Small parts that panels are made of. Every one has a name for screen readers and tests.

mod callout;
mod choice;
mod path_field;
mod phase_lobe;
mod row;
pub mod section;
mod spectrum_editor;
mod spectrum_model;
mod spectrum_plot;
mod text;
mod value;
mod vector;

pub use callout::{badge, callout, hint};
pub use choice::{segmented, switch};
pub use path_field::path_field;
pub use phase_lobe::phase_lobe;
pub use row::row;
pub use spectrum_editor::{SpectrumField, spectrum_editor};
pub use spectrum_model::Kind as SpectrumKind;
pub use text::buffered_text;
pub use value::{Value, format_number, optional, parse_number};
pub use vector::Vector;
