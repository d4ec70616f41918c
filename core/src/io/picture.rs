//! Pictures of the surroundings: EXR and Radiance HDR, as linear RGB.

use super::exr_picture::{self, MAX_PIXELS, Opened};
use super::primaries;
use crate::light::Panorama;
use exr::prelude as exr;
use glam::DMat3;
use std::path::Path;

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

/// A picture as its file has it.
struct Stored {
    picture: Picture,
    /// Linear sRGB from the file's RGB, by columns; `None` where it is the same.
    to_srgb: Option<DMat3>,
    notices: Vec<String>,
}

/// Reads an `.exr` or `.hdr` picture as linear sRGB. Of an EXR, what its display window shows: overscan is cut off, and
/// what the file lacks is black.
///
/// # Errors
/// When the file is missing, damaged, of another kind, or larger than memory allows.
pub fn read(path: &Path) -> Result<Picture, PictureError> {
    let Stored { mut picture, to_srgb, .. } = stored(path, |_| Ok(()))?;
    if let Some(matrix) = to_srgb {
        picture.pixels.iter_mut().for_each(|pixel| *pixel = primaries::convert(&matrix, *pixel));
    }
    Ok(picture)
}

/// Reads a picture whose head passes a check.
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

/// A picture with the standard errors and the metadata that [`super::export::write_exr`] adds.
#[derive(Clone, Debug)]
pub struct EstimatedPicture {
    /// Mean linear RGB.
    pub picture: Picture,
    /// Its standard error, if the file holds it.
    pub standard_error: Option<Vec<[f32; 3]>>,
    /// The JSON that this program leaves.
    pub metadata: Option<String>,
    /// What is to be known about its windows and primaries.
    pub notices: Vec<String>,
}

/// Reads an EXR with all that is known about its noise, as linear sRGB. Pixels of the display window that the file lacks
/// are NaN: nothing is known of them, and no error is measured there.
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
        return Err(invalid("none of its pixels lies in its display window, or all of them are NaN"));
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

/// The JSON that [`super::export::write_exr`] leaves.
fn metadata(opened: &Opened) -> Option<String> {
    let name = exr::Text::from(super::export::METADATA);
    match opened.header().own_attributes.other.get(&name) {
        Some(exr::AttributeValue::Text(text)) => Some(text.to_string()),
        _ => None,
    }
}

/// What an infinite texel becomes: the largest half float, which is what a sun is clipped to by writers that do not let
/// it overflow.
const LARGEST_HALF: f32 = 65504.0;
/// Beyond this, sums over a large picture leave the range of floats.
const INFINITE: f32 = 1e30;

/// Reads a panorama as linear sRGB that is finite and not negative. Infinite texels become `LARGEST_HALF`, what is NaN
/// or negative 0; each is told.
///
/// # Errors
/// As for [`read`], and when the picture is black or a cube map.
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
        .ok_or_else(|| invalid("the picture is empty or black, it would give no light"))?;
    Ok((panorama, notices))
}

/// Makes texels finite, linear sRGB and not negative, and tells what was changed.
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

/// What an EXR file says about itself.
#[derive(Clone, Debug)]
pub struct ExrInfo {
    /// Columns of the picture, that is, of the display window.
    pub width: usize,
    /// Rows of the picture.
    pub height: usize,
    /// First and last pixel of the display window, both inclusive: x, y, x, y.
    pub display_window: [i64; 4],
    /// First and last pixel in the file.
    pub data_window: [i64; 4],
    /// Names of the channels of the part that holds the colour, or of the first.
    pub channels: Vec<String>,
    /// The JSON that [`super::export::write_exr`] leaves, if this program wrote the file.
    pub metadata: Option<String>,
    /// What is to be known about its windows and primaries.
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

/// Tells what would be changed in a picture if it were used as an environment map: texels that are not finite or
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
