//! Image files: PNGs of views and maps, EXRs of views.

use super::ReportError;
use super::gather::{Gathered, Shown};
use crate::compare::maps::{Map, Range};
use crate::film::display::DisplayTransform;
use crate::io::export;
use crate::scene::ViewDoc;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};
use std::path::{Path, PathBuf};

/// Writes all images of a comparison into a folder.
pub(super) fn write(
    gathered: &Gathered<'_>,
    dir: &Path,
    files: &mut Vec<PathBuf>,
) -> Result<(), ReportError> {
    let save = |files: &mut Vec<PathBuf>, name: &str, png: Result<Vec<u8>, String>| {
        let path = dir.join(name);
        let bytes = png.map_err(|e| ReportError::write(&path, e))?;
        std::fs::write(&path, bytes).map_err(|e| ReportError::write(&path, e))?;
        files.push(path);
        Ok::<(), ReportError>(())
    };
    for view in &gathered.views {
        save(files, &format!("{}.png", view.name), picture(view))?;
        for (map, range) in &gathered.maps {
            if let Some(png) = painted(view, map, range) {
                save(files, &format!("{}.{}.png", view.name, map.id), png)?;
            }
        }
        let path = dir.join(format!("{}.exr", view.name));
        export::write_exr(&path, &view.view.snapshot, &view.view.doc)?;
        files.push(path);
    }
    if let Some(png) = reference(gathered) {
        save(files, "reference.png", png)?;
    }
    Ok(())
}

/// PNG of a view as displayed.
pub(super) fn picture(view: &Shown<'_>) -> Result<Vec<u8>, String> {
    let snapshot = &view.view.snapshot;
    shown(&snapshot.mean, (snapshot.width, snapshot.height), &view.view.doc.view)
}

/// PNG of the reference with the view settings of the scene, if there is a reference.
pub(super) fn reference(gathered: &Gathered<'_>) -> Option<Result<Vec<u8>, String>> {
    let reference = gathered.reference()?;
    Some(shown(reference.mean(), (reference.width, reference.height), &gathered.experiment.doc.view))
}

/// PNG of a map of a view, if the view has it.
pub(super) fn painted(view: &Shown<'_>, map: &Map, range: &Range) -> Option<Result<Vec<u8>, String>> {
    let values = view.map(map)?;
    let snapshot = &view.view.snapshot;
    let bytes: Vec<u8> = values.iter().flat_map(|v| range.paint(*v)).collect();
    Some(encode(&bytes, (snapshot.width, snapshot.height)))
}

fn shown(pixels: &[[f32; 3]], size: (usize, usize), view: &ViewDoc) -> Result<Vec<u8>, String> {
    encode(&rgb(pixels, view), size)
}

/// Converts linear radiance to display colours, three bytes per pixel.
pub(crate) fn rgb(pixels: &[[f32; 3]], view: &ViewDoc) -> Vec<u8> {
    let display = DisplayTransform::new(view);
    pixels.iter().flat_map(|p| display.encode(*p)).collect()
}

/// Encodes a PNG from three bytes per pixel.
pub(crate) fn encode(bytes: &[u8], (width, height): (usize, usize)) -> Result<Vec<u8>, String> {
    let mut png = Vec::new();
    PngEncoder::new_with_quality(&mut png, CompressionType::Default, FilterType::Adaptive)
        .write_image(bytes, width as u32, height as u32, ExtendedColorType::Rgb8)
        .map_err(|e| e.to_string())?;
    Ok(png)
}
