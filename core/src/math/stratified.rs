//! Low-discrepancy points for the first decisions of a pixel's paths.

use super::bits::{mix, unit};

/// Generating vector of an embedded lattice for up to 2^20 points in base 2: every prefix of 2^k points is a
/// lattice, too (Cools, Kuo and Nuyens 2006, "Constructing embedded lattice rules for multivariate
/// integration").
const GENERATOR: [u32; 51] = [
    1, 182_667, 469_891, 498_753, 110_745, 446_247, 250_185, 118_627, 245_333, 283_199, 408_519, 391_023,
    246_327, 126_539, 399_185, 461_527, 300_343, 69_681, 516_695, 436_179, 106_383, 238_523, 413_283, 70_841,
    47_719, 300_129, 113_029, 123_925, 410_745, 211_325, 17_489, 511_893, 40_767, 186_077, 519_471, 255_369,
    101_819, 243_573, 66_189, 152_143, 503_455, 113_217, 132_603, 463_967, 297_717, 157_383, 224_015,
    502_917, 36_237, 94_049, 170_665,
];

/// Dimensions before the first vertex: position within the pixel, components.
const CAMERA: usize = 3;
/// Dimensions per vertex, in order: direction, point on a light, choice of light, roulette, then optical
/// depth and event of the first few collisions.
const PER_VERTEX: usize = 12;
const COLLISIONS: usize = 3;
const FIRST_COLLISION: usize = PER_VERTEX - 2 * COLLISIONS;
/// Vertices whose decisions are stratified; later vertices vary too much between paths to gain from it.
pub(super) const STRATIFIED_VERTICES: usize = (GENERATOR.len() - CAMERA) / PER_VERTEX;

/// A point of a sequence, with the dimensions that a path has used so far.
#[derive(Clone, Debug)]
pub(super) struct Stratified {
    sequence: Sequence,
    vertex: usize,
    /// Numbers of optical depths and events used at the current vertex.
    flights: usize,
    events: usize,
}

#[derive(Clone, Copy, Debug)]
enum Sequence {
    /// Radical inverse of the sample index in base 2, in units of 2^−32, and the seed of the shifts of all
    /// dimensions.
    Lattice { inverse: u32, shift: u32 },
    /// Scrambled after Burley 2020, "Practical hash-based Owen scrambling".
    Sobol { index: u32, seed: u32 },
}

impl Stratified {
    /// Binary logarithms of the lengths of the sequences.
    pub const LATTICE_BITS: u32 = 20;
    pub const SOBOL_BITS: u32 = 16;

    fn new(sequence: Sequence) -> Self {
        Self { sequence, vertex: 0, flights: 0, events: 0 }
    }

    /// Point `sample`, modulo the length, of the lattice with this shift.
    pub fn lattice(sample: u64, shift: u32) -> Self {
        let inverse = (sample as u32 & ((1 << Self::LATTICE_BITS) - 1)).reverse_bits();
        Self::new(Sequence::Lattice { inverse, shift })
    }

    /// Point `sample`, modulo the length, of the Sobol sequence scrambled with this seed.
    pub fn sobol(sample: u64, seed: u32) -> Self {
        Self::new(Sequence::Sobol { index: sample as u32 & ((1 << Self::SOBOL_BITS) - 1), seed })
    }

    #[inline]
    pub fn at(&self, dimension: usize) -> f32 {
        match self.sequence {
            Sequence::Lattice { inverse, shift } => {
                let shift = (mix(u64::from(shift) << 8 | dimension as u64) >> 32) as u32;
                unit(inverse.wrapping_mul(GENERATOR[dimension]).wrapping_add(shift))
            }
            Sequence::Sobol { index, seed } => sobol_burley::sample(index, dimension as u32, seed),
        }
    }

    #[inline]
    pub fn of_vertex(&self, which: usize) -> f32 {
        self.at(CAMERA + PER_VERTEX * self.vertex + which)
    }

    /// Advances to the decisions that lead to the next vertex; returns false if those are no longer
    /// stratified.
    #[inline]
    pub fn start_vertex(&mut self) -> bool {
        self.vertex += 1;
        (self.flights, self.events) = (0, 0);
        self.vertex < STRATIFIED_VERTICES
    }

    /// Sample for the next optical depth, while it is stratified.
    #[inline]
    pub fn flight(&mut self) -> Option<f32> {
        (self.flights < COLLISIONS).then(|| {
            self.flights += 1;
            self.of_vertex(FIRST_COLLISION + 2 * (self.flights - 1))
        })
    }

    /// Sample for the next event, while it is stratified.
    #[inline]
    pub fn event(&mut self) -> Option<f32> {
        (self.events < COLLISIONS).then(|| {
            self.events += 1;
            self.of_vertex(FIRST_COLLISION + 2 * self.events - 1)
        })
    }
}
