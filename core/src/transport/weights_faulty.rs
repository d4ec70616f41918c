//! Path weights with a deliberate error in one rule, for exercises and tests.

use super::{Collision, DirectionSample, PathSettings, PathWeights, WalkWeights, WeightRecord, Weights};
use crate::math::numbers_of_point;
use crate::scene::{Fault, Heuristics};
use crate::spectrum::{Radiance, Sampled};

/// [`PathWeights`] with the error of a [`Fault`].
#[derive(Clone, Copy, Debug)]
pub struct FaultyWeights<const N: usize> {
    right: PathWeights<N>,
    fault: Fault,
    /// Π 1/q over the roulettes survived: the factor missing from p_nee.
    survived: f32,
    /// Null collisions of the current flight.
    nulls: u32,
}

/// Largest number of null collisions of a flight under [`Fault::NullCap`].
const NULL_CAP: u32 = 8;
/// Probability of an error per event under [`Fault::NullByRounding`]; in single precision it is some 10⁻⁷.
const STRIKES: f32 = 1.0 / 512.0;
/// Salt of the hash of positions, distinct from its other uses.
const SALT: u32 = 0xfa17;

impl<const N: usize> FaultyWeights<N> {
    /// Returns the collision with the fault's event densities.
    fn seen(&self, c: &Collision<N>) -> Collision<N> {
        if self.fault != Fault::HeroProbability {
            return *c;
        }
        let share = |density: Sampled<N>| c.tentative * (density.hero() / c.tentative.hero());
        let mut seen = *c;
        (seen.null_density, seen.scattering_density) = (share(c.null_density), share(c.scattering_density));
        seen
    }

    fn count_null(&mut self) {
        self.nulls += 1;
        if self.fault == Fault::NullCap && self.nulls > NULL_CAP {
            self.right.contribution = Sampled::ZERO;
        }
    }

    /// Erroneous factor of p_nee when the path leaves a vertex.
    fn beyond(&self, outgoing: &DirectionSample) -> f32 {
        match self.fault {
            Fault::PhaseInBoth => outgoing.density,
            Fault::RouletteOnOneTechnique => self.survived,
            _ => 1.0,
        }
    }
}

impl<const N: usize> WalkWeights<N> for FaultyWeights<N> {
    const CAMERA: Self = Self { right: PathWeights::CAMERA, fault: Fault::None, survived: 1.0, nulls: 0 };

    fn starting(settings: &PathSettings) -> Self {
        Self { fault: settings.fault, ..Self::CAMERA }
    }

    fn pass(&mut self, optical_depth: Sampled<N>) {
        self.right.pass(optical_depth);
    }

    fn null(&mut self, c: &Collision<N>) {
        self.right.null(&self.seen(c));
        self.count_null();
    }

    fn null_by_ratio(&mut self, c: &Collision<N>) {
        self.right.null_by_ratio(&self.seen(c));
        self.count_null();
    }

    fn scatter(&mut self, c: &Collision<N>) {
        self.right.scatter(&self.seen(c));
        let strikes = || numbers_of_point(c.point, SALT).x < STRIKES;
        if self.fault == Fault::NullByRounding && c.null_density.hero() == 0.0 && strikes() {
            // 0 / 0.
            self.right.contribution *= f32::NAN;
        }
    }

    fn reflect(&mut self, albedo: Sampled<N>) {
        self.right.reflect(albedo);
    }

    fn choose_direction(&mut self, outgoing: &DirectionSample) {
        self.right.choose_direction(outgoing);
        self.right.nee *= self.beyond(outgoing);
        self.nulls = 0;
    }

    fn leave(&mut self, value: Sampled<N>, density: Sampled<N>, connects: bool) {
        self.right.leave(value, density, connects);
        self.nulls = 0;
    }

    fn adjust(&mut self, value: Sampled<N>, density: Sampled<N>) {
        self.right.adjust(value, density);
    }

    fn emitted<R: Radiance<N>>(&self, radiance: R, c: &Collision<N>, heuristics: Heuristics) -> R {
        self.right.emitted(radiance, c, heuristics)
    }

    fn survive(&mut self, q: f32) {
        self.right.survive(q);
        self.survived *= 1.0 / q;
    }

    fn throughput(&self) -> f32 {
        self.right.throughput()
    }

    fn weight_record(&self) -> WeightRecord {
        self.right.weight_record()
    }

    fn is_zero(&self) -> bool {
        self.right.is_zero()
    }

    fn unidirectional<R: Radiance<N>>(&self, radiance: R, heuristics: Heuristics) -> R {
        self.right.unidirectional(radiance, heuristics)
    }
}

impl<const N: usize> Weights<N> for FaultyWeights<N> {
    fn connect(&self, outgoing: &DirectionSample, light_density: f32) -> Self {
        let mut link = Self { right: self.right.connect(outgoing, light_density), nulls: 0, ..*self };
        link.right.nee *= self.beyond(outgoing);
        link
    }

    fn attenuate(&mut self, transmittance: Sampled<N>) {
        self.right.attenuate(transmittance);
    }

    fn connected_only<R: Radiance<N>>(&self, radiance: R, heuristics: Heuristics) -> R {
        self.right.connected_only(radiance, heuristics)
    }

    fn combined<R: Radiance<N>>(&self, radiance: R, light_density: f32, heuristics: Heuristics) -> R {
        self.right.combined(radiance, light_density, heuristics)
    }

    fn connected_combined<R: Radiance<N>>(&self, radiance: R, heuristics: Heuristics) -> R {
        self.right.connected_combined(radiance, heuristics)
    }
}
