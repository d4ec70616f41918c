//! Replacement of an embedded volume by the user's own.

use super::FiguresError;
use crate::io::volume::{ReadLimits, Volume, VolumeError, read_sparse_volume, read_sparse_volume_bytes};
use crate::io::{Library, embedded};
use crate::scene::{DensityDoc, GridRef, Resources, SceneDoc, bounds, rotation};
use glam::Vec3;
use std::path::Path;

/// Replaces the embedded volume by another with the same centre, the same longest edge, and the same optical
/// thickness of the densest grid line, so that camera and lights still fit. A scene without an embedded grid
/// is not changed.
///
/// # Errors
/// When the file cannot be read, is not a density, or is empty.
pub(super) fn replace(doc: &mut SceneDoc, file: &Path) -> Result<(), FiguresError> {
    let Some(ours) = embedded(doc)? else { return Ok(()) };
    let name = file.display().to_string();
    let theirs = read_sparse_volume(file, None, &ReadLimits::default(), &|_| ())?;
    if theirs.channels() != 1 {
        return Err(FiguresError::Colour { file: name, channels: theirs.channels() });
    }
    theirs.validate_density(file)?;
    let thickness = thickness(&theirs);
    if thickness <= 0.0 {
        return Err(FiguresError::Empty { file: name });
    }
    doc.medium_mut().scale *= self::thickness(&ours) / thickness;
    let (lo, hi) = own_box(doc)?;
    let placement = &mut doc.medium_mut().placement;
    if placement.fit.is_none() {
        // With `fit` the box is centred on the origin; the embedded volume rotates about its own origin.
        let centre = Vec3::from(placement.scale) * (0.5 * (lo + hi));
        let moved = rotation(placement.rotate_deg) * centre;
        placement.translate = (Vec3::from(placement.translate) + moved).into();
        placement.fit = Some((hi - lo).max_element());
    }
    doc.medium_mut().density = DensityDoc::Grid(GridRef { file: name, grid: None });
    Ok(())
}

fn embedded(doc: &SceneDoc) -> Result<Option<Volume>, VolumeError> {
    let Some(grid) = doc.medium().density.grid() else { return Ok(None) };
    let Some(bytes) = embedded::volume(&grid.file) else { return Ok(None) };
    read_sparse_volume_bytes(bytes, &grid.file, grid.grid.as_deref(), &ReadLimits::default(), &|_| ())
        .map(Some)
}

/// Bounding box of the embedded grid in the scene, before its placement.
fn own_box(doc: &SceneDoc) -> Result<(Vec3, Vec3), FiguresError> {
    let Some(grid) = doc.medium().density.grid() else { return Ok((Vec3::ZERO, Vec3::ONE)) };
    let placed = Library::default().scalar_grid(grid, doc.medium().precision)?;
    let (lo, hi) = bounds(&placed.object_from_unit);
    Ok((lo.as_vec3(), hi.as_vec3()))
}

/// Largest sum of densities along a grid line, in units of the longest edge.
fn thickness(volume: &Volume) -> f32 {
    let longest = volume.size().into_iter().max().unwrap_or(1).max(1);
    volume.thickest_line() / longest as f32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::scene_file;

    fn scene(name: &str) -> SceneDoc {
        scene_file::parse(embedded::find(name).unwrap().toml, name).unwrap()
    }

    #[test]
    fn our_own_volume_in_its_own_place_changes_nothing() {
        let folder = tempfile::tempdir().unwrap();
        for (name, volume) in
            [("first-light", "plume.vdb"), ("plume-spectral", "plume.vdb"), ("cloud-sidelit", "cloud.vdb")]
        {
            let file = folder.path().join(volume);
            std::fs::write(&file, embedded::volume(&format!("embedded:{volume}")).unwrap()).unwrap();
            let ours = scene(name);
            let mut own = ours.clone();
            replace(&mut own, &file).unwrap();
            assert!((own.medium().scale / ours.medium().scale - 1.0).abs() < 1e-5, "{name}");
            // The same box in world space, compared through the built scenes.
            let bounds = |doc: &SceneDoc| {
                let info = crate::scene::build(doc, &mut Library::default()).unwrap().info;
                [info.world_min, info.world_max].concat()
            };
            let pairs = bounds(&ours).into_iter().zip(bounds(&own));
            assert!(
                pairs.clone().all(|(a, b)| (a - b).abs() < 1e-4),
                "{name}: {:?}",
                pairs.collect::<Vec<_>>()
            );
        }
    }

    #[test]
    fn an_unsuitable_volume_is_refused_and_a_cube_stays_a_cube() {
        let mut doc = scene("cloud-sidelit");
        let missing = replace(&mut doc, Path::new("none.vdb")).unwrap_err().to_string();
        assert!(missing.contains("none.vdb"), "{missing}");
        let mut cube = scene("homogeneous-absorption");
        replace(&mut cube, Path::new("none.vdb")).unwrap();
        assert_eq!(cube, scene("homogeneous-absorption"));
    }
}
