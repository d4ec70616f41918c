//! Frozen scene: the immutable form in which paths are traced.

use super::{Bodies, Camera, Crossing};
use crate::light::{Light, LightChoice, LightLobes, LightPoint};
use crate::material::Material;
use crate::math::Ray;
use crate::medium::{AnyMedium, Emission, PlacedMedium};
use crate::phase::Phase;
use crate::surface::{Surface, SurfaceHit, SurfacePoint};
use glam::{Affine3A, Vec3};

/// Frozen scene, immutable and shared by all views that render it.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Camera.
    pub camera: Camera,
    /// Width of the film in pixels.
    pub width: u32,
    /// Height of the film in pixels.
    pub height: u32,
    /// Media. Empty scenes have one that does not interact with light.
    pub media: Vec<SceneMedium>,
    /// Whether a medium without a boundary extinguishes all light from infinity.
    pub is_unbounded: bool,
    /// Surfaces of lights that have a shape, and of objects.
    pub surfaces: Vec<Surface>,
    /// Transparent bodies.
    pub bodies: Bodies,
    /// All lights.
    pub lights: Vec<Light>,
    /// Selection probabilities of lights for connections.
    pub light_choice: LightChoice,
    /// Direction lobes towards the lights that have a dominant direction.
    pub lobes: Option<LightLobes>,
    /// Whether media and surfaces are independent of wavelength.
    pub achromatic: bool,
    /// Statistics for display.
    pub info: SceneInfo,
    /// Repairs made while building, and warnings.
    pub notices: Vec<String>,
}

/// A medium of a scene.
#[derive(Clone, Debug)]
pub struct SceneMedium {
    /// Index in the document.
    pub index: usize,
    /// Coefficients, region and violations of the majorant.
    pub placed: PlacedMedium,
    /// Phase function.
    pub phase: Phase,
    /// Thermal emission.
    pub emission: Option<Emission>,
    /// Axis-aligned bounds in world space; `None` for a medium without a boundary.
    pub bounds: Option<(Vec3, Vec3)>,
    /// Transform from world space to medium space.
    pub(super) medium_from_world: Affine3A,
}

impl SceneMedium {
    /// Transform from world space to medium space.
    #[must_use]
    #[inline]
    pub fn medium_from_world(&self) -> &Affine3A {
        &self.medium_from_world
    }
}

/// Statistics of a scene for display.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneInfo {
    /// Statistics of every medium of the document; `None` for media that are not part of the scene.
    pub media: Vec<Option<MediumInfo>>,
    /// Statistics of every object of the document.
    pub objects: Vec<ObjectInfo>,
    /// Minimum corner of the bounds of all media in world space.
    pub world_min: [f32; 3],
    /// Maximum corner of the bounds of all media in world space.
    pub world_max: [f32; 3],
}

impl SceneInfo {
    /// Statistics of a medium, by its index in the document; `None` if it is not part of the scene.
    #[must_use]
    pub fn medium(&self, index: usize) -> Option<&MediumInfo> {
        self.media.get(index)?.as_ref()
    }
}

/// Statistics of an object for display; zero for shapes other than meshes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ObjectInfo {
    /// Number of triangles with an area.
    pub triangles: usize,
    /// Number of vertices.
    pub vertices: usize,
    /// Memory in bytes, with the hierarchy.
    pub memory_bytes: usize,
}

/// Statistics of a medium for display.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MediumInfo {
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
    /// Number of non-zero density voxels.
    pub occupied_voxels: usize,
    /// Maximum error of the density due to storage at reduced precision.
    pub storage_error: f32,
    /// Memory of its grids in bytes.
    pub memory_bytes: usize,
}

/// Nearest surface along a ray, if any.
#[derive(Clone, Copy, Debug)]
pub struct NearestSurface<'a>(Option<(SurfaceHit, &'a Surface, u32)>);

impl<'a> NearestSurface<'a> {
    /// Distance along the ray; infinite without a hit.
    #[must_use]
    #[inline]
    pub fn t(&self) -> f32 {
        self.0.map_or(f32::INFINITY, |(hit, ..)| hit.t)
    }

    /// Unit normal; zero without a hit.
    #[must_use]
    #[inline]
    pub fn normal(&self) -> Vec3 {
        self.0.map_or(Vec3::ZERO, |(hit, ..)| hit.normal)
    }

    /// The end of the ray as a point of a light.
    #[must_use]
    #[inline]
    pub fn light_point(&self, ray: &Ray) -> LightPoint {
        let triangle = self.0.map_or(0, |(hit, ..)| hit.triangle);
        LightPoint { direction: ray.direction, distance: self.t(), triangle }
    }

    /// Returns whether the ray meets no surface.
    #[must_use]
    #[inline]
    pub fn is_none(&self) -> bool {
        self.0.is_none()
    }

    /// Index of the light that the surface emits as, if any.
    #[must_use]
    #[inline]
    pub fn light(&self) -> Option<usize> {
        self.0?.1.light
    }

    /// Index of the surface in the scene; 0 without a hit.
    #[must_use]
    pub fn index(&self) -> u32 {
        self.0.map_or(0, |(_, _, index)| index)
    }

    /// Transparent body that the surface bounds, if any.
    #[must_use]
    #[inline]
    pub fn body(&self) -> Option<u32> {
        self.0?.1.body
    }

    /// Material of the surface; `None` without a hit, and where all light is absorbed.
    #[must_use]
    #[inline]
    pub fn material(&self) -> Option<&'a Material> {
        self.0?.1.material.as_ref()
    }

    /// The point that the ray meets; `None` without a hit.
    #[must_use]
    #[inline]
    pub fn point(&self, ray: &Ray) -> Option<SurfacePoint> {
        self.0.map(|(hit, surface, _)| surface.shape.point(ray, &hit))
    }
}

impl Scene {
    /// The medium with this index among those of the scene.
    #[must_use]
    #[inline]
    pub fn medium(&self, index: u32) -> &SceneMedium {
        &self.media[index as usize]
    }

    /// The medium with this index in the document; `None` if it is not part of the scene.
    #[must_use]
    pub fn medium_of_document(&self, index: usize) -> Option<&SceneMedium> {
        self.media.iter().find(|medium| medium.index == index)
    }

    /// Returns whether there is a single medium, extinction and albedo are the same everywhere in it, and no
    /// ray enters it more than once.
    #[must_use]
    pub fn is_uniform(&self) -> bool {
        matches!(&*self.media, [only] if matches!(only.placed.medium, AnyMedium::Homogeneous(_))
            && only.placed.is_convex())
    }

    /// Returns whether the extinction of a medium may exceed its majorant.
    #[must_use]
    pub fn is_watched(&self) -> bool {
        self.media.iter().any(|medium| medium.placed.medium.is_watched())
    }

    /// Returns whether a majorant is raised where it is found to be exceeded.
    #[must_use]
    pub fn is_progressive(&self) -> bool {
        self.media.iter().any(|medium| medium.placed.medium.is_progressive())
    }

    /// Returns the same scene with empty records of majorant violations.
    #[must_use]
    pub fn without_violations(&self) -> Self {
        self.with_media(PlacedMedium::without_violations)
    }

    /// Returns the same scene with majorants raised by all recorded violations and empty records; `None` if
    /// there are no violations of a progressive majorant.
    #[must_use]
    pub fn raised(&self) -> Option<Self> {
        let due = self.media.iter().any(|medium| medium.placed.must_be_raised());
        due.then(|| self.with_media(PlacedMedium::raised))
    }

    fn with_media(&self, change: impl Fn(&PlacedMedium) -> PlacedMedium) -> Self {
        let mut scene = self.clone();
        for medium in &mut scene.media {
            medium.placed = change(&medium.placed);
        }
        scene
    }

    /// Returns whether any surface intersects the ray at `0 < t < t_max`.
    #[must_use]
    #[inline]
    pub fn occluded(&self, ray: &Ray, t_max: f32) -> bool {
        if self.bodies.0.len() > 1 {
            // Faces of bodies inside others may be no boundary.
            return !self.nearest_surface(ray, t_max, false).is_none();
        }
        self.surfaces.iter().any(|surface| surface.shape.occludes(ray, t_max))
    }

    /// Returns the nearest surface along a ray at `0 < t < t_max`. Camera rays pass through lights that are
    /// hidden from the camera.
    #[must_use]
    #[inline]
    pub fn nearest_surface(&self, ray: &Ray, t_max: f32, from_camera: bool) -> NearestSurface<'_> {
        let nearest = self.nearest_face(ray, t_max, from_camera);
        if self.bodies.0.len() < 2 {
            return nearest;
        }
        // Skips faces behind which the same body is found as in front of them.
        let mut nearest = nearest;
        while let Some(passed) = self.passed_face(ray, &nearest) {
            let onward = Ray { origin: ray.at(passed), direction: ray.direction };
            nearest = self.nearest_face(&onward, t_max - passed, from_camera);
            if let Some((hit, ..)) = &mut nearest.0 {
                hit.t += passed;
            }
        }
        nearest
    }

    /// Parameter just behind a face that is no boundary; `None` at any other end of a ray.
    fn passed_face(&self, ray: &Ray, end: &NearestSurface<'_>) -> Option<f32> {
        let crossing = self.crossing(ray, end)?;
        let error = end.point(ray)?.error;
        let cosine = ray.direction.dot(end.normal()).abs().max(1e-3);
        (crossing.before == crossing.after).then(|| end.t() + 4.0 * error / cosine)
    }

    /// The bodies on both sides of the boundary of a body; `None` at any other end of a ray.
    #[must_use]
    pub fn crossing(&self, ray: &Ray, end: &NearestSurface<'_>) -> Option<Crossing> {
        let (body, at) = (end.body()?, end.point(ray)?);
        let enters = ray.direction.dot(end.normal()) < 0.0;
        let side = if enters { end.normal() } else { -end.normal() };
        Some(self.bodies.crossing(body, at.position, side, at.error, enters))
    }

    #[inline]
    fn nearest_face(&self, ray: &Ray, t_max: f32, from_camera: bool) -> NearestSurface<'_> {
        let mut nearest: Option<(SurfaceHit, &Surface, u32)> = None;
        for (index, surface) in (0..).zip(&self.surfaces) {
            if from_camera
                && let Some(index) = surface.light
                && self.lights.get(index).is_some_and(|light| !light.visible)
            {
                continue;
            }
            let limit = nearest.map_or(t_max, |(hit, ..)| hit.t);
            if let Some(hit) = surface.shape.intersect(ray, limit) {
                nearest = Some((hit, surface, index));
            }
        }
        NearestSurface(nearest)
    }
}
