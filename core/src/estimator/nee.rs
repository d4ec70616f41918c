//! Next-event estimation: every real vertex is connected to a light.
//!
//! ```text
//!   L_j ≈ Le_j · f_j / ( (1/C) Σ_i p_nee,i )
//! ```
//!
//! The walk itself collects light only before its first real vertex, where no connection can be made;
//! afterwards lights that it reaches are ignored, as connections account for them, except straight after a
//! smooth surface, from which no connection can be made. Good for small lights
//! (the report's figure 3, lower row), poor for sharp phase functions. Miller, Georgiev and Jarosz 2019,
//! section 5.2.
//!
//! Path weights ([`PathWeights`]) in pbrt-v4's names: `contribution` is `beta`, `nee` is `r_l`; a connection
//! is divided by the mean of `r_l` over heroes. `uni` is `r_u`, used only before the first real vertex.
//!
//! Measured on the embedded plume, side-lit and back-lit cloud (96 × 96 pixels, 32 samples): 2.7, 13.9 and
//! 14.2 look-ups per path; relMSE 1.05, 1.9 and 450 times that of Uni+NEE MIS, in about its time.

use super::{Axis, Entry, Estimator, biased_transmittance, clamped_majorant, dispatch};
use crate::math::Ray;
use crate::medium::LocalMedia;
use crate::scene::SceneDoc;
use crate::spectrum::{Components, Radiance};
use crate::transmittance::TransmittanceKind;
use crate::transport::{FlightEnd, PathWeights, Technique, Trace, WalkWeights, Weights, World, hero_event};

const USES: &[Axis] = &[
    Axis::Absorption,
    Axis::Distances,
    Axis::Components,
    Axis::Lights,
    Axis::LightSampling,
    Axis::Transmittance,
];

pub(super) const ENTRY: Entry = Entry {
    id: "nee",
    name: "NEE",
    summary: "Connects every scattering vertex to a light; wins for small lights.",
    reference: "Miller, Georgiev & Jarosz 2019, section 5.2; Horešovský's report, figure 3",
    uses: USES,
    infinite_variance: |_| None,
    bias_of,
    kernel: dispatch::family::<Nee>,
};

fn bias_of(doc: &SceneDoc) -> Option<&'static str> {
    clamped_majorant(doc).or_else(|| biased_transmittance(doc))
}

pub(super) struct Nee;

impl Estimator for Nee {
    const USES: &'static [Axis] = USES;

    fn estimate<M: LocalMedia<N>, C: Components<N>, const N: usize>(
        world: &World<'_, M, C, N>,
        mut ray: Ray,
        trace: &mut Trace<'_>,
    ) -> C::Radiance {
        let heuristics = world.settings.heuristics;
        let mut radiance = C::Radiance::BLACK;
        let mut path = PathWeights::CAMERA;
        let mut vertices = 0;
        let mut connected = false;
        loop {
            // Fly to the next real event; every null collision updates the weights.
            let surface = world.nearest_surface(&ray, vertices == 0);
            let flight = world.fly_to_event(
                (&ray, surface.t()),
                &mut path,
                &mut radiance,
                trace,
                |path, emitted, collision| path.emitted(emitted, collision, heuristics),
                hero_event,
            );
            let vertex = match flight {
                FlightEnd::Absorption => return radiance,
                FlightEnd::Scattering(at) => world.scattering_vertex(at, &ray),
                FlightEnd::Exit => {
                    if !connected {
                        // No real vertex yet, or one on a smooth surface: only the walk can reach this light.
                        for light in world.arrivals(&ray, &surface, vertices == 0) {
                            let value = path.unidirectional(light.radiance, heuristics);
                            radiance += world.record(Technique::Walk, (light.radiance, 0.0), value, trace);
                        }
                    }
                    let Some((vertex, albedo)) = world.surface_vertex(&ray, &surface, trace) else {
                        return radiance;
                    };
                    path.reflect(albedo);
                    vertex
                }
            };

            vertices += 1;
            if !world.within_depth(vertices, &path, trace) {
                return radiance;
            }
            let link = if world.settings.transmittance == TransmittanceKind::ALONG_THE_PATH {
                world.connect(&vertex, &path, trace)
            } else {
                world.connect_by_estimate(&vertex, &path, trace)
            };
            if let Some(link) = link {
                let value = link.weights.connected_only(link.radiance, heuristics);
                radiance += world.record(Technique::Connection, (link.radiance, 0.0), value, trace);
            }
            if !world.survives_roulette(vertices, &mut path, trace) {
                return radiance;
            }
            connected = world.connects(&vertex);
            ray = world.sample_direction(&vertex, &mut path, trace);
        }
    }
}
