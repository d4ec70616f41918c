//! Freezes a document into a scene.

use super::{
    Camera, DensityDoc, EmissionDoc, GridRef, LightDoc, MediumDoc, ObjectDoc, Problem, Scene, SceneDoc,
    SceneError, SceneInfo, WhenExceeded, placement, validate,
};
use crate::light::{
    Environment, EnvironmentMap, Light, LightChoice, LightKind, LightLobes, Panorama, RectangleLight,
    SphereLight, Sun,
};
use crate::medium::{
    AlbedoField, AnyMedium, DensityGrid, Emission, ExtinctionField, Grid, Homogeneous, MajorantGrid,
    MajorantPolicy, Majorants, Precision, RgbGrids, Violations,
};
use crate::phase::{Phase, PhaseDoc, check_table};
use crate::spectrum::{Quantity, Spectrum, SpectrumDoc};
use crate::surface::{OrientedBox, Plane, Rectangle, Role, Shape, Sphere, Surface};
use glam::{Affine3A, Vec3};
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
    pub object_from_unit: Affine3A,
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
    let (phase, phase_points) = build_phase(&doc.medium.phase, resources)?;
    let (medium, emission, object_from_unit, mut info) =
        build_medium(&doc.medium, phase.mean_cosine(), resources, &mut notices)?;
    info.phase_points = phase_points;
    let world_from_unit = placement::world_from_unit(&doc.medium.placement, object_from_unit);
    // Relative to the edge lengths: a tiny box is valid, a flat one is not.
    let m = world_from_unit.matrix3;
    let edges = m.x_axis.length() * m.y_axis.length() * m.z_axis.length();
    if !world_from_unit.inverse().is_finite() || m.determinant().abs() <= 1e-6 * edges {
        return Err(SceneError::Invalid(Problem {
            path: "medium.placement".into(),
            message: "the box has no volume: give every scale a value other than 0".into(),
        }));
    }
    let (lo, hi) = placement::bounds(&world_from_unit);
    check_optical_depth(&doc.medium, info.majorant * (hi - lo).length(), &mut notices)?;
    (info.world_min, info.world_max) = (lo.to_array(), hi.to_array());

    let mut surfaces = Vec::new();
    let mut lights = Vec::new();
    for (index, light) in doc.lights.iter().enumerate() {
        let built = build_light(light, resources, &mut notices)
            .map_err(|source| SceneError::Resource { path: format!("lights[{index}]"), source })?;
        let shape = match &built {
            LightKind::Rectangle(l) => Some(Shape::Rectangle(l.shape)),
            LightKind::Sphere(l) => Some(Shape::Sphere(l.shape)),
            _ => None,
        };
        surfaces.extend(shape.map(|shape| Surface { shape, role: Role::Light(index) }));
        lights.push(Light { kind: built, visible: light.visible() });
    }
    surfaces.extend(doc.objects.iter().map(build_object));
    if lights.is_empty() && emission.is_none() {
        notices.push("No light: the image is black. Add a light.".into());
    }

    let flat_surfaces = surfaces.iter().all(|surface: &Surface| match &surface.role {
        Role::Diffuse(albedo) => albedo.is_flat(),
        Role::Light(_) => true,
    });

    let cells = medium.majorant_cells().map_or(1, |cells| cells.cells());
    Ok(Scene {
        lobes: LightLobes::towards(&lights),
        light_choice: LightChoice::new(&lights, 0.5 * (hi - lo).length()),
        achromatic: medium.is_achromatic() && flat_surfaces,
        camera: Camera::new(&doc.camera, doc.film.width, doc.film.height),
        width: doc.film.width,
        height: doc.film.height,
        medium,
        emission,
        violations: Arc::new(Violations::none(cells)),
        medium_from_world: world_from_unit.inverse(),
        phase,
        surfaces,
        lights,
        info,
        notices,
    })
}

/// Maximum optical depth of a box, by its majorant. Beyond it free flights are shorter than the rounding
/// error of positions, and a walk would no longer advance.
const MAX_OPTICAL_DEPTH: f32 = 1e6;

fn check_optical_depth(doc: &MediumDoc, depth: f32, notices: &mut Vec<String>) -> Result<(), SceneError> {
    if depth.is_nan() || depth > MAX_OPTICAL_DEPTH {
        return Err(SceneError::Invalid(Problem {
            path: "medium.scale".into(),
            message: format!(
                "the majorant's optical depth across the box is {depth:.1e}; at most {MAX_OPTICAL_DEPTH:.0e} can be \
                 resolved: lower the scale, the extinction or the majorant's factor"
            ),
        }));
    }
    let excess = depth * (1.0 / doc.majorant.factor - 1.0);
    if doc.majorant.when_exceeded == WhenExceeded::Weighted && excess > 4.0 {
        notices.push(format!(
            "The extinction exceeds the majorant by an optical depth of up to {excess:.0}: still unbiased, but the \
             variance grows exponentially with that number. Raise the majorant's factor towards 1."
        ));
    }
    Ok(())
}

/// Phase function, with its points if they come from a file.
fn build_phase(doc: &PhaseDoc, resources: &mut dyn Resources) -> Result<(Phase, Vec<[f32; 2]>), SceneError> {
    let PhaseDoc::Tabulated { angle, file, .. } = doc else { return Ok((Phase::new(doc), Vec::new())) };
    if file.is_empty() {
        return Ok((Phase::new(doc), Vec::new()));
    }
    let failed = |source| SceneError::Resource { path: "medium.phase.file".into(), source };
    let points = resources.phase_table(file).map_err(failed)?;
    check_table(*angle, &points).map_err(|e| failed(ResourceError(format!("{file}: {e}"))))?;
    let read = PhaseDoc::Tabulated { angle: *angle, points: points.clone(), file: file.clone() };
    Ok((Phase::new(&read), points))
}

fn coefficient(doc: &SpectrumDoc) -> Spectrum {
    Spectrum::new(doc, Quantity::Coefficient)
}

fn build_medium(
    doc: &MediumDoc,
    mean_cosine: f32,
    resources: &mut dyn Resources,
    notices: &mut Vec<String>,
) -> Result<(AnyMedium, Option<Emission>, Affine3A, SceneInfo), SceneError> {
    let at = |path: &str| {
        let path = path.to_owned();
        move |source| SceneError::Resource { path, source }
    };
    let centred = Affine3A::from_translation(Vec3::splat(-0.5));
    let majorant = MajorantPolicy::new(&doc.majorant);
    let (extinction, albedo) = doc.extinction_and_albedo(mean_cosine);
    let sigma = extinction.scaled(doc.scale);
    let mut info = SceneInfo { max_density: 1.0, mean_density: 1.0, ..SceneInfo::default() };

    // Placement of the unit cube in the space of the file, if the file defines one.
    let mut placed = centred;
    let mut density_box = None;
    let extinction = match &doc.density {
        DensityDoc::Uniform {} => ExtinctionField::Uniform(sigma),
        DensityDoc::Grid(grid) => {
            let read = resources.scalar_grid(grid, doc.precision).map_err(at("medium.density"))?;
            info.density_grid.clone_from(&read.name);
            describe(&mut info, &read.grid);
            notices.extend_from_slice(&read.notices);
            placed = read.object_from_unit;
            density_box = read.has_position.then_some(placed);
            let bounds = bounds_of(&read, doc, &mut info, sigma.rgb().element_sum() / 3.0);
            ExtinctionField::Density(read.grid, bounds, sigma)
        }
        DensityDoc::RgbGrid(grid) => {
            let read = resources.rgb_grid(grid, doc.precision).map_err(at("medium.density"))?;
            info.density_grid.clone_from(&read.name);
            describe(&mut info, &read.grid);
            notices.extend_from_slice(&read.notices);
            placed = read.object_from_unit;
            density_box = read.has_position.then_some(placed);
            let bounds = bounds_of(&read, doc, &mut info, doc.scale);
            ExtinctionField::Rgb(read.grid, bounds, doc.scale)
        }
    };
    let albedo = match &doc.albedo_grid {
        None => AlbedoField::Uniform(albedo),
        Some(grid) => {
            let read = resources.rgb_grid(grid, doc.precision).map_err(at("medium.albedo_grid"))?;
            if read.grid.max().iter().any(|a| *a > 1.0) {
                return Err(at("medium.albedo_grid")(ResourceError(format!(
                    "{}: an albedo of {} is above 1; scale the grid to at most 1",
                    grid.file,
                    read.grid.max().into_iter().fold(0.0, f32::max)
                ))));
            }
            info.memory_bytes += read.grid.bytes();
            notices.extend(read.notices);
            // Two files that both define a position are registered by it; otherwise both grids fill the same
            // box.
            let albedo_from_density = match density_box {
                Some(density) if read.has_position => read.object_from_unit.inverse() * density,
                _ => Affine3A::IDENTITY,
            };
            AlbedoField::Rgb(read.grid, albedo_from_density)
        }
    };
    let emission = match &doc.emission {
        None => None,
        Some(emission) => Some(
            build_emission(emission, density_box, resources, &mut info, notices)
                .map_err(at("medium.emission"))?,
        ),
    };
    info.majorant = doc.majorant.factor
        * match &extinction {
            ExtinctionField::Uniform(sigma) => sigma.largest(),
            ExtinctionField::Density(grid, _, sigma) => sigma.largest() * grid.max()[0],
            ExtinctionField::Rgb(_, _, scale) => info.max_density * scale,
        };
    let mean_bound = match &extinction {
        ExtinctionField::Uniform(_) => 1.0,
        ExtinctionField::Density(_, bounds, _) => bounds.mean_bound(),
        ExtinctionField::Rgb(_, bounds, _) => bounds.mean_bound(),
    };
    info.tightness =
        if mean_bound > 0.0 { info.mean_density / (mean_bound * doc.majorant.factor) } else { 1.0 };
    let medium = match (extinction, albedo) {
        (ExtinctionField::Uniform(extinction), AlbedoField::Uniform(albedo)) => {
            AnyMedium::Homogeneous(Homogeneous { extinction, albedo, majorant })
        }
        (ExtinctionField::Density(density, bounds, extinction), AlbedoField::Uniform(albedo)) => {
            let interpolation = doc.interpolation;
            AnyMedium::DensityGrid(DensityGrid {
                density,
                interpolation,
                bounds,
                extinction,
                albedo,
                majorant,
            })
        }
        (extinction, albedo) => {
            AnyMedium::RgbGrids(RgbGrids::new(extinction, albedo, doc.interpolation, majorant))
        }
    };
    Ok((medium, emission, placed, info))
}

/// Freezes the emission. The temperature grid is registered with the density where both files define a
/// position, and fills the same box otherwise.
fn build_emission(
    doc: &EmissionDoc,
    density_box: Option<Affine3A>,
    resources: &mut dyn Resources,
    info: &mut SceneInfo,
    notices: &mut Vec<String>,
) -> Result<Emission, ResourceError> {
    let mut emission = Emission {
        temperature: None,
        temperature_from_medium: Affine3A::IDENTITY,
        kelvin: doc.kelvin,
        scale: doc.scale,
    };
    if let Some(grid) = &doc.temperature {
        let read = resources.temperature_grid(grid)?;
        info.temperature_grid.clone_from(&read.name);
        info.memory_bytes += read.grid.bytes();
        notices.extend(read.notices);
        if let Some(density) = density_box.filter(|_| read.has_position) {
            emission.temperature_from_medium = read.object_from_unit.inverse() * density;
        }
        emission.temperature = Some(read.grid);
    }
    Ok(emission)
}

/// Majorant cells at the resolution of the document, or else the cheapest ones for a grid whose unit value
/// has this extinction.
fn bounds_of<const C: usize>(
    placed: &PlacedGrid<C>,
    doc: &MediumDoc,
    info: &mut SceneInfo,
    extinction: f32,
) -> Arc<MajorantGrid<C>> {
    let world_from_unit = placement::world_from_unit(&doc.placement, placed.object_from_unit).matrix3;
    let edge =
        (world_from_unit.x_axis.length() + world_from_unit.y_axis.length() + world_from_unit.z_axis.length())
            / 3.0;
    let bounds = match doc.majorant.resolution {
        Some(cells) => placed.majorants.at(cells, doc.interpolation),
        None => placed.majorants.cheapest(extinction * edge * doc.majorant.factor, doc.interpolation),
    };
    info.majorant_cells = Some(bounds.cells());
    bounds
}

fn describe<const C: usize>(info: &mut SceneInfo, grid: &Grid<C>) {
    info.grid_size = Some(grid.size());
    info.memory_bytes += grid.bytes();
    info.occupied_voxels += grid.occupied();
    info.storage_error = info.storage_error.max(grid.storage_error());
    info.max_density = grid.max().into_iter().fold(0.0, f32::max);
    info.mean_density = grid.mean().into_iter().fold(0.0, f32::max);
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
        ObjectDoc::Ground { point, normal, albedo } => {
            (Shape::Plane(Plane { point: (*point).into(), normal: Vec3::from(*normal).normalize() }), albedo)
        }
        ObjectDoc::Box { center, size, rotate_deg, albedo } => (
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
