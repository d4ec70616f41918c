//! Frozen scene: the immutable form in which paths are traced.

use super::Camera;
use crate::light::{Light, LightChoice, LightLobes};
use crate::math::Ray;
use crate::medium::{AnyMedium, Emission, Violations};
use crate::phase::Phase;
use crate::surface::{Role, Surface, SurfaceHit};
use glam::{Affine3A, Vec3};
use std::sync::Arc;

/// Frozen scene, immutable and shared by all views that render it.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Camera.
    pub camera: Camera,
    /// Width of the film in pixels.
    pub width: u32,
    /// Height of the film in pixels.
    pub height: u32,
    /// Medium, in the unit cube of its own space.
    pub medium: AnyMedium,
    /// Violations of the majorant found by free flights.
    pub violations: Arc<Violations>,
    /// Thermal emission of the medium.
    pub emission: Option<Emission>,
    /// Transform from world space into the medium's unit cube.
    pub medium_from_world: Affine3A,
    /// Phase function of the medium.
    pub phase: Phase,
    /// Diffuse surfaces, and the surfaces of lights that have a shape.
    pub surfaces: Vec<Surface>,
    /// All lights.
    pub lights: Vec<Light>,
    /// Selection probabilities of lights for connections.
    pub light_choice: LightChoice,
    /// Direction lobes towards the lights that have a dominant direction.
    pub lobes: Option<LightLobes>,
    /// Whether medium and surfaces are independent of wavelength.
    pub achromatic: bool,
    /// Statistics for display.
    pub info: SceneInfo,
    /// Repairs made while building, and warnings.
    pub notices: Vec<String>,
}

/// Statistics of a scene for display.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneInfo {
    /// Name of the density grid in its file; empty if it has none.
    pub density_grid: String,
    /// Name of the temperature grid in its file; empty if it has none.
    pub temperature_grid: String,
    /// Samples per axis of the density grid.
    pub grid_size: Option<[usize; 3]>,
    /// Points of the phase function, if read from a file.
    pub phase_points: Vec<[f32; 2]>,
    /// Maximum density.
    pub max_density: f32,
    /// Mean density over the box.
    pub mean_density: f32,
    /// Maximum of the majorant over the wavelengths, per scene unit.
    pub majorant: f32,
    /// Cells per axis of the grid of local majorants.
    pub majorant_cells: Option<usize>,
    /// Mean extinction over mean majorant: the fraction of real collisions along a straight line through the
    /// box.
    pub tightness: f32,
    /// Minimum corner of the medium's bounds in world space.
    pub world_min: [f32; 3],
    /// Maximum corner of the medium's bounds in world space.
    pub world_max: [f32; 3],
    /// Number of non-zero density voxels.
    pub occupied_voxels: usize,
    /// Maximum error of the density due to storage at reduced precision.
    pub storage_error: f32,
    /// Memory of all grids in bytes.
    pub memory_bytes: usize,
}

/// Nearest surface along a ray, if any.
#[derive(Clone, Copy, Debug)]
pub struct NearestSurface<'a>(Option<(SurfaceHit, &'a Surface)>);

impl<'a> NearestSurface<'a> {
    /// Distance along the ray; infinite without a hit.
    #[must_use]
    pub fn t(&self) -> f32 {
        self.0.map_or(f32::INFINITY, |(hit, _)| hit.t)
    }

    /// Unit normal; zero without a hit.
    #[must_use]
    pub fn normal(&self) -> Vec3 {
        self.0.map_or(Vec3::ZERO, |(hit, _)| hit.normal)
    }

    /// Role of the surface in light transport; `None` without a hit.
    #[must_use]
    pub fn role(&self) -> Option<&'a Role> {
        self.0.map(|(_, surface)| &surface.role)
    }
}

impl Scene {
    /// Returns the same scene with an empty record of majorant violations.
    #[must_use]
    pub fn without_violations(&self) -> Self {
        Self { violations: Arc::new(Violations::none(self.violations.cells())), ..self.clone() }
    }

    /// Returns the same scene with majorants raised by all recorded violations and an empty record; `None` if
    /// there are no violations or the majorant is not progressive.
    #[must_use]
    pub fn raised(&self) -> Option<Self> {
        (self.medium.is_progressive() && self.violations.exceeded_cells() > 0).then(|| {
            let mut raised = self.without_violations();
            raised.medium = self.medium.raised(&self.violations);
            raised
        })
    }

    /// Returns whether any surface intersects the ray at `0 < t < t_max`.
    #[must_use]
    pub fn occluded(&self, ray: &Ray, t_max: f32) -> bool {
        self.surfaces.iter().any(|surface| surface.shape.intersect(ray, t_max).is_some())
    }

    /// Returns the nearest surface along a ray at `0 < t < t_max`. Camera rays pass through lights that are
    /// hidden from the camera.
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
