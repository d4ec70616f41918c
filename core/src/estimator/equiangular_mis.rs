//! Equiangular MIS: Uni+NEE MIS with equiangular sampling as a third technique.
//!
//! ```text
//!   each technique adds   Le_j · f_j / ( (1/C) Σ_i (p_uni,i + p_nee,i + p_eq,i) )
//! ```
//!
//! Along every ray of the path an additional vertex is drawn, with a density proportional to the inverse
//! square of its distance to a light, and connected to that light; collisions before it are taken as null
//! (ratio tracking). The walk continues from its own vertex. Costs a second connection per vertex: a path
//! takes 2.3 times as long. Wins where a small light is inside or close to a thin medium, whose collisions
//! are rare where the light is strong: on the embedded lanterns 2.9 times the efficiency of Uni+NEE MIS.
//! Distant lights have no position, so for them the estimator is Uni+NEE MIS. Kulla and Fajardo 2012,
//! section 4; in path space, Miller, Georgiev and Jarosz 2019, section 5.2.
//!
//! Path weights ([`EquiangularWeights`]) in pbrt-v4's names: `contribution` is `beta`, `uni` is `r_u`, `nee`
//! is `r_l`; `eq` = p_eq / P is the same quotient for the third technique.
//!
//! Measured on the embedded plume, side-lit and back-lit cloud (96 × 96 pixels, 32 samples): 4.2, 22 and 22
//! look-ups per path; relMSE 1.0, 0.93 and 0.99 times that of Uni+NEE MIS, in 1.3 to 1.8 of its time. None of
//! these scenes has a small light close to the medium.

use super::{Axis, Entry, Estimator, clamped_majorant, dispatch};
use crate::math::{Ray, SideStream};
use crate::medium::LocalMedia;
use crate::spectrum::{Components, Radiance, Sampled};
use crate::transport::{
    EquiangularWeights, FlightEnd, LightDensities, Note, Passage, Reached, Technique, Trace, WalkWeights,
    World, hero_event,
};

const USES: &[Axis] =
    &[Axis::Absorption, Axis::Components, Axis::Techniques, Axis::Lights, Axis::LightSampling];

pub(super) const ENTRY: Entry = Entry {
    id: "equiangular-mis",
    name: "Equiangular MIS",
    summary: "Uni+NEE MIS with additional distances drawn towards the light; wins for lamps in thin media.",
    reference: "Kulla & Fajardo 2012, section 4; Miller, Georgiev & Jarosz 2019, section 5.2",
    uses: USES,
    infinite_variance: |_| None,
    bias_of: clamped_majorant,
    kernel: dispatch::family::<EquiangularMis>,
};

pub(super) struct EquiangularMis;

impl Estimator for EquiangularMis {
    const USES: &'static [Axis] = USES;

    fn estimate<M: LocalMedia<N>, C: Components<N>, const N: usize>(
        world: &World<'_, M, C, N>,
        mut ray: Ray,
        trace: &mut Trace<'_>,
    ) -> C::Radiance {
        let heuristics = world.settings.heuristics;
        let mut radiance = C::Radiance::BLACK;
        let mut path = EquiangularWeights::CAMERA;
        let mut reached = Reached::Otherwise;
        let mut last = None;
        let mut vertices = 0;
        loop {
            let surface = world.nearest_surface(&ray, vertices == 0);

            // The additional vertex and its connection.
            let passage = Passage::through(&world.media, &ray, surface.t());
            if let Some(passage) = &passage
                && vertices + 1 < world.settings.max_depth
            {
                trace.notify(move || Note::EquiangularVertex);
                radiance += equiangular_connection(world, passage, path, trace).unwrap_or(C::Radiance::BLACK);
                trace.notify(move || Note::EquiangularVertexEnds);
            }

            // Fly to the next real event; every null collision updates the weights.
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
                FlightEnd::Scattering(at) => {
                    reached = Reached::through(passage, at);
                    world.scattering_vertex(at, &ray)
                }
                FlightEnd::Exit => {
                    // The walk has reached a light, before the first real vertex the only technique that can.
                    for light in world.arrivals(&ray, &surface, vertices == 0) {
                        let (other, value) = match &last {
                            None => (0.0, path.unidirectional(light.radiance, heuristics)),
                            Some(vertex) => {
                                let nee = world.aim_density(vertex, light.index, &surface.light_point(&ray));
                                let densities = reached.light_densities(world, light.index, ray.origin, nee);
                                (nee, path.combined(light.radiance, densities, heuristics))
                            }
                        };
                        radiance += world.record(Technique::Walk, (light.radiance, other), value, trace);
                    }
                    let Some((vertex, albedo)) = world.surface_vertex(&ray, &surface, trace) else {
                        return radiance;
                    };
                    path.reflect(albedo);
                    reached = Reached::Otherwise;
                    vertex
                }
            };

            vertices += 1;
            if !world.within_depth(vertices, &path, trace) {
                return radiance;
            }
            if let Some(aim) = world.aim(&vertex, trace) {
                let densities = reached.light_densities(world, aim.light, vertex.point(), aim.density);
                let mut link = path.connect(&aim.outgoing, densities);
                world.adjust_at_boundary(&vertex, &aim.outgoing, &mut link, trace);
                if let Some(link) = world.arrive(&aim, link, trace) {
                    let (other, value) = (aim.outgoing.density, link.connected(aim.radiance, heuristics));
                    radiance += world.record(Technique::Connection, (aim.radiance, other), value, trace);
                }
            }
            if !world.survives_roulette(vertices, &mut path, trace) {
                return radiance;
            }
            ray = world.sample_direction(&vertex, &mut path, trace);
            last = Some(vertex);
        }
    }
}

/// Contribution of a vertex drawn by equiangular sampling and of its connection to the light.
fn equiangular_connection<M: LocalMedia<N>, C: Components<N>, const N: usize>(
    world: &World<'_, M, C, N>,
    passage: &Passage,
    path: EquiangularWeights<N>,
    trace: &mut Trace<'_>,
) -> Option<C::Radiance> {
    trace.start_side_stream(SideStream::EquiangularVertex);
    let (from, by) = (passage.ray.origin, world.settings.lights);
    let choice = &world.scene.light_choice;
    let (light, probability) = choice.choose(from, trace.connection.next_1d(), by)?;
    let pivot = world.scene.lights.get(light)?.center()?;
    let (t, density) = passage.sample(pivot, trace.connection.next_1d());
    let mut link = world.pass_by_ratio(&passage.ray, t, path, trace)?;
    let collision = world.collision_at(&passage.ray, t, trace)?;
    let density = density * probability * collision.share;
    link.scatter_equiangular(&collision, density);
    let choice_there = choice.probability(light, collision.point, by);
    trace.notify(move || Note::EquiangularVertexSampled {
        found: collision.found(Sampled::ZERO),
        density,
        choice: choice_there,
        weight_record: link.weight_record(),
    });

    let vertex = world.scattering_vertex((&collision).into(), &passage.ray);
    let aim = world.aim_at(&vertex, light, trace.connection.next_2d())?;
    let nee = aim.density * choice_there;
    let link = link.connect_equiangular(&aim.outgoing, LightDensities { nee, eq: aim.density });
    let link = world.arrive(&aim, link, trace)?;
    let value = link.connected_equiangular(aim.radiance, world.settings.heuristics);
    Some(world.record(Technique::Equiangular, (aim.radiance, aim.outgoing.density), value, trace))
}
