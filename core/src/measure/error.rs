//! Errors of measuring an image.

/// Error of measuring an image.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MeasureError {
    /// Image and reference differ in size.
    #[error(
        "the image has {} × {} pixels, but the reference {} × {}: render both at the same size",
        picture[0], picture[1], reference[0], reference[1]
    )]
    Sizes {
        /// Columns and rows of the image.
        picture: [usize; 2],
        /// Columns and rows of the reference.
        reference: [usize; 2],
    },
    /// A buffer does not match the size of its image.
    #[error("{what} should have {width} × {height} pixels, but has {held} values")]
    Buffer {
        /// Name of the buffer.
        what: &'static str,
        /// Expected columns.
        width: usize,
        /// Expected rows.
        height: usize,
        /// Actual number of pixels.
        held: usize,
    },
}
