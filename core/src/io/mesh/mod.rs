//! Triangle meshes from OBJ, PLY and glTF files.
//!
//! Polygons are divided into triangles by a fan. All objects, groups and nodes of a file become one mesh;
//! materials, textures and animation are not read.

mod gltf;
mod obj;
mod ply;

use crate::surface::{Mesh, MeshError};
use glam::{DVec3, Vec3};
use std::path::Path;

/// Reason why a mesh could not be read.
#[derive(Debug, thiserror::Error)]
pub enum MeshFileError {
    /// The file could not be read.
    #[error("{file}: {source}. Check the name and the folder, or choose another file.")]
    Io {
        /// File name.
        file: String,
        /// Error of the operating system.
        source: std::io::Error,
    },
    /// The file is larger than the limit.
    #[error("{file}: has {bytes} bytes, above the limit of {limit}: reduce the mesh")]
    TooLarge {
        /// File name.
        file: String,
        /// Size of the file.
        bytes: u64,
        /// Limit.
        limit: u64,
    },
    /// The name does not end like that of a mesh.
    #[error("{0}: is not a mesh by its name: choose a .obj, .ply, .gltf or .glb file")]
    Kind(String),
    /// The content is not as the format prescribes.
    #[error("{file}: {message}")]
    Invalid {
        /// File name.
        file: String,
        /// Place and fault.
        message: String,
    },
    /// The content does not make a mesh.
    #[error("{file}: {source}")]
    Mesh {
        /// File name.
        file: String,
        /// Fault.
        source: MeshError,
    },
}

/// File endings of meshes.
pub const ENDINGS: [&str; 4] = ["obj", "ply", "gltf", "glb"];

/// Content of a mesh file.
#[derive(Default)]
struct Content {
    positions: Vec<DVec3>,
    /// One per position, or none; zero where the file has none.
    normals: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
}

impl Content {
    /// Adds a polygon as a fan of triangles.
    fn add_polygon(&mut self, indices: &[u32]) {
        if let [first, rest @ ..] = indices {
            self.triangles.extend(rest.windows(2).map(|pair| [*first, pair[0], pair[1]]));
        }
    }
}

/// Reads a mesh file of at most `max_bytes` bytes, and returns the mesh with the repairs made.
///
/// # Errors
/// When the file is missing, too large, damaged or of another kind, or has no triangles.
pub fn read_mesh(path: &Path, max_bytes: u64) -> Result<(Mesh, Vec<String>), MeshFileError> {
    let file = path.display().to_string();
    let io = |source| MeshFileError::Io { file: file.clone(), source };
    let bytes = std::fs::metadata(path).map_err(io)?.len();
    if bytes > max_bytes {
        return Err(MeshFileError::TooLarge { file, bytes, limit: max_bytes });
    }
    parse_mesh(&std::fs::read(path).map_err(io)?, path)
}

/// Reads a mesh from memory; the ending of `path` gives its format, and glTF buffers are read beside it.
///
/// # Errors
/// As for [`read_mesh`].
pub fn parse_mesh(bytes: &[u8], path: &Path) -> Result<(Mesh, Vec<String>), MeshFileError> {
    let file = path.display().to_string();
    let ending = path.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default();
    let read = match ending.as_str() {
        "obj" => obj::read(bytes),
        "ply" => ply::read(bytes),
        "gltf" | "glb" => gltf::read(bytes, path.parent().unwrap_or(Path::new(""))),
        _ => return Err(MeshFileError::Kind(file)),
    };
    let content = read.map_err(|message| MeshFileError::Invalid { file: file.clone(), message })?;
    let count = content.triangles.len();
    let mesh = Mesh::new(&content.positions, content.normals, content.triangles)
        .map_err(|source| MeshFileError::Mesh { file: file.clone(), source })?;
    let flat = count - mesh.triangle_count();
    let repairs =
        (flat > 0).then(|| format!("{file}: {flat} of {count} triangles have no area and are left out."));
    Ok((mesh, repairs.into_iter().collect()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fmt::Write;

    const CUBE: &str = "# a cube of quadrilaterals
o cube
v 1 1 1
v 3 1 1
v 3 3 1
v 1 3 1
v 1 1 3
v 3 1 3
v 3 3 3
v 1 3 3
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f -8 -4 -1 -5
";

    fn parse(text: &[u8], name: &str) -> Result<(Mesh, Vec<String>), String> {
        parse_mesh(text, Path::new(name)).map_err(|e| e.to_string())
    }

    fn is_the_cube((mesh, repairs): &(Mesh, Vec<String>)) {
        assert_eq!((mesh.triangle_count(), mesh.open_edge(), repairs.len()), (12, None, 0));
        let object = mesh.object_from_mesh();
        let [lo, hi] = [mesh.bounds().0, mesh.bounds().1].map(|p| object.transform_point3(p.as_dvec3()));
        assert!((lo - DVec3::ONE).length() < 1e-6 && (hi - DVec3::splat(3.0)).length() < 1e-6, "{lo} {hi}");
    }

    /// The cube as ASCII PLY, with indices of a type.
    fn ascii_ply(extra: &str) -> String {
        let vertices: Vec<_> = CUBE.lines().filter_map(|l| l.strip_prefix("v ")).collect();
        let faces = ["0 3 2 1", "4 5 6 7", "0 1 5 4", "1 2 6 5", "2 3 7 6", "0 4 7 3"];
        let mut text = format!(
            "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 8\nproperty float x\nproperty float y\n\
             property float z\n{extra}element face 6\nproperty list uchar int vertex_indices\nend_header\n"
        );
        for vertex in vertices {
            writeln!(text, "{vertex}{}", if extra.is_empty() { "" } else { " 0 0 255" }).unwrap();
        }
        faces.iter().for_each(|face| writeln!(text, "4 {face}").unwrap());
        text
    }

    fn binary_ply(big: bool) -> Vec<u8> {
        let (name, endian) = if big { ("big", 1) } else { ("little", 0) };
        let mut bytes = format!(
            "ply\nformat binary_{name}_endian 1.0\nelement vertex 8\nproperty double x\nproperty double y\n\
             property double z\nelement face 6\nproperty uchar flags\nproperty list uchar uint vertex_index\nend_header\n"
        )
        .into_bytes();
        for line in CUBE.lines().filter_map(|l| l.strip_prefix("v ")) {
            for x in line.split(' ').map(|x| x.parse::<f64>().unwrap()) {
                bytes.extend(if endian == 1 { x.to_be_bytes() } else { x.to_le_bytes() });
            }
        }
        for face in [[0u32, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [0, 4, 7, 3]] {
            bytes.extend([9, 4]);
            for i in face {
                bytes.extend(if endian == 1 { i.to_be_bytes() } else { i.to_le_bytes() });
            }
        }
        bytes
    }

    /// The cube as glTF: half of it in mesh coordinates, moved and scaled by two nested nodes.
    fn gltf(uri: &str) -> (String, Vec<u8>) {
        let mut bytes = Vec::new();
        for line in CUBE.lines().filter_map(|l| l.strip_prefix("v ")) {
            line.split(' ').for_each(|x| bytes.extend((0.5 * x.parse::<f32>().unwrap() - 1.0).to_le_bytes()));
        }
        let quads = [[0u16, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [0, 4, 7, 3]];
        for [a, b, c, d] in quads {
            [a, b, c, a, c, d].into_iter().for_each(|i| bytes.extend(i.to_le_bytes()));
        }
        let text = format!(
            r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],
            "nodes":[{{"children":[1],"translation":[2,2,2]}},{{"mesh":0,"scale":[2,2,2]}}],
            "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],
            "accessors":[{{"bufferView":0,"componentType":5126,"count":8,"type":"VEC3","min":[-1,-1,-1],"max":[1,1,1]}},
                {{"bufferView":1,"componentType":5123,"count":36,"type":"SCALAR"}}],
            "bufferViews":[{{"buffer":0,"byteLength":96}},{{"buffer":0,"byteOffset":96,"byteLength":72}}],
            "buffers":[{{"byteLength":168{uri}}}]}}"#
        );
        (text, bytes)
    }

    fn glb() -> Vec<u8> {
        let (mut text, bin) = gltf("");
        while text.len() % 4 != 0 {
            text.push(' ');
        }
        let mut glb = b"glTF".to_vec();
        let total = 12 + 8 + text.len() + 8 + bin.len();
        for (number, chunk) in [
            (2u32, None),
            (total as u32, None),
            (text.len() as u32, Some((b"JSON", text.as_bytes()))),
            (bin.len() as u32, Some((b"BIN\0", &bin[..]))),
        ] {
            glb.extend(number.to_le_bytes());
            if let Some((kind, content)) = chunk {
                glb.extend(*kind);
                glb.extend(content);
            }
        }
        glb
    }

    #[test]
    fn the_same_cube_from_every_format() {
        use base64::Engine;
        is_the_cube(&parse(CUBE.as_bytes(), "cube.OBJ").unwrap());
        is_the_cube(&parse(ascii_ply("").as_bytes(), "cube.ply").unwrap());
        let coloured = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
        is_the_cube(&parse(ascii_ply(coloured).as_bytes(), "cube.ply").unwrap());
        is_the_cube(&parse(&binary_ply(false), "cube.ply").unwrap());
        is_the_cube(&parse(&binary_ply(true), "cube.ply").unwrap());
        is_the_cube(&parse(&glb(), "cube.glb").unwrap());
        let data = base64::engine::general_purpose::STANDARD.encode(gltf("").1);
        let uri = format!(r#","uri":"data:application/octet-stream;base64,{data}""#);
        is_the_cube(&parse(gltf(&uri).0.as_bytes(), "cube.gltf").unwrap());
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("cube.bin"), gltf("").1).unwrap();
        let path = folder.path().join("cube.gltf");
        std::fs::write(&path, gltf(r#","uri":"cube.bin""#).0).unwrap();
        is_the_cube(&read_mesh(&path, 1 << 20).unwrap());
        assert!(read_mesh(&path, 100).unwrap_err().to_string().contains("above the limit of 100"));
    }

    #[test]
    fn normals_make_a_mesh_smooth() {
        let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn 1 0 1\nf 1//1 2//2 3//1\n";
        assert!(parse(text.as_bytes(), "a.obj").unwrap().0.is_smooth());
        assert!(!parse(CUBE.as_bytes(), "a.obj").unwrap().0.is_smooth());
    }

    #[test]
    fn damage_is_named_with_its_place() {
        let error = |text: &[u8], name: &str| parse(text, name).map(|_| ()).unwrap_err();
        let obj = |from: &str, to: &str| error(CUBE.replacen(from, to, 1).as_bytes(), "a.obj");
        assert!(
            obj("v 3 1 1", "v 3 one 1").starts_with("a.obj: line 4: "),
            "{}",
            obj("v 3 1 1", "v 3 one 1")
        );
        assert!(
            obj("f 5 6 7 8", "f 5 6 7 9").starts_with("a.obj: line 12: "),
            "{}",
            obj("f 5 6 7 8", "f 5 6 7 9")
        );
        assert!(obj("v 3 1 1", "v 3 nan 1").contains("line 4: `v 3 nan 1`: a coordinate is not a finite"));
        assert!(error(b"v 0 0 0\n", "a.obj").contains("no triangles"));
        assert!(error(b"v 1 2 3\nv 1 2 3\nv 1 2 3\nf 1 2 3\n", "a.obj").contains("zero area"));
        assert!(error(b"x", "a.stl").contains(".obj, .ply, .gltf or .glb"));
        let (mesh, repairs) = parse((CUBE.to_owned() + "f 1 2 2\n").as_bytes(), "a.obj").unwrap();
        assert_eq!((mesh.triangle_count(), repairs.len()), (12, 1));

        let ply = |from: &str, to: &str| error(ascii_ply("").replacen(from, to, 1).as_bytes(), "a.ply");
        assert!(ply("element vertex 8", "element vertex 10000000000").starts_with("a.ply: "));
        assert!(ply("property float x", "property float u").contains("no coordinate `x`"));
        assert!(ply("4 0 3 2 1", "4 0 3 2 99").contains("vertex 99, but there are only 8"));
        assert!(ply("3 1 1", "3 one 1").contains("line"), "{}", ply("3 1 1", "3 one 1"));
        let whole = binary_ply(false);
        for end in [whole.len() - 1, whole.len() - 30, 60, 3, 0] {
            assert!(error(&whole[..end], "a.ply").starts_with("a.ply: "), "{end}");
        }

        let cut = glb();
        for end in [cut.len() - 1, 200, 11, 0] {
            assert!(error(&cut[..end], "a.glb").starts_with("a.glb: "), "{end}");
        }
        let gltf = |from: &str, to: &str| {
            let data = r#","uri":"data:application/octet-stream;base64,AAAA""#;
            error(gltf(data).0.replacen(from, to, 1).as_bytes(), "a.gltf")
        };
        for (from, to) in [
            ("\"count\":8", "\"count\":0"),
            ("\"count\":8", "\"count\":18446744073709551615"),
            ("5123", "5126"),
            ("\"VEC3\"", "\"VEC2\""),
            ("\"byteOffset\":96", "\"byteOffset\":18446744073709551000"),
            ("base64,AAAA", "base64,*"),
            ("data:application/octet-stream;base64,AAAA", "../../etc/passwd"),
            ("\"nodes\":[0]", "\"nodes\":[7]"),
            ("\"POSITION\"", "\"_COLOUR\""),
            ("\"children\":[1]", "\"children\":[0]"),
        ] {
            assert!(gltf(from, to).starts_with("a.gltf: "), "{to}");
        }
    }
}
