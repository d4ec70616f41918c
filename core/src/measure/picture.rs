//! What is measured, and against what.

use super::MeasureError;

/// A linear sRGB picture, row by row from the top.
#[derive(Clone, Copy, Debug)]
pub struct Picture<'a> {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// `width · height` pixels.
    pub pixels: &'a [[f32; 3]],
}

/// What a picture is compared with.
#[derive(Clone, Copy, Debug)]
pub struct ReferencePicture<'a> {
    /// Its mean.
    pub picture: Picture<'a>,
    /// Standard error of each mean; `None`: the reference is taken as exact.
    pub standard_error: Option<&'a [[f32; 3]]>,
}

impl Picture<'_> {
    /// That the buffer holds what the size says.
    pub(super) fn check(&self, what: &'static str) -> Result<(), MeasureError> {
        holds(self.width, self.height, self.pixels.len(), what)
    }

    /// That both have the same size, and buffers of that size.
    pub(super) fn check_against(&self, reference: &Picture) -> Result<(), MeasureError> {
        self.check("the picture")?;
        reference.check("the reference")?;
        let (picture, reference) = ([self.width, self.height], [reference.width, reference.height]);
        if picture == reference { Ok(()) } else { Err(MeasureError::Sizes { picture, reference }) }
    }
}

impl ReferencePicture<'_> {
    /// That its noise is that of as many pixels.
    pub(super) fn check(&self) -> Result<(), MeasureError> {
        let Picture { width, height, .. } = self.picture;
        self.standard_error
            .map_or(Ok(()), |e| holds(width, height, e.len(), "the reference's standard error"))
    }

    /// Whether a pixel's mean and noise are finite.
    pub(super) fn is_finite(&self, index: usize) -> bool {
        is_finite(self.picture.pixels[index]) && self.standard_error.is_none_or(|e| is_finite(e[index]))
    }
}

/// Whether all channels are finite.
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
