//! NumPy `.npy` arrays of shape (z, y, x) or (z, y, x, 3).
//!
//! Format: <https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html>, versions 1 to 3: magic,
//! version, header length, a Python dictionary as text, then the values. Element types: little-endian
//! float16, float32, float64, and uint8 (values 0 to 255).
//!
//! An array has no transformation; see [`VoxelGrid::without_place`].

use half::f16;

use super::cursor::Cursor;
use super::error::{Fault, VolumeError};
use super::grid::VoxelGrid;
use super::read_limits::{ReadLimits, allocate};

/// First bytes of every `.npy` file.
pub(super) const MAGIC: &[u8] = b"\x93NUMPY";

/// Maximum length of the header in bytes. NumPy writes 118 for a plain array.
const MAX_HEADER_BYTES: usize = 1 << 16;

/// Supported element types.
#[derive(Debug, Clone, Copy)]
enum Element {
    F16,
    F32,
    F64,
    U8,
}

/// Contents of the header dictionary.
struct Header {
    element: Element,
    /// Voxels along x, y, z.
    size: [usize; 3],
    channels: usize,
}

/// Reads a `.npy` file in memory; `label` is its path in messages.
///
/// # Errors
/// When the header is malformed, the shape, order or element type is not supported, the number of bytes does
/// not match, or the array exceeds the limits.
pub fn read_npy_bytes(bytes: &[u8], label: &str, limits: &ReadLimits) -> Result<VoxelGrid, VolumeError> {
    read(bytes, limits).map_err(|fault| fault.in_file(label, None))
}

fn read(bytes: &[u8], limits: &ReadLimits) -> Result<VoxelGrid, Fault> {
    let mut cursor = Cursor::new(bytes);
    let Header { element, size, channels } = header(&mut cursor)?;
    let len = limits.dense_values(size.map(|n| n as u64), channels)?;
    let data = data(&mut cursor, len, element.bytes())?;
    let mut values = allocate(len)?;
    match element {
        Element::F16 => values.extend(chunks(data).map(|b| f16::from_le_bytes(b).to_f32())),
        Element::F32 => values.extend(chunks(data).map(f32::from_le_bytes)),
        Element::F64 => values.extend(chunks(data).map(|b| f64::from_le_bytes(b) as f32)),
        Element::U8 => values.extend(data.iter().map(|&byte| f32::from(byte))),
    }
    Ok(VoxelGrid::without_place(size, channels, values))
}

/// Reads the rest of the file, which must be exactly `len` elements.
pub(super) fn data<'a>(cursor: &mut Cursor<'a>, len: usize, element_bytes: usize) -> Result<&'a [u8], Fault> {
    let (expected, actual) = (len.saturating_mul(element_bytes), cursor.remaining());
    if expected != actual {
        return Err(Fault::invalid(
            cursor.position(),
            format!("{expected} bytes of values expected, but {actual} follow"),
        ));
    }
    cursor.take(actual)
}

/// Splits bytes into groups of `N`; an incomplete group is dropped.
pub(super) fn chunks<const N: usize>(data: &[u8]) -> impl Iterator<Item = [u8; N]> + '_ {
    data.chunks_exact(N).map(|chunk| {
        let mut bytes = [0; N];
        bytes.copy_from_slice(chunk);
        bytes
    })
}

impl Element {
    fn of(descr: &str) -> Result<Self, Fault> {
        Ok(match descr {
            "<f2" => Self::F16,
            "<f4" => Self::F32,
            "<f8" => Self::F64,
            "|u1" | "<u1" => Self::U8,
            _ => {
                return Err(Fault::unsupported(
                    format!("elements of type {descr}"),
                    "Convert in Python: numpy.save(path, array.astype('<f4'))",
                ));
            }
        })
    }

    fn bytes(self) -> usize {
        match self {
            Self::F16 => 2,
            Self::F32 => 4,
            Self::F64 => 8,
            Self::U8 => 1,
        }
    }
}

fn header(cursor: &mut Cursor) -> Result<Header, Fault> {
    if cursor.take(MAGIC.len()).ok() != Some(MAGIC) {
        return Err(Fault::invalid(0, "this is not a NumPy file: its magic number is missing"));
    }
    let (major, _minor) = (cursor.u8()?, cursor.u8()?);
    let len = match major {
        1 => usize::from(cursor.u16()?),
        2 | 3 => cursor.u32()? as usize,
        _ => {
            return Err(Fault::unsupported(
                format!("NumPy format version {major}"),
                "Save the array with numpy.save of NumPy 1 or 2",
            ));
        }
    };
    let at = cursor.position();
    if len > MAX_HEADER_BYTES {
        return Err(Fault::invalid(at, format!("a header of {len} bytes")));
    }
    let text = String::from_utf8_lossy(cursor.take(len)?);
    let malformed = |key: &str| Fault::invalid(at, format!("the header has no usable '{key}'"));

    let order = value_of(&text, "fortran_order").ok_or_else(|| malformed("fortran_order"))?;
    if !order.starts_with("False") {
        return Err(Fault::unsupported(
            "Fortran order",
            "Convert in Python: numpy.save(path, numpy.ascontiguousarray(array))",
        ));
    }
    let descr = value_of(&text, "descr").and_then(quoted).ok_or_else(|| malformed("descr"))?;
    let shape = value_of(&text, "shape").and_then(tuple).ok_or_else(|| malformed("shape"))?;
    let (size, channels) = match shape[..] {
        [z, y, x] => ([x, y, z], 1),
        [z, y, x, 3] => ([x, y, z], 3),
        _ => {
            return Err(Fault::unsupported(
                format!("an array of shape {shape:?}"),
                "Use three axes (z, y, x), or four with three channels last (z, y, x, 3)",
            ));
        }
    };
    if size.contains(&0) {
        return Err(Fault::invalid(at, format!("an array of shape {shape:?} has no voxels")));
    }
    Ok(Header { element: Element::of(descr)?, size, channels })
}

/// Text after `'key':` in the header dictionary.
fn value_of<'a>(text: &'a str, key: &str) -> Option<&'a str> {
    let (_, behind) = text.split_once(&format!("'{key}'"))?;
    Some(behind.trim_start().strip_prefix(':')?.trim_start())
}

/// Text between quotation marks.
fn quoted(text: &str) -> Option<&str> {
    text.strip_prefix('\'')?.split_once('\'').map(|(inside, _)| inside)
}

/// Numbers of a tuple such as `(3, 4, 5)`.
fn tuple(text: &str) -> Option<Vec<usize>> {
    let (inside, _) = text.strip_prefix('(')?.split_once(')')?;
    let items = inside.split(',').map(str::trim).filter(|item| !item.is_empty());
    items.map(|item| item.parse().ok().filter(|&n| n <= u32::MAX as usize)).collect()
}
