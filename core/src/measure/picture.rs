//! Images and references for error measures.

use super::MeasureError;

/// A linear sRGB image, row by row from the top.
#[derive(Clone, Copy, Debug)]
pub struct Picture<'a> {
    /// Width in pixels.
    pub width: usize,
    /// Height in pixels.
    pub height: usize,
    /// `width · height` pixels.
    pub pixels: &'a [[f32; 3]],
}

/// Reference that an image is compared with.
#[derive(Clone, Copy, Debug)]
pub struct ReferencePicture<'a> {
    /// Mean.
    pub picture: Picture<'a>,
    /// Standard error of each mean; `None` if the reference is assumed to be exact.
    pub standard_error: Option<&'a [[f32; 3]]>,
}

impl Picture<'_> {
    /// Checks that the buffer matches the size.
    pub(super) fn check(&self, what: &'static str) -> Result<(), MeasureError> {
        holds(self.width, self.height, self.pixels.len(), what)
    }

    /// Checks that both images have the same size, and matching buffers.
    pub(super) fn check_against(&self, reference: &Picture) -> Result<(), MeasureError> {
        self.check("the image")?;
        reference.check("the reference")?;
        let (picture, reference) = ([self.width, self.height], [reference.width, reference.height]);
        if picture == reference { Ok(()) } else { Err(MeasureError::Sizes { picture, reference }) }
    }
}

impl ReferencePicture<'_> {
    /// Checks that the standard error has the same number of pixels.
    pub(super) fn check(&self) -> Result<(), MeasureError> {
        let Picture { width, height, .. } = self.picture;
        self.standard_error
            .map_or(Ok(()), |e| holds(width, height, e.len(), "the reference's standard error"))
    }

    /// Returns whether a pixel's mean and standard error are finite.
    pub(super) fn is_finite(&self, index: usize) -> bool {
        is_finite(self.picture.pixels[index]) && self.standard_error.is_none_or(|e| is_finite(e[index]))
    }
}

/// Returns whether all channels are finite.
pub(super) fn is_finite(rgb: [f32; 3]) -> bool {
    rgb.iter().all(|x| x.is_finite())
}

fn holds(width: usize, height: usize, held: usize, what: &'static str) -> Result<(), MeasureError> {
    if width.checked_mul(height) == Some(held) {
        Ok(())
    } else {
        Err(MeasureError::Buffer { what, width, height, held })
    }
}
