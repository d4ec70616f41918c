//! Random numbers as a pure function of (seed, pixel, sample).

use super::bits::{mix, unit};
use super::ln;
use super::stratified::Stratified;
use glam::{Vec2, Vec3};
use rand_core::RngCore;
use rand_pcg::Pcg32;
use serde::{Deserialize, Serialize};

/// Sampler: correlation between the samples of a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SamplerKind {
    /// Independent random numbers.
    #[default]
    Independent,
    /// A randomly shifted lattice over the pixel's samples for the first decisions of a path. Each sample has
    /// the same distribution as before, and together they are spread more evenly. The sample variance then
    /// overstates the error of the mean. relMSE ×0.54 on the embedded plume at 32 samples, ×0.95 on clouds
    /// with many scattering events.
    Lattice,
    /// An Owen-scrambled Sobol sequence for the same decisions: less even than the lattice, but without a
    /// regular structure that could alias with the scene. The same caveat applies. relMSE ×0.59 on the plume,
    /// ×0.9 to 1.07 on the clouds.
    Sobol,
}

/// Random numbers of one path: a PCG stream of its own and, for the first decisions, optionally a point of a
/// low-discrepancy sequence. A path can be replayed alone, and the image does not depend on the order in
/// which threads trace paths.
#[derive(Clone, Debug)]
pub struct Sampler {
    rng: Pcg32,
    stratified: Option<Stratified>,
    /// Hash of seed, pixel and sample.
    path: u64,
    /// Hash of seed and pixel; selects the PCG sequence.
    pixel: u64,
    /// Number of vertices that the path has left.
    vertex: u32,
}

/// Independent streams used at a vertex besides the walk's own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SideStream {
    /// Connection from the vertex to a light.
    Connection = 1,
    /// Connection from an equiangularly sampled vertex on the segment to the next one.
    EquiangularVertex = 2,
    /// Separate walk towards a light in the direction of the next segment.
    LightWalk = 3,
}

impl Sampler {
    /// Creates independent numbers for sample `sample` of pixel `pixel` under `seed`.
    #[must_use]
    pub fn new(seed: u64, pixel: u64, sample: u64) -> Self {
        let key = mix(mix(seed).wrapping_add(pixel));
        let path = mix(key.wrapping_add(sample));
        Self { rng: Pcg32::new(path, key), stratified: None, path, pixel: key, vertex: 0 }
    }

    /// Returns an independent stream for the current vertex, as a function of (seed, pixel, sample, vertex).
    /// The numbers used by a connection do not change those of the walk, so all estimators walk the same
    /// path.
    #[must_use]
    #[inline]
    pub fn side_stream(&self, what: SideStream) -> Self {
        let path = mix(self.path ^ (u64::from(self.vertex) << 8 | what as u64));
        Self { rng: Pcg32::new(path, self.pixel), stratified: None, path, pixel: self.pixel, vertex: 0 }
    }

    /// Creates the sampler of a kind for sample `sample` of pixel `pixel` under `seed`.
    #[must_use]
    pub fn of_kind(kind: SamplerKind, seed: u64, pixel: u64, sample: u64) -> Self {
        let mut sampler = Self::new(seed, pixel, sample);
        // A new sequence begins after the last point of the previous one.
        let seed = |period: u32| mix(mix(mix(seed) ^ (sample >> period)).wrapping_add(pixel)) as u32;
        sampler.stratified = match kind {
            SamplerKind::Independent => None,
            SamplerKind::Lattice => Some(Stratified::lattice(sample, seed(Stratified::LATTICE_BITS))),
            SamplerKind::Sobol => Some(Stratified::sobol(sample, seed(Stratified::SOBOL_BITS))),
        };
        sampler
    }

    /// Samples the position within the pixel, and a number that selects the components of the path.
    #[inline]
    pub fn camera(&mut self) -> (Vec2, f32) {
        match &self.stratified {
            Some(point) => (Vec2::new(point.at(0), point.at(1)), point.at(2)),
            None => (self.next_2d(), self.next_1d()),
        }
    }

    /// Advances to the decisions that lead to the next vertex.
    #[inline]
    pub fn start_vertex(&mut self) {
        self.vertex += 1;
        if self.stratified.as_mut().is_some_and(|point| !point.start_vertex()) {
            self.stratified = None;
        }
    }

    /// Two numbers for the direction in which the path leaves its vertex.
    #[inline]
    pub fn direction(&mut self) -> Vec2 {
        match &self.stratified {
            Some(point) => Vec2::new(point.of_vertex(0), point.of_vertex(1)),
            None => self.next_2d(),
        }
    }

    /// Two numbers for the point on a light, and one for the choice of the light: stratified, or the next of
    /// `connection`.
    #[inline]
    pub fn light(&self, connection: &mut Self) -> (Vec2, f32) {
        match &self.stratified {
            Some(point) => (Vec2::new(point.of_vertex(2), point.of_vertex(3)), point.of_vertex(4)),
            None => (connection.next_2d(), connection.next_1d()),
        }
    }

    /// A number for the Russian roulette at a vertex.
    #[inline]
    pub fn roulette(&mut self) -> f32 {
        match &self.stratified {
            Some(point) => point.of_vertex(5),
            None => self.next_1d(),
        }
    }

    /// Samples an optical depth with density e^(−τ), as −ln(1 − ξ), on the segment to the next vertex.
    #[inline]
    pub fn optical_depth(&mut self) -> f32 {
        let stratified = self.stratified.as_mut().and_then(Stratified::flight);
        -ln(1.0 - stratified.unwrap_or_else(|| self.next_1d()))
    }

    /// A number for the event at a collision on the segment to the next vertex.
    #[inline]
    pub fn event(&mut self) -> f32 {
        let stratified = self.stratified.as_mut().and_then(Stratified::event);
        stratified.unwrap_or_else(|| self.next_1d())
    }

    /// Samples an optical depth with density e^(−τ), independent of all others.
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

    /// Two numbers uniform in [0, 1), independent of all others.
    #[inline]
    pub fn next_2d(&mut self) -> Vec2 {
        Vec2::new(self.next_1d(), self.next_1d())
    }
}

/// Three numbers uniform in [0, 1), computed as a hash of a point's bits: the same point always gives the
/// same numbers.
#[must_use]
#[inline]
pub fn numbers_of_point(point: Vec3, salt: u32) -> Vec3 {
    let [x, y, z] = point.to_array().map(f32::to_bits);
    let a = mix(u64::from(x) << 32 | u64::from(y));
    let b = mix(a ^ (u64::from(z) << 32 | u64::from(salt)));
    Vec3::new(unit(b as u32), unit((b >> 32) as u32), unit(mix(b) as u32))
}

#[cfg(test)]
mod tests {
    use super::super::stratified::STRATIFIED_VERTICES;
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

    /// Over a run of samples every decision is stratified, at every vertex; it is uniform, and other pixels
    /// and seeds are scrambled differently.
    #[test]
    fn decisions_of_a_run_are_evenly_spread() {
        evenly_spread(SamplerKind::Lattice, 1 << 20);
        evenly_spread(SamplerKind::Sobol, 1 << 16);
    }

    fn evenly_spread(kind: SamplerKind, length: u64) {
        let n = 64u64;
        let draw = |seed, pixel, sample, vertices: usize| {
            let mut s = Sampler::of_kind(kind, seed, pixel, sample);
            let (jitter, component) = s.camera();
            for _ in 0..vertices {
                s.start_vertex();
            }
            let flight = [s.optical_depth(), s.optical_depth()].map(|depth| -(-depth).exp_m1());
            let event = s.event();
            let mut connection = s.side_stream(SideStream::Connection);
            let (point, light) = s.light(&mut connection);
            let (direction, roulette) = (s.direction(), s.roulette());
            let decisions = [flight[0], flight[1], event, roulette, light];
            [jitter.x, jitter.y, component, point.x, point.y, direction.x, direction.y]
                .into_iter()
                .chain(decisions)
                .collect::<Vec<f32>>()
        };
        for vertices in 0..STRATIFIED_VERTICES {
            for which in 0..12 {
                // Any two neighbours of 64 evenly spaced numbers are 1/64 apart, whatever the shift.
                let mut numbers: Vec<f32> = (3 * n..4 * n).map(|s| draw(1, 7, s, vertices)[which]).collect();
                numbers.sort_by(f32::total_cmp);
                let even = match kind {
                    SamplerKind::Lattice => {
                        let gaps = numbers.windows(2).map(|pair| pair[1] - pair[0]);
                        gaps.fold(0.0f32, |worst, gap| worst.max((gap * n as f32 - 1.0).abs()))
                    }
                    // One number in each interval of 1/64; flights are recovered from an exponential.
                    _ => numbers.iter().zip(0u8..).fold(0.0f32, |worst, (x, i)| {
                        worst.max((x * n as f32 - f32::from(i) - 0.5).abs() - 0.5)
                    }),
                };
                assert!(even < 1e-3, "{kind:?}: decision {which} after {vertices} vertices: {even}");
            }
        }
        let base = draw(1, 7, 0, 1);
        for other in [draw(2, 7, 0, 1), draw(1, 8, 0, 1), draw(1, 7, length, 1), draw(1, 7, 1, 1)] {
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
