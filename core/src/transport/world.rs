//! A scene evaluated at the components of one path: the interface of an estimator to the scene.

use super::{
    Boundary, Collision, DirectionSample, DirectionSampler, EventRule, Guide, Note, PathContext,
    ScatteringPoint, Technique, Vertex, Walk, WalkWeights,
};
use crate::light::{Emitter, LobeParts};
use crate::material::Material;
use crate::math::{Ray, Sampler, SideStream};
use crate::medium::LocalMedia;
use crate::scene::{
    Absorption, Bookkeeping, Crossing, DirectionSampling, DistanceSampling, Fault, Heuristics, LightSampling,
    LightSelection, LightWalk, NearestSurface, Scene, Tracking,
};
use crate::spectrum::{Components, Radiance, Sampled};
use crate::transmittance::TransmittanceKind;

/// Settings shared by all paths of a render.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathSettings {
    /// Treatment of absorption at a collision.
    pub absorption: Absorption,
    /// Rule by which distances to the next event are drawn.
    pub distances: DistanceSampling,
    /// Heuristics of multiple importance sampling.
    pub heuristics: Heuristics,
    /// Form in which f and p of a path are stored.
    pub bookkeeping: Bookkeeping,
    /// Rule by which spectral tracking draws events.
    pub tracking: Tracking,
    /// Deliberate error in the path weights.
    pub fault: Fault,
    /// Walk that finds the lights of unidirectional sampling.
    pub light_walk: LightWalk,
    /// Rule by which a connection chooses its light.
    pub lights: LightSelection,
    /// Rule by which a connection draws a direction towards its light.
    pub light_sampling: LightSampling,
    /// Transmittance estimator of a connection, where MIS does not need its density.
    pub transmittance: TransmittanceKind,
    /// Distribution from which directions in the medium are drawn.
    pub directions: DirectionSampling,
    /// Largest number of segments between camera, real vertices and light; `u32::MAX` for no limit.
    pub max_depth: u32,
    /// Number of real vertices from which Russian roulette applies; `u32::MAX` for never.
    pub roulette_depth: u32,
}

impl PathSettings {
    /// Number of real vertices from which Russian roulette may end a path; `u32::MAX` for never.
    #[must_use]
    #[inline]
    pub fn first_roulette(&self) -> u32 {
        match self.absorption {
            Absorption::Roulette => 0,
            Absorption::Analogue | Absorption::Weighted => self.roulette_depth,
        }
    }
}

/// Steps of a path between two checks of the cancellation token.
const STEPS_PER_CHECK: u32 = 1024;

/// Random numbers, cost, cancellation token and optional observer of one path.
#[derive(Debug)]
pub struct Trace<'a> {
    /// Random numbers of the walk.
    pub sampler: Sampler,
    /// Random numbers of the current side stream: a connection, or a walk beside the path's own.
    pub connection: Sampler,
    /// Look-ups in the medium: of its coefficients, and of its temperature for emission.
    pub lookups: u64,
    /// Collisions at which the extinction exceeded the majorant.
    pub exceeded: u64,
    context: PathContext<'a>,
    steps: u32,
    stopped: bool,
}

impl<'a> Trace<'a> {
    /// Creates the trace of a path, with all counts at zero.
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

    /// Restarts `connection` with the random numbers of a side stream.
    #[inline]
    pub fn start_side_stream(&mut self, what: SideStream) {
        self.connection = self.sampler.side_stream(what);
    }

    /// Reports a step to the observer, if there is one.
    #[inline(always)]
    pub fn notify(&mut self, note: impl FnOnce() -> Note) {
        self.context.notify(note);
    }

    /// Counts a step of the path and returns whether the path has been cancelled; once true, it remains true.
    pub fn must_stop(&mut self) -> bool {
        self.steps = self.steps.wrapping_add(1);
        if self.steps.is_multiple_of(STEPS_PER_CHECK) && !self.context.cancel.is_active() {
            self.stopped = true;
        }
        self.stopped
    }
}

/// Light that a ray reaches.
#[derive(Clone, Copy, Debug)]
pub struct Arrival<R> {
    /// Emitted radiance.
    pub radiance: R,
    /// Index of the light.
    pub index: usize,
}

/// A scene, its media and its spectra at the components of one path.
pub struct World<'a, M, C, const N: usize> {
    /// The frozen scene.
    pub scene: &'a Scene,
    /// The media at the components.
    pub media: M,
    /// Wavelengths or channels of the path.
    pub components: C,
    /// Settings shared by all paths.
    pub settings: PathSettings,
}

impl<M: LocalMedia<N>, C: Components<N>, const N: usize> World<'_, M, C, N> {
    /// The walk through the media along a ray, up to `t_max`.
    #[must_use]
    #[inline(always)]
    pub fn walk(&self, ray: &Ray, t_max: f32) -> Walk<'_, M, N> {
        Walk::new(&self.media, ray, t_max, &self.settings)
    }

    /// The walk of a connection along a ray, up to its light at `t_max`.
    #[must_use]
    #[inline(always)]
    pub fn walk_to_light(&self, ray: &Ray, t_max: f32) -> Walk<'_, M, N> {
        Walk::along(&self.media, ray, t_max, EventRule::from(&self.settings), false)
    }

    /// Radiance that the medium of a collision emits there, not yet weighted by the path; `None` where it
    /// does not emit.
    #[must_use]
    #[inline]
    pub fn emission_at(&self, collision: &Collision<N>, trace: &mut Trace<'_>) -> Option<C::Radiance> {
        let medium = self.scene.medium(collision.medium);
        let emission = medium.emission.as_ref()?;
        trace.lookups += 1;
        let kelvin = emission.kelvin_at(medium.medium_from_world().transform_point3(collision.point));
        (kelvin > 0.0).then(|| self.components.blackbody(kelvin) * Sampled::splat(emission.scale))
    }

    /// Reports a contribution to the estimate to the observer and returns it: `value` is `emitted` weighted
    /// by the path. The other technique that could have sampled the light has the density `other_density`.
    #[inline(always)]
    pub fn record(
        &self,
        technique: Technique,
        (emitted, other_density): (C::Radiance, f32),
        value: C::Radiance,
        trace: &mut Trace<'_>,
    ) -> C::Radiance {
        let components = self.components;
        trace.notify(move || Note::Contribution {
            technique,
            emitted: emitted.lanes(),
            other_density,
            value: value.lanes(),
            film: components.to_film(value),
        });
        value
    }

    /// The surface that a ray meets first. Camera rays pass through hidden lights.
    #[must_use]
    pub fn nearest_surface(&self, ray: &Ray, from_camera: bool) -> NearestSurface<'_> {
        self.scene.nearest_surface(ray, f32::INFINITY, from_camera)
    }

    /// All lights that a ray reaches at its end: the light that `end` belongs to, or all lights behind the
    /// scene. Hidden lights are left out for camera rays.
    pub fn arrivals(
        &self,
        ray: &Ray,
        end: &NearestSurface,
        from_camera: bool,
    ) -> impl Iterator<Item = Arrival<C::Radiance>> {
        let (ray, met, normal, leaves) = (*ray, end.light(), end.normal(), end.is_none());
        self.scene.lights.iter().enumerate().filter_map(move |(index, light)| {
            // Lights with a surface emit on the side of its normal only.
            let met = if leaves {
                light.is_behind(ray.direction)
            } else {
                met == Some(index) && ray.direction.dot(normal) < 0.0
            };
            (met && (light.visible || !from_camera))
                .then(|| Arrival { radiance: light.radiance(ray.direction, &self.components), index })
        })
    }

    /// The vertex at which a ray ends on a surface, and the albedo that the path is multiplied by there; `None`
    /// at a surface that absorbs all light, and if the ray leaves the scene. Surfaces that are not diffuse have
    /// an albedo of one; their weights depend on the direction in which the path leaves.
    #[must_use]
    pub fn surface_vertex(
        &self,
        ray: &Ray,
        end: &NearestSurface,
        trace: &mut Trace<'_>,
    ) -> Option<(Vertex, Sampled<N>)> {
        let material = end.material()?;
        let at = end.point(ray)?;
        let side = -ray.direction.dot(end.normal()).signum();
        let (outward, normal) = (end.normal() * side, at.shading_normal * side);
        let (albedo, boundary) = match material {
            Material::Diffuse(diffuse) => (self.components.evaluate(&diffuse.albedo), None),
            _ => {
                let crossing = self.scene.crossing(ray, end).unwrap_or(Crossing::NONE);
                (Sampled::ONE, Some(Boundary { surface: end.index(), crossing, lift: at.error }))
            }
        };
        let point = at.position;
        trace.notify(move || Note::Surface { point, albedo: albedo.lanes() });
        // The vertex is lifted off the surface by the error of its position.
        let point = point + outward * at.error;
        Some((Vertex::Surface { point, omega_in: ray.direction, normal, outward, boundary }, albedo))
    }

    /// A scattering vertex in a medium, on this ray.
    #[must_use]
    #[inline]
    pub fn scattering_vertex(&self, at: ScatteringPoint, ray: &Ray) -> Vertex {
        let ScatteringPoint { point, medium, .. } = at;
        let by_product = self.settings.directions == DirectionSampling::Product
            || self.settings.light_sampling == LightSampling::Product;
        let lights = &self.scene.lights;
        let parts = (by_product && !lights.is_empty()).then(|| {
            LobeParts::new(lights, point, ray.direction, self.scene.medium(medium).phase.mean_cosine())
        });
        Vertex::Medium { point, medium, omega_in: ray.direction, parts }
    }

    /// Sampler of the directions out of a vertex, by the settings.
    #[must_use]
    #[inline]
    pub fn directions(&self, vertex: &Vertex) -> DirectionSampler<'_> {
        let guide = match self.settings.directions {
            DirectionSampling::Phase => None,
            DirectionSampling::TowardsLights => self.scene.lobes.as_ref().map(Guide::Lobes),
            DirectionSampling::Product => Some(Guide::Product),
        };
        let medium = match vertex {
            Vertex::Medium { medium, .. } => *medium,
            Vertex::Surface { .. } => 0,
        };
        DirectionSampler { phase: &self.scene.medium(medium).phase, guide }
    }

    /// Samples the direction in which a path leaves a vertex, multiplies it into the weights and returns the
    /// next ray.
    #[inline]
    pub fn sample_direction(
        &self,
        vertex: &Vertex,
        weights: &mut impl WalkWeights<N>,
        trace: &mut Trace<'_>,
    ) -> Ray {
        if let Some(boundary) = vertex.boundary() {
            return self.leave_boundary(vertex, boundary, weights, trace);
        }
        let outgoing = self.sample_outgoing(vertex, trace);
        weights.choose_direction(&outgoing);
        Ray { origin: vertex.point(), direction: outgoing.direction }
    }

    /// Draws the direction in which a path leaves a vertex.
    #[inline]
    pub fn sample_outgoing(&self, vertex: &Vertex, trace: &mut Trace<'_>) -> DirectionSample {
        let u = trace.sampler.direction();
        let outgoing = self.directions(vertex).draw(vertex, u);
        trace.sampler.start_vertex();
        let ray = Ray { origin: vertex.point(), direction: outgoing.direction };
        trace.notify(move || Note::Direction { ray, u, value: outgoing.value, density: outgoing.density });
        outgoing
    }

    /// Whether a path continues beyond its vertex number `vertices`: it is within the depth limit, can still
    /// contribute, and has not been cancelled.
    pub fn within_depth(&self, vertices: u32, weights: &impl WalkWeights<N>, trace: &mut Trace<'_>) -> bool {
        let weight_record = *weights;
        trace.notify(move || Note::Vertex(weight_record.weight_record()));
        vertices < self.settings.max_depth && !weights.is_zero() && !trace.must_stop()
    }

    /// Russian roulette: the path survives with a probability equal to its throughput, clamped to 0.05 to 1,
    /// and its weights are divided accordingly.
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
            trace.notify(move || Note::Roulette { u, q });
            if u >= q {
                return false;
            }
            weights.survive(q);
            let weight_record = *weights;
            trace.notify(move || Note::Weights(weight_record.weight_record()));
        }
        true
    }
}
