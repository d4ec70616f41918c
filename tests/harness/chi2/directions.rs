//! χ² test of directions on the sphere, with bins adapted to the samples.
//!
//! The axis of the frame is the direction of highest concentration, its range the widest sample. Rings about
//! the axis and sectors of each ring have their edges at quantiles of a pilot run, so that every bin has
//! about as many samples, whether the density is a sharp peak, a small sun in a bright sky, or uniform.
//! The density is integrated over each bin at sub-points that follow the same quantiles.

use super::Family;
use glam::{DVec3, Vec3};
use std::f64::consts::PI;

const PILOT: usize = 65_536;
const SAMPLES: usize = 200_000;
const RINGS: usize = 16;
const SECTORS: usize = 16;
/// Strata per ring and per sector; a stratum of a ring has three sub-points, one of a sector has one.
const PER_RING: usize = 12;
const PER_SECTOR: usize = 12;
/// Nodes and weights of Gauss–Legendre quadrature over 0 to 1.
const GAUSS: [(f64, f64); 3] = [(0.112_701_665, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.887_298_335, 5.0 / 18.0)];

/// Polar coordinates about an axis: y = ln(1 + (1 − cos θ)/c) for the median c of 1 − cos θ, which
/// resolves both a needle and its tail, and the azimuth φ.
struct Polar {
    axis: DVec3,
    u: DVec3,
    v: DVec3,
    c: f64,
}

impl Polar {
    fn about(pilot: &[DVec3]) -> Self {
        // The mean direction, iterated towards the principal axis: two opposite lobes have no mean.
        let mut axis = pilot.iter().sum::<DVec3>().normalize();
        for _ in 0..8 {
            axis = pilot.iter().map(|d| d * d.dot(axis)).sum::<DVec3>().normalize();
        }
        let (u, v) = axis.any_orthonormal_pair();
        let mut offsets: Vec<f64> = pilot.iter().map(|d| 0.5 * (d - axis).length_squared()).collect();
        offsets.sort_by(f64::total_cmp);
        Self { axis, u, v, c: offsets[PILOT / 2] }
    }

    fn of(&self, d: &DVec3) -> [f64; 2] {
        let offset = 0.5 * (d - self.axis).length_squared();
        [(offset / self.c).ln_1p(), d.dot(self.v).atan2(d.dot(self.u))]
    }

    /// Direction of a point, and its solid angle per dy dφ.
    fn direction(&self, y: f64, phi: f64) -> (DVec3, f64) {
        let offset = (self.c * y.exp_m1()).min(2.0);
        let sin = (offset * (2.0 - offset)).sqrt();
        let across = self.u * phi.cos() + self.v * phi.sin();
        (self.axis * (1.0 - offset) + across * sin, self.c * y.exp())
    }
}

/// One coordinate, divided into bins with equal numbers of pilot samples, and each bin into strata.
struct Axis {
    bins: Vec<f64>,
    strata: Vec<f64>,
}

impl Axis {
    fn new(mut pilot: Vec<f64>, (lo, hi): (f64, f64), bins: usize, per_bin: usize) -> Self {
        pilot.sort_by(f64::total_cmp);
        let count = bins * per_bin;
        let at = |i: usize| i * pilot.len() / count;
        let edge = |i: usize| if i == 0 { lo } else { pilot.get(at(i)).copied().unwrap_or(hi).min(hi) };
        let mut strata = Vec::new();
        for i in 0..count {
            split(&pilot[at(i)..at(i + 1)], edge(i), edge(i + 1), &mut strata);
        }
        strata.push(hi);
        Self { bins: (0..=bins).map(|i| edge(i * per_bin)).collect(), strata }
    }

    /// Index of the bin of a value.
    fn bin(&self, value: f64) -> usize {
        self.bins.partition_point(|e| *e <= value).clamp(1, self.bins.len() - 1) - 1
    }
}

/// Splits a stratum at the median of its samples until these are evenly distributed, so that edges of the
/// density, such as those of a rectangle or a bright texel, are resolved.
fn split(samples: &[f64], lo: f64, hi: f64, strata: &mut Vec<f64>) {
    let (before, after) = samples.split_at(samples.len() / 2);
    match after.first() {
        Some(median) if samples.len() > 1 && !(0.25..0.75).contains(&((median - lo) / (hi - lo))) => {
            split(before, lo, *median, strata);
            split(after, *median, hi, strata);
        }
        _ => strata.push(lo),
    }
}

impl Family {
    /// Tests directions against their density per steradian, which must integrate to one and be positive
    /// at every sample. Returns the mean direction ∫ density · direction.
    pub fn directions(
        &mut self,
        name: &str,
        mut sample: impl FnMut() -> Vec3,
        density: impl Fn(Vec3) -> f32,
    ) -> DVec3 {
        let mut draw = |count: usize| -> Vec<DVec3> {
            let checked = |d: Vec3| {
                assert!((d.length() - 1.0).abs() < 1e-5, "{name}: a direction of length {}", d.length());
                d.as_dvec3().normalize()
            };
            (0..count).map(|_| checked(sample())).collect()
        };
        let (pilot, samples) = (draw(PILOT), draw(SAMPLES));
        let polar = Polar::about(&pilot);
        for d in &samples {
            // A sample on the edge of the support may be rounded out of it: test a point further in, too.
            let inward = (d + (polar.axis - d) * 2e-3).normalize().as_vec3();
            let inside = density(d.as_vec3()) > 0.0 || density(inward) > 0.0;
            assert!(inside, "{name}: a sample at {d}, where the density is zero");
        }

        let place =
            |directions: &[DVec3]| -> Vec<[f64; 2]> { directions.iter().map(|d| polar.of(d)).collect() };
        let (pilot, samples) = (place(&pilot), place(&samples));
        let widest = pilot.iter().chain(&samples).map(|p| p[0]).fold(0.0, f64::max);
        let rings = Axis::new(pilot.iter().map(|p| p[0]).collect(), (0.0, widest), RINGS, PER_RING);
        let sectors: Vec<Axis> = (0..RINGS)
            .map(|ring| {
                let inside = pilot.iter().filter(|p| rings.bin(p[0]) == ring);
                Axis::new(inside.map(|p| p[1]).collect(), (-PI, PI), SECTORS, PER_SECTOR)
            })
            .collect();

        let mut observed = vec![0; RINGS * SECTORS];
        for [y, phi] in samples {
            let ring = rings.bin(y);
            observed[ring * SECTORS + sectors[ring].bin(phi)] += 1;
        }
        let mut shares = vec![0.0; RINGS * SECTORS];
        let mut mean = DVec3::ZERO;
        for y in rings.strata.windows(2) {
            let ring = rings.bin(0.5 * (y[0] + y[1]));
            for phi in sectors[ring].strata.windows(2) {
                let middle = 0.5 * (phi[0] + phi[1]);
                let bin = ring * SECTORS + sectors[ring].bin(middle);
                for (node, weight) in GAUSS {
                    let (d, per) = polar.direction(y[0] + (y[1] - y[0]) * node, middle);
                    let solid_angle = per * weight * (y[1] - y[0]) * (phi[1] - phi[0]);
                    let share = f64::from(density(d.as_vec3())) * solid_angle;
                    shares[bin] += share;
                    mean += d * share;
                }
            }
        }
        let integral: f64 = shares.iter().sum();
        assert!((integral - 1.0).abs() < 3e-3, "{name}: the density integrates to {integral}");
        self.chi2(name, &observed, &shares);
        mean
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use majorant_core::math::{Frame, PolarAngle, Sampler};
    use majorant_core::phase::{Phase, PhaseDoc};
    use std::f32::consts::TAU;
    use std::panic::{AssertUnwindSafe, catch_unwind};

    fn lobe(g: f32) -> Phase {
        Phase::new(&PhaseDoc::HenyeyGreenstein { g })
    }

    /// Whether directions drawn by `sample` pass the test against `density`.
    fn passes(mut sample: impl FnMut(&mut Sampler) -> Vec3, density: impl Fn(Vec3) -> f32) -> bool {
        let mut sampler = Sampler::new(1, 2, 3);
        let test = || {
            let mut family = Family::default();
            family.directions("test", || sample(&mut sampler), density);
            family.judge();
        };
        catch_unwind(AssertUnwindSafe(test)).is_ok()
    }

    #[test]
    fn a_slightly_other_lobe_is_caught() {
        for (g, other) in [(0.5, 0.48), (-0.9, -0.905), (0.999, 0.99905)] {
            let draw = |s: &mut Sampler| lobe(g).sample(Vec3::X, s.next_2d()).0;
            assert!(passes(draw, |d| lobe(g).density(Vec3::X, d)));
            assert!(!passes(draw, |d| lobe(other).density(Vec3::X, d)), "{g} passes for {other}");
        }
    }

    /// Uniform density over a spherical cap, zero outside.
    #[test]
    fn a_cap_that_is_too_narrow_too_wide_or_uneven_is_caught() {
        let frame = Frame::about(Vec3::new(0.6, 0.0, -0.8));
        let cap = |height: f32| {
            move |s: &mut Sampler| {
                frame.polar(PolarAngle::from_one_minus_cos(height * s.next_1d()), s.next_1d())
            }
        };
        let axis = frame.to_world(Vec3::Z);
        let inside = |d: Vec3| PolarAngle::between(axis, d).one_minus_cos < 1e-3;
        let density = |d: Vec3| if inside(d) { 1e3 / TAU } else { 0.0 };
        assert!(passes(cap(1e-3), density));
        assert!(!passes(cap(0.99e-3), density));
        assert!(!passes(cap(1.01e-3), density));
        let turned = |s: &mut Sampler| {
            let turn = 0.97 * s.next_1d();
            frame.polar(PolarAngle::from_one_minus_cos(1e-3 * s.next_1d()), turn)
        };
        assert!(!passes(turned, density));
    }
}
