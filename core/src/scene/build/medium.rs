//! Freezes the media of a document.

use super::{PlacedGrid, ResourceError, Resources};
use crate::medium::{
    AlbedoField, AnyMedium, DensityGrid, Emission, ExtinctionField, Grid, Homogeneous, MajorantGrid,
    MajorantPolicy, PlacedMedium, Region, RgbGrids,
};
use crate::phase::{Phase, PhaseDoc, check_table};
use crate::scene::{
    DensityDoc, EmissionDoc, MajorantDoc, MediumDoc, MediumInfo, Problem, SceneError, SceneMedium,
    WhenExceeded, Within, placement,
};
use crate::spectrum::Spectrum;
use crate::surface::Solid;
use glam::{Affine3A, DAffine3, DVec3, Vec3};
use std::sync::Arc;

/// Maximum optical depth of a box, by its majorant. Beyond it free flights are shorter than the rounding
/// error of positions, and a walk would no longer advance.
const MAX_OPTICAL_DEPTH: f32 = 1e6;

/// Maximum albedo of a medium without a boundary, in which paths end by absorption alone.
const MAX_UNBOUNDED_ALBEDO: f32 = 0.9999;

/// Freezes one medium of a document, given its index, its key in messages and the closed object that it fills, if
/// any.
pub(super) fn build(
    doc: &MediumDoc,
    (index, path): (usize, &str),
    solid: Option<Arc<Solid>>,
    resources: &mut dyn Resources,
    notices: &mut Vec<String>,
) -> Result<(SceneMedium, MediumInfo), SceneError> {
    let invalid = |key: &str, message: &str| {
        SceneError::Invalid(Problem { path: format!("{path}.{key}"), message: message.into() })
    };
    let (phase, phase_points) = build_phase(doc, path, resources)?;
    let (medium, emission, object_from_unit, mut info) =
        build_medium(doc, path, phase.mean_cosine(), resources, notices)?;
    info.phase_points = phase_points;
    let (region, bounds) = match (&doc.within, doc.extent) {
        (Within::Grid | Within::Object(_), _) => {
            let world_from_unit = placement::world_from_unit(&doc.placement, object_from_unit);
            let (lo, hi) = placement::bounds(&world_from_unit);
            let own = (lo.as_vec3(), hi.as_vec3());
            // Relative to the edge lengths: a tiny box is valid, a flat one is not.
            let m = world_from_unit.matrix3;
            let edges = m.x_axis.length() * m.y_axis.length() * m.z_axis.length();
            let medium_from_world = placement::single(&world_from_unit.inverse());
            if !medium_from_world.is_finite() || m.determinant().abs() <= 1e-6 * edges {
                let message = "the box has no volume: give every scale a value other than 0";
                return Err(invalid("placement", message));
            }
            match solid {
                None => (Region::Cube(medium_from_world), Some(own)),
                Some(solid) => {
                    // A grid of any kind ends at its box; uniform coefficients fill the object.
                    let temperature =
                        doc.emission.as_ref().and_then(|emission| emission.temperature.as_ref());
                    let cut_by_cube = !doc.is_uniform() || temperature.is_some();
                    let (lo, hi) = solid.bounds();
                    let bounds = if cut_by_cube { (lo.max(own.0), hi.min(own.1)) } else { (lo, hi) };
                    if bounds.0.cmpge(bounds.1).any() {
                        notices.push(format!(
                            "The medium `{}` lies outside the object that bounds it.",
                            doc.name
                        ));
                    }
                    (Region::Inside { solid, medium_from_world, cut_by_cube }, Some(bounds))
                }
            }
        }
        (Within::Everywhere, Some(radius)) => {
            (Region::Ball(radius), Some((Vec3::splat(-radius), Vec3::splat(radius))))
        }
        (Within::Everywhere, None) => {
            if let AnyMedium::Homogeneous(medium) = &medium {
                if !medium.extinction.is_positive() {
                    let message = "is zero at some wavelength, where light would travel to infinity: raise it, \
                                   or give the medium an `extent`";
                    return Err(invalid("extinction", message));
                }
                if medium.albedo.largest() > MAX_UNBOUNDED_ALBEDO {
                    let message = "is close to 1 in a medium without a boundary, in which paths would not end: \
                                   lower it to 0.9999, or set `extent`";
                    return Err(invalid("albedo", message));
                }
            }
            (Region::Everywhere, None)
        }
    };
    if let Some((lo, hi)) = bounds {
        check_optical_depth(doc, path, info.majorant * (hi - lo).length(), notices)?;
    }
    let medium_from_world = region.medium_from_world();
    let placed = PlacedMedium::new(medium, region);
    Ok((SceneMedium { index, placed, phase, emission, bounds, medium_from_world }, info))
}

/// Medium without extinction, which stands in for the media of a scene that has none.
pub(super) fn vacuum() -> SceneMedium {
    let medium = Homogeneous {
        extinction: Spectrum::constant(0.0),
        albedo: Spectrum::constant(0.0),
        majorant: MajorantPolicy::new(&MajorantDoc::default()),
    };
    let placed = PlacedMedium::new(AnyMedium::Homogeneous(medium), Region::Ball(0.0));
    let phase = Phase::new(&PhaseDoc::Isotropic {});
    SceneMedium {
        index: usize::MAX,
        placed,
        phase,
        emission: None,
        bounds: None,
        medium_from_world: Affine3A::IDENTITY,
    }
}

/// Bounds of all media in world space. Those without a boundary do not count, unless there is no other; then
/// the bounds are those of the unit cube.
pub(super) fn bounds_of_all(media: &[SceneMedium]) -> (Vec3, Vec3) {
    let all = media.iter().filter_map(|medium| medium.bounds);
    all.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1))).unwrap_or((Vec3::splat(-0.5), Vec3::splat(0.5)))
}

fn check_optical_depth(
    doc: &MediumDoc,
    path: &str,
    depth: f32,
    notices: &mut Vec<String>,
) -> Result<(), SceneError> {
    if depth.is_nan() || depth > MAX_OPTICAL_DEPTH {
        return Err(SceneError::Invalid(Problem {
            path: format!("{path}.scale"),
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
fn build_phase(
    medium: &MediumDoc,
    path: &str,
    resources: &mut dyn Resources,
) -> Result<(Phase, Vec<[f32; 2]>), SceneError> {
    let doc = &medium.phase;
    let PhaseDoc::Tabulated { angle, file, .. } = doc else { return Ok((Phase::new(doc), Vec::new())) };
    if file.is_empty() {
        return Ok((Phase::new(doc), Vec::new()));
    }
    let failed = |source| SceneError::Resource { path: format!("{path}.phase.file"), source };
    let points = resources.phase_table(file).map_err(failed)?;
    check_table(*angle, &points).map_err(|e| failed(ResourceError(format!("{file}: {e}"))))?;
    let read = PhaseDoc::Tabulated { angle: *angle, points: points.clone(), file: file.clone() };
    Ok((Phase::new(&read), points))
}

fn build_medium(
    doc: &MediumDoc,
    path: &str,
    mean_cosine: f32,
    resources: &mut dyn Resources,
    notices: &mut Vec<String>,
) -> Result<(AnyMedium, Option<Emission>, DAffine3, MediumInfo), SceneError> {
    let at = |key: &str| {
        let path = format!("{path}.{key}");
        move |source| SceneError::Resource { path, source }
    };
    let centred = DAffine3::from_translation(DVec3::splat(-0.5));
    let majorant = MajorantPolicy::new(&doc.majorant);
    let (extinction, albedo) = doc.extinction_and_albedo(mean_cosine);
    let sigma = extinction.scaled(doc.scale);
    let mut info = MediumInfo { max_density: 1.0, mean_density: 1.0, ..MediumInfo::default() };

    // Placement of the unit cube in the space of the file, if the file defines one.
    let mut placed = centred;
    let mut density_box = None;
    let extinction = match &doc.density {
        DensityDoc::Uniform {} => ExtinctionField::Uniform(sigma),
        DensityDoc::Grid(grid) => {
            let read = resources.scalar_grid(grid, doc.precision).map_err(at("density"))?;
            info.density_grid.clone_from(&read.name);
            describe(&mut info, &read.grid);
            notices.extend_from_slice(&read.notices);
            placed = read.object_from_unit;
            density_box = read.has_position.then_some(placed);
            let bounds = bounds_of(&read, doc, &mut info, sigma.rgb().element_sum() / 3.0);
            ExtinctionField::Density(read.grid, bounds, sigma)
        }
        DensityDoc::RgbGrid(grid) => {
            let read = resources.rgb_grid(grid, doc.precision).map_err(at("density"))?;
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
            let read = resources.rgb_grid(grid, doc.precision).map_err(at("albedo_grid"))?;
            if read.grid.max().iter().any(|a| *a > 1.0) {
                return Err(at("albedo_grid")(ResourceError(format!(
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
                Some(density) if read.has_position => {
                    placement::single(&(read.object_from_unit.inverse() * density))
                }
                _ => Affine3A::IDENTITY,
            };
            AlbedoField::Rgb(read.grid, albedo_from_density)
        }
    };
    let emission = match &doc.emission {
        None => None,
        Some(emission) => Some(
            build_emission(emission, density_box, resources, &mut info, notices).map_err(at("emission"))?,
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
    density_box: Option<DAffine3>,
    resources: &mut dyn Resources,
    info: &mut MediumInfo,
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
            emission.temperature_from_medium =
                placement::single(&(read.object_from_unit.inverse() * density));
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
    info: &mut MediumInfo,
    extinction: f32,
) -> Arc<MajorantGrid<C>> {
    let world_from_unit = placement::world_from_unit(&doc.placement, placed.object_from_unit).matrix3;
    let edge = ((world_from_unit.x_axis.length()
        + world_from_unit.y_axis.length()
        + world_from_unit.z_axis.length())
        / 3.0) as f32;
    let bounds = match doc.majorant.resolution {
        Some(cells) => placed.majorants.at(cells, doc.interpolation),
        None => placed.majorants.cheapest(extinction * edge * doc.majorant.factor, doc.interpolation),
    };
    info.majorant_cells = Some(bounds.cells());
    bounds
}

fn describe<const C: usize>(info: &mut MediumInfo, grid: &Grid<C>) {
    info.grid_size = Some(grid.size());
    info.memory_bytes += grid.bytes();
    info.occupied_voxels += grid.occupied();
    info.storage_error = info.storage_error.max(grid.storage_error());
    info.max_density = grid.max().into_iter().fold(0.0, f32::max);
    info.mean_density = grid.mean().into_iter().fold(0.0, f32::max);
}
