//! glTF 2.0, as text (`.gltf`) and binary (`.glb`).

use super::Content;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use glam::{DMat4, DVec3, Mat4, Vec3};
use gltf::accessor::{DataType, Dimensions};
use gltf::buffer::Source;
use gltf::mesh::Mode;
use std::path::{Component, Path};

/// Depth of nested nodes beyond which a file is refused: nodes may refer to their own parents.
const MAX_DEPTH: usize = 64;

pub(super) fn read(bytes: &[u8], folder: &Path) -> Result<Content, String> {
    let file = gltf::Gltf::from_slice(bytes).map_err(|e| e.to_string())?;
    let buffers = file
        .buffers()
        .map(|buffer| match buffer.source() {
            Source::Bin => file.blob.clone().ok_or_else(|| "its binary chunk is missing".to_owned()),
            Source::Uri(uri) => read_buffer(uri, folder),
        })
        .collect::<Result<Vec<_>, _>>()?;
    let mut content = Content::default();
    let scene = file.default_scene().or_else(|| file.scenes().next()).ok_or("it has no scene")?;
    for node in scene.nodes() {
        add_node(&node, DMat4::IDENTITY, &buffers, &mut content, 0)?;
    }
    if content.normals.iter().all(|normal| *normal == Vec3::ZERO) {
        content.normals.clear();
    }
    Ok(content)
}

/// Content of a buffer: data in the text, or a file in the folder.
fn read_buffer(uri: &str, folder: &Path) -> Result<Vec<u8>, String> {
    if let Some(data) = uri.strip_prefix("data:") {
        let (_, encoded) = data.split_once("base64,").ok_or("a buffer is neither base64 nor a file")?;
        return STANDARD.decode(encoded).map_err(|e| format!("a buffer is not base64: {e}"));
    }
    let name = Path::new(uri);
    if !name.components().all(|part| matches!(part, Component::Normal(_))) {
        return Err(format!("the buffer `{uri}` is not in its folder"));
    }
    std::fs::read(folder.join(name)).map_err(|e| format!("the buffer `{uri}`: {e}"))
}

fn add_node(
    node: &gltf::Node<'_>,
    parent: DMat4,
    buffers: &[Vec<u8>],
    content: &mut Content,
    depth: usize,
) -> Result<(), String> {
    if depth > MAX_DEPTH {
        return Err(format!("its nodes are nested more than {MAX_DEPTH} deep"));
    }
    let world = parent * Mat4::from_cols_array_2d(&node.transform().matrix()).as_dmat4();
    if let Some(mesh) = node.mesh() {
        for primitive in mesh.primitives() {
            add_primitive(&primitive, world, buffers, content).map_err(|fault| {
                format!("mesh {}, primitive {}: {fault}", mesh.index(), primitive.index())
            })?;
        }
    }
    node.children().try_for_each(|child| add_node(&child, world, buffers, content, depth + 1))
}

fn add_primitive(
    primitive: &gltf::Primitive<'_>,
    world: DMat4,
    buffers: &[Vec<u8>],
    content: &mut Content,
) -> Result<(), String> {
    if matches!(primitive.mode(), Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip) {
        return Ok(());
    }
    let reader = primitive.reader(|buffer| buffers.get(buffer.index()).map(Vec::as_slice));
    let position = primitive.get(&gltf::Semantic::Positions).ok_or("it has no positions")?;
    check(&position, buffers, Dimensions::Vec3, &[DataType::F32])?;
    let positions: Vec<DVec3> = reader
        .read_positions()
        .ok_or("its positions are outside their buffer")?
        .map(|p| world.transform_point3(Vec3::from(p).as_dvec3()))
        .collect();
    let first = content.positions.len() as u32;
    let count = positions.len();
    content.positions.extend(positions);
    if let Some(normal) = primitive.get(&gltf::Semantic::Normals) {
        check(&normal, buffers, Dimensions::Vec3, &[DataType::F32])?;
        let to_world = glam::DMat3::from_mat4(world).inverse().transpose();
        let normals = reader.read_normals().ok_or("its normals are outside their buffer")?;
        let turned = normals.map(|n| (to_world * Vec3::from(n).as_dvec3()).as_vec3().normalize_or_zero());
        content.normals.extend(turned);
    }
    content.normals.resize(content.positions.len(), Vec3::ZERO);
    let indices: Vec<u32> = match primitive.indices() {
        Some(accessor) => {
            check(&accessor, buffers, Dimensions::Scalar, &[DataType::U8, DataType::U16, DataType::U32])?;
            reader.read_indices().ok_or("its indices are outside their buffer")?.into_u32().collect()
        }
        None => (0..count as u32).collect(),
    };
    // Mirrored nodes turn triangles inside out.
    let mirrored = world.determinant() < 0.0;
    let mut add = |a: u32, b: u32, c: u32| {
        let [b, c] = if mirrored { [c, b] } else { [b, c] };
        content.triangles.push([a, b, c].map(|index| index.saturating_add(first)));
    };
    match primitive.mode() {
        Mode::TriangleStrip => {
            for (i, t) in indices.windows(3).enumerate() {
                if i % 2 == 0 { add(t[0], t[1], t[2]) } else { add(t[1], t[0], t[2]) }
            }
        }
        Mode::TriangleFan => {
            if let [center, rim @ ..] = &*indices {
                rim.windows(2).for_each(|pair| add(*center, pair[0], pair[1]));
            }
        }
        _ => indices.as_chunks::<3>().0.iter().for_each(|t| add(t[0], t[1], t[2])),
    }
    Ok(())
}

/// Checks an accessor before it is read: the crate trusts its type and its numbers.
fn check(
    accessor: &gltf::Accessor<'_>,
    buffers: &[Vec<u8>],
    dimensions: Dimensions,
    types: &[DataType],
) -> Result<(), String> {
    let index = accessor.index();
    if accessor.dimensions() != dimensions || !types.contains(&accessor.data_type()) {
        return Err(format!("accessor {index} has a type that does not fit its use"));
    }
    if accessor.sparse().is_some() {
        return Err(format!("accessor {index} is sparse: export the mesh without shape keys"));
    }
    let view =
        accessor.view().ok_or_else(|| format!("accessor {index} has no data: export without compression"))?;
    let most = buffers.get(view.buffer().index()).map_or(0, Vec::len);
    let numbers = [accessor.count(), accessor.offset(), view.offset(), view.length()];
    if accessor.count() == 0
        || numbers.iter().any(|number| *number > most)
        || view.stride().is_some_and(|s| s < accessor.size())
    {
        return Err(format!("accessor {index} reaches beyond its buffer of {most} bytes"));
    }
    Ok(())
}
