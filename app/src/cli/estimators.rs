//! `majorant estimators`: ids and summaries of the estimators.

use super::{Failure, print_line};
use majorant_core::estimator::REGISTRY;

pub(super) fn run() -> Result<(), Failure> {
    let width = REGISTRY.iter().map(|e| e.id.len()).max().unwrap_or(0);
    for entry in REGISTRY {
        print_line(&format!("{:width$}  {}  [{}]", entry.id, entry.summary, entry.reference))?;
    }
    Ok(())
}
