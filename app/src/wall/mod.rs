//! The wall: one to eight views of the scene, what they are held against, and what comes of it.
//!
//! ```text
//!   document ──► slots (one view of the session each) ──► pictures, maps   (developer's thread)
//!        ▲                                           └──► numbers, verdicts (analyst's thread)
//!        └── WallEdit ◄── bar, cells, dock
//! ```
//!
//! | file | does |
//! | --- | --- |
//! | `slot.rs` | which view of the session renders which view of the document |
//! | `edit.rs` | what a comparison can be asked to become |
//! | `reference.rs` | what errors are measured against |
//! | `analysis.rs`, `provenance.rs` | the numbers, and which pictures they describe |
//! | `bar.rs`, `cells.rs`, `caption.rs`, `legend.rs` | what is seen of it |
//! | `dock/` | ranking, curves, the samples of a pixel, a scanline, a path, an image's parts; one tab a file |
//! | `inspector.rs`, `errand.rs` | what tabs about single paths hold, and the threads that work it out |

pub mod analysis;
mod bar;
mod caption;
mod cells;
pub mod dock;
pub mod inspector;
mod legend;
pub mod presets;
mod provenance;
mod reference;
mod slot;
mod state;

pub use provenance::Provenance;
pub use reference::{ReferenceId, ReferenceState};
pub use slot::Slot;
pub use state::{Tool, Wall};
