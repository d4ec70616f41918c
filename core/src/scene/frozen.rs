//! A scene that does not change any more: what paths are traced in.

use super::Camera;
use crate::light::{Light, LightChoice, LightLobes};
use crate::math::Ray;
use crate::medium::{AnyMedium, Emission, Violations};
use crate::phase::Phase;
use crate::surface::{Role, Surface, SurfaceHit};
use glam::{Affine3A, Vec3};
use std::sync::Arc;

/// A frozen scene. Immutable and shared by every view that renders it.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The camera.
    pub camera: Camera,
    /// Columns of the film.
    pub width: u32,
    /// Rows of the film.
    pub height: u32,
    /// The medium, in the unit cube of its own space.
    pub medium: AnyMedium,
    /// Where flights have found its extinction to exceed the majorant.
    pub violations: Arc<Violations>,
    /// How it glows, if it does.
    pub emission: Option<Emission>,
    /// Takes points of the world into the medium's unit cube.
    pub medium_from_world: Affine3A,
    /// The medium's phase function.
    pub phase: Phase,
    /// Lights with a shape, and diffuse surfaces.
    pub surfaces: Vec<Surface>,
    /// Every light.
    pub lights: Vec<Light>,
    /// What connections choose among the lights by.
    pub light_choice: LightChoice,
    /// Lobes towards those lights that stand in some direction.
    pub lobes: Option<LightLobes>,
    /// Whether neither the medium nor a surface tells one wavelength from another.
    pub achromatic: bool,
    /// Numbers that people want to see.
    pub info: SceneInfo,
    /// What building repaired or wants to be known.
    pub notices: Vec<String>,
}

/// Numbers about a scene that people want to see.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneInfo {
    /// Name of the density's grid in its file; empty where it has none.
    pub density_grid: String,
    /// Name of the temperature's grid in its file; empty where it has none.
    pub temperature_grid: String,
    /// Samples per axis of the density grid.
    pub grid_size: Option<[usize; 3]>,
    /// Points of the phase function, if they were read from a file.
    pub phase_points: Vec<[f32; 2]>,
    /// Largest density.
    pub max_density: f32,
    /// Mean density over the box.
    pub mean_density: f32,
    /// Largest majorant over wavelengths, per scene unit.
    pub majorant: f32,
    /// Cells per axis of the grid of local majorants.
    pub majorant_cells: Option<usize>,
    /// Mean extinction over mean majorant: the share of collisions along a straight line through the box
    /// that are real.
    pub tightness: f32,
    /// Lowest corner of the medium's bounds in the world.
    pub world_min: [f32; 3],
    /// Highest corner.
    pub world_max: [f32; 3],
    /// Voxels of the density that are not zero.
    pub occupied_voxels: usize,
    /// The largest error in any density that keeping it at less than full precision has made.
    pub storage_error: f32,
    /// Bytes that grids take.
    pub memory_bytes: usize,
}

/// The surface that a ray meets first, if any.
#[derive(Clone, Copy, Debug)]
pub struct NearestSurface<'a>(Option<(SurfaceHit, &'a Surface)>);

impl<'a> NearestSurface<'a> {
    /// Distance along the ray; infinite if none is met.
    #[must_use]
    pub fn t(&self) -> f32 {
        self.0.map_or(f32::INFINITY, |(hit, _)| hit.t)
    }

    /// Unit normal; zero if none is met.
    #[must_use]
    pub fn normal(&self) -> Vec3 {
        self.0.map_or(Vec3::ZERO, |(hit, _)| hit.normal)
    }

    /// What the surface does with light; `None` if none is met.
    #[must_use]
    pub fn role(&self) -> Option<&'a Role> {
        self.0.map(|(_, surface)| &surface.role)
    }
}

impl Scene {
    /// The same scene, in which no violation of the majorant has been found yet.
    #[must_use]
    pub fn unwatched(&self) -> Self {
        Self { violations: Arc::new(Violations::none(self.violations.cells())), ..self.clone() }
    }

    /// The same scene under bounds that are raised by all violations that were found, and none found yet; `None` if
    /// there are none, or bounds are not to be raised.
    #[must_use]
    pub fn raised(&self) -> Option<Self> {
        (self.medium.is_progressive() && self.violations.exceeded_cells() > 0).then(|| {
            let mut raised = self.unwatched();
            raised.medium = self.medium.raised(&self.violations);
            raised
        })
    }

    /// Whether any surface stands in the way at `0 < t < t_max`.
    #[must_use]
    pub fn occluded(&self, ray: &Ray, t_max: f32) -> bool {
        self.surfaces.iter().any(|surface| surface.shape.intersect(ray, t_max).is_some())
    }

    /// The surface that a ray meets first at `0 < t < t_max`. Rays from the camera pass through lights
    /// that are hidden from it.
    #[must_use]
    pub fn nearest_surface(&self, ray: &Ray, t_max: f32, from_camera: bool) -> NearestSurface<'_> {
        let mut nearest: Option<(SurfaceHit, &Surface)> = None;
        for surface in &self.surfaces {
            if from_camera
                && let Role::Light(index) = surface.role
                && self.lights.get(index).is_some_and(|light| !light.visible)
            {
                continue;
            }
            let limit = nearest.map_or(t_max, |(hit, _)| hit.t);
            if let Some(hit) = surface.shape.intersect(ray, limit) {
                nearest = Some((hit, surface));
            }
        }
        NearestSurface(nearest)
    }
}
