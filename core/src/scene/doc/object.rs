//! Editable objects: shapes with a material.

use super::{MaterialDoc, PlacementDoc};
use crate::spectrum::SpectrumDoc;
use serde::{Deserialize, Serialize};

fn is_zero(priority: &i32) -> bool {
    *priority == 0
}
fn unit() -> f32 {
    1.0
}
fn present() -> bool {
    true
}
fn world_up() -> [f32; 3] {
    [0.0, 1.0, 0.0]
}

/// A shape with a material. It may emit light, and bound media.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(from = "WrittenObject")]
pub struct ObjectDoc {
    /// Name by which media refer to the object; empty if none does.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// Whether its surface is part of the scene. Media within the object keep their region.
    pub enabled: bool,
    /// Shape.
    #[serde(flatten)]
    pub shape: ShapeDoc,
    /// How the surface scatters light.
    pub material: MaterialDoc,
    /// Rank among dielectrics: where two overlap, only that of higher priority is there.
    #[serde(skip_serializing_if = "is_zero")]
    pub priority: i32,
    /// Light emitted on the outer side. Absent: none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub emission: Option<SurfaceEmissionDoc>,
}

/// An object as written in a file: with the albedo of version 1 in place of the material.
#[derive(Deserialize)]
struct WrittenObject {
    #[serde(default)]
    name: String,
    #[serde(default = "present")]
    enabled: bool,
    #[serde(flatten)]
    shape: ShapeDoc,
    material: Option<MaterialDoc>,
    #[serde(default)]
    priority: i32,
    albedo: Option<SpectrumDoc>,
    emission: Option<SurfaceEmissionDoc>,
}

impl From<WrittenObject> for ObjectDoc {
    fn from(written: WrittenObject) -> Self {
        let WrittenObject { name, enabled, shape, material, priority, albedo, emission } = written;
        let diffuse = albedo.map(|albedo| MaterialDoc::Diffuse { albedo });
        let material = diffuse.or(material).unwrap_or_default();
        Self { name, enabled, shape, material, priority, emission }
    }
}

/// Shape of an object.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum ShapeDoc {
    /// An infinite plane.
    Ground {
        /// A point on the plane.
        #[serde(default)]
        point: [f32; 3],
        /// Normal of the upper side; the other side reflects as well.
        #[serde(default = "world_up")]
        normal: [f32; 3],
    },
    /// A box.
    Box {
        /// Centre.
        center: [f32; 3],
        /// Edge lengths.
        size: [f32; 3],
        /// Rotation about x, then y, then z, degrees.
        #[serde(default)]
        rotate_deg: [f32; 3],
    },
    /// A sphere.
    Sphere {
        /// Centre.
        center: [f32; 3],
        /// Radius.
        radius: f32,
    },
    /// A disk.
    Disk {
        /// Centre.
        center: [f32; 3],
        /// Normal, on the side that emits.
        #[serde(default = "world_up")]
        normal: [f32; 3],
        /// Radius.
        radius: f32,
    },
    /// A rectangle.
    Rectangle {
        /// Centre.
        center: [f32; 3],
        /// Point that the emitting side faces.
        target: [f32; 3],
        /// Direction of the height, projected onto the rectangle.
        #[serde(default = "world_up")]
        up: [f32; 3],
        /// Width and height.
        size: [f32; 2],
    },
    /// A triangle mesh from a file.
    Mesh {
        /// File, relative to the scene: OBJ, PLY or glTF.
        file: String,
        /// Placement; by default the mesh stands at the coordinates of its file.
        #[serde(default)]
        placement: PlacementDoc,
    },
}

/// Light that a surface emits on its outer side.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SurfaceEmissionDoc {
    /// Emitted radiance.
    pub radiance: SpectrumDoc,
    /// Multiplies the radiance.
    #[serde(default = "unit")]
    pub scale: f32,
    /// Visibility to camera rays.
    #[serde(default = "present")]
    pub visible: bool,
}

impl Default for SurfaceEmissionDoc {
    fn default() -> Self {
        Self { radiance: SpectrumDoc::Constant(1.0), scale: 1.0, visible: true }
    }
}

impl ShapeDoc {
    /// Display name of the kind.
    #[must_use]
    pub fn kind_name(&self) -> &'static str {
        match self {
            Self::Ground { .. } => "Ground plane",
            Self::Box { .. } => "Box",
            Self::Sphere { .. } => "Sphere",
            Self::Disk { .. } => "Disk",
            Self::Rectangle { .. } => "Rectangle",
            Self::Mesh { .. } => "Mesh",
        }
    }

    /// Returns whether the shape has an inside that a medium can fill. A mesh has one if it is closed.
    #[must_use]
    pub fn has_inside(&self) -> bool {
        matches!(self, Self::Box { .. } | Self::Sphere { .. } | Self::Mesh { .. })
    }
}

impl ObjectDoc {
    /// Creates a diffuse object without a name.
    #[must_use]
    pub fn new(shape: ShapeDoc) -> Self {
        let material = MaterialDoc::default();
        Self { name: String::new(), enabled: true, shape, material, priority: 0, emission: None }
    }

    /// One object of each kind with its display name.
    #[must_use]
    pub fn templates() -> Vec<(&'static str, Self)> {
        let up = world_up();
        let shapes = [
            ShapeDoc::Ground { point: [0.0, -0.5, 0.0], normal: up },
            ShapeDoc::Box { center: [0.8, -0.2, 0.0], size: [0.3, 0.6, 0.3], rotate_deg: [0.0, 20.0, 0.0] },
            ShapeDoc::Sphere { center: [0.8, -0.2, 0.0], radius: 0.3 },
            ShapeDoc::Disk { center: [0.0, -0.6, 0.0], normal: up, radius: 0.5 },
            ShapeDoc::Rectangle { center: [0.0, 0.0, -1.0], target: [0.0; 3], up, size: [2.0, 2.0] },
            ShapeDoc::Mesh { file: String::new(), placement: PlacementDoc::default() },
        ];
        shapes.into_iter().map(|shape| (shape.kind_name(), Self::new(shape))).collect()
    }

    /// Returns whether the object has a surface that light meets.
    #[must_use]
    pub fn has_surface(&self) -> bool {
        self.enabled && (self.emission.is_some() || self.material != MaterialDoc::Interface {})
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Files of version 1 give an albedo, later ones a material; an unknown key is refused.
    #[test]
    fn an_albedo_is_read_as_a_diffuse_material() {
        let read = |text: &str| toml::from_str::<ObjectDoc>(text);
        let plain = read("kind = \"sphere\"\ncenter = [0.0, 1.0, 0.0]\nradius = 2.0").unwrap();
        assert_eq!(plain, ObjectDoc::new(ShapeDoc::Sphere { center: [0.0, 1.0, 0.0], radius: 2.0 }));
        let old = read("kind = \"ground\"\nalbedo = 0.25").unwrap();
        let new = read("kind = \"ground\"\nmaterial = { kind = \"diffuse\", albedo = 0.25 }").unwrap();
        assert_eq!(old, new);
        assert_eq!(old.material, MaterialDoc::Diffuse { albedo: SpectrumDoc::Constant(0.25) });
        for bad in [
            "kind = \"ground\"\nradius = 1.0",
            "kind = \"ground\"\nemission = { scale = 1 }",
            "kind = \"cone\"",
        ] {
            assert!(read(bad).is_err(), "{bad}");
        }
        let objects = ObjectDoc::templates().into_iter().map(|(_, object)| object);
        let plain = || ObjectDoc::new(ShapeDoc::Sphere { center: [0.0; 3], radius: 1.0 });
        let materials = MaterialDoc::templates().into_iter();
        let with_material = materials.map(|(_, material)| ObjectDoc { material, priority: -3, ..plain() });
        for object in objects.chain(with_material) {
            let text = toml::to_string(&object).unwrap();
            assert_eq!(read(&text).unwrap(), object, "{text}");
        }
    }
}
