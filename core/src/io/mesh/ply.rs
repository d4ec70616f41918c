//! Stanford PLY, ASCII and binary.

use super::Content;
use glam::{DVec3, Vec3};
use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{BeginList, Property, PropertyAccess, PropertyAccessResult, PropertyType};
use std::io::Cursor;

/// A vertex; all other properties are skipped.
struct Vertex {
    position: DVec3,
    normal: Vec3,
}

impl Vertex {
    fn set(&mut self, name: &str, value: f64) -> PropertyAccessResult {
        match name {
            "x" => self.position.x = value,
            "y" => self.position.y = value,
            "z" => self.position.z = value,
            "nx" => self.normal.x = value as f32,
            "ny" => self.normal.y = value as f32,
            "nz" => self.normal.z = value as f32,
            _ => return PropertyAccessResult::Ignored,
        }
        PropertyAccessResult::Set
    }
}

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self { position: DVec3::ZERO, normal: Vec3::ZERO }
    }

    fn set_float(&mut self, name: &str, value: f32) -> PropertyAccessResult {
        self.set(name, f64::from(value))
    }

    fn set_double(&mut self, name: &str, value: f64) -> PropertyAccessResult {
        self.set(name, value)
    }

    fn set_property(&mut self, name: &str, value: Property) -> PropertyAccessResult {
        value.to_f32_lossy().map_or(PropertyAccessResult::Ignored, |value| self.set(name, f64::from(value)))
    }
}

/// A face: the indices of its vertices.
#[derive(Default)]
struct Face {
    signed: Vec<i32>,
    unsigned: Vec<u32>,
}

fn is_indices(name: &str) -> bool {
    matches!(name, "vertex_indices" | "vertex_index")
}

impl PropertyAccess for Face {
    fn new() -> Self {
        Self::default()
    }

    fn begin_list_int(&mut self, name: &str, _: usize) -> BeginList<'_, i32> {
        if is_indices(name) { BeginList::Fill(&mut self.signed) } else { BeginList::UseSetter }
    }

    fn begin_list_uint(&mut self, name: &str, _: usize) -> BeginList<'_, u32> {
        if is_indices(name) { BeginList::Fill(&mut self.unsigned) } else { BeginList::UseSetter }
    }

    fn set_property(&mut self, name: &str, value: Property) -> PropertyAccessResult {
        match value.to_u32_list().filter(|_| is_indices(name)) {
            Some(indices) => {
                self.unsigned = indices;
                PropertyAccessResult::Set
            }
            None => PropertyAccessResult::Ignored,
        }
    }
}

/// An element that is not read.
struct Skipped;

impl PropertyAccess for Skipped {
    fn new() -> Self {
        Self
    }
}

pub(super) fn read(bytes: &[u8]) -> Result<Content, String> {
    let failed = |e: ply_rs_bw::parser::ParseError| {
        let line = e.line().map(|line| format!("line {line}: ")).unwrap_or_default();
        format!("{line}{e}")
    };
    let mut reader = Reader::new(Cursor::new(bytes));
    let header = Parser::<Skipped>::new().read_header(&mut reader).map_err(failed)?;
    let mut content = Content::default();
    for element in header.elements.values() {
        // Every element takes at least a byte, so that a damaged count fails at once.
        if element.count > bytes.len() {
            return Err(format!(
                "the header announces {} elements `{}`, more than the file has bytes: it is cut off or damaged",
                element.count, element.name
            ));
        }
        let has = |name: &str| element.properties.contains_key(name);
        match element.name.as_str() {
            "vertex" => {
                if let Some(missing) = ["x", "y", "z"].into_iter().find(|name| !has(name)) {
                    return Err(format!("its vertices have no coordinate `{missing}`"));
                }
                let smooth = ["nx", "ny", "nz"].into_iter().all(has);
                let parser = Parser::<Vertex>::new();
                for v in parser.read_payload_for_element(&mut reader, element, &header).map_err(failed)? {
                    content.positions.push(v.position);
                    if smooth {
                        content.normals.push(v.normal.normalize_or_zero());
                    }
                }
            }
            "face" => {
                let is_list = |p: &PropertyType| matches!(p, PropertyType::List(..));
                if !element.properties.iter().any(|(k, p)| is_indices(k) && is_list(&p.data_type)) {
                    return Err("its faces have no list `vertex_indices`".into());
                }
                let parser = Parser::<Face>::new();
                for face in parser.read_payload_for_element(&mut reader, element, &header).map_err(failed)? {
                    if face.unsigned.is_empty() {
                        // A negative index becomes one that is out of range, and is named.
                        let indices: Vec<u32> = face.signed.iter().map(|index| *index as u32).collect();
                        content.add_polygon(&indices);
                    } else {
                        content.add_polygon(&face.unsigned);
                    }
                }
            }
            _ => {
                let parser = Parser::<Skipped>::new();
                parser.read_payload_for_element(&mut reader, element, &header).map_err(failed)?;
            }
        }
    }
    Ok(content)
}
