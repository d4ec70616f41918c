//! Validation of combinations of values in objects.

use super::Checker;
use crate::scene::{IorDoc, MaterialDoc, ObjectDoc, SceneDoc, ShapeDoc, Within};

pub(super) fn objects(c: &mut Checker, doc: &SceneDoc) {
    for (index, object) in doc.objects.iter().enumerate() {
        let named = format!("objects[{index}].name");
        let reserved = Within::RESERVED.contains(&object.name.as_str());
        let message = format!("`{}` is the name of a region: choose another name", object.name);
        c.check(!reserved, named.clone(), message);
        let taken = doc.object_named(&object.name).is_some_and(|(first, _)| first != index);
        c.check(!taken, named, format!("`{}` is the name of another object: give each its own", object.name));
        check_object(c, object, index);
    }
}

fn check_object(c: &mut Checker, object: &ObjectDoc, index: usize) {
    let path = |key: &str| format!("objects[{index}].{key}");
    match &object.shape {
        ShapeDoc::Rectangle { center, target, .. } => c.apart(&path("target"), *target, *center),
        ShapeDoc::Mesh { file, .. } => {
            let message = "names no mesh: choose an OBJ, PLY or glTF file";
            c.check(!file.is_empty(), path("file"), message);
        }
        ShapeDoc::Ground { .. } => {
            let message =
                "is given for an infinite plane, which would emit infinite power: choose a rectangle";
            c.check(object.emission.is_none(), path("emission"), message);
        }
        ShapeDoc::Box { .. } | ShapeDoc::Sphere { .. } | ShapeDoc::Disk { .. } => {}
    }
    check_material(c, object, &path("material"));
    let emits_nowhere = object.emission.is_some() && object.material == MaterialDoc::Interface {};
    let message = "is given for an interface, which has no surface that emits: choose `diffuse`, with albedo 0 for a lamp";
    c.check(!emits_nowhere, path("emission"), message);
}

fn check_material(c: &mut Checker, object: &ObjectDoc, path: &str) {
    match &object.material {
        MaterialDoc::Conductor { preset, eta, k, .. } => {
            let message = "is a conductor, which needs a `preset`, or `eta` and `k`, and not both";
            let complete = preset.is_some() != (eta.is_some() && k.is_some());
            let mixed = preset.is_some() && (eta.is_some() || k.is_some());
            c.check(complete && !mixed, path, message);
        }
        MaterialDoc::Dielectric { ior, .. } => {
            let kind = object.shape.kind_name().to_lowercase();
            let message = format!(
                "is a dielectric, which needs a closed shape, and a {kind} is not: choose `thin-dielectric`, or a box, a \
                 sphere or a closed mesh"
            );
            c.check(object.shape.has_inside(), path, message);
            check_ior(c, ior, path);
        }
        MaterialDoc::ThinDielectric { ior } => check_ior(c, ior, path),
        MaterialDoc::Diffuse { .. } | MaterialDoc::Mirror { .. } | MaterialDoc::Interface {} => {}
    }
}

/// Checks the values of Cauchy's equation; numbers and points are checked by their key.
fn check_ior(c: &mut Checker, ior: &IorDoc, path: &str) {
    if let IorDoc::Cauchy { .. } = ior {
        let values = ior.spectrum().values();
        let message = "gives an index outside 1 to 4 at some wavelength: choose other coefficients";
        c.check(values.iter().all(|n| (1.0..=4.0).contains(n)), format!("{path}.ior"), message);
    }
}
