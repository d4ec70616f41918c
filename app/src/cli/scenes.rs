//! `majorant scenes`: names and summaries of the embedded scenes.

use super::{Failure, print_line};
use majorant_core::io::embedded::SCENES;

pub(super) fn run() -> Result<(), Failure> {
    let width = SCENES.iter().map(|s| s.name.len()).max().unwrap_or(0);
    for scene in SCENES {
        print_line(&format!("{:width$}  {}", scene.name, scene.summary()))?;
    }
    Ok(())
}
