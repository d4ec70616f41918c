//! Uni+NEE MIS: unidirectional sampling and next-event estimation, combined over techniques and
//! wavelengths at once.
//!
//! ```text
//!   each technique adds   Le_j · f_j / ( (1/C) Σ_i (p_uni,i + p_nee,i) )
//! ```
//!
//! Wavelengths are a one-sample family (hence the mean), techniques a two-sample family (hence the
//! sum). p_uni has the phase function's density at the last vertex, p_nee the light's, never both. The
//! continuing walk *is* the unidirectional sample: if it reaches a light without another real event, it
//! adds the contribution. Robust in both extremes of the report's figure 3. Miller, Georgiev and Jarosz 2019,
//! section 5.2; the report's algorithms 4–6, without the misprints of 4 (lines 14, 17 and 19).
//!
//! Path weights in pbrt-v4's names, `beta`, `r_u`, `r_l`, by form (P: density of the technique that made the
//! path):
//!
//! | form | `beta` = f / P | `r_u` = p_uni / P | `r_l` = p_nee / P |
//! | --- | --- | --- | --- |
//! | rescaled (`PathWeights`) | `contribution` | `uni` | `nee` |
//! | apart (`WeightsApart`) | `f` / P | `uni` / P | `nee` / P |
//! | pairwise (`WeightsPairwise`) | – | `uni[i][j]` · `beta[j]` | `nee[i][j]` · `beta[j]` |
//!
//! The denominator of the formula, divided by P, is the mean of `r_u` + `r_l` over heroes.
//!
//! Measured on the embedded plume, side-lit and back-lit cloud (96 × 96 pixels, 32 samples): 2.7, 13.9 and
//! 14.2 look-ups per path; relMSE and time are the reference for the other estimators' figures.

use super::{Axis, Entry, Estimator, PathEstimate, PathIndex, Settings, clamped_majorant, dispatch};
use crate::math::{Ray, SideStream};
use crate::medium::LocalMedia;
use crate::scene::{Bookkeeping, Fault, LightWalk, Scene, SceneDoc};
use crate::spectrum::{Components, Radiance};
use crate::transport::{
    ApartF32, ApartF64, Event, Faulty, FlightEnd, Note, Pairwise, PathContext, Rescaled, Technique, Trace,
    Vertex, WalkWeights, WeightForm, Weights, World, hero_event,
};
use std::marker::PhantomData;

const USES: &[Axis] = &[
    Axis::Absorption,
    Axis::Distances,
    Axis::Components,
    Axis::Techniques,
    Axis::Bookkeeping,
    Axis::Lights,
    Axis::LightSampling,
    Axis::LightWalk,
    Axis::Fault,
];

pub(super) const ENTRY: Entry = Entry {
    id: "uni-nee-mis",
    name: "Uni+NEE MIS",
    summary: "Unidirectional and next-event estimation combined, over all components; robust.",
    reference: "Miller, Georgiev & Jarosz 2019, section 5.2; Horešovský's report, algorithms 4–6, figure 3",
    uses: USES,
    infinite_variance: |_| None,
    bias_of,
    kernel,
};

fn bias_of(doc: &SceneDoc) -> Option<&'static str> {
    if doc.estimator.fault != Fault::None {
        return Some("a fault is planted in its path weights");
    }
    if doc.estimator.bookkeeping == Bookkeeping::ApartF32 {
        return Some("f and p in single precision overflow on long paths, whose contributions are lost");
    }
    clamped_majorant(doc)
}

/// Selects the kernel for the form of the path weights.
fn kernel(scene: &Scene, settings: &Settings, at: PathIndex, context: PathContext<'_>) -> PathEstimate {
    let kernel = match settings.path.bookkeeping {
        _ if settings.path.fault != Fault::None => dispatch::family_in_any_media::<UniNeeMis<Faulty>>,
        Bookkeeping::Rescaled => dispatch::family::<UniNeeMis<Rescaled>>,
        Bookkeeping::ApartF32 => dispatch::family::<UniNeeMis<ApartF32>>,
        Bookkeeping::ApartF64 => dispatch::family::<UniNeeMis<ApartF64>>,
        Bookkeeping::Pairwise => dispatch::family::<UniNeeMis<Pairwise>>,
    };
    kernel(scene, settings, at, context)
}

struct UniNeeMis<B>(PhantomData<B>);

impl<B: WeightForm> Estimator for UniNeeMis<B> {
    const USES: &'static [Axis] = USES;

    fn estimate<M: LocalMedia<N>, C: Components<N>, const N: usize>(
        world: &World<'_, M, C, N>,
        mut ray: Ray,
        trace: &mut Trace<'_>,
    ) -> C::Radiance {
        let heuristics = world.settings.heuristics;
        let mut radiance = C::Radiance::BLACK;
        let mut path = B::Weights::<N>::starting(&world.settings);
        let mut last: Option<Vertex> = None;
        let mut vertices = 0;
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
                    // The walk has reached a light, before the first real vertex the only technique that can.
                    if last.is_none() || world.settings.light_walk == LightWalk::Fused {
                        world.add_light_on_ray(last.as_ref(), &ray, &surface, &path, &mut radiance, trace);
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
            if let Some(link) = world.connect(&vertex, &path, trace) {
                let value = link.weights.connected_combined(link.radiance, heuristics);
                let other = link.outgoing.density;
                radiance += world.record(Technique::Connection, (link.radiance, other), value, trace);
            }
            if !world.survives_roulette(vertices, &mut path, trace) {
                return radiance;
            }
            ray = world.sample_direction(&vertex, &mut path, trace);
            if world.settings.light_walk == LightWalk::Separate {
                by_separate_walk(world, &vertex, &ray, path, &mut radiance, trace);
            }
            last = Some(vertex);
        }
    }
}

/// Adds the lights that a separate walk along the ray reaches, if it has no real event before them.
fn by_separate_walk<M: LocalMedia<N>, C: Components<N>, W: Weights<N>, const N: usize>(
    world: &World<'_, M, C, N>,
    vertex: &Vertex,
    ray: &Ray,
    mut path: W,
    radiance: &mut C::Radiance,
    trace: &mut Trace<'_>,
) {
    trace.notify(move || Note::LightWalk);
    trace.start_side_stream(SideStream::LightWalk);
    let surface = world.nearest_surface(ray, false);
    let mut walk = world.walk_to_light(ray, surface.t());
    while let Some(collision) = walk.next_collision(trace, &mut path) {
        match collision.draw_event_side_stream(trace) {
            Event::Null => path.null(&collision),
            Event::Absorption | Event::Scattering => return trace.notify(move || Note::LightWalkEnds),
        }
    }
    world.add_light_on_ray(Some(vertex), ray, &surface, &path, radiance, trace);
    trace.notify(move || Note::LightWalkEnds);
}
