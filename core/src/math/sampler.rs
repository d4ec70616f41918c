//! Random numbers as a pure function of (seed, pixel, sample).

use super::ln;
use glam::{Vec2, Vec3};
use rand_core::RngCore;
use rand_pcg::Pcg32;
use serde::{Deserialize, Serialize};

/// How the samples of a pixel relate to each other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SamplerKind {
    /// Not at all.
    #[default]
    Independent,
    /// The first decisions of a path follow a randomly shifted lattice over the pixel's samples: each sample
    /// is as random as before, together they are spread more evenly. The spread of samples then overstates
    /// the error of their mean.
    Lattice,
}

/// The random numbers of one path, so that a path can be replayed alone and an image does not depend on who
/// traces which path, or when: a PCG stream of its own, and before it, if wanted, a point of a lattice.
#[derive(Clone, Debug)]
pub struct Sampler {
    rng: Pcg32,
    lattice: Option<LatticePoint>,
}

/// A generating vector for up to 2^20 points in base 2, every prefix of 2^k of them being a lattice too (Cools,
/// Kuo and Nuyens 2006, "Constructing embedded lattice rules for multivariate integration").
const GENERATOR: [u32; 51] = [
    1, 182_667, 469_891, 498_753, 110_745, 446_247, 250_185, 118_627, 245_333, 283_199, 408_519, 391_023,
    246_327, 126_539, 399_185, 461_527, 300_343, 69_681, 516_695, 436_179, 106_383, 238_523, 413_283, 70_841,
    47_719, 300_129, 113_029, 123_925, 410_745, 211_325, 17_489, 511_893, 40_767, 186_077, 519_471, 255_369,
    101_819, 243_573, 66_189, 152_143, 503_455, 113_217, 132_603, 463_967, 297_717, 157_383, 224_015,
    502_917, 36_237, 94_049, 170_665,
];

/// Dimensions before the first vertex: place within the pixel, components.
const CAMERA: usize = 3;
/// Dimensions of a vertex, in order: direction, point on a light, light, roulette, then optical depth and
/// event of so many collisions.
const PER_VERTEX: usize = 12;
const COLLISIONS: usize = 3;
const FIRST_COLLISION: usize = PER_VERTEX - 2 * COLLISIONS;
/// Vertices whose decisions are stratified; later ones are too scattered to gain from it.
const STRATIFIED_VERTICES: usize = (GENERATOR.len() - CAMERA) / PER_VERTEX;

/// A point of a shifted lattice, of which a path has used some dimensions.
#[derive(Clone, Debug)]
struct LatticePoint {
    /// The sample's radical inverse in base 2, in units of 2^−32.
    inverse: u32,
    /// What the shifts of all dimensions follow from.
    shift: u32,
    vertex: usize,
    /// Optical depths and events that the vertex has taken.
    flights: usize,
    events: usize,
}

impl LatticePoint {
    #[inline]
    fn at(&self, dimension: usize) -> f32 {
        let shift = (mix(u64::from(self.shift) << 8 | dimension as u64) >> 32) as u32;
        unit(self.inverse.wrapping_mul(GENERATOR[dimension]).wrapping_add(shift))
    }

    #[inline]
    fn of_vertex(&self, which: usize) -> f32 {
        self.at(CAMERA + PER_VERTEX * self.vertex + which)
    }
}

/// A number in [0, 1) from the upper 24 bits.
#[inline]
fn unit(bits: u32) -> f32 {
    (bits >> 8) as f32 * (1.0 / 16_777_216.0)
}

impl Sampler {
    /// Independent numbers for sample number `sample` of pixel number `pixel` under `seed`.
    #[must_use]
    pub fn new(seed: u64, pixel: u64, sample: u64) -> Self {
        let key = mix(mix(seed).wrapping_add(pixel));
        Self { rng: Pcg32::new(mix(key.wrapping_add(sample)), key), lattice: None }
    }

    /// Numbers of a kind for sample number `sample` of pixel number `pixel` under `seed`.
    #[must_use]
    pub fn of_kind(kind: SamplerKind, seed: u64, pixel: u64, sample: u64) -> Self {
        let mut sampler = Self::new(seed, pixel, sample);
        if kind == SamplerKind::Lattice {
            // After the last point of the lattice another one begins.
            let shift = mix(mix(mix(seed) ^ (sample >> 20)).wrapping_add(pixel)) as u32;
            let inverse = (sample as u32 & 0xf_ffff).reverse_bits();
            sampler.lattice = Some(LatticePoint { inverse, shift, vertex: 0, flights: 0, events: 0 });
        }
        sampler
    }

    /// The place within the pixel, and a number that chooses the path's components.
    #[inline]
    pub fn camera(&mut self) -> (Vec2, f32) {
        match &self.lattice {
            Some(point) => (Vec2::new(point.at(0), point.at(1)), point.at(2)),
            None => (self.next_2d(), self.next_1d()),
        }
    }

    /// Begins the decisions that lead to the next vertex.
    #[inline]
    pub fn start_vertex(&mut self) {
        if let Some(point) = &mut self.lattice {
            point.vertex += 1;
            (point.flights, point.events) = (0, 0);
            if point.vertex == STRATIFIED_VERTICES {
                self.lattice = None;
            }
        }
    }

    /// Two numbers for the direction in which the path leaves its vertex.
    #[inline]
    pub fn direction(&mut self) -> Vec2 {
        match &self.lattice {
            Some(point) => Vec2::new(point.of_vertex(0), point.of_vertex(1)),
            None => self.next_2d(),
        }
    }

    /// Two numbers for the point on a light, and one for the choice of the light.
    #[inline]
    pub fn light(&mut self) -> (Vec2, f32) {
        match &self.lattice {
            Some(point) => (Vec2::new(point.of_vertex(2), point.of_vertex(3)), point.of_vertex(4)),
            None => (self.next_2d(), self.next_1d()),
        }
    }

    /// A number that decides whether the path survives its vertex.
    #[inline]
    pub fn roulette(&mut self) -> f32 {
        match &self.lattice {
            Some(point) => point.of_vertex(5),
            None => self.next_1d(),
        }
    }

    /// An optical depth with density e^(−τ), −ln(1 − ξ), on the way to the next vertex.
    #[inline]
    pub fn optical_depth(&mut self) -> f32 {
        let xi = match &mut self.lattice {
            Some(point) if point.flights < COLLISIONS => {
                point.flights += 1;
                point.of_vertex(FIRST_COLLISION + 2 * (point.flights - 1))
            }
            _ => self.next_1d(),
        };
        -ln(1.0 - xi)
    }

    /// A number that decides what happens at a collision on the way to the next vertex.
    #[inline]
    pub fn event(&mut self) -> f32 {
        match &mut self.lattice {
            Some(point) if point.events < COLLISIONS => {
                point.events += 1;
                point.of_vertex(FIRST_COLLISION + 2 * point.events - 1)
            }
            _ => self.next_1d(),
        }
    }

    /// An optical depth with density e^(−τ), independent of all others.
    #[inline]
    pub fn next_optical_depth(&mut self) -> f32 {
        // 1 − ξ is exact: both are multiples of 2^−24.
        -ln(1.0 - self.next_1d())
    }

    /// A number uniform in [0, 1), independent of all others.
    #[inline]
    pub fn next_1d(&mut self) -> f32 {
        unit(self.rng.next_u32())
    }

    /// Two of them.
    #[inline]
    pub fn next_2d(&mut self) -> Vec2 {
        Vec2::new(self.next_1d(), self.next_1d())
    }
}

/// Three numbers uniform in [0, 1) that follow from a point's bits: whoever comes to the same point finds the same.
#[must_use]
#[inline]
pub fn numbers_of_point(point: Vec3, salt: u32) -> Vec3 {
    let [x, y, z] = point.to_array().map(f32::to_bits);
    let a = mix(u64::from(x) << 32 | u64::from(y));
    let b = mix(a ^ (u64::from(z) << 32 | u64::from(salt)));
    Vec3::new(unit(b as u32), unit((b >> 32) as u32), unit(mix(b) as u32))
}

/// The finaliser of SplitMix64 (Steele, Lea and Flood 2014): every input bit reaches every output bit.
fn mix(x: u64) -> u64 {
    let x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn streams_are_reproducible_and_distinct() {
        let draw = |seed, pixel, sample| {
            let mut s = Sampler::new(seed, pixel, sample);
            [s.next_1d(), s.next_1d(), s.next_1d()]
        };
        assert_eq!(draw(1, 2, 3), draw(1, 2, 3));
        for other in [draw(0, 2, 3), draw(1, 3, 3), draw(1, 2, 4), draw(2, 1, 3)] {
            assert_ne!(draw(1, 2, 3), other);
        }
    }

    /// Over a run of samples every decision is stratified, however far a path has come; it is uniform, and
    /// other pixels and seeds are scrambled otherwise.
    #[test]
    fn decisions_of_a_run_are_evenly_spread() {
        let n = 64u64;
        let draw = |seed, pixel, sample, vertices: usize| {
            let mut s = Sampler::of_kind(SamplerKind::Lattice, seed, pixel, sample);
            let (jitter, component) = s.camera();
            for _ in 0..vertices {
                s.start_vertex();
            }
            let flight = [s.optical_depth(), s.optical_depth()].map(|depth| -(-depth).exp_m1());
            let event = s.event();
            let (point, light) = s.light();
            let (direction, roulette) = (s.direction(), s.roulette());
            let decisions = [flight[0], flight[1], event, roulette, light];
            [jitter.x, jitter.y, component, point.x, point.y, direction.x, direction.y]
                .into_iter()
                .chain(decisions)
                .collect::<Vec<f32>>()
        };
        for vertices in 0..STRATIFIED_VERTICES {
            for which in 0..12 {
                // Between any two of 64 evenly spaced numbers there is one, whatever the shift.
                let mut numbers: Vec<f32> = (3 * n..4 * n).map(|s| draw(1, 7, s, vertices)[which]).collect();
                numbers.sort_by(f32::total_cmp);
                let gaps = numbers.windows(2).map(|pair| pair[1] - pair[0]);
                let even = gaps.fold(0.0f32, |worst, gap| worst.max((gap * n as f32 - 1.0).abs()));
                assert!(even < 1e-3, "decision {which} after {vertices} vertices: {even}");
            }
        }
        let base = draw(1, 7, 0, 1);
        for other in [draw(2, 7, 0, 1), draw(1, 8, 0, 1), draw(1, 7, 1 << 20, 1), draw(1, 7, 1, 1)] {
            assert!(base.iter().zip(other).all(|(a, b)| *a != b));
        }
    }

    #[test]
    fn first_numbers_of_neighbouring_streams_are_uniform() {
        let n = 40_000u32;
        let mut bins = [0u32; 16];
        for i in 0..n {
            let u = Sampler::new(7, u64::from(i % 200), u64::from(i / 200)).next_1d();
            bins[(u * 16.0) as usize] += 1;
        }
        let expected = f64::from(n) / 16.0;
        let chi2: f64 = bins.iter().map(|b| (f64::from(*b) - expected).powi(2) / expected).sum();
        // 15 degrees of freedom: the 0.9999 quantile is 44.3; the seed is fixed.
        assert!(chi2 < 44.3, "χ² = {chi2}");
    }
}
