//! Independent tracking: one colour component per path.
//!
//! ```text
//!   L ≈ Le · f₁ / p₁
//! ```
//!
//! The path carries a single wavelength (or one of R, G, B), is sampled by that component's own
//! coefficients, and shares nothing with other components: every weight but the albedo is 1. Simple
//! and unbiased; but components see different paths, which shows as colour noise (the report's figure 2,
//! left). Miller, Georgiev and Jarosz 2019, section 5.1.
//!
//! Measured on the embedded plume, side-lit and back-lit cloud (96 × 96 pixels, 32 samples): 1.2, 2.8 and 2.9 look-
//! ups per path; relMSE 8, 13 and 4.3 times that of Uni+NEE MIS, in 0.3 to 0.4 of its time.

use super::{
    Axis, Entry, Estimator, HERO_DRAWS, NO_CONNECTIONS, NO_FAULTS, NOTHING_TO_ESTIMATE, ONE_TECHNIQUE,
    ONE_WALK, RESCALED, clamped_majorant, dispatch,
};
use crate::math::Ray;
use crate::medium::LocalMedium;
use crate::spectrum::{Components, Radiance};
use crate::transport::{Event, PathWeights, Technique, Trace, WalkWeights, World};

pub(super) const ENTRY: Entry = Entry {
    id: "independent",
    name: "Independent tracking",
    summary: "One colour component per path; simple, and the source of colour noise.",
    reference: "Miller, Georgiev & Jarosz 2019, section 5.1; Horešovský's report, figure 2",
    unused: &[
        ONE_WALK,
        NO_FAULTS,
        (Axis::Components, "its paths carry one component"),
        ONE_TECHNIQUE,
        NO_CONNECTIONS,
        NOTHING_TO_ESTIMATE,
        HERO_DRAWS,
        RESCALED,
    ],
    infinite_variance: |_| None,
    bias_of: clamped_majorant,
    kernel: dispatch::single::<Independent>,
};

pub(super) struct Independent;

impl Estimator for Independent {
    fn estimate<L: LocalMedium<N>, C: Components<N>, const N: usize>(
        world: &World<'_, L, C, N>,
        mut ray: Ray,
        trace: &mut Trace<'_>,
    ) -> C::Radiance {
        let mut radiance = C::Radiance::BLACK;
        let mut path = PathWeights::CAMERA;
        let mut vertices = 0;
        loop {
            // Fly until something real happens; null collisions do not turn the path.
            let surface = world.nearest_surface(&ray, vertices == 0);
            let mut walk = world.walk(&ray, surface.t());
            let scattered_at = loop {
                let Some(collision) = walk.next_collision(trace, &mut path) else { break None };
                if let Some(glow) = world.emission_at(&collision, trace) {
                    radiance += world.credit(
                        Technique::Glow,
                        (glow, 0.0),
                        path.hero_emitted(glow, &collision),
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
                for light in world.arrivals(&ray, &surface, vertices == 0) {
                    let value = path.hero_only(light.radiance);
                    radiance += world.credit(Technique::Walk, (light.radiance, 0.0), value, trace);
                }
                let Some((vertex, albedo)) = world.diffuse_vertex(&ray, &surface, trace) else {
                    return radiance;
                };
                path.reflect(albedo);
                vertex
            };

            vertices += 1;
            if !world.goes_on(vertices, &path, trace) || !world.survives_roulette(vertices, &mut path, trace)
            {
                return radiance;
            }
            ray = world.leave(&vertex, &mut path, trace);
        }
    }
}
