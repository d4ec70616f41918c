//! Independent tracking: one colour component per path.
//!
//! ```text
//!   L ≈ Le · f₁ / p₁
//! ```
//!
//! The path carries a single wavelength (or one of R, G, B), is sampled by the coefficients of that
//! component, and shares nothing with other components: every weight but the albedo is 1. Simple
//! and unbiased; but the components have different paths, which shows as colour noise (the report's
//! figure 2, left). Miller, Georgiev and Jarosz 2019, section 5.1.
//!
//! Path weights ([`PathWeights`]) in pbrt-v4's names: `contribution` is `beta`, here f₁ / p₁. The estimate
//! uses neither `r_u` (`uni`, which is 1) nor `r_l` (`nee`).
//!
//! Measured on the embedded plume, side-lit and back-lit cloud (96 × 96 pixels, 32 samples): 1.2, 2.8 and 2.9
//! look-ups per path; relMSE 8, 13 and 4.3 times that of Uni+NEE MIS, in 0.3 to 0.4 of its time.

use super::{Axis, Entry, Estimator, clamped_majorant, dispatch};
use crate::math::Ray;
use crate::medium::LocalMedia;
use crate::spectrum::{Components, Radiance};
use crate::transport::{FlightEnd, PathWeights, Technique, Trace, WalkWeights, World, hero_event};

const USES: &[Axis] = &[Axis::Absorption, Axis::Distances];

pub(super) const ENTRY: Entry = Entry {
    id: "independent",
    name: "Independent tracking",
    summary: "One colour component per path; simple, and the source of colour noise.",
    reference: "Miller, Georgiev & Jarosz 2019, section 5.1; Horešovský's report, figure 2",
    uses: USES,
    infinite_variance: |_| None,
    bias_of: clamped_majorant,
    kernel: dispatch::single::<Independent>,
};

pub(super) struct Independent;

impl Estimator for Independent {
    const USES: &'static [Axis] = USES;

    fn estimate<M: LocalMedia<N>, C: Components<N>, const N: usize>(
        world: &World<'_, M, C, N>,
        mut ray: Ray,
        trace: &mut Trace<'_>,
    ) -> C::Radiance {
        let mut radiance = C::Radiance::BLACK;
        let mut path = PathWeights::CAMERA;
        let mut vertices = 0;
        loop {
            // Fly to the next real event; null collisions do not change the direction.
            let surface = world.nearest_surface(&ray, vertices == 0);
            let flight = world.fly_to_event(
                (&ray, surface.t()),
                &mut path,
                &mut radiance,
                trace,
                |path, emitted, collision| path.hero_emitted(emitted, collision),
                hero_event,
            );
            let vertex = match flight {
                FlightEnd::Absorption => return radiance,
                FlightEnd::Scattering(at) => world.scattering_vertex(at, &ray),
                FlightEnd::Exit => {
                    for light in world.arrivals(&ray, &surface, vertices == 0) {
                        let value = path.hero_only(light.radiance);
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
            ray = world.sample_direction(&vertex, &mut path, trace);
        }
    }
}
