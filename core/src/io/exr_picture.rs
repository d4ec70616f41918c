//! Reading of EXR files as images: their colour channels, placed in the display window.
//!
//! A file contains the pixels of its data window, anywhere in the plane; the display window defines the
//! extent of the image. Pixels outside the display window (overscan) are discarded; pixels of the display
//! window that are not in the file (a crop) get a value given by the caller.

use super::picture::PictureError;
use super::primaries::Primaries;
use ::exr::meta::attribute::EnvironmentMap;
use ::exr::meta::header::Header;
use ::exr::prelude as exr;
use ::exr::prelude::{IntegerBounds, ReadChannels, ReadLayers, ReadSpecificChannel, Vec2};
use glam::DMat3;
use std::path::Path;

/// Maximum number of pixels: 128 million take 1.5 GB.
pub(super) const MAX_PIXELS: usize = 128_000_000;

/// Header of an EXR file, and its part that contains the image.
pub(super) struct Opened {
    file: String,
    header: Header,
    colour: Option<Colour>,
}

/// Channels that define the colour.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Colour {
    /// R, G and B.
    Rgb,
    /// Luminance alone: grey.
    Luminance,
}

impl Opened {
    /// Reads the header and refuses images that would take too much memory, since a damaged header can state
    /// any size.
    ///
    /// # Errors
    /// When the file is missing, not an EXR file, or too large.
    pub(super) fn head(path: &Path) -> Result<Self, PictureError> {
        let file = path.display().to_string();
        std::fs::metadata(path).map_err(|source| PictureError::Io { file: file.clone(), source })?;
        let invalid = |reason: String| PictureError::Invalid { file: file.clone(), reason };
        let meta = exr::MetaData::read_from_file(path, false).map_err(|e| invalid(e.to_string()))?;
        for header in &meta.headers {
            let pixels = header.layer_size.area().max(header.shared_attributes.display_window.size.area());
            if pixels > MAX_PIXELS || header.channels.list.is_empty() {
                return Err(invalid(format!(
                    "a layer of {} × {} pixels and {} channels; at most {MAX_PIXELS} pixels fit",
                    header.layer_size.width(),
                    header.layer_size.height(),
                    header.channels.list.len()
                )));
            }
        }
        // The reader of specific channels uses the first part that has the channels.
        let find = |colour: Colour| meta.headers.iter().position(|h| !h.deep && colour.is_in(h));
        let found = [Colour::Rgb, Colour::Luminance].into_iter().find_map(|c| Some((find(c)?, c)));
        let (part, colour) = found.map_or((0, None), |(part, colour)| (part, Some(colour)));
        let header = meta.headers.into_iter().nth(part).ok_or_else(|| invalid("it has no part".into()))?;
        Ok(Self { file, header, colour })
    }

    pub(super) fn header(&self) -> &Header {
        &self.header
    }

    /// Display window, the extent of the image.
    pub(super) fn display(&self) -> IntegerBounds {
        self.header.shared_attributes.display_window
    }

    /// Data window, the extent of the pixels in the file.
    pub(super) fn data(&self) -> IntegerBounds {
        self.header.data_window()
    }

    /// Matrix from the RGB of the file to linear sRGB; `None` for the identity.
    pub(super) fn to_srgb(&self) -> Option<DMat3> {
        self.primaries()?.to_srgb().ok().flatten()
    }

    fn primaries(&self) -> Option<Primaries> {
        let c = self.header.shared_attributes.chromaticities.filter(|_| self.colour == Some(Colour::Rgb))?;
        let pair = |Vec2(x, y): Vec2<f32>| [x, y];
        Some(Primaries { red: pair(c.red), green: pair(c.green), blue: pair(c.blue), white: pair(c.white) })
    }

    /// Whether the image is a cube map.
    pub(super) fn is_cube(&self) -> bool {
        self.header.own_attributes.environment_map == Some(EnvironmentMap::Cube)
    }

    /// Whether pixels of the display window are missing in the file.
    pub(super) fn is_crop(&self) -> bool {
        let (data, display) = (corners(self.data()), corners(self.display()));
        data[0] > display[0] || data[1] > display[1] || data[2] < display[2] || data[3] < display[3]
    }

    /// Notices about windows and primaries; `missing` describes the treatment of missing pixels.
    pub(super) fn notices(&self, missing: &str) -> Vec<String> {
        let file = &self.file;
        let mut notices = Vec::new();
        let (data, display) = (corners(self.data()), corners(self.display()));
        if data != display {
            let window = |[x0, y0, x1, y1]: [i64; 4]| format!("({x0}, {y0}) to ({x1}, {y1})");
            let rest = if self.is_crop() {
                format!("missing pixels {missing}")
            } else {
                "the rest is cut off".into()
            };
            notices.push(format!(
                "{file}: it contains the pixels {} of the image {}; {rest}.",
                window(data),
                window(display)
            ));
        }
        if let Some(primaries) = self.primaries() {
            let Primaries { red, green, blue, white } = primaries;
            match primaries.to_srgb() {
                Ok(None) => {}
                Ok(Some(_)) => notices.push(format!(
                    "{file}: its primaries {red:?}, {green:?}, {blue:?} and white {white:?} were converted to linear \
                     sRGB, with Bradford's adaptation of the white point."
                )),
                Err(_) => notices.push(format!(
                    "{file}: its chromaticities {red:?}, {green:?}, {blue:?}, {white:?} span no colour space; the \
                     image is read as linear sRGB."
                )),
            }
        }
        if self.colour == Some(Colour::Luminance) {
            notices.push(format!("{file}: it contains luminance (Y) only, and is read as grey."));
        }
        notices
    }

    /// Reads the colour of every pixel of the display window; pixels missing in the file become `missing`.
    ///
    /// # Errors
    /// When there is no colour, or the pixels are damaged.
    pub(super) fn colour(&self, path: &Path, missing: f32) -> Result<Vec<[f32; 3]>, PictureError> {
        match self.colour {
            None => Err(self.invalid("it needs a layer with R, G and B channels")),
            Some(Colour::Rgb) => self.planes(path, RGB, missing),
            Some(Colour::Luminance) => {
                let place = self.place();
                let read =
                    exr::read().no_deep_data().largest_resolution_level().specific_channels().required("Y");
                let read = read.collect_pixels(
                    move |_, _| vec![[missing; 3]; place.pixels()],
                    move |pixels: &mut Vec<[f32; 3]>, at, (y,): (f32,)| place.set(pixels, at, [y; 3]),
                );
                let image = read.first_valid_layer().all_attributes().from_file(path);
                image.map(|i| i.layer_data.channel_data.pixels).map_err(|e| self.invalid(e))
            }
        }
    }

    /// Reads the standard errors that this program writes with the colour; `None` if there are none.
    ///
    /// # Errors
    /// When the pixels are damaged.
    pub(super) fn standard_error(
        &self,
        path: &Path,
        missing: f32,
    ) -> Result<Option<Vec<[f32; 3]>>, PictureError> {
        let names = STANDARD_ERROR;
        if self.colour != Some(Colour::Rgb) || !names.into_iter().all(|name| has(&self.header, name)) {
            return Ok(None);
        }
        self.planes(path, names, missing).map(Some)
    }

    /// Reads three channels, placed in the display window.
    fn planes(&self, path: &Path, names: [&str; 3], missing: f32) -> Result<Vec<[f32; 3]>, PictureError> {
        let place = self.place();
        let [a, b, c] = names;
        let read = exr::read().no_deep_data().largest_resolution_level().specific_channels();
        let read = read.required(a).required(b).required(c).collect_pixels(
            move |_, _| vec![[missing; 3]; place.pixels()],
            move |pixels: &mut Vec<[f32; 3]>, at, (a, b, c): (f32, f32, f32)| {
                place.set(pixels, at, [a, b, c])
            },
        );
        let image = read.first_valid_layer().all_attributes().from_file(path);
        image.map(|i| i.layer_data.channel_data.pixels).map_err(|e| self.invalid(e))
    }

    fn place(&self) -> Place {
        let (data, display) = (corners(self.data()), corners(self.display()));
        let size = self.display().size;
        Place { size: [size.width(), size.height()], offset: [data[0] - display[0], data[1] - display[1]] }
    }

    fn invalid(&self, reason: impl ToString) -> PictureError {
        PictureError::Invalid { file: self.file.clone(), reason: reason.to_string() }
    }
}

const RGB: [&str; 3] = ["R", "G", "B"];
const STANDARD_ERROR: [&str; 3] = ["stderr.R", "stderr.G", "stderr.B"];

impl Colour {
    fn is_in(self, header: &Header) -> bool {
        match self {
            Self::Rgb => RGB.into_iter().all(|name| has(header, name)),
            // With X and Z, Y is a coordinate of XYZ; with RY and BY the file has subsampled chroma.
            Self::Luminance => {
                has(header, "Y") && !["X", "Z", "RY", "BY"].into_iter().any(|name| has(header, name))
            }
        }
    }
}

fn has(header: &Header, name: &str) -> bool {
    header.channels.list.iter().any(|channel| channel.name == *name)
}

/// Position of the data window in the display window.
#[derive(Clone, Copy)]
struct Place {
    size: [usize; 2],
    offset: [i64; 2],
}

impl Place {
    fn pixels(&self) -> usize {
        self.size[0] * self.size[1]
    }

    /// Stores a pixel of the data window if it is inside the display window.
    fn set(&self, pixels: &mut [[f32; 3]], Vec2(x, y): Vec2<usize>, value: [f32; 3]) {
        let at = |axis: usize, index: usize| {
            let at = usize::try_from(index as i64 + self.offset[axis]).ok()?;
            (at < self.size[axis]).then_some(at)
        };
        if let (Some(x), Some(y)) = (at(0, x), at(1, y)) {
            pixels[y * self.size[0] + x] = value;
        }
    }
}

/// First and last pixel of a window, both inclusive: (x, y, x, y).
pub(super) fn corners(window: IntegerBounds) -> [i64; 4] {
    let IntegerBounds { position: Vec2(x, y), size: Vec2(width, height) } = window;
    let (x, y) = (i64::from(x), i64::from(y));
    [x, y, x + width as i64 - 1, y + height as i64 - 1]
}
