//! Next-event estimation: every real vertex is connected to a light.
//!
//! ```text
//!   L_j ≈ Le_j · f_j / ( (1/C) Σ_i p_nee,i )
//! ```
//!
//! The walk itself collects light only before its first real vertex, where no connection can be made;
//! afterwards light that it meets is ignored, as connections account for it. Good for small lights
//! (the report's figure 3, lower row), poor for sharp phase functions. Miller, Georgiev and Jarosz 2019,
//! section 5.2.
//!
//! Measured on the embedded plume, side-lit and back-lit cloud (96 × 96 pixels, 32 samples): 2.7, 13.9 and 14.2
//! look-ups per path; relMSE 1.05, 1.9 and 450 times that of Uni+NEE MIS, in about its time.

use super::{
    Entry, Estimator, HERO_DRAWS, NO_FAULTS, ONE_TECHNIQUE, ONE_WALK, RESCALED, biased_transmittance,
    clamped_majorant, dispatch,
};
use crate::math::Ray;
use crate::medium::LocalMedium;
use crate::scene::SceneDoc;
use crate::spectrum::{Components, Radiance};
use crate::transmittance::TransmittanceKind;
use crate::transport::{Event, PathWeights, Technique, Trace, WalkWeights, Weights, World};

pub(super) const ENTRY: Entry = Entry {
    id: "nee",
    name: "NEE",
    summary: "Connects every scattering vertex to a light; wins for small lights.",
    reference: "Miller, Georgiev & Jarosz 2019, section 5.2; Horešovský's report, figure 3",
    unused: &[ONE_WALK, NO_FAULTS, ONE_TECHNIQUE, HERO_DRAWS, RESCALED],
    infinite_variance: |_| None,
    bias_of,
    kernel: dispatch::family::<Nee>,
};

fn bias_of(doc: &SceneDoc) -> Option<&'static str> {
    clamped_majorant(doc).or_else(|| biased_transmittance(doc))
}

pub(super) struct Nee;

impl Estimator for Nee {
    fn estimate<L: LocalMedium<N>, C: Components<N>, const N: usize>(
        world: &World<'_, L, C, N>,
        mut ray: Ray,
        trace: &mut Trace<'_>,
    ) -> C::Radiance {
        let heuristics = world.settings.heuristics;
        let mut radiance = C::Radiance::BLACK;
        let mut path = PathWeights::CAMERA;
        let mut vertices = 0;
        loop {
            // Fly until something real happens; the weights follow every null collision.
            let surface = world.nearest_surface(&ray, vertices == 0);
            let mut walk = world.walk(&ray, surface.t());
            let scattered_at = loop {
                let Some(collision) = walk.next_collision(trace, &mut path) else { break None };
                if let Some(glow) = world.emission_at(&collision, trace) {
                    radiance += world.credit(
                        Technique::Glow,
                        (glow, 0.0),
                        path.emitted(glow, &collision, heuristics),
                        trace,
                    );
                }
                match collision.draw_event(trace) {
                    Event::Null => path.null(&collision),
                    Event::Absorption => return radiance,
                    Event::Scattering => {
                        path.scatter(&collision);
                        break Some(collision.point);
                    }
                }
            };

            let vertex = if let Some(point) = scattered_at {
                world.scattering_vertex(point, &ray)
            } else {
                if vertices == 0 {
                    // No real vertex yet: only the walk can find this light.
                    for light in world.arrivals(&ray, &surface, true) {
                        let value = path.unidirectional(light.radiance, heuristics);
                        radiance += world.credit(Technique::Walk, (light.radiance, 0.0), value, trace);
                    }
                }
                let Some((vertex, albedo)) = world.diffuse_vertex(&ray, &surface, trace) else {
                    return radiance;
                };
                path.reflect(albedo);
                vertex
            };

            vertices += 1;
            if !world.goes_on(vertices, &path, trace) {
                return radiance;
            }
            let link = if world.settings.transmittance == TransmittanceKind::ALONG_THE_PATH {
                world.connect(&vertex, &path, trace)
            } else {
                world.connect_by_estimate(&vertex, &path, trace)
            };
            if let Some(link) = link {
                let value = link.weights.connected_only(link.radiance, heuristics);
                radiance += world.credit(Technique::Connection, (link.radiance, 0.0), value, trace);
            }
            if !world.survives_roulette(vertices, &mut path, trace) {
                return radiance;
            }
            ray = world.leave(&vertex, &mut path, trace);
        }
    }
}
