//! Rectangles of pixels.

use serde::{Deserialize, Serialize};

/// A half-open rectangle of pixels: columns `x0..x1` of rows `y0..y1`, from the top left.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Region {
    /// First column.
    pub x0: usize,
    /// First row.
    pub y0: usize,
    /// Column after the last.
    pub x1: usize,
    /// Row after the last.
    pub y1: usize,
}

impl Region {
    /// The region of a whole image.
    #[must_use]
    pub fn whole(width: usize, height: usize) -> Self {
        Self { x0: 0, y0: 0, x1: width, y1: height }
    }

    /// The part of the region inside an image of this size.
    #[must_use]
    pub fn clipped(self, width: usize, height: usize) -> Self {
        let (x1, y1) = (self.x1.min(width), self.y1.min(height));
        Self { x0: self.x0.min(x1), y0: self.y0.min(y1), x1, y1 }
    }

    /// Returns whether the region contains a pixel.
    #[must_use]
    pub fn contains(self, x: usize, y: usize) -> bool {
        (self.x0..self.x1).contains(&x) && (self.y0..self.y1).contains(&y)
    }

    /// Returns whether the region contains no pixel.
    #[must_use]
    pub fn is_empty(self) -> bool {
        self.x0 >= self.x1 || self.y0 >= self.y1
    }

    /// Number of columns.
    #[must_use]
    pub fn width(self) -> usize {
        self.x1.saturating_sub(self.x0)
    }

    /// Number of rows.
    #[must_use]
    pub fn height(self) -> usize {
        self.y1.saturating_sub(self.y0)
    }

    /// Indices of the pixels, row by row, in an image of this size; pixels outside the image are omitted.
    pub fn indices(self, width: usize, height: usize) -> impl Iterator<Item = usize> {
        let inside = self.clipped(width, height);
        (inside.y0..inside.y1).flat_map(move |y| (inside.x0..inside.x1).map(move |x| y * width + x))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indices_cover_the_part_inside_the_image() {
        let region = Region { x0: 2, y0: 1, x1: 9, y1: 3 };
        assert_eq!(region.clipped(4, 9), Region { x0: 2, y0: 1, x1: 4, y1: 3 });
        assert_eq!(region.indices(4, 9).collect::<Vec<_>>(), [6, 7, 10, 11]);
        assert_eq!((region.width(), region.height()), (7, 2));
        assert_eq!(Region::whole(4, 3).indices(4, 3).collect::<Vec<_>>(), (0..12).collect::<Vec<_>>());
        assert!(region.contains(2, 1) && region.contains(8, 2));
        assert!(!region.contains(9, 2) && !region.contains(2, 3) && !region.contains(1, 1));
    }

    #[test]
    fn regions_outside_or_inverted_are_empty() {
        for region in [
            Region { x0: 5, y0: 0, x1: 9, y1: 3 },
            Region { x0: 0, y0: 7, x1: 2, y1: usize::MAX },
            Region { x0: 3, y0: 0, x1: 1, y1: 2 },
        ] {
            let clipped = region.clipped(4, 3);
            assert!(clipped.is_empty(), "{clipped:?}");
            assert_eq!(clipped.width() * clipped.height(), 0);
            assert_eq!(region.indices(4, 3).count(), 0);
        }
        assert!(!Region::whole(1, 1).is_empty());
    }
}
