//! Writer of tiny OpenVDB files: grids of one leaf of 8³ voxels, of any name, class, type and file version.
//!
//! It follows the same format description as the readers, and serves to test the handling of names and
//! versions; compatibility with OpenVDB is tested with files written by OpenVDB.

/// One grid to write.
#[derive(Clone, Copy, Debug)]
pub struct TinyGrid<'a> {
    /// Name, with OpenVDB's `\x1eN` suffix if it is to share one.
    pub name: &'a str,
    /// Grid class.
    pub class: &'a str,
    /// Value type: `float`, `half` or `vec3s`.
    pub values: &'a str,
    /// Whether a float grid is saved as half floats.
    pub saved_as_half: bool,
    /// Value of the last voxel; the first has 1/512 of it.
    pub largest: f32,
}

/// A fog volume of floats up to 1.
impl Default for TinyGrid<'_> {
    fn default() -> Self {
        Self { name: "density", class: "fog volume", values: "float", saved_as_half: false, largest: 1.0 }
    }
}

/// Encodes a file with the given grids; with `zip` chunks are declared compressed, but stored uncompressed.
pub fn vdb(version: u32, zip: bool, grids: &[TinyGrid]) -> Vec<u8> {
    let mut file = b"\x20BDV\0\0\0\0".to_vec();
    for word in [version, 13, 0] {
        file.extend(word.to_le_bytes());
    }
    file.push(1); // has offsets
    file.extend([b'0'; 36]);
    file.extend(0_u32.to_le_bytes()); // entries of file metadata
    file.extend((grids.len() as u32).to_le_bytes());
    for grid in grids {
        let suffix = if grid.saved_as_half { "_HalfFloat" } else { "" };
        text(&mut file, grid.name);
        text(&mut file, &format!("Tree_{}_5_4_3{suffix}", grid.values));
        text(&mut file, ""); // no instance
        let offsets = file.len();
        file.extend([0; 24]);
        let start = file.len() as u64;
        let blocks = write_grid(&mut file, grid, zip);
        let end = file.len() as u64;
        let places = [start, blocks, end].map(u64::to_le_bytes).concat();
        file[offsets..offsets + 24].copy_from_slice(&places);
    }
    file
}

/// Writes a grid without its descriptor; returns the offset of the leaf values.
fn write_grid(file: &mut Vec<u8>, grid: &TinyGrid, zip: bool) -> u64 {
    file.extend((if zip { 3_u32 } else { 2 }).to_le_bytes()); // zip, active mask
    file.extend(3_u32.to_le_bytes());
    for (name, value) in [("name", grid.name), ("class", grid.class)] {
        for entry in [name, "string", value] {
            text(file, entry);
        }
    }
    text(file, "is_saved_as_half_float");
    text(file, "bool");
    file.extend(1_u32.to_le_bytes());
    file.push(u8::from(grid.saved_as_half));
    text(file, "UniformScaleMap");
    for value in [0.125, 0.125, 8.0, 64.0, 4.0_f64] {
        (0..3).for_each(|_| file.extend(value.to_le_bytes()));
    }
    let narrowed = grid.saved_as_half;
    file.extend(1_u32.to_le_bytes()); // buffers
    file.extend(vec![0; bytes(grid, 0.0, false).len()]); // background
    for word in [0_u32, 1, 0, 0, 0] {
        file.extend(word.to_le_bytes()); // tiles, children, origin
    }
    for words in [512, 64] {
        let mut masks = vec![0_u64; 2 * words];
        masks[0] = 1; // the first entry is a child
        masks.iter().for_each(|word| file.extend(word.to_le_bytes()));
        chunk(file, &[], zip, narrowed);
    }
    file.extend([0xff; 64]); // all voxels of the leaf are active
    let blocks = file.len() as u64;
    file.extend([0xff; 64]);
    let value = |i: u16| bytes(grid, grid.largest * f32::from(i + 1) / 512.0, narrowed);
    let values: Vec<u8> = (0..512).flat_map(value).collect();
    chunk(file, &values, zip, narrowed);
    blocks
}

/// Writes a tag for no inactive values, and a chunk.
fn chunk(file: &mut Vec<u8>, values: &[u8], zip: bool, narrowed: bool) {
    file.push(0);
    // OpenVDB writes no size for an empty chunk of narrowed values.
    if zip && !(values.is_empty() && narrowed) {
        file.extend((-(values.len() as i64)).to_le_bytes());
    }
    file.extend(values);
}

fn bytes(grid: &TinyGrid, value: f32, narrowed: bool) -> Vec<u8> {
    match grid.values {
        "half" => half(value).to_le_bytes().to_vec(),
        "float" if narrowed => half(value).to_le_bytes().to_vec(),
        "float" => value.to_le_bytes().to_vec(),
        "vec3s" => [value.to_le_bytes(); 3].concat(),
        other => panic!("no values of type {other}"),
    }
}

/// Converts a number to a half float, which must represent it exactly.
fn half(value: f32) -> u16 {
    if value == 0.0 {
        return 0;
    }
    let bits = value.to_bits();
    assert!(value > 1e-4 && bits & 0x1fff == 0, "{value} is no half float");
    (((bits >> 23) - 112) << 10 | (bits >> 13) & 0x3ff) as u16
}

fn text(file: &mut Vec<u8>, text: &str) {
    file.extend((text.len() as u32).to_le_bytes());
    file.extend(text.as_bytes());
}
