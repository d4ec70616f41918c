//! Adaptation of a scene to a volume of the user.

use glam::Vec3;
use majorant_core::io::volume::{ReadLimits, Volume, read_sparse_volume};
use majorant_core::scene::{DensityDoc, GridRef, LightDoc, MediumDoc, PlacementDoc, SceneDoc, Within};
use std::path::Path;

/// Optical thickness of the thickest line through an opened volume, at the wavelength of the strongest
/// extinction: opaque, but with visible depth.
const OPTICAL_THICKNESS: f32 = 12.0;

/// Measurements of a volume that determine the scene setup.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    channels: usize,
    /// Edge lengths, relative to the longest.
    edges: [f32; 3],
    /// Density integrated along the thickest grid line, in units of the longest edge.
    thickest: f32,
}

/// Reads and validates a volume like the renderer, and measures it.
///
/// # Errors
/// A message with the cause and the remedy.
pub fn look_into(path: &Path) -> Result<Look, String> {
    let volume =
        read_sparse_volume(path, None, &ReadLimits::default(), &|_| ()).map_err(|e| e.to_string())?;
    volume.validate_density(path).map_err(|e| e.to_string())?;
    Ok(measure(&volume))
}

fn measure(volume: &Volume) -> Look {
    let size = volume.size().map(|n| n as f32);
    let longest = size.into_iter().fold(1.0, f32::max);
    Look {
        channels: volume.channels(),
        edges: size.map(|n| n / longest),
        thickest: volume.thickest_line() / longest,
    }
}

/// Returns the scene with its density replaced by a file: fitted to length 1 around the origin, scaled to be
/// neither invisible nor black, with camera and lights in the same arrangement around it as before.
#[must_use]
pub fn with_volume(doc: &SceneDoc, file: String, look: &Look) -> SceneDoc {
    let mut doc = doc.clone();
    doc.title = Path::new(&file).file_stem().map_or_else(String::new, |s| s.to_string_lossy().into_owned());
    doc.note = String::new();
    let grid = GridRef { file, grid: None };
    *doc.medium_mut() = MediumDoc {
        density: if look.channels == 3 { DensityDoc::RgbGrid(grid) } else { DensityDoc::Grid(grid) },
        placement: PlacementDoc { fit: Some(1.0), ..PlacementDoc::default() },
        albedo_grid: None,
        enabled: true,
        within: Within::Grid,
        extent: None,
        ..doc.medium().clone()
    };
    let strongest = match look.channels {
        3 => 1.0,
        // The extinction does not depend on the mean cosine.
        _ => doc.medium().extinction_and_albedo(0.0).0.max_over_wavelengths(),
    };
    let thickness = strongest * look.thickest;
    if thickness > 0.0 {
        doc.medium_mut().scale = two_digits(OPTICAL_THICKNESS / thickness).min(1e6);
    }
    move_about_origin(&mut doc);
    frame(&mut doc, look.edges);
    doc
}

/// Translates camera and lights so that the camera's target is the origin.
fn move_about_origin(doc: &mut SceneDoc) {
    let target = doc.camera.target;
    let moved = |p: &mut [f32; 3]| p.iter_mut().zip(target).for_each(|(p, t)| *p -= t);
    for light in &mut doc.lights {
        match light {
            LightDoc::Rectangle { center, target, .. } => {
                moved(center);
                moved(target);
            }
            LightDoc::Sphere { center, .. } => moved(center),
            LightDoc::Sun { .. } | LightDoc::Environment { .. } | LightDoc::EnvironmentMap { .. } => {}
        }
    }
    moved(&mut doc.camera.origin);
    moved(&mut doc.camera.target);
}

/// Moves the camera along its line of sight, as close as the whole box stays in the image.
fn frame(doc: &mut SceneDoc, edges: [f32; 3]) {
    /// Factor by which the corners of the box, which are mostly empty, may exceed the image.
    const FILL: f32 = 1.06;
    let camera = &mut doc.camera;
    let origin = Vec3::from(camera.origin);
    let Some(back) = origin.try_normalize() else { return };
    let right = Vec3::from(camera.up).cross(back).normalize_or(back.any_orthonormal_vector());
    let up = back.cross(right);
    let aspect = doc.film.height as f32 / doc.film.width.max(1) as f32;
    let half_width = FILL * (0.5 * camera.fov_deg.to_radians()).tan();
    let half_height = half_width * aspect;
    let distance = (0..8_u8)
        .map(|corner| {
            let sign = |axis: u8| if corner >> axis & 1 == 1 { 0.5 } else { -0.5 };
            let at = Vec3::new(sign(0), sign(1), sign(2)) * Vec3::from(edges);
            let sideways = (at.dot(right).abs() / half_width).max(at.dot(up).abs() / half_height);
            at.dot(back) + sideways
        })
        .fold(0.0, f32::max);
    camera.origin = (back * distance).into();
}

/// Rounds to two significant digits.
fn two_digits(x: f32) -> f32 {
    // Via text, which gives the number nearest to its two digits.
    format!("{x:.1e}").parse().unwrap_or(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    const LOOK: Look = Look { channels: 1, edges: [1.0, 0.5, 0.5], thickest: 0.3 };

    #[test]
    fn the_volume_is_fitted_scaled_and_framed() {
        let mut doc = SceneDoc::default();
        doc.camera.target = [1.0, 2.0, 0.0];
        doc.camera.origin = [1.0, 2.0, 30.0];
        doc.lights = vec![LightDoc::Sphere {
            center: [1.0, 3.0, 0.0],
            radius: 0.1,
            radiance: majorant_core::spectrum::SpectrumDoc::Constant(1.0),
            scale: 1.0,
            visible: true,
            enabled: true,
        }];
        let filled = with_volume(&doc, "a.vdb".into(), &LOOK);
        assert_eq!(filled.medium().placement.fit, Some(1.0));
        // Extinction 4, thickest line 0.3: 12 / 1.2.
        assert!((filled.medium().scale - 10.0).abs() < 1e-3);
        assert_eq!(filled.camera.target, [0.0; 3]);
        assert!(
            filled.camera.origin[0] == 0.0 && filled.camera.origin[2] > 1.0 && filled.camera.origin[2] < 10.0
        );
        assert!(matches!(filled.lights[0], LightDoc::Sphere { center: [0.0, 1.0, 0.0], .. }));
        assert!(majorant_core::scene::validate(&filled).is_empty());
    }

    #[test]
    fn a_tall_volume_stays_in_a_wide_image() {
        let tall = Look { edges: [0.3, 1.0, 0.3], ..LOOK };
        let filled = with_volume(&SceneDoc::default(), "a.vdb".into(), &tall);
        let distance = filled.camera.origin[2] - 0.15;
        let width = 2.0 * distance * (0.5 * filled.camera.fov_deg.to_radians()).tan();
        let height = width * filled.film.height as f32 / filled.film.width as f32;
        assert!(height > 0.93 && height < 1.0, "{height}");
    }

    #[test]
    fn the_scale_has_two_digits() {
        assert_eq!(two_digits(0.786_13), 0.79);
        assert_eq!(two_digits(83.7), 84.0);
        assert_eq!(two_digits(1234.0), 1200.0);
    }

    #[test]
    fn an_empty_volume_keeps_the_scale() {
        let empty = Look { thickest: 0.0, ..LOOK };
        assert_eq!(with_volume(&SceneDoc::default(), "a.vdb".into(), &empty).medium().scale, 1.0);
        let colour = Look { channels: 3, ..LOOK };
        let filled = with_volume(&SceneDoc::default(), "a.vol".into(), &colour);
        assert!(matches!(filled.medium().density, DensityDoc::RgbGrid(_)));
    }
}
