//! Path weights with a planted mistake: right in everything but one rule.

use super::{Collision, DirectionSample, PathSettings, PathWeights, WalkWeights, WeightRecord, Weights};
use crate::math::numbers_of_point;
use crate::scene::{Fault, Heuristics};
use crate::spectrum::{Radiance, Sampled};

/// [`PathWeights`] that follow a [`Fault`].
#[derive(Clone, Copy, Debug)]
pub struct FaultyWeights<const N: usize> {
    right: PathWeights<N>,
    fault: Fault,
    /// Π 1/q over the roulette that was survived: what p_nee lacks.
    survived: f32,
    /// Null collisions of the flight.
    nulls: u32,
}

/// Null collisions that [`Fault::NullCap`] lets a flight have.
const NULL_CAP: u32 = 8;
/// How often [`Fault::NullByRounding`] strikes; with single precision it is some 10⁻⁷.
const STRIKES: f32 = 1.0 / 512.0;
/// Makes places strike that no other use of them does.
const SALT: u32 = 0xfa17;

impl<const N: usize> FaultyWeights<N> {
    /// A collision as the mistake sees it.
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

    /// What p_nee is multiplied by that it should not be, for a turn.
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

    fn leave(&mut self, outgoing: &DirectionSample) {
        self.right.leave(outgoing);
        self.right.nee *= self.beyond(outgoing);
        self.nulls = 0;
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

    fn kept(&self) -> WeightRecord {
        self.right.kept()
    }

    fn is_dark(&self) -> bool {
        self.right.is_dark()
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
