//! Freezes a document into a scene.

mod medium;

use super::{
    Camera, GridRef, LightDoc, ObjectDoc, Scene, SceneDoc, SceneError, SceneInfo, placement, validate,
};
use crate::light::{
    Environment, EnvironmentMap, Light, LightChoice, LightKind, LightLobes, Panorama, RectangleLight,
    SphereLight, Sun,
};
use crate::medium::{Grid, Majorants, Precision, Region};
use crate::spectrum::{Quantity, Spectrum, SpectrumDoc};
use crate::surface::{OrientedBox, Plane, Rectangle, Role, Shape, Sphere, Surface};
use glam::{DAffine3, Vec3};
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
    let (mut media, mut info) = (Vec::new(), SceneInfo::default());
    for (index, medium) in doc.media.iter().enumerate() {
        let (built, described) = if medium.enabled {
            let path = doc.medium_path(index);
            let (built, info) = medium::build(medium, (index, &path), resources, &mut notices)?;
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
        surfaces.extend(shape.map(|shape| Surface { shape, role: Role::Light(lights.len()) }));
        lights.push(Light { kind: built, visible: light.visible() });
    }
    surfaces.extend(doc.objects.iter().filter(|object| object.enabled()).map(build_object));
    if lights.is_empty() && media.iter().all(|medium| medium.emission.is_none()) {
        notices.push("No light: the image is black. Add a light.".into());
    }
    let is_unbounded = media.iter().any(|medium| medium.placed.region == Region::Everywhere);
    if is_unbounded && lights.iter().any(|light| light.center().is_none()) {
        notices.push(
            "A medium that reaches to infinity extinguishes suns, environments and environment maps: give it an \
             `extent`, or use lights at a finite distance."
                .into(),
        );
    }

    let flat_surfaces = surfaces.iter().all(|surface: &Surface| match &surface.role {
        Role::Diffuse(albedo) => albedo.is_flat(),
        Role::Light(_) => true,
    });

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

fn build_object(doc: &ObjectDoc) -> Surface {
    let (shape, albedo) = match doc {
        ObjectDoc::Ground { point, normal, albedo, .. } => {
            (Shape::Plane(Plane { point: (*point).into(), normal: Vec3::from(*normal).normalize() }), albedo)
        }
        ObjectDoc::Box { center, size, rotate_deg, albedo, .. } => (
            Shape::Box(OrientedBox {
                center: (*center).into(),
                half_size: Vec3::from(*size) * 0.5,
                world_from_box: placement::rotation(*rotate_deg),
            }),
            albedo,
        ),
    };
    Surface { shape, role: Role::Diffuse(coefficient(albedo)) }
}
