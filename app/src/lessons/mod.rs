//! Lessons: short texts that control the window, in steps to predict, see or explain a result.
//!
//! ```text
//!   Markdown file ──► Lesson (steps with settings) ──► Player (current step) ──► commands to the window
//! ```
//!
//! | file | does |
//! | --- | --- |
//! | `lesson.rs` | file format |
//! | `shelf.rs` | embedded lessons and those of a folder |
//! | `player.rs` | open lesson and the column that shows it |
//! | `prose.rs` | layout of Markdown paragraphs, lists and equations |
//! | `equation.rs` | rasterization of TeX |
//! | `live.rs` | measured numbers in the text |

mod equation;
mod lesson;
mod live;
mod player;
mod prose;
mod shelf;

pub use lesson::{Lesson, LessonError, RaySet, Stage, Step, Stop};
pub use live::Live;
pub use player::{Player, player_ui};
pub use shelf::{embedded, in_folder};
