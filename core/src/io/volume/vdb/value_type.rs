//! Value types of trees, and the supported tree types.

use super::super::cursor::Cursor;
use super::super::error::Fault;

/// Value type of a tree, as part of its type name (`Tree_float_5_4_3`).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ValueType {
    /// Half floats in memory and in the file (OpenVDB 13), including background and tiles.
    Half,
    Float,
    Double,
    Int32,
    Int64,
    Vec3s,
    Vec3d,
}

/// Storage type of the values of a block after decompression.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Stored {
    F16,
    F32,
    F64,
    I32,
    I64,
    F16x3,
    F32x3,
    F64x3,
}

/// The only tree shape in use: 32³ children of 16³ children of 8³ voxels.
const TREE_SHAPE: &str = "_5_4_3";

impl ValueType {
    /// Value type of a supported tree, or the reason why it is not supported.
    pub(super) fn of_tree(tree_type: &str) -> Result<Self, Fault> {
        let inner = tree_type.strip_prefix("Tree_");
        let Some(value) = inner.and_then(|inner| inner.strip_suffix(TREE_SHAPE)) else {
            return Err(Fault::unsupported(
                format!("the tree type \"{tree_type}\""),
                "Save the grid with OpenVDB's standard 5-4-3 tree, for example as FloatGrid",
            ));
        };
        Ok(match value {
            "half" => Self::Half,
            "float" => Self::Float,
            "double" => Self::Double,
            "int32" => Self::Int32,
            "int64" => Self::Int64,
            "vec3s" => Self::Vec3s,
            "vec3d" => Self::Vec3d,
            "bool" | "mask" => {
                return Err(Fault::unsupported(
                    format!("a {value} grid, which marks voxels but contains no densities"),
                    "Convert it to a float fog volume",
                ));
            }
            _ if value.starts_with("ptdataidx") || value.starts_with("ptidx") => {
                return Err(Fault::unsupported(
                    "a point grid",
                    "Rasterise the points to a float density grid first",
                ));
            }
            _ => {
                return Err(Fault::unsupported(
                    format!("values of type \"{value}\""),
                    "Convert the grid to float",
                ));
            }
        })
    }

    /// Size in bytes of one full-precision value: background, tiles, and inactive values.
    pub(super) fn bytes(self) -> usize {
        self.stored(false).bytes()
    }

    /// Storage type in blocks. The half flag applies to real numbers only.
    pub(super) fn stored(self, half: bool) -> Stored {
        match (self, half) {
            (Self::Half, _) => Stored::F16,
            (Self::Float, false) => Stored::F32,
            (Self::Double, false) => Stored::F64,
            (Self::Float | Self::Double, true) => Stored::F16,
            (Self::Int32, _) => Stored::I32,
            (Self::Int64, _) => Stored::I64,
            (Self::Vec3s, false) => Stored::F32x3,
            (Self::Vec3d, false) => Stored::F64x3,
            (Self::Vec3s | Self::Vec3d, true) => Stored::F16x3,
        }
    }

    /// Number of channels: 1 or 3.
    pub(super) fn channels(self) -> usize {
        match self {
            Self::Half | Self::Float | Self::Double | Self::Int32 | Self::Int64 => 1,
            Self::Vec3s | Self::Vec3d => 3,
        }
    }

    /// Whether storing as `stored` narrows the values, as the half flag does for all real types except half.
    pub(super) fn is_narrowed(self, stored: Stored) -> bool {
        stored.is_half() && self != Self::Half
    }

    /// Whether a voxel is a single real number, as required for a density.
    pub(super) fn is_real_scalar(self) -> bool {
        matches!(self, Self::Half | Self::Float | Self::Double)
    }

    /// Reads one full-precision value; a scalar is repeated in all three channels.
    pub(super) fn read(self, cursor: &mut Cursor) -> Result<[f32; 3], Fault> {
        let mut number = || {
            Ok::<f32, Fault>(match self {
                Self::Half => half::f16::from_bits(cursor.u16()?).to_f32(),
                Self::Float | Self::Vec3s => cursor.f32()?,
                Self::Double | Self::Vec3d => cursor.f64()? as f32,
                Self::Int32 => cursor.i32()? as f32,
                Self::Int64 => cursor.i64()? as f32,
            })
        };
        let first = number()?;
        Ok(if self.channels() == 1 { [first; 3] } else { [first, number()?, number()?] })
    }
}

impl Stored {
    /// Size in bytes of one value.
    pub(super) fn bytes(self) -> usize {
        match self {
            Self::F16 => 2,
            Self::F32 | Self::I32 => 4,
            Self::F16x3 => 6,
            Self::F64 | Self::I64 => 8,
            Self::F32x3 => 12,
            Self::F64x3 => 24,
        }
    }

    /// Whether values are half floats.
    pub(super) fn is_half(self) -> bool {
        matches!(self, Self::F16 | Self::F16x3)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tree_types_are_read_or_refused_by_name() {
        assert_eq!(ValueType::of_tree("Tree_float_5_4_3").unwrap(), ValueType::Float);
        assert_eq!(ValueType::of_tree("Tree_half_5_4_3").unwrap(), ValueType::Half);
        assert_eq!(ValueType::of_tree("Tree_vec3d_5_4_3").unwrap(), ValueType::Vec3d);
        for refused in ["Tree_float_4_3_3", "Tree_bool_5_4_3", "Tree_ptdataidx32_5_4_3", "", "Tree_"] {
            assert!(ValueType::of_tree(refused).is_err(), "{refused}");
        }
    }

    #[test]
    fn half_flag_leaves_integers_alone() {
        assert_eq!(ValueType::Int32.stored(true), Stored::I32);
        assert_eq!(ValueType::Double.stored(true), Stored::F16);
        assert_eq!([true, false].map(|flag| ValueType::Half.stored(flag)), [Stored::F16; 2]);
    }
}
