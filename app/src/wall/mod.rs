//! Comparison of one to eight views of the scene: images, reference, statistics and verdicts.
//!
//! ```text
//!   document ──► slots (one view of the session each) ──► images, maps          (tone mapper's thread)
//!        ▲                                           └──► statistics, verdicts  (analysis thread)
//!        └── WallEdit ◄── bar, cells, dock
//! ```
//!
//! | file | does |
//! | --- | --- |
//! | `slot.rs` | assignment of session views to views of the document |
//! | `state.rs`, `state/pictures.rs` | views, textures and statistics between frames |
//! | `reference.rs` | reference of the errors |
//! | `analysis.rs`, `provenance.rs` | statistics, and the images that they describe |
//! | `bar.rs`, `cells.rs`, `caption.rs`, `legend.rs` | toolbar, images, captions and colour scale |
//! | `dock/` | tabs, one per file: ranking, curves, pixel, scanline, path, ray, contributions, noise |
//! | `inspector.rs` | state of the tabs for paths, rays, contributions and noise |
//! | `presets.rs` | predefined comparisons |

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
