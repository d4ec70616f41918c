//! Profiles whose optical depth is known in closed form, for tests, tables and the interactive bench.

use super::{Piece, Profile};
use crate::math;
use crate::medium::MajorantSegment;
use crate::spectrum::Sampled;
use statrs::function::erf::erf;
use std::f64::consts::{PI, SQRT_2, TAU};

/// Extinction as a function of x in [0, 1], at most 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// 1.
    Constant,
    /// x.
    Ramp,
    /// exp(−(x − ½)²/(2 s²)), s = 0.1.
    Gaussian,
    /// ½ (1 + cos(2π · 3.3 x)): without a symmetry that uniform steps could exploit.
    Cosine,
    /// 1, and 0 for 0.37 < x < 0.61.
    Hole,
}

const WIDTH: f64 = 0.1;
const WAVES: f64 = 3.3;
const HOLE: [f64; 2] = [0.37, 0.61];

impl Shape {
    /// All shapes.
    pub const ALL: [Self; 5] = [Self::Constant, Self::Ramp, Self::Gaussian, Self::Cosine, Self::Hole];

    /// Display name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Constant => "constant",
            Self::Ramp => "ramp",
            Self::Gaussian => "gaussian",
            Self::Cosine => "cosine",
            Self::Hole => "hole",
        }
    }

    /// Value at x.
    #[must_use]
    #[inline]
    pub fn value(self, x: f32) -> f32 {
        match self {
            Self::Constant => 1.0,
            Self::Ramp => x,
            Self::Gaussian => {
                let z = (x - 0.5) / WIDTH as f32;
                math::exp(-0.5 * z * z)
            }
            Self::Cosine => 0.5 + 0.5 * math::sin_cos_turns((WAVES as f32 * x).fract().abs()).1,
            Self::Hole => f32::from(!(HOLE[0] as f32..HOLE[1] as f32).contains(&x)),
        }
    }

    /// Integral of the value from 0 to x.
    #[must_use]
    pub fn integral(self, x: f64) -> f64 {
        match self {
            Self::Constant => x,
            Self::Ramp => 0.5 * x * x,
            Self::Gaussian => {
                let half = |x: f64| erf((x - 0.5) / (WIDTH * SQRT_2));
                WIDTH * (0.5 * PI).sqrt() * (half(x) - half(0.0))
            }
            Self::Cosine => 0.5 * x + (TAU * WAVES * x).sin() / (2.0 * TAU * WAVES),
            Self::Hole => x - (x.clamp(HOLE[0], HOLE[1]) - HOLE[0]),
        }
    }

    /// Smallest and largest value over [a, b].
    #[must_use]
    pub fn range(self, a: f32, b: f32) -> (f32, f32) {
        let (at_a, at_b) = (self.value(a), self.value(b));
        let (low, high) = (at_a.min(at_b), at_a.max(at_b));
        let holds = |x: f64| f64::from(a) <= x && x <= f64::from(b);
        match self {
            Self::Constant | Self::Ramp => (low, high),
            Self::Gaussian => (low, if holds(0.5) { 1.0 } else { high }),
            Self::Cosine => {
                // Crests at whole periods, troughs half a period later.
                let met = |offset: f64| {
                    let wave = |x: f32| f64::from(x) * WAVES - offset;
                    wave(a).ceil() <= wave(b).floor()
                };
                (if met(0.5) { 0.0 } else { low }, if met(0.0) { 1.0 } else { high })
            }
            Self::Hole => {
                let full = f64::from(a) >= HOLE[0] && f64::from(b) <= HOLE[1];
                let none = f64::from(b) <= HOLE[0] || f64::from(a) >= HOLE[1];
                (f32::from(none), f32::from(!full))
            }
        }
    }
}

/// Shapes along a ray, one per component, with bounds over cells of equal length.
#[derive(Clone, Copy, Debug)]
pub struct Analytic<const N: usize> {
    /// Shape of each component and its largest extinction, per scene unit.
    pub components: [(Shape, f32); N],
    /// Length in scene units.
    pub length: f32,
    /// Number of cells with a majorant, minorant and mean each; at least 1.
    pub cells: u32,
    /// Majorant relative to the least upper bound; below 1 it is not a bound.
    pub majorant_factor: f32,
}

impl<const N: usize> Analytic<N> {
    /// Creates a profile with the same shape for all components.
    #[must_use]
    pub fn new(shape: Shape, extinction: [f32; N], cells: u32) -> Self {
        Self { components: extinction.map(|e| (shape, e)), length: 1.0, cells, majorant_factor: 1.0 }
    }

    /// Optical depth ∫μ dt per component.
    #[must_use]
    pub fn optical_depth(&self) -> [f64; N] {
        let length = f64::from(self.length);
        self.components.map(|(shape, extinction)| f64::from(extinction) * length * shape.integral(1.0))
    }

    /// Transmittance exp(−∫μ dt) per component.
    #[must_use]
    pub fn transmittance(&self) -> [f64; N] {
        self.optical_depth().map(|depth| (-depth).exp())
    }

    fn piece(&self, cell: u32) -> Piece<N> {
        let cells = self.cells.max(1);
        let [a, b] = [cell, cell + 1].map(|edge| edge as f32 / cells as f32);
        let of = |f: &dyn Fn(Shape) -> f32| Sampled(self.components.map(|(shape, scale)| scale * f(shape)));
        let mean = |shape: Shape| {
            let [a, b] = [f64::from(a), f64::from(b)];
            ((shape.integral(b) - shape.integral(a)) / (b - a)) as f32
        };
        Piece {
            segment: MajorantSegment {
                t0: a * self.length,
                t1: b * self.length,
                majorant: of(&|shape| shape.range(a, b).1) * self.majorant_factor,
                clamp_null: false,
                watched: false,
            },
            minorant: of(&|shape| shape.range(a, b).0),
            mean: of(&mean),
        }
    }
}

impl<const N: usize> Profile<N> for Analytic<N> {
    type Pieces<'a> = AnalyticPieces<'a, N>;

    fn pieces(&self) -> AnalyticPieces<'_, N> {
        AnalyticPieces { profile: self, next: 0 }
    }

    #[inline]
    fn extinction(&self, t: f32, _piece: &Piece<N>) -> Sampled<N> {
        let x = t / self.length;
        Sampled(self.components.map(|(shape, scale)| scale * shape.value(x)))
    }
}

/// The non-empty cells of an [`Analytic`].
#[derive(Clone, Debug)]
pub struct AnalyticPieces<'a, const N: usize> {
    profile: &'a Analytic<N>,
    next: u32,
}

impl<const N: usize> Iterator for AnalyticPieces<'_, N> {
    type Item = Piece<N>;

    fn next(&mut self) -> Option<Piece<N>> {
        while self.next < self.profile.cells.max(1) {
            let piece = self.profile.piece(self.next);
            self.next += 1;
            if !piece.segment.majorant.is_zero() {
                return Some(piece);
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integrals_are_those_of_the_values_and_ranges_hold_them() {
        let n = 200_000u32;
        for shape in Shape::ALL {
            let (a, b) = (0.07f32, 0.93f32);
            let step = f64::from(b - a) / f64::from(n);
            let place = |i: u32| f64::from(a) + (f64::from(i) + 0.5) * step;
            let sum: f64 = (0..n).map(|i| f64::from(shape.value(place(i) as f32)) * step).sum();
            let exact = shape.integral(b.into()) - shape.integral(a.into());
            assert!((sum / exact - 1.0).abs() < 2e-5, "{shape:?}: {sum} {exact}");
            for cells in [1, 3, 5, 16] {
                let profile = Analytic::new(shape, [2.0], cells);
                for piece in profile.pieces() {
                    for i in 0..=1000u16 {
                        let t = piece.segment.t0 + piece.length() * f32::from(i) / 1000.0;
                        let [value] = profile.extinction(t, &piece).0;
                        // At a face the value may be that of the neighbouring cell.
                        let face = i == 0 || i == 1000;
                        let within =
                            piece.minorant[0] - 1e-5 <= value && value <= piece.segment.majorant[0] + 1e-5;
                        assert!(within || (face && shape == Shape::Hole), "{shape:?} {cells} {t}");
                    }
                }
                let mean: f64 = profile.pieces().map(|p| f64::from(p.mean[0] * p.length())).sum();
                let depth = profile.optical_depth()[0];
                assert!((mean / depth - 1.0).abs() < 1e-5, "{shape:?} {cells}: {mean} {depth}");
            }
        }
    }
}
