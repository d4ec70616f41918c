//! Wavefront OBJ.

use super::Content;
use glam::{DVec3, Vec3};
use std::io::Cursor;
use tobj::LoadOptions;

pub(super) fn read(bytes: &[u8]) -> Result<Content, String> {
    let options = LoadOptions { triangulate: true, single_index: true, ..LoadOptions::default() };
    let materials = |_: &std::path::Path| Ok(Default::default());
    let (models, _) = tobj::load_obj_buf(&mut Cursor::new(bytes), &options, materials)
        .map_err(|error| format!("{}{error}: export it again as OBJ", line_of_fault(bytes)))?;
    let finite = |model: &tobj::Model| model.mesh.positions.iter().all(|x| x.is_finite());
    if !models.iter().all(finite) {
        return Err(format!("{}a coordinate is not a finite number", line_of_fault(bytes)));
    }
    let mut content = Content::default();
    let smooth = models.iter().any(|model| !model.mesh.normals.is_empty());
    for mesh in models.iter().map(|model| &model.mesh) {
        let first = content.positions.len() as u32;
        content.positions.extend(mesh.positions.as_chunks::<3>().0.iter().map(|p| DVec3::from(*p)));
        if smooth {
            let normals = mesh.normals.as_chunks::<3>().0.iter().map(|n| DVec3::from(*n).as_vec3());
            content.normals.extend(normals.map(Vec3::normalize_or_zero));
            content.normals.resize(content.positions.len(), Vec3::ZERO);
        }
        let triangles = mesh.indices.as_chunks::<3>().0;
        content.triangles.extend(triangles.iter().map(|t| t.map(|index| index.saturating_add(first))));
    }
    Ok(content)
}

/// Line of the first vertex or face that cannot be read, as the start of a message; empty if all can.
fn line_of_fault(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes);
    let is_number = |word: &str| word.parse::<f64>().is_ok_and(f64::is_finite);
    let mut vertices = 0i64;
    for (number, line) in text.lines().enumerate() {
        let mut words = line.split_whitespace();
        let good = match words.next() {
            Some("v") => {
                vertices += 1;
                words.clone().count() >= 3 && words.take(3).all(is_number)
            }
            Some("vn") => words.take(3).all(is_number),
            Some("f") => words.all(|word| {
                let index = word.split('/').next().and_then(|index| index.parse::<i64>().ok());
                index.is_some_and(|index| index != 0 && index.abs() <= vertices)
            }),
            _ => true,
        };
        if !good {
            return format!("line {}: `{}`: ", number + 1, line.chars().take(60).collect::<String>());
        }
    }
    String::new()
}
