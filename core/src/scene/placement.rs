//! World-from-object transforms from an editable placement.

use super::PlacementDoc;
use glam::{Affine3A, EulerRot, Mat3, Quat, Vec3};

/// Rotation about x, then y, then z, by angles in degrees.
pub(crate) fn rotation(rotate_deg: [f32; 3]) -> Quat {
    let [x, y, z] = rotate_deg.map(f32::to_radians);
    Quat::from_euler(EulerRot::ZYX, z, y, x)
}

/// Axis-aligned bounds of the transformed unit cube.
pub(crate) fn bounds(world_from_unit: &Affine3A) -> (Vec3, Vec3) {
    let mut lo = Vec3::INFINITY;
    let mut hi = Vec3::NEG_INFINITY;
    for corner in 0..8 {
        let bit = |i: u8| f32::from(corner >> i & 1u8);
        let p = world_from_unit.transform_point3(Vec3::new(bit(0), bit(1), bit(2)));
        (lo, hi) = (lo.min(p), hi.max(p));
    }
    (lo, hi)
}

/// World-from-unit-cube transform: fit, then scale, rotation and translation, or the matrix.
pub(super) fn world_from_unit(doc: &PlacementDoc, object_from_unit: Affine3A) -> Affine3A {
    let mut placed = object_from_unit;
    if let Some(longest) = doc.fit {
        let (lo, hi) = bounds(&placed);
        let scale = longest / (hi - lo).max_element();
        placed =
            Affine3A::from_scale(Vec3::splat(scale)) * Affine3A::from_translation(-0.5 * (lo + hi)) * placed;
    }
    let world_from_object = match doc.matrix {
        Some([x, y, z]) => Affine3A::from_mat3_translation(
            Mat3::from_cols_array_2d(&[[x[0], y[0], z[0]], [x[1], y[1], z[1]], [x[2], y[2], z[2]]]),
            Vec3::new(x[3], y[3], z[3]),
        ),
        None => Affine3A::from_scale_rotation_translation(
            doc.scale.into(),
            rotation(doc.rotate_deg),
            doc.translate.into(),
        ),
    };
    world_from_object * placed
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fit_scale_rotate_translate_in_this_order() {
        let doc = PlacementDoc {
            fit: Some(2.0),
            scale: [1.0, 2.0, 1.0],
            rotate_deg: [0.0, 0.0, 90.0],
            translate: [10.0, 0.0, 0.0],
            matrix: None,
        };
        // An object from (4,4,4) to (8,6,6): longest side 4.
        let object = Affine3A::from_scale_rotation_translation(
            Vec3::new(4.0, 2.0, 2.0),
            Quat::IDENTITY,
            Vec3::splat(4.0),
        );
        let m = world_from_unit(&doc, object);
        // Fitted corner (1, .5, .5) → scaled (1, 1, .5) → rotated (-1, 1, .5) → translated (9, 1, .5).
        assert!((m.transform_point3(Vec3::ONE) - Vec3::new(9.0, 1.0, 0.5)).length() < 1e-5);
    }

    #[test]
    fn a_matrix_is_given_by_rows() {
        let doc = PlacementDoc {
            matrix: Some([[0.0, -1.0, 0.0, 5.0], [1.0, 0.0, 0.0, 6.0], [0.0, 0.0, 1.0, 7.0]]),
            ..PlacementDoc::default()
        };
        let m = world_from_unit(&doc, Affine3A::IDENTITY);
        assert!((m.transform_point3(Vec3::X) - Vec3::new(5.0, 7.0, 7.0)).length() < 1e-6);
    }
}
