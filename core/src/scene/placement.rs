//! World-from-object transforms from an editable placement.

use super::PlacementDoc;
use glam::{Affine3A, DAffine3, DMat3, DQuat, DVec3, EulerRot, Quat};

/// Rotation about x, then y, then z, by angles in degrees.
pub(crate) fn rotation(rotate_deg: [f32; 3]) -> Quat {
    let [x, y, z] = rotate_deg.map(f32::to_radians);
    Quat::from_euler(EulerRot::ZYX, z, y, x)
}

/// Axis-aligned bounds of the transformed unit cube.
pub(crate) fn bounds(world_from_unit: &DAffine3) -> (DVec3, DVec3) {
    let mut lo = DVec3::INFINITY;
    let mut hi = DVec3::NEG_INFINITY;
    for corner in 0..8 {
        let bit = |i: u8| f64::from(corner >> i & 1u8);
        let p = world_from_unit.transform_point3(DVec3::new(bit(0), bit(1), bit(2)));
        (lo, hi) = (lo.min(p), hi.max(p));
    }
    (lo, hi)
}

/// World-from-unit-cube transform: fit, then scale, rotation and translation, or the matrix. In double
/// precision: a grid far from the origin of its file, in units of its voxels, would lose its shape otherwise.
pub(super) fn world_from_unit(doc: &PlacementDoc, object_from_unit: DAffine3) -> DAffine3 {
    let fitted = match fitting(doc, bounds(&object_from_unit)) {
        Some(fitting) => fitting * object_from_unit,
        None => object_from_unit,
    };
    world_from_fitted(doc) * fitted
}

/// World-from-object transform of an object with these bounds: fit, then the rest of the placement.
pub(super) fn world_from_object(doc: &PlacementDoc, bounds: (DVec3, DVec3)) -> DAffine3 {
    let world = world_from_fitted(doc);
    fitting(doc, bounds).map_or(world, |fitting| world * fitting)
}

/// Centres bounds on the origin and scales their longest side to the length of the document, if it gives one.
fn fitting(doc: &PlacementDoc, (lo, hi): (DVec3, DVec3)) -> Option<DAffine3> {
    let scale = f64::from(doc.fit?) / (hi - lo).max_element();
    Some(DAffine3::from_scale(DVec3::splat(scale)) * DAffine3::from_translation(-0.5 * (lo + hi)))
}

/// Scale, rotation and translation, or the matrix.
fn world_from_fitted(doc: &PlacementDoc) -> DAffine3 {
    match doc.matrix {
        Some(rows) => {
            let [x, y, z] = rows.map(|row| row.map(f64::from));
            DAffine3::from_mat3_translation(
                DMat3::from_cols_array_2d(&[[x[0], y[0], z[0]], [x[1], y[1], z[1]], [x[2], y[2], z[2]]]),
                DVec3::new(x[3], y[3], z[3]),
            )
        }
        None => {
            let [x, y, z] = doc.rotate_deg.map(|degrees| f64::from(degrees).to_radians());
            DAffine3::from_scale_rotation_translation(
                DVec3::from(doc.scale.map(f64::from)),
                DQuat::from_euler(EulerRot::ZYX, z, y, x),
                DVec3::from(doc.translate.map(f64::from)),
            )
        }
    }
}

/// The transform in single precision.
pub(crate) fn single(transform: &DAffine3) -> Affine3A {
    Affine3A::from_mat3_translation(transform.matrix3.as_mat3(), transform.translation.as_vec3())
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
        let object = DAffine3::from_scale_rotation_translation(
            DVec3::new(4.0, 2.0, 2.0),
            DQuat::IDENTITY,
            DVec3::splat(4.0),
        );
        let m = world_from_unit(&doc, object);
        // Fitted corner (1, .5, .5) → scaled (1, 1, .5) → rotated (-1, 1, .5) → translated (9, 1, .5).
        assert!((m.transform_point3(DVec3::ONE) - DVec3::new(9.0, 1.0, 0.5)).length() < 1e-5);
    }

    #[test]
    fn a_matrix_is_given_by_rows() {
        let doc = PlacementDoc {
            matrix: Some([[0.0, -1.0, 0.0, 5.0], [1.0, 0.0, 0.0, 6.0], [0.0, 0.0, 1.0, 7.0]]),
            ..PlacementDoc::default()
        };
        let m = world_from_unit(&doc, DAffine3::IDENTITY);
        assert!((m.transform_point3(DVec3::X) - DVec3::new(5.0, 7.0, 7.0)).length() < 1e-6);
    }

    /// A grid keeps its shape wherever its file places it: at the radius of the earth, with voxels of 1 µm, and
    /// with indices beyond two million.
    #[test]
    fn a_fitted_box_is_the_same_at_any_distance_from_the_origin() {
        let fitted = PlacementDoc { fit: Some(1.0), ..PlacementDoc::default() };
        let size = DVec3::new(3.0, 4.0, 5.0);
        let at_origin = single(&world_from_unit(&fitted, DAffine3::from_scale(size)));
        for (unit, distance) in [(1.0, 6.371e6), (1e-6, 10.0), (1e-3, 2.5e6)] {
            let object =
                DAffine3::from_translation(DVec3::splat(distance)) * DAffine3::from_scale(size * unit);
            let placed = single(&world_from_unit(&fitted, object));
            assert!(placed.abs_diff_eq(at_origin, 1e-6), "{unit} at {distance}: {placed:?}");
        }
    }
}
