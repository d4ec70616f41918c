//! Pictures of the surroundings: EXR and Radiance HDR, as linear RGB.

use crate::light::Panorama;
use exr::prelude as exr;
use std::path::Path;

/// The most pixels that are read: 128 million take 1.5 GB.
const MAX_PIXELS: usize = 128_000_000;

/// Why a picture could not be used.
#[derive(Debug, thiserror::Error)]
pub enum PictureError {
    /// The file could not be opened or read.
    #[error("{file}: {source}. Check the name and the folder, or choose another file.")]
    Io {
        /// The file.
        file: String,
        /// What the system said.
        source: std::io::Error,
    },
    /// The file is not a picture that is understood.
    #[error(
        "{file}: not a usable picture: {reason}. Use a scan-line or tiled EXR, or a Radiance HDR, with R, G and B."
    )]
    Invalid {
        /// The file.
        file: String,
        /// What is wrong, and the cure.
        reason: String,
    },
}

/// A linear RGB picture, row by row from the top.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Pixels.
    pub pixels: Vec<[f32; 3]>,
}

/// Reads an `.exr` or `.hdr` picture.
///
/// # Errors
/// When the file is missing, damaged, of another kind, or larger than memory allows.
pub fn read(path: &Path) -> Result<Picture, PictureError> {
    let file = path.display().to_string();
    let invalid = |reason: String| PictureError::Invalid { file: file.clone(), reason };
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase();
    match extension.as_str() {
        "exr" => read_exr(path, &file),
        "hdr" => {
            let reader = image::ImageReader::open(path)
                .map_err(|source| PictureError::Io { file: file.clone(), source })?;
            let mut reader = reader;
            reader.set_format(image::ImageFormat::Hdr);
            let mut limits = image::Limits::default();
            limits.max_alloc = Some(16 * MAX_PIXELS as u64);
            reader.limits(limits);
            let rgb = reader.decode().map_err(|e| invalid(e.to_string()))?.into_rgb32f();
            let (width, height) = (rgb.width() as usize, rgb.height() as usize);
            let pixels = rgb.pixels().map(|p| p.0).collect();
            Ok(Picture { width, height, pixels })
        }
        other => Err(invalid(format!("`.{other}` is not supported; use .exr or .hdr"))),
    }
}

/// A picture with the standard errors and the metadata that [`super::export::write_exr`] adds.
#[derive(Clone, Debug)]
pub struct EstimatedPicture {
    /// Mean linear RGB.
    pub picture: Picture,
    /// Its standard error, if the file holds it.
    pub standard_error: Option<Vec<[f32; 3]>>,
    /// The JSON that this program leaves.
    pub metadata: Option<String>,
}

/// Reads an EXR with all that is known about its noise.
///
/// # Errors
/// As for [`read`].
pub fn read_estimate(path: &Path) -> Result<EstimatedPicture, PictureError> {
    use exr::{AttributeValue, ReadChannels, ReadLayers, Text};
    let file = path.display().to_string();
    let invalid = |reason: String| PictureError::Invalid { file: file.clone(), reason };
    if !path.extension().is_some_and(|e| e.eq_ignore_ascii_case("exr")) {
        return Err(invalid("a reference has to be an EXR file".into()));
    }
    guard_exr(path, &file)?;
    let image = exr::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_file(path)
        .map_err(|e| invalid(e.to_string()))?;
    let layer = image.layer_data;
    let (width, height) = (layer.size.width(), layer.size.height());
    let channel = |name: &str| {
        let found = layer.channel_data.list.iter().find(|c| c.name == *name)?;
        Some(found.sample_data.values_as_f32().collect::<Vec<f32>>())
    };
    let planes = |prefix: &str| {
        let [r, g, b] = ["R", "G", "B"].map(|c| channel(&format!("{prefix}{c}")));
        let (r, g, b) = (r?, g?, b?);
        Some(r.into_iter().zip(g).zip(b).map(|((r, g), b)| [r, g, b]).collect::<Vec<_>>())
    };
    let pixels = planes("").ok_or_else(|| invalid("it has no channels named R, G and B".into()))?;
    let metadata = match layer.attributes.other.get(&Text::from(super::export::METADATA)) {
        Some(AttributeValue::Text(text)) => Some(text.to_string()),
        _ => None,
    };
    let picture = Picture { width, height, pixels };
    Ok(EstimatedPicture { picture, standard_error: planes("stderr."), metadata })
}

/// Refuses what would take too much memory. The header is read first: a damaged one can ask for any amount.
fn guard_exr(path: &Path, file: &str) -> Result<(), PictureError> {
    use exr::*;
    let invalid = |reason: String| PictureError::Invalid { file: file.to_owned(), reason };
    std::fs::metadata(path).map_err(|source| PictureError::Io { file: file.to_owned(), source })?;
    let meta = MetaData::read_from_file(path, false).map_err(|e| invalid(e.to_string()))?;
    for header in &meta.headers {
        if header.layer_size.area() > MAX_PIXELS || header.channels.list.is_empty() {
            return Err(invalid(format!(
                "a layer of {} × {} pixels and {} channels; at most {MAX_PIXELS} pixels fit",
                header.layer_size.width(),
                header.layer_size.height(),
                header.channels.list.len()
            )));
        }
    }
    Ok(())
}

fn read_exr(path: &Path, file: &str) -> Result<Picture, PictureError> {
    use exr::*;
    let invalid = |reason: String| PictureError::Invalid { file: file.to_owned(), reason };
    guard_exr(path, file)?;
    let image = read_first_rgba_layer_from_file(
        path,
        |size, _| Picture { width: size.width(), height: size.height(), pixels: vec![[0.0; 3]; size.area()] },
        |picture: &mut Picture, at, (r, g, b, _a): (f32, f32, f32, f32)| {
            let index = at.y() * picture.width + at.x();
            picture.pixels[index] = [r, g, b];
        },
    )
    .map_err(|e| invalid(format!("{e}; it needs a layer with R, G and B channels")))?;
    Ok(image.layer_data.channel_data.pixels)
}

/// Reads a panorama. Texels that are negative or not finite are set to 0 and counted.
///
/// # Errors
/// As for [`read`], and when the picture is black.
pub fn read_panorama(path: &Path) -> Result<(Panorama, usize), PictureError> {
    let mut picture = read(path)?;
    let mut repaired = 0;
    for pixel in &mut picture.pixels {
        if pixel.iter().any(|x| !x.is_finite() || *x < 0.0) {
            repaired += 1;
            *pixel = pixel.map(|x| if x.is_finite() { x.max(0.0) } else { 0.0 });
        }
    }
    let panorama = Panorama::new(picture.width, picture.height, picture.pixels).ok_or_else(|| {
        PictureError::Invalid {
            file: path.display().to_string(),
            reason: "the picture is empty or black, it would give no light".into(),
        }
    })?;
    Ok((panorama, repaired))
}

/// What an EXR file says about itself.
#[derive(Clone, Debug)]
pub struct ExrInfo {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Names of the channels of the first part.
    pub channels: Vec<String>,
    /// The JSON that [`super::export::write_exr`] leaves, if this program wrote the file.
    pub metadata: Option<String>,
}

/// Reads the header of an EXR file.
///
/// # Errors
/// When the file is missing or not an EXR file.
pub fn exr_info(path: &Path) -> Result<ExrInfo, PictureError> {
    let file = path.display().to_string();
    std::fs::metadata(path).map_err(|source| PictureError::Io { file: file.clone(), source })?;
    let invalid = |reason: String| PictureError::Invalid { file: file.clone(), reason };
    let meta = exr::MetaData::read_from_file(path, false).map_err(|e| invalid(e.to_string()))?;
    let header = meta.headers.first().ok_or_else(|| invalid("it has no part".into()))?;
    let name = exr::Text::from(super::export::METADATA);
    let metadata = match header.own_attributes.other.get(&name) {
        Some(exr::AttributeValue::Text(text)) => Some(text.to_string()),
        _ => None,
    };
    Ok(ExrInfo {
        width: header.layer_size.width(),
        height: header.layer_size.height(),
        channels: header.channels.list.iter().map(|c| c.name.to_string()).collect(),
        metadata,
    })
}
