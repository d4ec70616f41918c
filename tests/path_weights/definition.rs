//! Paths as sequences of events, for tests of the path weights.
//!
//! Computes f, p_uni and p_nee in double precision by their definitions in the table of events, and in
//! Miller's pairwise form.

use glam::Vec3;
use majorant_core::medium::{Coefficients, MajorantSegment};
use majorant_core::scene::Absorption;
use majorant_core::spectrum::Sampled;
use majorant_core::transport::Collision;
use majorant_core::transport::DirectionSample;
use majorant_core::transport::Weights;
use proptest::array::uniform;
use proptest::prelude::*;
use std::array::from_fn;

/// Coefficients of the medium at a collision, per component; the extinction may exceed the majorant or be
/// zero.
#[derive(Clone, Copy, Debug)]
pub struct Place<const N: usize> {
    extinction: [f32; N],
    albedo: [f32; N],
    majorant: [f32; N],
}

#[derive(Clone, Copy, Debug)]
pub enum Step<const N: usize> {
    Pass {
        majorant: [f32; N],
        distance: f32,
    },
    Null(Place<N>),
    /// Scattering vertex, with the density of the outgoing direction.
    Scatter(Place<N>, f32),
    /// Reflection at a surface with this albedo, with the density of the outgoing direction.
    Reflect([f32; N], f32),
    /// Survival of Russian roulette, with its probability.
    Survive(f32),
}

/// A path from the camera to a light.
#[derive(Clone, Debug)]
pub struct Events<const N: usize> {
    pub absorption: Absorption,
    /// Events before the last real vertex.
    pub before: Vec<Step<N>>,
    /// The last real vertex.
    pub vertex: Step<N>,
    /// Density under light sampling of the direction from `vertex` to the light.
    pub light: f32,
    /// Events between `vertex` and the light: passed segments and null collisions.
    pub after: Vec<Step<N>>,
}

fn rotated<const N: usize>(values: [f32; N], hero: usize) -> [f32; N] {
    from_fn(|i| values[(hero + i) % N])
}

impl<const N: usize> Place<N> {
    pub fn rotated(&self, hero: usize) -> Self {
        let outgoing = |values| rotated(values, hero);
        Self {
            extinction: outgoing(self.extinction),
            albedo: outgoing(self.albedo),
            majorant: outgoing(self.majorant),
        }
    }

    pub fn collision(&self, absorption: Absorption) -> Collision<N> {
        let majorant = Sampled(self.majorant);
        let segment = MajorantSegment { t0: 0.0, t1: 1.0, majorant, clamp_null: false, watched: false };
        let coefficients = Coefficients::new(Sampled(self.extinction), Sampled(self.albedo), &segment);
        Collision::new(Vec3::ZERO, coefficients, absorption.into())
    }
}

impl<const N: usize> Step<N> {
    fn rotated(self, hero: usize) -> Self {
        match self {
            Self::Pass { majorant, distance } => Self::Pass { majorant: rotated(majorant, hero), distance },
            Self::Null(place) => Self::Null(place.rotated(hero)),
            Self::Scatter(place, density) => Self::Scatter(place.rotated(hero), density),
            Self::Reflect(albedo, density) => Self::Reflect(rotated(albedo, hero), density),
            Self::Survive(q) => Self::Survive(q),
        }
    }

    /// Factors of f, p_uni and p_nee for component `i`. The factor of p_nee does not include the density of a
    /// vertex's outgoing direction.
    fn factors(&self, i: usize, absorption: Absorption) -> [f64; 3] {
        let of = |p: &Place<N>| [p.extinction[i], p.albedo[i], p.majorant[i]].map(f64::from);
        match self {
            Self::Pass { majorant, distance } => [(-f64::from(majorant[i]) * f64::from(*distance)).exp(); 3],
            Self::Null(place) => {
                let [t, _, m] = of(place);
                [m - t, (m - t).abs() * m / (t + (m - t).abs()), m]
            }
            Self::Scatter(place, density) => {
                let ([t, albedo, m], density) = (of(place), f64::from(*density));
                let drawn = match absorption {
                    Absorption::Analogue => t * albedo,
                    Absorption::Weighted | Absorption::Roulette => t,
                } * m
                    / (t + (m - t).abs());
                [t * albedo * VALUE * density, drawn * density, drawn]
            }
            Self::Reflect(albedo, density) => {
                [f64::from(albedo[i]) * f64::from(*density), f64::from(*density), 1.0]
            }
            Self::Survive(q) => [1.0 / f64::from(*q), 1.0, 1.0],
        }
    }
}

/// Phase function over the density of direction sampling in the medium.
const VALUE: f64 = 0.6;

impl<const N: usize> Step<N> {
    /// Sample of the outgoing direction, at a vertex.
    fn outgoing(&self) -> Option<DirectionSample> {
        let (value, density) = match self {
            Self::Scatter(_, density) => (VALUE as f32 * density, *density),
            Self::Reflect(_, density) => (*density, *density),
            _ => return None,
        };
        Some(DirectionSample { direction: Vec3::Z, value, density })
    }
}

/// f, p_uni and p_nee of a whole path, and the quotients p_i / f_j, each updated event by event.
pub struct Plain<const N: usize> {
    pub f: [f64; N],
    pub uni: [f64; N],
    pub nee: [f64; N],
    pub uni_over_f: [[f64; N]; N],
    pub nee_over_f: [[f64; N]; N],
}

impl<const N: usize> Events<N> {
    /// Returns the same path with another component as the hero.
    pub fn rotated(&self, hero: usize) -> Self {
        let outgoing = |steps: &[Step<N>]| steps.iter().map(|step| step.rotated(hero)).collect();
        Self {
            before: outgoing(&self.before),
            vertex: self.vertex.rotated(hero),
            after: outgoing(&self.after),
            ..*self
        }
    }

    /// Returns the same path without roulette.
    pub fn without_roulette(&self) -> Self {
        let mut events = self.clone();
        events.before.retain(|step| !matches!(step, Step::Survive(_)));
        events
    }

    fn apply(&self, path: &mut impl Weights<N>, step: &Step<N>) {
        match step {
            Step::Pass { majorant, distance } => path.pass(Sampled(*majorant) * *distance),
            Step::Null(place) => path.null(&place.collision(self.absorption)),
            Step::Scatter(place, _) => path.scatter(&place.collision(self.absorption)),
            Step::Reflect(albedo, _) => path.reflect(Sampled(*albedo)),
            Step::Survive(q) => path.survive(*q),
        }
        // The walk samples a direction at every vertex.
        if let Some(outgoing) = step.outgoing() {
            path.choose_direction(&outgoing);
        }
    }

    fn up_to_vertex<W: Weights<N>>(&self) -> W {
        let mut path = W::CAMERA;
        self.before.iter().for_each(|step| self.apply(&mut path, step));
        path
    }

    /// Weights of the path sampled by the walk.
    pub fn walk<W: Weights<N>>(&self) -> W {
        let mut path = self.up_to_vertex();
        self.apply(&mut path, &self.vertex);
        self.after.iter().for_each(|step| self.apply(&mut path, step));
        path
    }

    /// Weights of the path sampled with a connection from the last vertex.
    pub fn connection<W: Weights<N>>(&self) -> W {
        let mut path = self.up_to_vertex::<W>();
        match &self.vertex {
            Step::Scatter(place, _) => path.scatter(&place.collision(self.absorption)),
            Step::Reflect(albedo, _) => path.reflect(Sampled(*albedo)),
            other => panic!("{other:?} is not a vertex"),
        }
        let outgoing = self.vertex.outgoing().expect("a vertex has an outgoing direction");
        let mut link = path.connect(&outgoing, self.light);
        for step in &self.after {
            match step {
                Step::Pass { majorant, distance } => link.pass(Sampled(*majorant) * *distance),
                Step::Null(place) => link.null_by_ratio(&place.collision(self.absorption)),
                other => panic!("{other:?} on the way to a light"),
            }
        }
        link
    }

    /// Evaluates the definitions of f, p_uni and p_nee.
    pub fn plain(&self) -> Plain<N> {
        let ones = [[1.0; N]; N];
        let mut plain =
            Plain { f: [1.0; N], uni: [1.0; N], nee: [1.0; N], uni_over_f: ones, nee_over_f: ones };
        // Both techniques sample the path up to the last vertex alike; there p_nee has the density of light
        // sampling.
        for step in &self.before {
            plain.multiply(|i| {
                let [f, uni, _] = step.factors(i, self.absorption);
                [f, uni, uni]
            });
        }
        plain.multiply(|i| {
            let [f, uni, nee] = self.vertex.factors(i, self.absorption);
            [f, uni, nee * f64::from(self.light)]
        });
        for step in &self.after {
            plain.multiply(|i| step.factors(i, self.absorption));
        }
        plain
    }
}

impl<const N: usize> Plain<N> {
    fn multiply(&mut self, factors: impl Fn(usize) -> [f64; 3]) {
        for i in 0..N {
            let [f, uni, nee] = factors(i);
            self.f[i] *= f;
            self.uni[i] *= uni;
            self.nee[i] *= nee;
            for j in 0..N {
                self.uni_over_f[i][j] *= uni / factors(j)[0];
                self.nee_over_f[i][j] *= nee / factors(j)[0];
            }
        }
    }
}

/// Strategy for one value per component, in some cases with one of them zero.
fn values<const N: usize>(lo: f32, hi: f32) -> impl Strategy<Value = [f32; N]> {
    (uniform(lo..hi), 0usize..100).prop_map(|(mut values, dark)| {
        if N > 1 && dark < N {
            values[dark] = 0.0;
        }
        values
    })
}

fn place<const N: usize>() -> impl Strategy<Value = Place<N>> {
    (values(0.2, 3.0), values(0.1, 1.0), uniform(0.3f32..4.0))
        .prop_map(|(extinction, albedo, majorant)| Place { extinction, albedo, majorant })
        .prop_filter("null coefficients with significant digits", |p: &Place<N>| {
            (0..N).all(|i| (p.majorant[i] - p.extinction[i]).abs() > 0.02)
        })
}

fn vertex<const N: usize>() -> impl Strategy<Value = Step<N>> {
    prop_oneof![
        3 => (place(), 0.01f32..3.0).prop_map(|(place, density)| Step::Scatter(place, density)),
        1 => (values(0.1, 1.0), 0.01f32..0.3).prop_map(|(albedo, density)| Step::Reflect(albedo, density)),
    ]
}

fn on_the_way<const N: usize>() -> impl Strategy<Value = Step<N>> {
    prop_oneof![
        (uniform(0.1f32..4.0), 0.01f32..0.5)
            .prop_map(|(majorant, distance)| Step::Pass { majorant, distance }),
        place().prop_map(Step::Null),
    ]
}

pub fn events<const N: usize>() -> impl Strategy<Value = Events<N>> {
    let before = prop_oneof![
        4 => on_the_way(),
        3 => vertex(),
        1 => (0.05f32..1.0).prop_map(Step::Survive),
    ];
    let absorption = prop_oneof![Just(Absorption::Analogue), Just(Absorption::Weighted)];
    (
        absorption,
        prop::collection::vec(before, 0..16),
        vertex(),
        0.01f32..5.0,
        prop::collection::vec(on_the_way(), 0..10),
    )
        .prop_map(|(absorption, before, vertex, light, after)| Events {
            absorption,
            before,
            vertex,
            light,
            after,
        })
}
