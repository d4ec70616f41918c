//! Record of the violations of a majorant by free flights.

use glam::Vec3;
use std::sync::atomic::{AtomicU32, Ordering};

/// Maximum ratio μt / μ̄ found by free flights in every cell of a majorant grid.
///
/// Only the maximum is stored, so the record after a set of paths does not depend on the order in which
/// threads trace them.
#[derive(Debug)]
pub struct Violations {
    cells: usize,
    /// `n³` ratios, x fastest, as bits: for positive numbers the bits have the same order as the numbers.
    largest: Vec<AtomicU32>,
}

impl Violations {
    /// Creates an empty record with `cells` per axis.
    #[must_use]
    pub fn none(cells: usize) -> Self {
        let cells = cells.max(1);
        let bits = || AtomicU32::new(1.0f32.to_bits());
        Self { cells, largest: std::iter::repeat_with(bits).take(cells.pow(3)).collect() }
    }

    /// Cells per axis.
    #[must_use]
    pub fn cells(&self) -> usize {
        self.cells
    }

    /// Records a ratio at a point of the unit cube.
    #[cold]
    pub fn note(&self, unit: Vec3, quotient: f32) {
        let n = self.cells;
        let [x, y, z] = (unit * n as f32).to_array().map(|x| (x as usize).min(n - 1));
        if quotient.is_finite() && quotient > 1.0 {
            self.largest[x + n * (y + n * z)].fetch_max(quotient.to_bits(), Ordering::Relaxed);
        }
    }

    /// Maximum ratio found in a cell; 1 if the majorant was never exceeded there.
    #[must_use]
    pub fn largest(&self, [x, y, z]: [usize; 3]) -> f32 {
        let n = self.cells;
        let bits = self.largest.get(x + n * (y + n * z)).map(|bits| bits.load(Ordering::Relaxed));
        bits.map_or(1.0, f32::from_bits)
    }

    /// Number of cells in which the majorant was exceeded.
    #[must_use]
    pub fn exceeded_cells(&self) -> usize {
        self.largest.iter().filter(|bits| f32::from_bits(bits.load(Ordering::Relaxed)) > 1.0).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_of_a_cell_is_kept() {
        let violations = Violations::none(2);
        assert_eq!(violations.exceeded_cells(), 0);
        for (x, quotient) in [(0.1, 1.5), (0.4, 2.5), (0.2, 2.0), (0.9, 0.5), (0.8, f32::NAN)] {
            violations.note(Vec3::new(x, 0.7, 1.0), quotient);
        }
        assert_eq!(violations.largest([0, 1, 1]), 2.5);
        assert_eq!((violations.largest([1, 1, 1]), violations.largest([0, 0, 0])), (1.0, 1.0));
        assert_eq!(violations.exceeded_cells(), 1);
    }
}
