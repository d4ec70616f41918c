//! Transform of a grid from index to world coordinates.
//!
//! Layouts after OpenVDB's `math/Maps.h`. All linear maps are converted to one affine transform.

use glam::{DAffine3, DMat3, DVec3};

use super::super::cursor::Cursor;
use super::super::error::Fault;

/// Reads a map of the named type; leaves the cursor behind it.
pub(super) fn read(name: &str, cursor: &mut Cursor) -> Result<DAffine3, Fault> {
    let at = cursor.position();
    let world_from_index = match name {
        "TranslationMap" => DAffine3::from_translation(vec3(cursor)?),
        "ScaleMap" | "UniformScaleMap" => DAffine3::from_scale(scale(cursor)?),
        "ScaleTranslateMap" | "UniformScaleTranslateMap" => {
            let translation = vec3(cursor)?;
            DAffine3::from_mat3_translation(DMat3::from_diagonal(scale(cursor)?), translation)
        }
        "AffineMap" | "UnitaryMap" => affine(cursor)?,
        _ => {
            return Err(Fault::unsupported(
                format!("the transform type \"{name}\" (not linear)"),
                "Resample the grid to one with a linear transform",
            )
            .at(at));
        }
    };
    let determinant = world_from_index.matrix3.determinant();
    if !world_from_index.is_finite() || !determinant.is_normal() {
        return Err(Fault::invalid(at, format!("its {name} is not invertible (determinant {determinant})"))
            .with_cure("Set a voxel size above zero and save the grid again"));
    }
    Ok(world_from_index)
}

fn vec3(cursor: &mut Cursor) -> Result<DVec3, Fault> {
    Ok(DVec3::new(cursor.f64()?, cursor.f64()?, cursor.f64()?))
}

/// Reads a scale and skips the four vectors derived from it.
fn scale(cursor: &mut Cursor) -> Result<DVec3, Fault> {
    let scale = vec3(cursor)?;
    for _voxel_size_inverse_square_and_half in 0..4 {
        vec3(cursor)?;
    }
    Ok(scale)
}

/// Reads a 4×4 matrix in row order, applied to row vectors: world = (index, 1) · M.
fn affine(cursor: &mut Cursor) -> Result<DAffine3, Fault> {
    let at = cursor.position();
    let mut rows = [DVec3::ZERO; 4];
    let mut last_column = [0.0; 4];
    for (row, last) in rows.iter_mut().zip(&mut last_column) {
        *row = vec3(cursor)?;
        *last = cursor.f64()?;
    }
    if last_column != [0.0, 0.0, 0.0, 1.0] {
        return Err(Fault::unsupported(
            "a projective transform",
            "Resample the grid to one with a linear transform",
        )
        .at(at));
    }
    let [x, y, z, translation] = rows;
    Ok(DAffine3 { matrix3: DMat3::from_cols(x, y, z), translation })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bytes(numbers: &[f64]) -> Vec<u8> {
        numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
    }

    #[test]
    fn affine_map_applies_to_row_vectors() {
        let rows = [0., 2., 0., 0., -1., 0., 0., 0., 0., 0., 3., 0., 7., 8., 9., 1.];
        let bytes = bytes(&rows);
        let mut cursor = Cursor::new(&bytes);
        let map = read("AffineMap", &mut cursor).unwrap();
        assert_eq!(cursor.remaining(), 0);
        // (1, 2, 3) -> 1·(0, 2, 0) + 2·(-1, 0, 0) + 3·(0, 0, 3) + (7, 8, 9)
        let point = map.transform_point3(DVec3::new(1.0, 2.0, 3.0));
        assert_eq!(point, DVec3::new(5.0, 10.0, 18.0));
    }

    #[test]
    fn useless_maps_are_refused() {
        let flat = bytes(&[[1.0, 0.0, 1.0].as_slice(), &[0.0; 12]].concat());
        assert!(read("ScaleMap", &mut Cursor::new(&flat)).is_err());
        let wild = bytes(&[f64::NAN; 3]);
        assert!(read("TranslationMap", &mut Cursor::new(&wild)).is_err());
        assert!(read("NonlinearFrustumMap", &mut Cursor::new(&wild)).is_err());
    }
}
