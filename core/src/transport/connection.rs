//! Next-event estimation: a connection from a vertex to a point drawn on a light.
//!
//! Every collision on the connection is taken as null (ratio tracking), so that the connection always
//! reaches the light, with the transmittance as its weight (the report's algorithm 6, mode "nee").

use super::{
    Collision, DirectionSample, EventRule, Note, Part, Place, Technique, Trace, Vertex, WalkWeights, Weights,
    World,
};
use crate::light::{Emitter, LightPoint, LobeParts};
use crate::math::{Ray, SideStream};
use crate::medium::{LocalMedia, Traversal};
use crate::scene::{LightSampling, NearestSurface};
use crate::spectrum::{Components, Sampled};
use crate::transmittance::InMedium;
use glam::Vec2;

/// A connection that has reached its light.
#[derive(Clone, Copy, Debug)]
pub struct Connection<R, W> {
    /// Weights of the whole path, from camera to light, as made by the connection.
    pub weights: W,
    /// Emitted radiance.
    pub radiance: R,
    /// Direction at the vertex, with the density with which the walk would have drawn it.
    pub outgoing: DirectionSample,
}

/// A direction sampled towards a light, with only the medium in between.
#[derive(Clone, Copy, Debug)]
pub struct Aim<R> {
    /// Phase function or cosine lobe, and the density with which the walk would have drawn the direction.
    pub outgoing: DirectionSample,
    /// Ray from the vertex.
    pub ray: Ray,
    /// Distance to the light.
    pub distance: f32,
    /// Density with which the direction was drawn, including the choice of the light; per steradian.
    pub density: f32,
    /// Emitted radiance.
    pub radiance: R,
    /// Index of the light.
    pub light: usize,
}

impl<R> Aim<R> {
    pub(super) fn note(&self) -> Note {
        Note::Connect {
            ray: self.ray,
            distance: self.distance,
            value: self.outgoing.value,
            walk_density: self.outgoing.density,
            light_density: self.density,
            light: self.light,
        }
    }
}

impl<M: LocalMedia<N>, C: Components<N>, const N: usize> World<'_, M, C, N> {
    /// As [`Self::connect`], with the transmittance estimator of the settings. Such an estimate has no path
    /// density, so that MIS can weight the path only over heroes.
    pub fn connect_by_estimate<W: Weights<N>>(
        &self,
        vertex: &Vertex,
        path: &W,
        trace: &mut Trace<'_>,
    ) -> Option<Connection<C::Radiance, W>> {
        let aim = self.aim(vertex, trace)?;
        let mut weights = self.set_out(vertex, path, &aim, trace);
        trace.notify(move || aim.note());
        let sets_out = weights;
        trace.notify(move || Note::Weights(sets_out.weight_record()));
        weights.attenuate(self.estimate_transmittance(&aim.ray, aim.distance, trace));
        let arrives = weights;
        trace.notify(move || Note::Weights(arrives.weight_record()));
        trace.notify(move || Note::Connected { arrives: true });
        Some(Connection { weights, radiance: aim.radiance, outgoing: aim.outgoing })
    }

    /// Chooses a light, draws a direction towards it, and walks to the light. `None` if the contribution is
    /// zero.
    pub fn connect<W: Weights<N>>(
        &self,
        vertex: &Vertex,
        path: &W,
        trace: &mut Trace<'_>,
    ) -> Option<Connection<C::Radiance, W>> {
        let aim = self.aim(vertex, trace)?;
        let weights = self.set_out(vertex, path, &aim, trace);
        let weights = self.arrive(&aim, weights, trace)?;
        Some(Connection { weights, radiance: aim.radiance, outgoing: aim.outgoing })
    }

    /// Weights of a connection as it leaves its vertex.
    #[inline]
    fn set_out<W: Weights<N>>(
        &self,
        vertex: &Vertex,
        path: &W,
        aim: &Aim<C::Radiance>,
        trace: &mut Trace<'_>,
    ) -> W {
        let mut weights = path.connect(&aim.outgoing, aim.density);
        self.adjust_at_boundary(vertex, &aim.outgoing, &mut weights, trace);
        weights
    }

    /// Traverses the connection to a light by [`Self::pass_by_ratio`].
    #[inline]
    pub fn arrive<W: WalkWeights<N>>(
        &self,
        aim: &Aim<C::Radiance>,
        weights: W,
        trace: &mut Trace<'_>,
    ) -> Option<W> {
        let told = *aim;
        trace.notify(move || told.note());
        let weights = self.pass_by_ratio(&aim.ray, aim.distance, weights, trace);
        let arrives = weights.is_some();
        trace.notify(move || Note::Connected { arrives });
        weights
    }

    /// Traverses a stretch of a ray by ratio tracking, with every collision taken as null; `None` if the
    /// contribution becomes zero.
    #[inline]
    pub fn pass_by_ratio<W: WalkWeights<N>>(
        &self,
        ray: &Ray,
        t_max: f32,
        mut weights: W,
        trace: &mut Trace<'_>,
    ) -> Option<W> {
        let mut walk = self.walk_to_light(ray, t_max);
        while let Some(collision) = walk.next_collision(trace, &mut weights) {
            weights.null_by_ratio(&collision);
            if weights.is_zero() {
                trace.notify(move || Note::Weights(weights.weight_record()));
                return None;
            }
        }
        Some(weights)
    }

    /// The collision that a walk could have at a point of a ray; `None` outside all media. Where media
    /// overlap, one is drawn by its share of the majorant averaged over the components: the distance was not
    /// drawn by the hero, and neither is the medium.
    pub fn collision_at(&self, ray: &Ray, t: f32, trace: &mut Trace<'_>) -> Option<Collision<N>> {
        let onward = Ray { origin: ray.at(t), direction: ray.direction };
        let (entry, mut traversal) = self.media.traverse(&onward, f32::INFINITY)?;
        // Stretches before the first segment are empty.
        let segment = traversal.next().filter(|segment| entry + segment.t0 <= 0.0)?;
        let number = || trace.connection.next_1d();
        let member = traversal.draw(0.0, &segment, |majorant| majorant.mean(), number);
        trace.lookups += 1;
        let place = Place::of(onward.origin, &member);
        let rule = EventRule::from(&self.settings);
        Some(place.collide(traversal.medium(&member), rule, Part::Whole).in_medium(&member))
    }

    /// Chooses a light and draws a direction towards it; `None` if the contribution is zero or the light is
    /// occluded.
    pub fn aim(&self, vertex: &Vertex, trace: &mut Trace<'_>) -> Option<Aim<C::Radiance>> {
        trace.start_side_stream(SideStream::Connection);
        let (u, which) = trace.sampler.light(&mut trace.connection);
        let (light, probability) =
            self.scene.light_choice.choose(vertex.point(), which, self.settings.lights)?;
        let aim = self.aim_at(vertex, light, u)?;
        Some(Aim { density: aim.density * probability, ..aim })
    }

    /// Draws a direction towards a light, without the probability of choosing it; `None` if the contribution
    /// is zero or the light is occluded, or extinguished by a medium without a boundary.
    #[inline]
    pub fn aim_at(&self, vertex: &Vertex, index: usize, u: Vec2) -> Option<Aim<C::Radiance>> {
        let light = self.scene.lights.get(index)?;
        let sample = match self.product(vertex) {
            Some(parts) => parts.sample_light(index, light, vertex.point(), u)?,
            None => light.sample(vertex.point(), u)?,
        };
        let at = sample.point;
        let (outgoing, ray) = if vertex.boundary().is_some() {
            (self.boundary_towards(vertex, at.direction)?.outgoing, vertex.ray(at.direction))
        } else {
            let ray = Ray { origin: vertex.point(), direction: at.direction };
            (self.directions(vertex).towards(vertex, at.direction), ray)
        };
        // The occlusion test ends just short of the light; the medium extends all the way.
        let extinguished = self.scene.is_unbounded && at.distance == f32::INFINITY;
        if outgoing.value <= 0.0 || extinguished || self.scene.occluded(&ray, at.distance * (1.0 - 1e-4)) {
            return None;
        }
        Some(Aim {
            outgoing,
            ray,
            distance: at.distance,
            density: sample.density,
            radiance: light.radiance(at.direction, &self.components),
            light: index,
        })
    }

    /// Adds the lights at the end of a walk's ray, weighted against connections from the vertex `last` that
    /// the walk left. Without such a vertex (a camera ray) no connection could have made the path.
    #[inline]
    pub fn add_light_on_ray<W: Weights<N>>(
        &self,
        last: Option<&Vertex>,
        ray: &Ray,
        end: &NearestSurface<'_>,
        path: &W,
        radiance: &mut C::Radiance,
        trace: &mut Trace<'_>,
    ) {
        let heuristics = self.settings.heuristics;
        for light in self.arrivals(ray, end, last.is_none()) {
            let (other, value) = match last {
                None => (0.0, path.unidirectional(light.radiance, heuristics)),
                Some(vertex) => {
                    let nee = self.aim_density(vertex, light.index, &end.light_point(ray));
                    (nee, path.combined(light.radiance, nee, heuristics))
                }
            };
            *radiance += self.record(Technique::Walk, (light.radiance, other), value, trace);
        }
    }

    /// Density with which [`Self::aim`] draws a point of a light from a vertex; per steradian, including the
    /// choice of the light.
    #[must_use]
    pub fn aim_density(&self, vertex: &Vertex, index: usize, at: &LightPoint) -> f32 {
        let (from, scene) = (vertex.point(), self.scene);
        let density = scene.lights.get(index).map_or(0.0, |light| match self.product(vertex) {
            Some(parts) => parts.light_density(index, light, from, at),
            None => light.density(from, at),
        });
        density * scene.light_choice.probability(index, from, self.settings.lights)
    }

    /// The lobe parts at a vertex, if connections are drawn from them.
    #[inline]
    fn product<'v>(&self, vertex: &'v Vertex) -> Option<&'v LobeParts> {
        match (self.settings.light_sampling, vertex) {
            (LightSampling::Product, Vertex::Medium { parts, .. }) => parts.as_ref(),
            _ => None,
        }
    }

    /// Transmittance along a ray, by the estimator of the settings.
    pub fn estimate_transmittance(&self, ray: &Ray, t_max: f32, trace: &mut Trace<'_>) -> Sampled<N> {
        let Some((_, traversal)) = self.media.traverse(ray, t_max) else { return Sampled::ONE };
        if traversal.t_end() == f32::INFINITY {
            // A medium without a boundary extinguishes light from infinity.
            return Sampled::ZERO;
        }
        let profile = InMedium::new(traversal);
        let estimate = self.settings.transmittance.estimate(&profile, &mut trace.connection);
        trace.lookups += u64::from(estimate.lookups);
        trace.notify(move || Note::Transmittance { estimate: estimate.weight.lanes() });
        estimate.weight
    }
}
