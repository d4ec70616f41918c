//! Tabulated phase function.
//!
//! It is linear in cos θ between points, constant beyond the first and last, and scaled to integrate to 1
//! over the sphere.

use super::Lobe;
use crate::math::PolarAngle;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;
use std::sync::Arc;

/// Largest number of points of a table.
pub const MAX_POINTS: usize = 65_536;

/// Meaning of a table's first column.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Angle {
    /// The cosine of the scattering angle, −1 (backward) to 1 (forward).
    #[default]
    Cosine,
    /// The scattering angle in degrees, 0 (forward) to 180 (backward).
    Degrees,
}

impl Angle {
    /// Range of valid values.
    #[must_use]
    pub fn range(self) -> [f32; 2] {
        match self {
            Self::Cosine => [-1.0, 1.0],
            Self::Degrees => [0.0, 180.0],
        }
    }

    /// 1 − cos θ, precise for small angles.
    fn one_minus_cos(self, value: f32) -> f64 {
        match self {
            Self::Cosine => 1.0 - f64::from(value),
            Self::Degrees => 2.0 * (0.5 * f64::from(value).to_radians()).sin().powi(2),
        }
    }
}

/// Reason why points are not a valid phase function.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum TableError {
    /// Fewer than two points.
    #[error("has {0} points; a table needs at least two")]
    TooFew(usize),
    /// More points than [`MAX_POINTS`].
    #[error("has {0} points; at most {MAX_POINTS} are supported")]
    TooMany(usize),
    /// A number that is NaN or infinite.
    #[error("point {0} has a number that is not finite")]
    NotFinite(usize),
    /// A value below zero.
    #[error("point {0} has the value {1}; a phase function must not be negative")]
    Negative(usize, f32),
    /// An angle outside the valid range.
    #[error("point {0} is at {1}, outside {2} to {3}")]
    Outside(usize, f32, f32, f32),
    /// An angle that is not greater than the one before.
    #[error("point {0} is at {1}, which is not beyond the point before it: the first numbers must increase")]
    NotRising(usize, f32),
    /// All values are zero.
    #[error("has the value 0 everywhere, which cannot be scaled to integrate to 1")]
    Dark,
}

/// One point, with the share of the distribution before it.
#[derive(Clone, Copy, Debug)]
struct Node {
    /// 1 − cos θ, increasing.
    one_minus_cos: f32,
    /// Value per steradian.
    value: f32,
    /// Probability of scattering at smaller angles.
    share: f32,
}

/// Tabulated phase function.
#[derive(Clone, Debug)]
pub(super) struct Table {
    /// Nodes from 1 − cos θ = 0 to 2, at least two.
    nodes: Arc<[Node]>,
    mean_cosine: f32,
}

/// Checks whether points are a valid phase function.
///
/// # Errors
/// The first fault found; points are counted from 1.
pub fn check(angle: Angle, points: &[[f32; 2]]) -> Result<(), TableError> {
    if points.len() < 2 {
        return Err(TableError::TooFew(points.len()));
    }
    if points.len() > MAX_POINTS {
        return Err(TableError::TooMany(points.len()));
    }
    let [lo, hi] = angle.range();
    let mut before = f32::NEG_INFINITY;
    for (number, [at, value]) in (1..).zip(points.iter().copied()) {
        if !at.is_finite() || !value.is_finite() {
            return Err(TableError::NotFinite(number));
        }
        if value < 0.0 {
            return Err(TableError::Negative(number, value));
        }
        if !(lo..=hi).contains(&at) {
            return Err(TableError::Outside(number, at, lo, hi));
        }
        if at <= before {
            return Err(TableError::NotRising(number, at));
        }
        before = at;
    }
    if points.iter().all(|[_, value]| *value == 0.0) {
        return Err(TableError::Dark);
    }
    Ok(())
}

impl Table {
    /// Builds the table, scaled to integrate to 1.
    ///
    /// # Errors
    /// The first fault of the points, as in [`check`].
    pub fn new(angle: Angle, points: &[[f32; 2]]) -> Result<Self, TableError> {
        check(angle, points)?;
        let mut rows: Vec<(f64, f64)> =
            points.iter().map(|[at, value]| (angle.one_minus_cos(*at), f64::from(*value))).collect();
        rows.sort_by(|a, b| a.0.total_cmp(&b.0));
        // Angles that differ by less than the rounding of a cosine are merged.
        rows.dedup_by(|b, a| b.0 as f32 <= a.0 as f32);
        if let (Some(first), Some(last)) = (rows.first().copied(), rows.last().copied()) {
            if first.0 > 0.0 {
                rows.insert(0, (0.0, first.1));
            }
            if (last.0 as f32) < 2.0 {
                rows.push((2.0, last.1));
            }
        }
        // Linear pieces from a to b over a width w:
        // ∫ p = w (a + b)/2, ∫ x p = w (x₀ (2 a + b) + x₁ (a + 2 b))/6.
        let pieces = |p: &[(f64, f64)]| match *p {
            [(x0, a), (x1, b)] => {
                ((x1 - x0) * (a + b) / 2.0, (x1 - x0) * (x0 * (2.0 * a + b) + x1 * (a + 2.0 * b)) / 6.0)
            }
            _ => (0.0, 0.0),
        };
        let (total, moment) =
            rows.windows(2).map(pieces).fold((0.0, 0.0), |(s, m), (ds, dm)| (s + ds, m + dm));
        if total.is_nan() || total <= 0.0 {
            return Err(TableError::Dark);
        }
        let mut below = 0.0;
        let mut nodes = Vec::with_capacity(rows.len());
        for (i, (x, value)) in rows.iter().enumerate() {
            nodes.push(Node {
                one_minus_cos: *x as f32,
                value: (value / (TAU * total)) as f32,
                share: (below / total) as f32,
            });
            below += rows.get(i..i + 2).map_or(0.0, |p| pieces(p).0);
        }
        Ok(Self { nodes: nodes.into(), mean_cosine: (1.0 - moment / total) as f32 })
    }

    /// Piece whose first node is the last one for which `before` is true.
    #[inline]
    fn piece(&self, before: impl Fn(&Node) -> bool) -> (&Node, &Node) {
        let last = self.nodes.len() - 1;
        let next = self.nodes.partition_point(before).clamp(1, last);
        (&self.nodes[next - 1], &self.nodes[next])
    }
}

impl Lobe for Table {
    #[inline(never)]
    fn value(&self, theta: PolarAngle) -> f32 {
        let x = theta.one_minus_cos;
        let (a, b) = self.piece(|node| node.one_minus_cos <= x);
        let s = ((x - a.one_minus_cos) / (b.one_minus_cos - a.one_minus_cos)).clamp(0.0, 1.0);
        a.value + (b.value - a.value) * s
    }

    /// Inverts the cumulative distribution, which is quadratic within a piece.
    #[inline(never)]
    fn sample(&self, u: f32) -> PolarAngle {
        let (a, b) = self.piece(|node| node.share <= u);
        // a y + (b − a) y²/2 = rest, with the form of the root that is stable for a = b.
        let rest = ((u - a.share) / (b.share - a.share)).clamp(0.0, 1.0) * 0.5 * (a.value + b.value);
        let root = (a.value * a.value + 2.0 * (b.value - a.value) * rest).max(0.0).sqrt();
        let y = if a.value + root > 0.0 { (2.0 * rest / (a.value + root)).min(1.0) } else { 0.0 };
        let width = b.one_minus_cos - a.one_minus_cos;
        let x = a.one_minus_cos + width * y;
        // Rounding must not put a sample at an end where the density is zero; it moves to the middle instead.
        let lost = (x == a.one_minus_cos && a.value == 0.0) || (x == b.one_minus_cos && b.value == 0.0);
        PolarAngle::from_one_minus_cos(if lost { a.one_minus_cos + 0.5 * width } else { x })
    }

    fn mean_cosine(&self) -> f32 {
        self.mean_cosine
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_that_make_no_phase_function_are_refused() {
        let is = |points: &[[f32; 2]], error| assert_eq!(check(Angle::Cosine, points), Err(error));
        is(&[], TableError::TooFew(0));
        is(&[[0.0, 1.0]], TableError::TooFew(1));
        is(&[[-1.0, 1.0], [0.0, f32::INFINITY]], TableError::NotFinite(2));
        is(&[[-1.0, 1.0], [0.0, -0.5]], TableError::Negative(2, -0.5));
        is(&[[-1.0, 1.0], [1.5, 1.0]], TableError::Outside(2, 1.5, -1.0, 1.0));
        is(&[[-1.0, 1.0], [0.5, 1.0], [0.5, 2.0]], TableError::NotRising(3, 0.5));
        is(&[[-1.0, 0.0], [0.5, 0.0]], TableError::Dark);
        assert!(matches!(
            check(Angle::Cosine, &[[f32::NAN, 1.0], [0.5, 1.0]]),
            Err(TableError::NotFinite(1))
        ));
        assert_eq!(
            check(Angle::Degrees, &[[0.0, 1.0], [190.0, 1.0]]),
            Err(TableError::Outside(2, 190.0, 0.0, 180.0))
        );
        assert_eq!(
            check(Angle::Cosine, &vec![[0.0, 1.0]; MAX_POINTS + 1]),
            Err(TableError::TooMany(MAX_POINTS + 1))
        );
    }

    #[test]
    fn values_are_linear_scaled_and_held_beyond_the_ends() {
        // From 1 (backward) to 3 (forward): mean 2.
        let table = Table::new(Angle::Cosine, &[[-1.0, 1.0], [1.0, 3.0]]).unwrap();
        let at = |t: &Table, c: f32| f64::from(t.value(PolarAngle::from_one_minus_cos(1.0 - c))) * 2.0 * TAU;
        for (c, expected) in [(-1.0, 0.5), (0.0, 1.0), (0.5, 1.25), (1.0, 1.5)] {
            assert!((at(&table, c) - expected).abs() < 1e-6, "{c}");
        }
        // ∫ (1 + c/2) c dc / 2 = 1/6.
        assert!((table.mean_cosine() - 1.0 / 6.0).abs() < 1e-6);
        let held = Table::new(Angle::Cosine, &[[-0.5, 1.0], [0.5, 1.0]]).unwrap();
        assert!([-1.0, -0.7, 0.0, 1.0].iter().all(|c| (at(&held, *c) - 1.0).abs() < 1e-6));
        let by_degrees = Table::new(Angle::Degrees, &[[0.0, 3.0], [60.0, 2.5], [180.0, 1.0]]).unwrap();
        for c in [-1.0, -0.2, 0.5, 0.9] {
            assert!((at(&by_degrees, c) - at(&table, c)).abs() < 1e-6, "{c}");
        }
    }

    #[test]
    fn samples_split_the_lobe_where_the_share_is_theirs() {
        let points = [[-1.0, 0.0], [-0.4, 2.0], [0.0, 0.0], [0.2, 0.0], [0.9, 5.0], [1.0, 40.0]];
        let table = Table::new(Angle::Cosine, &points).unwrap();
        for i in 0..200u16 {
            let u = (f32::from(i) + 0.5) / 200.0;
            let end = f64::from(table.sample(u).one_minus_cos);
            let n = 20_000;
            let step = end / f64::from(n);
            let value = |x: f64| f64::from(table.value(PolarAngle::from_one_minus_cos(x as f32)));
            let below: f64 = (0..n).map(|j| TAU * value(step * (f64::from(j) + 0.5)) * step).sum();
            assert!((below - f64::from(u)).abs() < 1e-4, "{u}: {below}");
        }
        for u in [0.0, 0.999_999_94] {
            assert!(table.value(table.sample(u)).is_finite());
        }
    }
}
