//! Small parts that panels are made of. Every one has a name for screen readers and tests.

mod callout;
mod choice;
mod keyed;
mod number;
mod path_field;
mod phase_lobe;
mod row;
pub mod section;
mod spectrum;
mod text;
mod value;
mod vector;

pub use callout::{badge, callout, hint};
pub use choice::{segmented, switch};
pub use keyed::key;
pub use number::{format_number, format_within, parse_number};
pub use path_field::path_field;
pub use phase_lobe::phase_lobe;
pub use row::{row, row_of};
pub use spectrum::{SpectrumField, spectrum_editor};
pub use text::buffered_text;
pub use value::{Value, optional_key, whole};
pub use vector::Vector;
