//! The report's older baseline: the volumetric path tracer of Mitsuba 2, before the null-scattering path
//! integral.
//!
//! ```text
//!   φ = throughput / density, one number per component; at every vertex, with the power heuristic,
//!   L += φ T Le f_p p_e / (p_e² + p_p²)   along a direction drawn towards a light
//!   L += φ T Le f_p p_p / (p_p² + p_e²)   along the direction in which the path continues
//! ```
//!
//! Multiple importance sampling is applied per bounce: whole paths have no density here. In a uniform medium
//! flights are drawn from the mean extinction of all components (algorithm 2), and the transmittance is
//! exact. In a heterogeneous medium flights use delta tracking (algorithm 3), which handles one component
//! only, and the transmittance is estimated by ratio tracking. **Where the extinction of a heterogeneous
//! medium is chromatic, every path therefore carries one component**, which corresponds to rendering
//! component by component. Every vertex traces two walks towards lights and a third to the next vertex.
//! Horešovský's report, algorithms 1–3, appendix A.
//!
//! In pbrt-v4's names, `phi` (φ) is `beta`. There is no `r_u` and no `r_l`: the MIS weights are formed from
//! the solid angle densities p_e (light sampling) and p_p (phase function or cosine lobe) of a single bounce.
//!
//! Measured on the embedded plume, side-lit and back-lit cloud (96 × 96 pixels, 32 samples): 4.1, 25 and 26
//! look-ups per path; relMSE 7.5, 1.15 and 1.6 times that of Uni+NEE MIS, in 0.8 to 1.6 of its time.

use super::{
    Axis, Entry, Estimator, Kernel, PathEstimate, PathIndex, Settings, biased_transmittance,
    clamped_majorant, dispatch, is_uniform,
};
use crate::math::{Ray, SideStream};
use crate::medium::LocalMedia;
use crate::scene::{MediumDoc, Scene, SceneDoc};
use crate::spectrum::{Components, Radiance, Sampled};
use crate::transport::{Note, PathContext, Technique, Trace, WeightRecord, World};

const USES: &[Axis] = &[Axis::Lights, Axis::LightSampling, Axis::Transmittance];

pub(super) const ENTRY: Entry = Entry {
    id: "mitsuba2-volpath",
    name: "Mitsuba 2 volpath",
    summary: "The report's older baseline: MIS per bounce, one component at a time in chromatic grids.",
    reference: "Horešovský's report, algorithms 1–3; Nimier-David et al. 2019",
    uses: USES,
    infinite_variance,
    bias_of,
    kernel: kernel as Kernel,
};

/// Where components differ, the weight of a thin one is a product of factors e^((mean − μ) t), which is
/// unbounded.
fn infinite_variance(doc: &SceneDoc) -> Option<&'static str> {
    let chromatic = |medium: &MediumDoc| !medium.extinction_and_albedo(0.0).0.is_flat();
    let coloured = is_uniform(doc) && doc.enabled_media().any(chromatic);
    coloured.then_some("flights drawn from the mean extinction give thin components unbounded weights")
}

/// Flights through a uniform medium use closed forms and no majorant. Delta tracking has no weight for
/// collisions at which the extinction exceeds the majorant.
fn bias_of(doc: &SceneDoc) -> Option<&'static str> {
    if doc.enabled_media().any(|medium| medium.emission.is_some()) {
        return Some("it does not support light from within the medium");
    }
    if is_uniform(doc) {
        return None;
    }
    let exceeded = doc.enabled_media().any(|medium| medium.majorant.factor < 1.0);
    clamped_majorant(doc)
        .or(exceeded.then_some("its delta tracking needs a bounding majorant"))
        .or_else(|| biased_transmittance(doc))
}

fn kernel(scene: &Scene, settings: &Settings, at: PathIndex, context: PathContext<'_>) -> PathEstimate {
    if scene.is_uniform() || scene.achromatic {
        dispatch::family::<Mitsuba2Volpath>(scene, settings, at, context)
    } else {
        dispatch::single::<Mitsuba2Volpath>(scene, settings, at, context)
    }
}

struct Mitsuba2Volpath;

impl Estimator for Mitsuba2Volpath {
    const USES: &'static [Axis] = USES;

    fn estimate<M: LocalMedia<N>, C: Components<N>, const N: usize>(
        world: &World<'_, M, C, N>,
        mut ray: Ray,
        trace: &mut Trace<'_>,
    ) -> C::Radiance {
        let mut radiance = C::Radiance::BLACK;
        let mut phi = Sampled::ONE;
        let mut vertices = 0;
        trace.notify(move || Note::Weights(WeightRecord::throughput(phi)));
        loop {
            let surface = world.nearest_surface(&ray, vertices == 0);
            let flight = world.sample_distance(&ray, surface.t(), trace);
            phi *= flight.weight;
            trace.notify(move || Note::Weights(WeightRecord::throughput(phi)));

            let vertex = if let Some(at) = flight.scattered_at {
                world.scattering_vertex(at, &ray)
            } else {
                // Lights on later segments were added when the direction was drawn.
                if vertices == 0 {
                    for light in world.arrivals(&ray, &surface, true) {
                        let value = light.radiance * phi;
                        radiance += world.record(Technique::Walk, (light.radiance, 0.0), value, trace);
                    }
                }
                let Some((vertex, albedo)) = world.surface_vertex(&ray, &surface, trace) else {
                    return radiance;
                };
                phi *= albedo;
                vertex
            };

            vertices += 1;
            trace.notify(move || Note::Vertex(WeightRecord::throughput(phi)));
            if vertices >= world.settings.max_depth || phi.is_zero() || trace.must_stop() {
                return radiance;
            }

            // A direction drawn towards a light.
            if let Some(aim) = world.aim(&vertex, trace) {
                let (relative, p_p) = world.by_any(&vertex, &aim.outgoing);
                let p_e = aim.density;
                let weight = aim.outgoing.value * p_e / (p_e * p_e + p_p * p_p);
                let value = aim.radiance * (phi * relative * world.transmittance_to(&aim, trace) * weight);
                radiance += world.record(Technique::Connection, (aim.radiance, p_p), value, trace);
            }

            // The direction in which the path continues.
            let Some((onward, outgoing, relative, connects)) = world.leave_by_any(&vertex, trace) else {
                return radiance;
            };
            ray = onward;
            let end = world.nearest_surface(&ray, false);
            for light in world.arrivals(&ray, &end, false) {
                let p_e = if connects {
                    world.aim_density(&vertex, light.index, &end.light_point(&ray))
                } else {
                    0.0
                };
                let p_p = outgoing.density;
                let weight = outgoing.value * p_p / (p_p * p_p + p_e * p_e);
                trace.notify(move || Note::LightWalk);
                trace.start_side_stream(SideStream::LightWalk);
                let value =
                    light.radiance * (phi * relative * world.transmittance(&ray, end.t(), trace) * weight);
                radiance += world.record(Technique::Walk, (light.radiance, p_e), value, trace);
                trace.notify(move || Note::LightWalkEnds);
            }
            phi *= relative * (outgoing.value / outgoing.density);
            trace.notify(move || Note::Weights(WeightRecord::throughput(phi)));

            if vertices >= world.settings.first_roulette() {
                let q = phi.max_component().clamp(0.05, 1.0);
                let u = trace.sampler.roulette();
                trace.notify(move || Note::Roulette { u, q });
                if u >= q {
                    return radiance;
                }
                phi *= 1.0 / q;
                trace.notify(move || Note::Weights(WeightRecord::throughput(phi)));
            }
        }
    }
}
