//! A scene at the components of one path: what an estimator asks.

use super::{
    Collision, DirectionSample, DirectionSampler, EventRule, Guide, Note, PathContext, Technique, Vertex,
    Walk, WalkWeights,
};
use crate::light::{Emitter, LobeParts};
use crate::math::{Ray, Sampler, SideStream};
use crate::medium::LocalMedium;
use crate::scene::{
    Absorption, Bookkeeping, DirectionSampling, DistanceSampling, Fault, Heuristics, LightSampling,
    LightSelection, LightWalk, NearestSurface, Scene, Tracking,
};
use crate::spectrum::{Components, Radiance, Sampled};
use crate::surface::Role;
use crate::transmittance::TransmittanceKind;
use glam::Vec3;

/// Choices that every path of a render shares.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathSettings {
    /// What happens at a collision that may absorb.
    pub absorption: Absorption,
    /// How distances to the next event are drawn.
    pub distances: DistanceSampling,
    /// How a path is shared among all that could have made it.
    pub heuristics: Heuristics,
    /// How f and p of a path are kept.
    pub bookkeeping: Bookkeeping,
    /// How spectral tracking draws events.
    pub tracking: Tracking,
    /// A planted mistake.
    pub fault: Fault,
    /// Which walk meets the light that unidirectional sampling adds.
    pub light_walk: LightWalk,
    /// Which light a connection goes to.
    pub lights: LightSelection,
    /// How a connection draws a direction towards its light.
    pub light_sampling: LightSampling,
    /// How the transmittance of a connection is estimated, where no MIS needs its density.
    pub transmittance: TransmittanceKind,
    /// What directions in the medium are drawn from.
    pub directions: DirectionSampling,
    /// Most segments between camera, real vertices and light; `u32::MAX` for no limit.
    pub max_depth: u32,
    /// Russian roulette from this number of real vertices on; `u32::MAX` for never.
    pub roulette_depth: u32,
}

impl PathSettings {
    /// The number of real vertices from which on Russian roulette may end a path; `u32::MAX` for never.
    #[must_use]
    #[inline]
    pub fn first_roulette(&self) -> u32 {
        match self.absorption {
            Absorption::Roulette => 0,
            Absorption::Analogue | Absorption::Weighted => self.roulette_depth,
        }
    }
}

/// Steps of a path between two questions whether it is still wanted.
const ASK_EVERY: u32 = 1024;

/// The random numbers of one path, what it has cost, and who accompanies it.
#[derive(Debug)]
pub struct Trace<'a> {
    /// Random numbers of the walk.
    pub sampler: Sampler,
    /// Random numbers of what is drawn beside the walk: the connection at hand.
    pub connection: Sampler,
    /// Evaluations of the medium's coefficients.
    pub lookups: u64,
    /// Collisions at which the extinction exceeded the majorant.
    pub exceeded: u64,
    context: PathContext<'a>,
    steps: u32,
    stopped: bool,
}

impl<'a> Trace<'a> {
    /// A path that has cost nothing yet.
    #[must_use]
    pub fn new(sampler: Sampler, context: impl Into<PathContext<'a>>) -> Self {
        let connection = sampler.side_stream(SideStream::Connection);
        Self {
            sampler,
            connection,
            lookups: 0,
            exceeded: 0,
            context: context.into(),
            steps: 0,
            stopped: false,
        }
    }

    /// Begins something that is drawn beside the walk, by numbers of its own.
    #[inline]
    pub fn start_side_stream(&mut self, what: SideStream) {
        self.connection = self.sampler.side_stream(what);
    }

    /// Tells a step to whoever looks on.
    #[inline(always)]
    pub fn tell(&mut self, note: impl FnOnce() -> Note) {
        self.context.tell(note);
    }

    /// Counts a collision or a vertex; true once the path is not wanted any more, and from then on.
    pub fn must_stop(&mut self) -> bool {
        self.steps = self.steps.wrapping_add(1);
        if self.steps.is_multiple_of(ASK_EVERY) && !self.context.cancel.is_active() {
            self.stopped = true;
        }
        self.stopped
    }
}

/// Light that a ray meets.
#[derive(Clone, Copy, Debug)]
pub struct Arrival<R> {
    /// Emitted radiance.
    pub radiance: R,
    /// Which light it is.
    pub index: usize,
}

/// A scene, its medium and its spectra at the components of one path.
pub struct World<'a, L, C, const N: usize> {
    /// The frozen scene.
    pub scene: &'a Scene,
    /// The medium at the components.
    pub medium: L,
    /// Wavelengths or channels.
    pub components: C,
    /// Choices that every path shares.
    pub settings: PathSettings,
}

impl<L: LocalMedium<N>, C: Components<N>, const N: usize> World<'_, L, C, N> {
    /// The walk through the medium along a ray, up to `t_max`.
    #[must_use]
    #[inline(always)]
    pub fn walk(&self, ray: &Ray, t_max: f32) -> Walk<'_, L, N> {
        Walk::new(&self.medium, self.scene, ray, t_max, &self.settings)
    }

    /// The walk of a connection, up to a light.
    #[must_use]
    #[inline(always)]
    pub fn walk_to_light(&self, ray: &Ray, t_max: f32) -> Walk<'_, L, N> {
        Walk::along(&self.medium, self.scene, ray, t_max, EventRule::from(&self.settings), false)
    }

    /// Radiance that the medium emits at a collision, to be weighted with what the path is worth there; black if it is
    /// cold.
    #[must_use]
    #[inline]
    pub fn emission_at(&self, collision: &Collision<N>, trace: &mut Trace<'_>) -> Option<C::Radiance> {
        let emission = self.scene.emission.as_ref()?;
        trace.lookups += 1;
        let kelvin = emission.kelvin_at(self.scene.medium_from_world.transform_point3(collision.point));
        (kelvin > 0.0).then(|| self.components.blackbody(kelvin) * Sampled::splat(emission.scale))
    }

    /// Records a contribution to the estimate for the observer and returns it: `value` is `emitted` light weighted by the
    /// path. The other technique that could have sampled the light would have done so with `other_density`.
    #[inline(always)]
    pub fn record(
        &self,
        technique: Technique,
        (emitted, other_density): (C::Radiance, f32),
        value: C::Radiance,
        trace: &mut Trace<'_>,
    ) -> C::Radiance {
        let components = self.components;
        trace.tell(move || Note::Credit {
            technique,
            emitted: emitted.lanes(),
            other_density,
            value: value.lanes(),
            film: components.to_film(value),
        });
        value
    }

    /// The surface that a ray meets first. Rays from the camera pass through hidden lights.
    #[must_use]
    pub fn nearest_surface(&self, ray: &Ray, from_camera: bool) -> NearestSurface<'_> {
        self.scene.nearest_surface(ray, f32::INFINITY, from_camera)
    }

    /// Every light that a ray meets at its end: the one that `end` belongs to, or all that lie behind
    /// the scene. The camera does not see hidden ones.
    pub fn arrivals(
        &self,
        ray: &Ray,
        end: &NearestSurface,
        from_camera: bool,
    ) -> impl Iterator<Item = Arrival<C::Radiance>> {
        let (ray, role, normal) = (*ray, end.role(), end.normal());
        self.scene.lights.iter().enumerate().filter_map(move |(index, light)| {
            let met = match role {
                // Lights with a surface emit on the side of its normal only.
                Some(Role::Light(met)) => *met == index && ray.direction.dot(normal) < 0.0,
                Some(Role::Diffuse(_)) => false,
                None => light.is_behind(ray.direction),
            };
            (met && (light.visible || !from_camera))
                .then(|| Arrival { radiance: light.radiance(ray.direction, &self.components), index })
        })
    }

    /// The diffuse vertex at which a ray ends, with its albedo; `None` on lights and beyond the scene.
    #[must_use]
    pub fn diffuse_vertex(
        &self,
        ray: &Ray,
        end: &NearestSurface,
        trace: &mut Trace<'_>,
    ) -> Option<(Vertex, Sampled<N>)> {
        let Some(Role::Diffuse(albedo)) = end.role() else { return None };
        let point = ray.at(end.t());
        let normal = end.normal() * -ray.direction.dot(end.normal()).signum();
        // Off the surface by several times the rounding of the point's own coordinates, whose error is
        // that of the ray's origin and of the point.
        let lift = 1e-6 * (point.abs().max_element() + ray.origin.abs().max_element());
        let albedo = self.components.evaluate(albedo);
        trace.tell(move || Note::Surface { point, albedo: albedo.lanes() });
        Some((Vertex::Surface { point: point + normal * lift, normal }, albedo))
    }

    /// A scattering vertex in the medium, on this ray.
    #[must_use]
    #[inline]
    pub fn scattering_vertex(&self, point: Vec3, ray: &Ray) -> Vertex {
        let by_product = self.settings.directions == DirectionSampling::Product
            || self.settings.light_sampling == LightSampling::Product;
        let lights = &self.scene.lights;
        let parts = (by_product && !lights.is_empty())
            .then(|| LobeParts::new(lights, point, ray.direction, self.scene.phase.mean_cosine()));
        Vertex::Medium { point, omega_in: ray.direction, parts }
    }

    /// What directions are drawn from.
    #[must_use]
    #[inline]
    pub fn directions(&self) -> DirectionSampler<'_> {
        let guide = match self.settings.directions {
            DirectionSampling::Phase => None,
            DirectionSampling::TowardsLights => self.scene.lobes.as_ref().map(Guide::Lobes),
            DirectionSampling::Product => Some(Guide::Product),
        };
        DirectionSampler { phase: &self.scene.phase, guide }
    }

    /// Samples the direction in which a path leaves a vertex, multiplies it into the weights and returns the next ray.
    #[inline]
    pub fn sample_direction(
        &self,
        vertex: &Vertex,
        weights: &mut impl WalkWeights<N>,
        trace: &mut Trace<'_>,
    ) -> Ray {
        let outgoing = self.sample_outgoing(vertex, trace);
        weights.leave(&outgoing);
        Ray { origin: vertex.point(), direction: outgoing.direction }
    }

    /// Draws the turn of a path at a vertex.
    #[inline]
    pub fn sample_outgoing(&self, vertex: &Vertex, trace: &mut Trace<'_>) -> DirectionSample {
        let u = trace.sampler.direction();
        let outgoing = self.directions().draw(vertex, u);
        trace.sampler.start_vertex();
        let ray = Ray { origin: vertex.point(), direction: outgoing.direction };
        trace.tell(move || Note::Leave { ray, u, value: outgoing.value, density: outgoing.density });
        outgoing
    }

    /// Whether a path continues beyond its vertex number `vertices`: it is within the depth limit, can still
    /// contribute, and has not been cancelled.
    pub fn within_depth(&self, vertices: u32, weights: &impl WalkWeights<N>, trace: &mut Trace<'_>) -> bool {
        let kept = *weights;
        trace.tell(move || Note::Vertex(kept.kept()));
        vertices < self.settings.max_depth && !weights.is_dark() && !trace.must_stop()
    }

    /// Russian roulette: continues with a probability that is the throughput, between 0.05 and 1, and
    /// adjusts the weights of what survives.
    pub fn survives_roulette(
        &self,
        vertices: u32,
        weights: &mut impl WalkWeights<N>,
        trace: &mut Trace<'_>,
    ) -> bool {
        if vertices < self.settings.first_roulette() {
            return true;
        }
        let q = weights.throughput().clamp(0.05, 1.0);
        if q < 1.0 {
            let u = trace.sampler.roulette();
            trace.tell(move || Note::Roulette { u, q });
            if u >= q {
                return false;
            }
            weights.survive(q);
            let kept = *weights;
            trace.tell(move || Note::Weights(kept.kept()));
        }
        true
    }
}
