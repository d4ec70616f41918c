//! Conversion of linear RGB with arbitrary primaries and white point to linear sRGB, whose primaries are
//! those of Rec. 709.

use glam::{DMat3, DVec3, Vec3};

/// Chromaticities (x, y) of the three primaries and of the white point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Primaries {
    pub(super) red: [f32; 2],
    pub(super) green: [f32; 2],
    pub(super) blue: [f32; 2],
    pub(super) white: [f32; 2],
}

/// Primaries of Rec. 709 and sRGB with the white point D65.
pub(super) const REC709: Primaries =
    Primaries { red: [0.64, 0.33], green: [0.3, 0.6], blue: [0.15, 0.06], white: [0.3127, 0.329] };

/// Tolerance, since files round chromaticities to three or four digits.
const ROUNDING: f32 = 1e-3;

/// Cone responses from XYZ after Bradford (K. M. Lam, 1985), by columns.
const BRADFORD: DMat3 = DMat3::from_cols_array(&[
    0.8951, -0.7502, 0.0389, //
    0.2664, 1.7135, -0.0685, //
    -0.1614, 0.0367, 1.0296,
]);

/// Error for primaries that span no colour space.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Degenerate;

impl Primaries {
    /// Matrix from linear RGB with these primaries to linear sRGB; `None` for the identity.
    ///
    /// The white point is preserved: it is adapted by Bradford's transformation, as in ICC and ACES colour
    /// management.
    pub(super) fn to_srgb(self) -> Result<Option<DMat3>, Degenerate> {
        let flat = |p: Self| [p.red, p.green, p.blue, p.white];
        let pairs = flat(self).into_iter().zip(flat(REC709));
        if pairs.into_iter().all(|(a, b)| (a[0] - b[0]).abs() <= ROUNDING && (a[1] - b[1]).abs() <= ROUNDING)
        {
            return Ok(None);
        }
        let cones = |p: Self| p.white_xyz().map(|white| BRADFORD * white);
        let (from, to) = (cones(self).ok_or(Degenerate)?, cones(REC709).ok_or(Degenerate)?);
        if from.min_element() <= 0.0 {
            return Err(Degenerate);
        }
        let adapted = BRADFORD.inverse() * DMat3::from_diagonal(to / from) * BRADFORD;
        let xyz = self.xyz_from_rgb().ok_or(Degenerate)?;
        let srgb = REC709.xyz_from_rgb().ok_or(Degenerate)?.inverse();
        let matrix = srgb * adapted * xyz;
        if matrix.is_finite() { Ok(Some(matrix)) } else { Err(Degenerate) }
    }

    /// XYZ of the white point with Y = 1.
    fn white_xyz(self) -> Option<DVec3> {
        let white = coordinates(self.white);
        (white.is_finite() && white.y > 0.0).then(|| white / white.y)
    }

    /// XYZ from RGB: columns along the primaries, scaled so that (1, 1, 1) is the white point. There is no
    /// division by y of a primary, which is 0 for a primary on the axis (X, Z).
    fn xyz_from_rgb(self) -> Option<DMat3> {
        let directions =
            DMat3::from_cols(coordinates(self.red), coordinates(self.green), coordinates(self.blue));
        if !directions.is_finite() || directions.determinant().abs() < 1e-6 {
            return None;
        }
        let lengths = directions.inverse() * self.white_xyz()?;
        Some(directions * DMat3::from_diagonal(lengths))
    }
}

/// Chromaticity (x, y, z) with z = 1 − x − y.
fn coordinates([x, y]: [f32; 2]) -> DVec3 {
    let (x, y) = (f64::from(x), f64::from(y));
    DVec3::new(x, y, 1.0 - x - y)
}

/// Applies a matrix to a colour in double precision.
pub(super) fn convert(matrix: &DMat3, rgb: [f32; 3]) -> [f32; 3] {
    (*matrix * Vec3::from(rgb).as_dvec3()).as_vec3().to_array()
}

/// Upper bounds of the standard errors of converted channels for any correlation: Σ |mᵢⱼ| sⱼ.
pub(super) fn convert_errors(matrix: &DMat3, errors: [f32; 3]) -> [f32; 3] {
    let absolute = DMat3::from_cols(matrix.x_axis.abs(), matrix.y_axis.abs(), matrix.z_axis.abs());
    convert(&absolute, errors)
}

#[cfg(test)]
mod tests {
    use super::*;

    const AP0: Primaries = Primaries {
        red: [0.7347, 0.2653],
        green: [0.0, 1.0],
        blue: [0.0001, -0.077],
        white: [0.32168, 0.33767],
    };
    const XYZ: Primaries =
        Primaries { red: [1.0, 0.0], green: [0.0, 1.0], blue: [0.0, 0.0], white: [1.0 / 3.0, 1.0 / 3.0] };

    fn close(matrix: DMat3, rows: [[f64; 3]; 3], tolerance: f64) {
        for (i, row) in rows.iter().enumerate() {
            for (j, expected) in row.iter().enumerate() {
                let found = matrix.col(j)[i];
                assert!((found - expected).abs() < tolerance, "{i} {j}: {found} instead of {expected}");
            }
        }
    }

    /// Published matrix from ACES2065-1 to linear Rec. 709 with Bradford's adaptation.
    #[test]
    fn ap0_becomes_srgb_by_the_published_matrix() {
        let rows = [
            [2.52168618674388, -1.13413098823972, -0.387555198504164],
            [-0.276479914229922, 1.37271908766826, -0.096239173438334],
            [-0.0153780649660342, -0.152975335867399, 1.16835340083343],
        ];
        close(AP0.to_srgb().unwrap().unwrap(), rows, 2e-4);
    }

    #[test]
    fn white_stays_white_and_the_same_primaries_are_left_alone() {
        let p3 =
            Primaries { red: [0.68, 0.32], green: [0.265, 0.69], blue: [0.15, 0.06], white: [0.314, 0.351] };
        for primaries in [AP0, XYZ, p3] {
            let white = convert(&primaries.to_srgb().unwrap().unwrap(), [2.0; 3]);
            assert!(white.iter().all(|w| (w - 2.0).abs() < 1e-5), "{primaries:?}: {white:?}");
        }
        assert_eq!(REC709.to_srgb(), Ok(None));
        assert_eq!(Primaries { white: [0.313, 0.329], ..REC709 }.to_srgb(), Ok(None));
    }

    #[test]
    fn degenerate_primaries_are_refused() {
        for broken in [
            Primaries { red: [0.0; 2], green: [0.0; 2], blue: [0.0; 2], white: [0.0; 2] },
            Primaries { green: REC709.red, ..REC709 },
            Primaries { white: [0.3, 0.0], ..REC709 },
            Primaries { white: [f32::NAN, 0.3], ..REC709 },
            Primaries { red: [f32::INFINITY, 0.3], ..REC709 },
        ] {
            assert_eq!(broken.to_srgb(), Err(Degenerate), "{broken:?}");
        }
    }

    #[test]
    fn errors_are_bounded_for_any_correlation() {
        let matrix = AP0.to_srgb().unwrap().unwrap();
        let errors = [0.1f32, 0.2, 0.3];
        let bounds = convert_errors(&matrix, errors);
        for signs in 0..8_u8 {
            let signed = std::array::from_fn(|c| if signs >> c & 1 == 1 { errors[c] } else { -errors[c] });
            for (found, bound) in convert(&matrix, signed).into_iter().zip(bounds) {
                assert!(found.abs() <= bound * (1.0 + 1e-6));
            }
        }
    }
}
