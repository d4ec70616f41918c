//! Freezes a document into a scene.

mod medium;
mod object;

use super::{
    Bodies, Camera, GridRef, LightDoc, ObjectDoc, Scene, SceneDoc, SceneError, SceneInfo, Within, validate,
};
use crate::light::{
    Environment, EnvironmentMap, Light, LightChoice, LightKind, LightLobes, Panorama, RectangleLight,
    SphereLight, Sun,
};
use crate::material::Material;
use crate::medium::{Grid, Majorants, Precision};
use crate::spectrum::{Quantity, Spectrum, SpectrumDoc};
use crate::surface::{Mesh, Rectangle, Shape, Solid, Sphere, Surface};
use glam::DAffine3;
use std::sync::Arc;

/// A grid and its bounding box in the space of its file.
#[derive(Clone, Debug)]
pub struct PlacedGrid<const C: usize> {
    /// Name in the file; empty if it has none.
    pub name: String,
    /// The samples.
    pub grid: Arc<Grid<C>>,
    /// Local bounds of the samples.
    pub majorants: Arc<Majorants<C>>,
    /// Maps the unit cube to the bounding box given by the file.
    pub object_from_unit: DAffine3,
    /// Whether the file defines the position of the box, as OpenVDB and `.vol` do and `.npy` does not.
    pub has_position: bool,
    /// Repairs and choices made while reading, e.g. NaN voxels that were set to 0.
    pub notices: Vec<String>,
}

/// Error on use of a file; the message names the file, the location and the remedy.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct ResourceError(pub String);

/// Source of a scene's files. Implementations cache what they have read.
pub trait Resources {
    /// Returns a scalar grid, stored at a precision; without a name, the grid that is named like a density.
    ///
    /// # Errors
    /// When the file is missing, damaged, of another kind, or too large, or has no grid of that name or kind.
    fn scalar_grid(&mut self, grid: &GridRef, precision: Precision) -> Result<PlacedGrid<1>, ResourceError>;

    /// Returns a scalar grid at full precision; without a name, the grid that is named like a temperature.
    ///
    /// # Errors
    /// As for [`Self::scalar_grid`].
    fn temperature_grid(&mut self, grid: &GridRef) -> Result<PlacedGrid<1>, ResourceError>;

    /// Returns an RGB grid, stored at a precision.
    ///
    /// # Errors
    /// As for [`Self::scalar_grid`].
    fn rgb_grid(&mut self, grid: &GridRef, precision: Precision) -> Result<PlacedGrid<3>, ResourceError>;

    /// Returns an environment image and the repairs made while reading it.
    ///
    /// # Errors
    /// As for [`Self::scalar_grid`].
    fn panorama(&mut self, file: &str) -> Result<(Arc<Panorama>, Vec<String>), ResourceError>;

    /// Returns a triangle mesh and the repairs made while reading it.
    ///
    /// # Errors
    /// As for [`Self::scalar_grid`].
    fn mesh(&mut self, file: &str) -> Result<(Arc<Mesh>, Vec<String>), ResourceError>;

    /// Returns the points of a tabulated phase function.
    ///
    /// # Errors
    /// As for [`Self::scalar_grid`].
    fn phase_table(&mut self, file: &str) -> Result<Vec<[f32; 2]>, ResourceError>;
}

/// Freezes a document. Spectra, lights and surfaces are rebuilt every time, which takes microseconds; grids
/// and images come from `resources`, which caches them.
///
/// # Errors
/// The first problem that validation finds, or a file that could not be used.
pub fn build(doc: &SceneDoc, resources: &mut dyn Resources) -> Result<Scene, SceneError> {
    if let Some(problem) = validate(doc).into_iter().next() {
        return Err(SceneError::Invalid(problem));
    }
    let mut notices = Vec::new();
    let mut info = SceneInfo::default();
    let mut objects = Vec::new();
    for (index, object) in doc.objects.iter().enumerate() {
        // Objects without a surface may still bound a medium.
        let built = object::build(object, index, resources, &mut notices)?;
        info.objects.push(built.info);
        objects.push(built.shape);
    }
    let bodies = object::build_bodies(doc, &objects)?;
    let mut media = Vec::new();
    for (index, medium) in doc.media.iter().enumerate() {
        let (built, described) = if medium.enabled {
            let path = doc.medium_path(index);
            let solid = solid_of(doc, &medium.within, &objects, &path)?;
            let within = match &medium.within {
                Within::Object(name) => doc.object_named(name).map(|(index, _)| index),
                Within::Grid | Within::Everywhere => None,
            };
            let displaced_by = object::displacing(within, solid.as_deref(), &bodies);
            let (mut built, info) = medium::build(medium, (index, &path), solid, resources, &mut notices)?;
            built.placed.displaced_by = displaced_by;
            (Some(built), Some(info))
        } else {
            (None, None)
        };
        media.extend(built);
        info.media.push(described);
    }
    if media.is_empty() {
        media.push(medium::vacuum());
    }
    let (lo, hi) = medium::bounds_of_all(&media);
    (info.world_min, info.world_max) = (lo.to_array(), hi.to_array());

    let mut surfaces = Vec::new();
    let mut lights = Vec::new();
    for (index, light) in doc.lights.iter().enumerate().filter(|(_, light)| light.enabled()) {
        let built = build_light(light, resources, &mut notices)
            .map_err(|source| SceneError::Resource { path: format!("lights[{index}]"), source })?;
        let shape = match &built {
            LightKind::Rectangle(l) => Some(Shape::Rectangle(l.shape)),
            LightKind::Sphere(l) => Some(Shape::Sphere(l.shape)),
            _ => None,
        };
        let light_index = Some(lights.len());
        surfaces.extend(shape.map(|shape| Surface { shape, light: light_index, material: None, body: None }));
        lights.push(Light { kind: built, visible: light.visible() });
    }
    let with_surface = |(_, (object, _)): &(usize, (&ObjectDoc, Shape))| object.has_surface();
    for (index, (object, shape)) in doc.objects.iter().zip(objects).enumerate().filter(with_surface) {
        let (mut shape, mut light) = (shape, None);
        if let Some(emission) = &object.emission {
            let (kind, emitting) = object::build_light(emission, shape, index)?;
            (shape, light) = (emitting, Some(lights.len()));
            lights.push(Light { kind, visible: emission.visible });
        }
        let body = bodies.iter().position(|(owner, _)| *owner == index).map(|body| body as u32);
        surfaces.push(Surface { shape, light, material: object::build_material(&object.material), body });
    }
    if lights.is_empty() && media.iter().all(|medium| medium.emission.is_none()) {
        notices.push("No light: the image is black. Add a light.".into());
    }
    let is_unbounded = media.iter().any(|medium| medium.placed.region.is_unbounded());
    if is_unbounded && lights.iter().any(|light| light.center().is_none()) {
        notices.push(
            "A medium that reaches to infinity extinguishes suns, environments and environment maps: give it an \
             `extent`, or use lights at a finite distance."
                .into(),
        );
    }

    let flat_surfaces = surfaces
        .iter()
        .all(|surface: &Surface| surface.material.as_ref().is_none_or(Material::is_achromatic));
    let achromatic = media.iter().all(|medium| medium.placed.medium.is_achromatic());
    Ok(Scene {
        lobes: LightLobes::towards(&lights),
        light_choice: LightChoice::new(
            &lights,
            if is_unbounded { f32::INFINITY } else { 0.5 * (hi - lo).length() },
        ),
        achromatic: achromatic && flat_surfaces,
        camera: Camera::new(&doc.camera, doc.film.width, doc.film.height),
        width: doc.film.width,
        height: doc.film.height,
        media,
        is_unbounded,
        surfaces,
        bodies: Bodies(bodies.into_iter().map(|(_, body)| body).collect()),
        lights,
        info,
        notices,
    })
}

fn coefficient(doc: &SpectrumDoc) -> Spectrum {
    Spectrum::new(doc, Quantity::Coefficient)
}

fn build_light(
    doc: &LightDoc,
    resources: &mut dyn Resources,
    notices: &mut Vec<String>,
) -> Result<LightKind, ResourceError> {
    let radiance = |doc: &SpectrumDoc, scale: f32| Spectrum::new(doc, Quantity::Radiance).scaled(scale);
    Ok(match doc {
        LightDoc::Rectangle { center, target, up, size, radiance: r, scale, .. } => {
            LightKind::Rectangle(RectangleLight {
                shape: Rectangle::facing((*center).into(), (*target).into(), (*up).into(), *size),
                radiance: radiance(r, *scale),
            })
        }
        LightDoc::Sphere { center, radius, radiance: r, scale, .. } => LightKind::Sphere(SphereLight {
            shape: Sphere { center: (*center).into(), radius: *radius },
            radiance: radiance(r, *scale),
        }),
        LightDoc::Sun { toward, angular_diameter_deg, irradiance, scale, .. } => {
            LightKind::Sun(Sun::new((*toward).into(), *angular_diameter_deg, radiance(irradiance, *scale)))
        }
        LightDoc::Environment { radiance: r, scale, .. } => {
            LightKind::Environment(Environment { radiance: radiance(r, *scale) })
        }
        LightDoc::EnvironmentMap { file, rotate_deg, scale, .. } => {
            let (panorama, repairs) = resources.panorama(file)?;
            notices.extend(repairs);
            LightKind::EnvironmentMap(EnvironmentMap {
                panorama,
                scale: *scale,
                rotate: rotate_deg.to_radians(),
            })
        }
    })
}

/// The closed object that a medium fills, if it fills one.
fn solid_of(
    doc: &SceneDoc,
    within: &Within,
    objects: &[Shape],
    path: &str,
) -> Result<Option<Arc<Solid>>, SceneError> {
    let Within::Object(name) = within else { return Ok(None) };
    let found = doc.object_named(name).and_then(|(index, _)| objects.get(index));
    let Some(shape) = found else { return Ok(None) };
    object::build_solid(shape, name, &format!("{path}.within")).map(|solid| Some(Arc::new(solid)))
}
