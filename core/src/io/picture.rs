//! Reading of images and environment maps: EXR and Radiance HDR, as linear RGB.

use super::exr_picture::{self, MAX_PIXELS, Opened};
use super::primaries;
use crate::light::Panorama;
use exr::prelude as exr;
use glam::DMat3;
use std::path::Path;

/// Reason why an image could not be used.
#[derive(Debug, thiserror::Error)]
pub enum PictureError {
    /// The file could not be opened or read.
    #[error("{file}: {source}. Check the name and the folder, or choose another file.")]
    Io {
        /// File name.
        file: String,
        /// Error of the operating system.
        source: std::io::Error,
    },
    /// The file is not a supported image.
    #[error(
        "{file}: not a usable image: {reason}. Use a scan-line or tiled EXR, or a Radiance HDR, with R, G and B."
    )]
    Invalid {
        /// File name.
        file: String,
        /// Fault and remedy.
        reason: String,
    },
}

/// A linear RGB image, row by row from the top.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Pixels.
    pub pixels: Vec<[f32; 3]>,
}

/// An image as stored in its file.
struct Stored {
    picture: Picture,
    /// Matrix from the RGB of the file to linear sRGB; `None` for the identity.
    to_srgb: Option<DMat3>,
    notices: Vec<String>,
}

/// Reads an `.exr` or `.hdr` image as linear sRGB. An EXR file is cropped to its display window: overscan is
/// discarded, and missing pixels are black.
///
/// # Errors
/// When the file is missing, damaged, of another format, or too large.
pub fn read(path: &Path) -> Result<Picture, PictureError> {
    let Stored { mut picture, to_srgb, .. } = stored(path, |_| Ok(()))?;
    if let Some(matrix) = to_srgb {
        picture.pixels.iter_mut().for_each(|pixel| *pixel = primaries::convert(&matrix, *pixel));
    }
    Ok(picture)
}

/// Reads an image whose EXR header passes a check.
fn stored(path: &Path, check: impl Fn(&Opened) -> Result<(), PictureError>) -> Result<Stored, PictureError> {
    let file = path.display().to_string();
    let invalid = |reason: String| PictureError::Invalid { file: file.clone(), reason };
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase();
    match extension.as_str() {
        "exr" => {
            let opened = Opened::head(path)?;
            check(&opened)?;
            let (width, height) = (opened.display().size.width(), opened.display().size.height());
            let pixels = opened.colour(path, 0.0)?;
            Ok(Stored {
                picture: Picture { width, height, pixels },
                to_srgb: opened.to_srgb(),
                notices: opened.notices("are black"),
            })
        }
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
            Ok(Stored { picture: Picture { width, height, pixels }, to_srgb: None, notices: Vec::new() })
        }
        other => Err(invalid(format!("`.{other}` is not supported; use .exr or .hdr"))),
    }
}

/// An image with the standard errors and the metadata written by [`super::export::write_exr`].
#[derive(Clone, Debug)]
pub struct EstimatedPicture {
    /// Mean linear RGB.
    pub picture: Picture,
    /// Standard error of the mean, if the file contains it.
    pub standard_error: Option<Vec<[f32; 3]>>,
    /// JSON metadata written by this program.
    pub metadata: Option<String>,
    /// Notices about windows and primaries.
    pub notices: Vec<String>,
}

/// Reads an EXR file with its noise statistics, as linear sRGB. Pixels of the display window that are missing
/// in the file are NaN: they are unknown, and excluded from error measurement.
///
/// # Errors
/// As for [`read`].
pub fn read_estimate(path: &Path) -> Result<EstimatedPicture, PictureError> {
    let file = path.display().to_string();
    let invalid = |reason: &str| PictureError::Invalid { file: file.clone(), reason: reason.into() };
    if !path.extension().is_some_and(|e| e.eq_ignore_ascii_case("exr")) {
        return Err(invalid("a reference has to be an EXR file"));
    }
    let opened = Opened::head(path)?;
    let size = opened.display().size;
    let mut pixels = opened.colour(path, f32::NAN)?;
    let mut standard_error = opened.standard_error(path, f32::NAN)?;
    if pixels.iter().all(|pixel| pixel.iter().all(|x| x.is_nan())) {
        return Err(invalid("no pixel is inside its display window, or all pixels are NaN"));
    }
    let mut notices = opened.notices("are unknown, and no error is measured there");
    if let Some(matrix) = opened.to_srgb() {
        pixels.iter_mut().for_each(|pixel| *pixel = primaries::convert(&matrix, *pixel));
        if let Some(errors) = &mut standard_error {
            errors.iter_mut().for_each(|error| *error = primaries::convert_errors(&matrix, *error));
            notices.push(format!("{file}: its standard errors were converted to upper bounds."));
        }
    }
    let picture = Picture { width: size.width(), height: size.height(), pixels };
    Ok(EstimatedPicture { picture, standard_error, metadata: metadata(&opened), notices })
}

/// JSON metadata written by [`super::export::write_exr`].
fn metadata(opened: &Opened) -> Option<String> {
    let name = exr::Text::from(super::export::METADATA);
    match opened.header().own_attributes.other.get(&name) {
        Some(exr::AttributeValue::Text(text)) => Some(text.to_string()),
        _ => None,
    }
}

/// Value that replaces an infinite texel: the largest half float, to which some writers clip the sun to avoid
/// overflow.
const LARGEST_HALF: f32 = 65504.0;
/// Threshold beyond which sums over a large image leave the range of floats.
const INFINITE: f32 = 1e30;

/// Reads an environment map as finite, non-negative linear sRGB. Infinite texels become `LARGEST_HALF`; NaN
/// and negative texels become 0. Each change is reported as a notice.
///
/// # Errors
/// As for [`read`], and when the image is black or a cube map.
pub fn read_panorama(path: &Path) -> Result<(Panorama, Vec<String>), PictureError> {
    let file = path.display().to_string();
    let invalid = |reason: &str| PictureError::Invalid { file: file.clone(), reason: reason.into() };
    let equirectangular = |opened: &Opened| match opened.is_cube() {
        true => Err(invalid("it is a cube map: convert it to a latitude-longitude map")),
        false => Ok(()),
    };
    let Stored { mut picture, to_srgb, mut notices } = stored(path, equirectangular)?;
    notices
        .extend(usable(&mut picture.pixels, to_srgb).into_iter().map(|notice| format!("{file}: {notice}")));
    let panorama = Panorama::new(picture.width, picture.height, picture.pixels)
        .ok_or_else(|| invalid("the image is empty or black and would emit no light"))?;
    Ok((panorama, notices))
}

/// Makes texels finite, linear sRGB and non-negative, and describes the changes.
fn usable(texels: &mut [[f32; 3]], to_srgb: Option<DMat3>) -> Vec<String> {
    let (mut infinite, mut undefined, mut negative) = (0_usize, 0_usize, 0_usize);
    for texel in texels {
        infinite += usize::from(texel.iter().any(|x| *x > INFINITE));
        undefined += usize::from(texel.iter().any(|x| x.is_nan()));
        *texel = texel.map(|x| match x {
            x if x.is_nan() => 0.0,
            x if x > INFINITE => LARGEST_HALF,
            x => x.max(-INFINITE),
        });
        if let Some(matrix) = &to_srgb {
            *texel = primaries::convert(matrix, *texel);
        }
        negative += usize::from(texel.iter().any(|x| *x < 0.0));
        *texel = texel.map(|x| x.max(0.0));
    }
    let tell = |count: usize, what: &str| (count > 0).then(|| format!("{count} {what}."));
    [
        tell(infinite, "infinite texel(s) set to 65504, the largest half float"),
        tell(undefined, "texel(s) with a channel that is not a number (NaN), set to 0"),
        tell(negative, "texel(s) with a channel below 0, or a colour out of sRGB's gamut, clamped at 0"),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// Header information of an EXR file.
#[derive(Clone, Debug)]
pub struct ExrInfo {
    /// Columns of the image, that is, of the display window.
    pub width: usize,
    /// Rows of the image.
    pub height: usize,
    /// First and last pixel of the display window, both inclusive: x, y, x, y.
    pub display_window: [i64; 4],
    /// First and last pixel of the data window.
    pub data_window: [i64; 4],
    /// Channel names of the part with the colour, or of the first part.
    pub channels: Vec<String>,
    /// JSON metadata of [`super::export::write_exr`], if this program wrote the file.
    pub metadata: Option<String>,
    /// Notices about windows and primaries.
    pub notices: Vec<String>,
}

/// Reads the header of an EXR file.
///
/// # Errors
/// When the file is missing or not an EXR file.
pub fn exr_info(path: &Path) -> Result<ExrInfo, PictureError> {
    let opened = Opened::head(path)?;
    let size = opened.display().size;
    Ok(ExrInfo {
        width: size.width(),
        height: size.height(),
        display_window: exr_picture::corners(opened.display()),
        data_window: exr_picture::corners(opened.data()),
        channels: opened.header().channels.list.iter().map(|c| c.name.to_string()).collect(),
        metadata: metadata(&opened),
        notices: opened.notices("are black in an environment map, and unknown in a reference"),
    })
}

/// Describes the changes that an image would undergo as an environment map: texels that are not finite or
/// negative.
///
/// # Errors
/// As for [`read`].
pub fn texel_notices(path: &Path) -> Result<Vec<String>, PictureError> {
    let file = path.display();
    let Stored { mut picture, to_srgb, .. } = stored(path, |_| Ok(()))?;
    let notices = usable(&mut picture.pixels, to_srgb);
    Ok(notices.into_iter().map(|notice| format!("{file}: as an environment map, {notice}")).collect())
}
