//! Freezes the objects of a document.

use super::Resources;
use crate::light::{DiskLight, LightKind, MeshLight, RectangleLight, SphereLight};
use crate::material::{Conductor, Dielectric, Diffuse, Ggx, Material, Mirror, SMOOTH, ThinDielectric};
use crate::scene::{
    Body, MaterialDoc, ObjectDoc, ObjectInfo, Problem, SceneDoc, SceneError, ShapeDoc, SurfaceEmissionDoc,
    placement,
};
use crate::spectrum::{Outside, Quantity, Spectrum, SpectrumDoc};
use crate::surface::{Disk, Mesh, MeshInstance, OrientedBox, Plane, Rectangle, Shape, Solid, Sphere};
use glam::{DAffine3, DVec3, Vec3};
use std::sync::Arc;

/// A shape of the document, placed in the world.
pub(super) struct BuiltObject {
    pub shape: Shape,
    pub info: ObjectInfo,
}

/// Freezes the shape of an object, given its index.
pub(super) fn build(
    doc: &ObjectDoc,
    index: usize,
    resources: &mut dyn Resources,
    notices: &mut Vec<String>,
) -> Result<BuiltObject, SceneError> {
    let mut info = ObjectInfo::default();
    let shape = match &doc.shape {
        ShapeDoc::Ground { point, normal } => {
            Shape::Plane(Plane { point: (*point).into(), normal: Vec3::from(*normal).normalize() })
        }
        ShapeDoc::Box { center, size, rotate_deg } => Shape::Box(OrientedBox {
            center: (*center).into(),
            half_size: Vec3::from(*size) * 0.5,
            world_from_box: placement::rotation(*rotate_deg),
        }),
        ShapeDoc::Sphere { center, radius } => {
            Shape::Sphere(Sphere { center: (*center).into(), radius: *radius })
        }
        ShapeDoc::Disk { center, normal, radius } => Shape::Disk(Disk {
            center: (*center).into(),
            normal: Vec3::from(*normal).normalize(),
            radius: *radius,
        }),
        ShapeDoc::Rectangle { center, target, up, size } => {
            Shape::Rectangle(Rectangle::facing((*center).into(), (*target).into(), (*up).into(), *size))
        }
        ShapeDoc::Mesh { file, placement } => {
            let path = format!("objects[{index}].file");
            let (mesh, repairs) =
                resources.mesh(file).map_err(|source| SceneError::Resource { path, source })?;
            notices.extend(repairs);
            (info.triangles, info.vertices) = (mesh.triangle_count(), mesh.vertex_count());
            info.memory_bytes = mesh.bytes();
            let (lo, hi) = mesh.bounds();
            let object = mesh.object_from_mesh();
            let bounds = [lo, hi].map(|corner| object.transform_point3(corner.as_dvec3()));
            let world_from_object = placement::world_from_object(placement, bounds.into());
            Shape::Mesh(placed(mesh, &world_from_object, index)?)
        }
    };
    Ok(BuiltObject { shape, info })
}

fn placed(mesh: Arc<Mesh>, world_from_object: &DAffine3, index: usize) -> Result<MeshInstance, SceneError> {
    MeshInstance::new(mesh, world_from_object).ok_or_else(|| {
        SceneError::Invalid(Problem {
            path: format!("objects[{index}].placement"),
            message: "the mesh would have no extent: give every scale a value other than 0".into(),
        })
    })
}

/// Material of the surface; `None` for an index-matched boundary.
pub(super) fn build_material(doc: &MaterialDoc) -> Option<Material> {
    let coefficient = super::coefficient;
    let ggx = |alpha: f32| (alpha >= SMOOTH).then_some(Ggx { alpha });
    Some(match doc {
        MaterialDoc::Diffuse { albedo } => Material::Diffuse(Diffuse { albedo: coefficient(albedo) }),
        MaterialDoc::Mirror { reflectance } => {
            Material::Mirror(Mirror { reflectance: coefficient(reflectance) })
        }
        MaterialDoc::Conductor { preset, eta, k, roughness } => {
            let named = |points: &str| {
                let points = SpectrumDoc::parse_points(points).unwrap_or_default();
                Spectrum::new(&SpectrumDoc::Points { points, outside: Outside::Hold }, Quantity::Coefficient)
            };
            let (n, absorption) = match (preset, eta, k) {
                (Some(metal), ..) => (named(metal.eta()), named(metal.k())),
                (None, Some(eta), Some(k)) => (coefficient(eta), coefficient(k)),
                _ => (Spectrum::constant(1.0), Spectrum::constant(0.0)),
            };
            Material::Conductor(Conductor { eta: n, k: absorption, ggx: ggx(*roughness) })
        }
        MaterialDoc::Dielectric { ior, roughness } => {
            Material::Dielectric(Dielectric { ior: coefficient(&ior.spectrum()), ggx: ggx(*roughness) })
        }
        MaterialDoc::ThinDielectric { ior } => {
            Material::ThinDielectric(ThinDielectric { ior: coefficient(&ior.spectrum()) })
        }
        MaterialDoc::Interface {} => return None,
    })
}

/// Transparent bodies by the index of their object.
pub(super) fn build_bodies(doc: &SceneDoc, shapes: &[Shape]) -> Result<Vec<(usize, Body)>, SceneError> {
    let mut bodies: Vec<(usize, Body)> = Vec::new();
    for (index, (object, shape)) in doc.objects.iter().zip(shapes).enumerate() {
        let MaterialDoc::Dielectric { ior, .. } = &object.material else { continue };
        if !object.enabled {
            continue;
        }
        let name = if object.name.is_empty() { "dielectric" } else { &object.name };
        let solid = Arc::new(build_solid(shape, name, &format!("objects[{index}].material"))?);
        let ior = super::coefficient(&ior.spectrum());
        let body = Body { solid, priority: object.priority, ior };
        let rival = bodies.iter().find(|(_, other)| {
            other.priority == body.priority
                && (reaches(&body.solid, &other.solid) || reaches(&other.solid, &body.solid))
        });
        if let Some((other, _)) = rival {
            return Err(SceneError::Invalid(Problem {
                path: format!("objects[{index}].priority"),
                message: format!(
                    "equals that of objects[{other}], another dielectric in the same place: give the one that is there \
                     a higher priority"
                ),
            }));
        }
        bodies.push((index, body));
    }
    Ok(bodies)
}

/// Returns whether a point on the surface of a shape lies inside another.
fn reaches(shape: &Solid, into: &Solid) -> bool {
    shape.surface_points().into_iter().any(|point| into.contains(point))
}

/// Bodies that take the place of a medium: all except the object that it fills, those around that object, and,
/// if the object is a body, those of lower priority.
pub(super) fn displacing(
    within: Option<usize>,
    solid: Option<&Solid>,
    bodies: &[(usize, Body)],
) -> Vec<Arc<Solid>> {
    let own = bodies.iter().find(|(index, _)| Some(*index) == within).map(|(_, body)| body.priority);
    let displaces = |(index, body): &&(usize, Body)| {
        let is_around =
            || solid.is_some_and(|solid| solid.surface_points().into_iter().all(|p| body.solid.contains(p)));
        let outranked = || own.is_some_and(|own| own > body.priority);
        Some(*index) != within && !outranked() && (own.is_some() || !is_around())
    };
    bodies.iter().filter(displaces).map(|(_, body)| Arc::clone(&body.solid)).collect()
}

/// The light that a shape emits as, and the shape that paths meet: a box becomes twelve triangles.
pub(super) fn build_light(
    doc: &SurfaceEmissionDoc,
    shape: Shape,
    index: usize,
) -> Result<(LightKind, Shape), SceneError> {
    let radiance = Spectrum::new(&doc.radiance, Quantity::Radiance).scaled(doc.scale);
    let shape = match shape {
        Shape::Box(solid) => Shape::Mesh(box_mesh(&solid, index)?),
        other => other,
    };
    let kind = match &shape {
        Shape::Rectangle(shape) => LightKind::Rectangle(RectangleLight { shape: *shape, radiance }),
        Shape::Disk(shape) => LightKind::Disk(DiskLight { shape: *shape, radiance }),
        Shape::Sphere(shape) => LightKind::Sphere(SphereLight { shape: *shape, radiance }),
        Shape::Mesh(shape) => LightKind::Mesh(MeshLight::new(shape.clone(), radiance)),
        Shape::Plane(_) | Shape::Box(_) => {
            let message = "is given for a shape that cannot emit: choose a rectangle";
            let path = format!("objects[{index}].emission");
            return Err(SceneError::Invalid(Problem { path, message: message.into() }));
        }
    };
    Ok((kind, shape))
}

fn box_mesh(solid: &OrientedBox, index: usize) -> Result<MeshInstance, SceneError> {
    let world_from_unit = DAffine3::from_scale_rotation_translation(
        2.0 * solid.half_size.as_dvec3(),
        solid.world_from_box.as_dquat(),
        solid.center.as_dvec3(),
    ) * DAffine3::from_translation(DVec3::splat(-0.5));
    let failed = |e: crate::surface::MeshError| {
        SceneError::Invalid(Problem { path: format!("objects[{index}]"), message: e.to_string() })
    };
    placed(Arc::new(Mesh::cube().map_err(failed)?), &world_from_unit, index)
}

/// The shape as a region that a medium can fill, given the path of the medium's `within` in messages.
pub(super) fn build_solid(shape: &Shape, name: &str, path: &str) -> Result<Solid, SceneError> {
    let invalid = |message: String| Err(SceneError::Invalid(Problem { path: path.into(), message }));
    match shape {
        Shape::Sphere(sphere) => Ok(Solid::Sphere(*sphere)),
        Shape::Box(solid) => Ok(Solid::Box(*solid)),
        Shape::Mesh(mesh) => match mesh.mesh().open_edge() {
            None => Ok(Solid::Mesh(mesh.clone())),
            Some(edge) => invalid(format!(
                "is `{name}`, a mesh that is not closed at {edge}: close its holes and turn its faces outwards"
            )),
        },
        Shape::Plane(_) | Shape::Disk(_) | Shape::Rectangle(_) => {
            invalid(format!("is `{name}`, which has no inside: choose a box, a sphere or a closed mesh"))
        }
    }
}
