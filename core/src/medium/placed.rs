//! Media placed in a scene.

use super::{AnyMedium, Region, Violations};
use crate::math::{BoxRay, Ray};
use crate::surface::Solid;
use smallvec::SmallVec;
use std::sync::Arc;

/// Medium with the region that it fills.
#[derive(Clone, Debug)]
pub struct PlacedMedium {
    /// The medium.
    pub medium: AnyMedium,
    /// Region that it fills.
    pub region: Region,
    /// Transparent bodies that take the medium's place where they are.
    pub displaced_by: Vec<Arc<Solid>>,
    /// Violations of its majorant found by free flights.
    pub violations: Arc<Violations>,
}

impl PlacedMedium {
    /// Creates a placed medium with an empty record of violations.
    #[must_use]
    pub fn new(medium: AnyMedium, region: Region) -> Self {
        let cells = medium.majorant_cells().map_or(1, |cells| cells.cells());
        Self { medium, region, displaced_by: Vec::new(), violations: Arc::new(Violations::none(cells)) }
    }

    /// Returns whether no ray enters the medium more than once.
    #[must_use]
    pub fn is_convex(&self) -> bool {
        self.region.is_convex() && self.displaced_by.is_empty()
    }

    /// Calls `visit` for every stretch of a ray, with 0 ≤ t ≤ t_max, in the medium: in its region and outside
    /// the bodies that displace it. See [`Region::enter`].
    #[inline]
    pub fn stretches(&self, ray: &Ray, t_max: f32, mut visit: impl FnMut(f32, BoxRay)) {
        if self.displaced_by.is_empty() {
            return self.region.stretches(ray, t_max, visit);
        }
        let mut cuts: SmallVec<[[f32; 2]; 4]> = SmallVec::new();
        for solid in &self.displaced_by {
            solid.stretches(ray, |t0, t1| cuts.push([t0, t1]));
        }
        cuts.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
        self.region.stretches(ray, t_max, |t0, inside| {
            let mut part = |from: f32, to: f32| {
                if from < to {
                    let origin = inside.at(from - t0).into();
                    visit(from, BoxRay { origin, t_end: to - from, ..inside });
                }
            };
            let (mut from, end) = (t0, t0 + inside.t_end);
            for [cut, rest] in &cuts {
                part(from, cut.min(end));
                from = from.max(*rest);
            }
            part(from, end);
        });
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
