//! Spectral tracking: one path shared by all components, without a hero.
//!
//! ```text
//!   L_j ≈ Le_j · Π_k  e_j(x_k) / ( μ̄ P_e(x_k) ),      P_e in proportion to max_i e_i, mean_i e_i or mean_i |w_i e_i|
//! ```
//!
//! Flights are drawn from the majorant of the densest component, events from probabilities that depend on all
//! components; each component's weight w_j is then updated by the event that was drawn. Path densities are
//! not formed, so techniques cannot be combined by multiple importance sampling: the precursor and main
//! competitor of spectral MIS. With the history in the probabilities weights stay bounded, at the cost of
//! evaluating every component per event. Wins over hero wavelengths where components differ little; loses
//! where one is far denser, as all components then pay for its collisions. Kutz, Habel, Li and Novák 2017,
//! "Spectral and decomposition tracking for rendering heterogeneous volumes", section 5.1, algorithm 4.
//!
//! Path weights ([`PathWeights`]) in pbrt-v4's names: `contribution` is `beta`, the weights w_j of the paper.
//! `r_u` (`uni`) stays 1, and `r_l` (`nee`) is not used.
//!
//! Measured on the embedded plume, side-lit and back-lit cloud (96 × 96 pixels, 32 samples): 2.4, 2.8 and 2.9
//! look-ups per path; relMSE 0.87, 3.9 and 1.0 times that of Uni+NEE MIS, in 0.3 to 0.7 of its time.

use super::{Axis, Entry, Estimator, clamped_majorant, dispatch};
use crate::math::Ray;
use crate::medium::LocalMedia;
use crate::scene::{SceneDoc, Tracking};
use crate::spectrum::{Components, Radiance};
use crate::transport::{
    Collision, Event, EventDensities, FlightEnd, PathSettings, PathWeights, Technique, Trace, WalkWeights,
    World,
};

const USES: &[Axis] = &[Axis::Absorption, Axis::Tracking];

pub(super) const ENTRY: Entry = Entry {
    id: "spectral-tracking",
    name: "Spectral tracking",
    summary: "All components share each unidirectional path by event probabilities instead of MIS.",
    reference: "Kutz, Habel, Li & Novák 2017, section 5.1",
    uses: USES,
    infinite_variance,
    bias_of: clamped_majorant,
    kernel: dispatch::family::<SpectralTracking>,
};

/// Probabilities by the largest component sum to more than one before normalisation, so that each event may
/// increase the weights, and the number of such events is unbounded.
fn infinite_variance(doc: &SceneDoc) -> Option<&'static str> {
    let by_largest = doc.estimator.tracking == Tracking::Maximum;
    by_largest.then_some("events drawn by the largest component may increase the weights without bound")
}

pub(super) struct SpectralTracking;

impl Estimator for SpectralTracking {
    const USES: &'static [Axis] = USES;
    const SHARED_MAJORANT: bool = true;

    fn estimate<M: LocalMedia<N>, C: Components<N>, const N: usize>(
        world: &World<'_, M, C, N>,
        mut ray: Ray,
        trace: &mut Trace<'_>,
    ) -> C::Radiance {
        let mut radiance = C::Radiance::BLACK;
        let mut path = PathWeights::CAMERA;
        let mut vertices = 0;
        loop {
            // Fly to the next real event; every event updates the weights.
            let surface = world.nearest_surface(&ray, vertices == 0);
            let flight = world.fly_to_event(
                (&ray, surface.t()),
                &mut path,
                &mut radiance,
                trace,
                |path, emitted, collision| path.emitted_as_drawn(emitted, collision),
                |path, collision, trace| draw_for_all(&world.settings, path, collision, trace),
            );
            let vertex = match flight {
                FlightEnd::Absorption => return radiance,
                FlightEnd::Scattering(at) => world.scattering_vertex(at, &ray),
                FlightEnd::Exit => {
                    for light in world.arrivals(&ray, &surface, vertices == 0) {
                        let value = path.as_drawn(light.radiance);
                        radiance += world.record(Technique::Walk, (light.radiance, 0.0), value, trace);
                    }
                    let Some((vertex, albedo)) = world.surface_vertex(&ray, &surface, trace) else {
                        return radiance;
                    };
                    path.reflect(albedo);
                    vertex
                }
            };

            vertices += 1;
            if !world.within_depth(vertices, &path, trace)
                || !world.survives_roulette(vertices, &mut path, trace)
            {
                return radiance;
            }
            let Some(onward) = world.sample_direction_by_any(&vertex, &mut path, trace) else {
                return radiance;
            };
            ray = onward;
        }
    }
}

/// Draws the event at a collision from densities of all components and divides the weights by the density
/// drawn.
fn draw_for_all<const N: usize>(
    settings: &PathSettings,
    path: &mut PathWeights<N>,
    collision: &Collision<N>,
    trace: &mut Trace<'_>,
) -> Event {
    let densities = EventDensities::of(collision, &path.contribution(), settings);
    let event = densities.draw_event(trace);
    match event {
        Event::Null => path.null_drawn(collision, densities.drawn(densities.null)),
        Event::Scattering => path.scatter_drawn(collision, densities.drawn(densities.scattering)),
        Event::Absorption => {}
    }
    event
}
