//! Image output: EXR with standard errors and the complete scene, and tone-mapped PNG.

use crate::film::Snapshot;
use crate::film::display::DisplayTransform;
use crate::scene::{SceneDoc, ViewDoc};
use exr::prelude::*;
use serde_json::json;
use std::path::Path;

/// Reason why an image could not be written.
#[derive(Debug, thiserror::Error)]
#[error("{file} could not be written: {reason}. Choose another place, or free some space.")]
pub struct ExportError {
    file: String,
    reason: String,
}

fn failed(path: &Path, reason: impl ToString) -> ExportError {
    ExportError { file: path.display().to_string(), reason: reason.to_string() }
}

/// Name of the EXR text attribute with scene and statistics as JSON.
pub const METADATA: &str = "majorant";

/// Writes `R,G,B` (linear sRGB) and `stderr.R/G/B` (standard error of the mean) in one part, with the
/// complete scene, estimator, seed, samples, seconds and version as JSON in the attribute `majorant`.
///
/// # Errors
/// When the file cannot be written.
pub fn write_exr(path: &Path, snapshot: &Snapshot, doc: &SceneDoc) -> std::result::Result<(), ExportError> {
    let plane = |pixels: &[[f32; 3]], c: usize| FlatSamples::F32(pixels.iter().map(|p| p[c]).collect());
    let mut channels = SmallVec::new();
    for (c, name) in ["R", "G", "B"].into_iter().enumerate() {
        channels.push(AnyChannel::new(name, plane(&snapshot.mean, c)));
        let error_name = format!("stderr.{name}");
        channels.push(AnyChannel::new(error_name.as_str(), plane(&snapshot.standard_error, c)));
    }
    // One attribute: the crate does not write several in a reproducible order.
    let mut attributes = LayerAttributes::default();
    let text = metadata(snapshot, doc).to_string();
    attributes.other.insert(Text::from(METADATA), AttributeValue::Text(Text::from(text.as_str())));
    let layer = Layer::new(
        (snapshot.width, snapshot.height),
        attributes,
        Encoding::SMALL_FAST_LOSSLESS,
        AnyChannels::sort(channels),
    );
    Image::from_layer(layer).write().to_file(path).map_err(|e| failed(path, e))
}

/// Metadata of an image, as written into an EXR file.
#[must_use]
pub fn metadata(snapshot: &Snapshot, doc: &SceneDoc) -> serde_json::Value {
    json!({
        "version": env!("CARGO_PKG_VERSION"),
        "target": snapshot.target,
        "scene": super::scene_file::to_toml(doc),
        "estimator": doc.estimator.id,
        "mode": doc.estimator.mode,
        "seed": doc.render.seed,
        "spp": snapshot.spp,
        "seconds": snapshot.seconds,
        "cpu_seconds": snapshot.cpu_seconds,
        "threads": snapshot.threads,
        "paths": snapshot.tally.paths,
        "lookups": snapshot.tally.lookups,
        "non_finite": snapshot.tally.non_finite,
        "non_finite_at": snapshot.tally.located.iter().map(|n| json!([n.x, n.y, n.sample])).collect::<Vec<_>>(),
    })
}

/// Writes a PNG with the tone mapping of the view settings.
///
/// # Errors
/// When the file cannot be written.
pub fn write_png(path: &Path, snapshot: &Snapshot, view: &ViewDoc) -> std::result::Result<(), ExportError> {
    write_png_of(path, &snapshot.mean, [snapshot.width, snapshot.height], view)
}

/// Writes linear sRGB, row by row from the top, as a PNG with the tone mapping of the view settings.
///
/// # Errors
/// When the file cannot be written.
pub fn write_png_of(
    path: &Path,
    linear: &[[f32; 3]],
    [width, height]: [usize; 2],
    view: &ViewDoc,
) -> std::result::Result<(), ExportError> {
    let display = DisplayTransform::new(view);
    let bytes: Vec<u8> = linear.iter().flat_map(|p| display.encode(*p)).collect();
    image::save_buffer_with_format(
        path,
        &bytes,
        width as u32,
        height as u32,
        image::ExtendedColorType::Rgb8,
        image::ImageFormat::Png,
    )
    .map_err(|e| failed(path, e))
}
