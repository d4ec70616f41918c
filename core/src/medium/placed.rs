//! Media placed in a scene.

use super::{AnyMedium, Region, Violations};
use std::sync::Arc;

/// Medium with the region that it fills.
#[derive(Clone, Debug)]
pub struct PlacedMedium {
    /// The medium.
    pub medium: AnyMedium,
    /// Region that it fills.
    pub region: Region,
    /// Violations of its majorant found by free flights.
    pub violations: Arc<Violations>,
}

impl PlacedMedium {
    /// Creates a placed medium with an empty record of violations.
    #[must_use]
    pub fn new(medium: AnyMedium, region: Region) -> Self {
        let cells = medium.majorant_cells().map_or(1, |cells| cells.cells());
        Self { medium, region, violations: Arc::new(Violations::none(cells)) }
    }

    /// Returns the same medium with an empty record of violations.
    #[must_use]
    pub fn without_violations(&self) -> Self {
        Self { violations: Arc::new(Violations::none(self.violations.cells())), ..self.clone() }
    }

    /// Returns whether free flights have found violations of a majorant that is raised where it is exceeded.
    #[must_use]
    pub fn must_be_raised(&self) -> bool {
        self.medium.is_progressive() && self.violations.exceeded_cells() > 0
    }

    /// Returns the medium with its majorant raised by all recorded violations, and an empty record.
    #[must_use]
    pub fn raised(&self) -> Self {
        let raised = self.without_violations();
        if self.must_be_raised() {
            Self { medium: self.medium.raised(&self.violations), ..raised }
        } else {
            raised
        }
    }
}
