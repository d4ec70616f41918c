//! Why a picture could not be measured.

/// Why a picture could not be measured.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MeasureError {
    /// Picture and reference have different sizes.
    #[error(
        "the picture has {} × {} pixels, but the reference {} × {}: render both at one size",
        picture[0], picture[1], reference[0], reference[1]
    )]
    Sizes {
        /// Columns and rows of the picture.
        picture: [usize; 2],
        /// Columns and rows of the reference.
        reference: [usize; 2],
    },
    /// A buffer does not hold as many pixels as its picture says.
    #[error("{what} is said to have {width} × {height} pixels, but {held} values are there")]
    Buffer {
        /// Which buffer.
        what: &'static str,
        /// Columns it should have.
        width: usize,
        /// Rows it should have.
        height: usize,
        /// Pixels it holds.
        held: usize,
    },
}
