//! Lessons: short texts that drive the lab, each step to predict, to see, or to explain.
//!
//! ```text
//!   a Markdown file ──► Lesson (steps with what they set) ──► Player (which step) ──► commands to the lab
//! ```
//!
//! | file | does |
//! | --- | --- |
//! | `lesson.rs` | the file format |
//! | `shelf.rs` | the embedded lessons, and those of a folder |
//! | `player.rs` | which lesson is open, and the column that shows it |
//! | `prose.rs` | Markdown as paragraphs, lists and equations |
//! | `equation.rs` | TeX as pictures |
//! | `live.rs` | numbers in the text, computed when they are read |

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
