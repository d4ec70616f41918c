//! Validation of combinations of values in objects.

use super::Checker;
use crate::scene::{MaterialDoc, ObjectDoc, SceneDoc, ShapeDoc, Within};

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
    let emits_nowhere = object.emission.is_some() && object.material == MaterialDoc::Interface {};
    let message = "is given for an interface, which has no surface that emits: choose `diffuse`, with albedo 0 for a lamp";
    c.check(!emits_nowhere, path("emission"), message);
}
