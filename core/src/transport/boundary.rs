//! Scattering at surfaces whose lobes depend on the component: mirrors, metals, dielectrics.
//!
//! A direction is drawn with the density of the hero. At component j the path has the value f_j |cos θ| of the
//! lobe, and density p_i had i been the hero:
//!
//! | lobe | contribution_j | uni_i | nee_i |
//! | --- | --- | --- | --- |
//! | rough | f_j \|cos θ\| / p_h | p_i / p_h | uni_i(before) / p_h |
//! | smooth, drawn with probability c_i | ρ_j / c_h | c_i / c_h | 0 |
//!
//! nee is zero where no connection can have the direction, so that the weights of a walk need no special case.
//! Components that a smooth refraction bends elsewhere have ρ_j = c_j = 0; the mean of uni over the heroes then
//! makes up for them.

use super::{Boundary, DirectionSample, Note, Trace, Vertex, WalkWeights, World};
use crate::material::{Material, Scattered, Scatterer};
use crate::math::{Frame, Ray};
use crate::medium::LocalMedia;
use crate::spectrum::{Components, Sampled};
use glam::{Vec2, Vec3};

/// A direction at a boundary with its values and densities at all components, relative to their largest.
#[derive(Clone, Copy, Debug)]
pub struct Towards<const N: usize> {
    /// Direction with the largest value and the largest density.
    pub outgoing: DirectionSample,
    /// Value at every component, relative to the largest.
    pub value: Sampled<N>,
    /// Density at every component, relative to the largest.
    pub density: Sampled<N>,
}

impl<M: LocalMedia<N>, C: Components<N>, const N: usize> World<'_, M, C, N> {
    /// The lobes of a boundary at the components, as seen from the side of the vertex.
    fn scatterer(&self, boundary: &Boundary) -> Option<Scatterer<N>> {
        let at = |spectrum| self.components.evaluate(spectrum);
        let index = |body: Option<u32>| {
            let body = body.and_then(|body| self.scene.bodies.0.get(body as usize));
            body.map_or(Sampled::ONE, |body| at(&body.ior))
        };
        Some(match self.scene.surfaces.get(boundary.surface as usize)?.material.as_ref()? {
            Material::Mirror(mirror) => Scatterer::Mirror(at(&mirror.reflectance)),
            Material::Conductor(metal) => Scatterer::Conductor(at(&metal.eta), at(&metal.k), metal.ggx),
            Material::Dielectric(dielectric) => {
                let (before, after) = (index(boundary.crossing.before), index(boundary.crossing.after));
                Scatterer::Dielectric(after.zip(before, |after, before| after / before), dielectric.ggx)
            }
            Material::ThinDielectric(pane) => Scatterer::Thin(at(&pane.ior)),
            Material::Diffuse(_) => return None,
        })
    }

    /// Returns whether connections from a vertex can have a density: from all except smooth surfaces.
    #[must_use]
    pub fn connects(&self, vertex: &Vertex) -> bool {
        vertex
            .boundary()
            .is_none_or(|boundary| self.scatterer(boundary).is_some_and(|lobes| !lobes.is_specular()))
    }

    /// A direction at a boundary, with its values and densities; `None` where they vanish at every component.
    #[must_use]
    pub fn boundary_towards(&self, vertex: &Vertex, direction: Vec3) -> Option<Towards<N>> {
        let Vertex::Surface { omega_in, normal, outward, boundary: Some(boundary), .. } = vertex else {
            return None;
        };
        let frame = Frame::about(*normal);
        let (wo, wi) = (frame.to_local(-*omega_in), frame.to_local(direction));
        // A direction that reflects at the shading normal must not pass the geometry, nor the other way round.
        if (wi.z > 0.0) != (outward.dot(direction) > 0.0) {
            return None;
        }
        let (value, density) = self.scatterer(boundary)?.towards(wo, wi)?;
        let (most_value, most_density) = (value.max_component(), density.max_component());
        if !(most_value > 0.0 && most_density > 0.0) {
            return None;
        }
        Some(Towards {
            outgoing: DirectionSample { direction, value: most_value, density: most_density },
            value: value * (1.0 / most_value),
            density: density * (1.0 / most_density),
        })
    }

    /// Multiplies the values and densities of the components into the weights of a connection that was made with
    /// their largest; without effect at vertices whose lobe is the same for all components.
    #[inline]
    pub fn adjust_at_boundary<W: WalkWeights<N>>(
        &self,
        vertex: &Vertex,
        outgoing: &DirectionSample,
        weights: &mut W,
        trace: &mut Trace<'_>,
    ) {
        if vertex.boundary().is_some()
            && let Some(Towards { value, density, .. }) = self.boundary_towards(vertex, outgoing.direction)
        {
            weights.adjust(value, density);
            trace.notify(move || Note::Adjusted { value: value.lanes(), density: density.lanes() });
        }
    }

    /// Values of the components relative to that of a direction towards a light, and the density with which
    /// [`Self::leave_by_any`] would have drawn it.
    #[must_use]
    pub fn by_any(&self, vertex: &Vertex, outgoing: &DirectionSample) -> (Sampled<N>, f32) {
        let at_boundary = vertex.boundary().and_then(|_| self.boundary_towards(vertex, outgoing.direction));
        at_boundary.map_or((Sampled::ONE, outgoing.density), |towards| {
            (towards.value, towards.density.mean() * outgoing.density)
        })
    }

    /// Draws the direction in which a path leaves a vertex, at a boundary by the density averaged over the
    /// components: for estimators that divide by the density of the direction whichever component is the hero.
    /// Returns the next ray, the direction with its density, the values of the components relative to its own,
    /// and whether connections can have the direction; `None` where the path is absorbed.
    pub fn leave_by_any(
        &self,
        vertex: &Vertex,
        trace: &mut Trace<'_>,
    ) -> Option<(Ray, DirectionSample, Sampled<N>, bool)> {
        let Some(boundary) = vertex.boundary() else {
            let outgoing = self.sample_outgoing(vertex, trace);
            let ray = Ray { origin: vertex.point(), direction: outgoing.direction };
            return Some((ray, outgoing, Sampled::ONE, true));
        };
        let lane = if N == 1 { 0 } else { ((trace.sampler.next_1d() * N as f32) as usize).min(N - 1) };
        let (ray, u, drawn) = self.draw_at_boundary(vertex, boundary, lane, trace)?;
        let drawn = Scattered { density: Sampled::splat(drawn.density.mean()), ..drawn };
        Self::note_leaving(ray, u, &drawn, trace);
        let most = drawn.value.max_component();
        let direction = ray.direction;
        let outgoing = DirectionSample { direction, value: most, density: drawn.density.hero() };
        (most > 0.0).then(|| (ray, outgoing, drawn.value * (1.0 / most), !drawn.is_specular))
    }

    /// Draws the direction in which a path leaves a boundary with the density of component `lane`. Returns the
    /// next ray, the random numbers and the direction; `None` where the path is absorbed.
    fn draw_at_boundary(
        &self,
        vertex: &Vertex,
        boundary: &Boundary,
        lane: usize,
        trace: &mut Trace<'_>,
    ) -> Option<(Ray, Vec2, Scattered<N>)> {
        let Vertex::Surface { omega_in, normal, outward, .. } = vertex else { return None };
        let u = trace.sampler.direction();
        let which = trace.sampler.next_1d();
        trace.sampler.start_vertex();
        let frame = Frame::about(*normal);
        let wo = frame.to_local(-*omega_in);
        let drawn = self.scatterer(boundary)?.draw(wo, lane, u, which)?;
        let direction = frame.to_world(drawn.wi).normalize();
        if (drawn.wi.z > 0.0) != (outward.dot(direction) > 0.0) {
            return None;
        }
        Some((vertex.ray(direction), u, drawn))
    }

    fn note_leaving(ray: Ray, u: Vec2, drawn: &Scattered<N>, trace: &mut Trace<'_>) {
        let (value, density) = (drawn.value.lanes(), drawn.density.lanes());
        let is_specular = drawn.is_specular;
        trace.notify(move || Note::Boundary { ray, u, value, density, is_specular });
    }

    /// Samples the direction in which a path leaves a vertex by [`Self::leave_by_any`] and multiplies it into
    /// the weights.
    pub fn sample_direction_by_any(
        &self,
        vertex: &Vertex,
        weights: &mut impl WalkWeights<N>,
        trace: &mut Trace<'_>,
    ) -> Option<Ray> {
        let (ray, outgoing, value, connects) = self.leave_by_any(vertex, trace)?;
        if vertex.boundary().is_some() {
            weights.leave(value * outgoing.value, Sampled::splat(outgoing.density), connects);
        } else {
            weights.choose_direction(&outgoing);
        }
        Some(ray)
    }

    /// Samples the direction in which a path leaves a boundary, multiplies it into the weights and returns the
    /// next ray. The weights become zero where the path is absorbed.
    pub(super) fn leave_boundary(
        &self,
        vertex: &Vertex,
        boundary: &Boundary,
        weights: &mut impl WalkWeights<N>,
        trace: &mut Trace<'_>,
    ) -> Ray {
        match self.draw_at_boundary(vertex, boundary, 0, trace) {
            Some((ray, u, drawn)) => {
                Self::note_leaving(ray, u, &drawn, trace);
                weights.leave(drawn.value, drawn.density, !drawn.is_specular);
                ray
            }
            None => {
                weights.leave(Sampled::ZERO, Sampled::ONE, true);
                let ray = Ray { origin: vertex.point(), direction: Vec3::Y };
                let (value, density, u) = ([0.0; 4], [1.0; 4], Vec2::ZERO);
                trace.notify(move || Note::Boundary { ray, u, value, density, is_specular: false });
                ray
            }
        }
    }
}
