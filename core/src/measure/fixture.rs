//! Two images with measures computed by NumPy and by the authors of FLIP (`tests/measures`).

// The layer test skips code after this line; test code may import from any module.
#[cfg(test)]
use crate::io::volume::{ReadLimits, read_npy_bytes};

use super::{Picture, ReferencePicture, Region};

/// Values of a stored array.
pub(super) fn values(bytes: &[u8]) -> Vec<f32> {
    read_npy_bytes(bytes, "fixture", &ReadLimits::default()).unwrap().values
}

fn colours(bytes: &[u8]) -> Vec<[f32; 3]> {
    values(bytes).chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect()
}

pub(super) struct Fixture {
    pub picture: Vec<[f32; 3]>,
    pub reference: Vec<[f32; 3]>,
    pub stderr: Vec<[f32; 3]>,
    /// Independently computed values: `measures.json`.
    pub truth: serde_json::Value,
}

impl Fixture {
    pub(super) const WIDTH: usize = 48;
    pub(super) const HEIGHT: usize = 36;
    pub(super) const WHOLE: Region = Region { x0: 0, y0: 0, x1: Self::WIDTH, y1: Self::HEIGHT };

    pub(super) fn load() -> Self {
        Self {
            picture: colours(include_bytes!("../../../tests/measures/picture.npy")),
            reference: colours(include_bytes!("../../../tests/measures/reference.npy")),
            stderr: colours(include_bytes!("../../../tests/measures/stderr.npy")),
            truth: serde_json::from_str(include_str!("../../../tests/measures/measures.json")).unwrap(),
        }
    }

    pub(super) fn region(&self) -> Region {
        serde_json::from_value(self.truth["region_of"].clone()).unwrap()
    }

    pub(super) fn picture(&self) -> Picture<'_> {
        of_size(&self.picture)
    }

    pub(super) fn reference(&self) -> ReferencePicture<'_> {
        ReferencePicture { picture: of_size(&self.reference), standard_error: Some(&self.stderr) }
    }

    pub(super) fn expected(&self, of: &str, what: &str) -> f64 {
        self.truth[of][what].as_f64().unwrap()
    }
}

/// An image of the fixture's size.
pub(super) fn of_size(pixels: &[[f32; 3]]) -> Picture<'_> {
    Picture { width: Fixture::WIDTH, height: Fixture::HEIGHT, pixels }
}
