//! Compression of value blocks, and validation of one compressed chunk.
//!
//! Layout after OpenVDB's `io/Compression.h` and `io/Compression.cc`.

use super::super::cursor::Cursor;
use super::super::error::Fault;
use super::blosc;

const ZIP: u32 = 0x1;
const ACTIVE_MASK: u32 = 0x2;
const BLOSC: u32 = 0x4;

/// Compression flags of a grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Compression {
    /// Codec of the chunks.
    pub(super) codec: Codec,
    /// Whether inactive values may be omitted from a block.
    pub(super) active_mask: bool,
}

/// Codec of the bytes of a chunk.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Codec {
    None,
    Zip,
    Blosc,
}

impl Compression {
    /// Parses the flags in the file; `at` is their offset in bytes.
    pub(super) fn from_flags(flags: u32, at: u64) -> Result<Self, Fault> {
        if flags & !(ZIP | ACTIVE_MASK | BLOSC) != 0 {
            return Err(Fault::invalid(at, format!("unknown compression flags {flags:#x}")));
        }
        // OpenVDB reads a file with both flags as Blosc.
        let codec = match (flags & BLOSC != 0, flags & ZIP != 0) {
            (true, _) => Codec::Blosc,
            (false, true) => Codec::Zip,
            (false, false) => Codec::None,
        };
        Ok(Self { codec, active_mask: flags & ACTIVE_MASK != 0 })
    }

    /// Flags for the transcript.
    pub(super) fn flags(self) -> u32 {
        let mask = if self.active_mask { ACTIVE_MASK } else { 0 };
        mask | match self.codec {
            Codec::None => 0,
            Codec::Zip => ZIP,
            Codec::Blosc => BLOSC,
        }
    }
}

/// Validates one chunk that unpacks to `unpacked` bytes. Returns its packed bytes and the size field in front
/// of them (without a codec there is no size field). A negative size marks bytes that are not packed.
pub(super) fn chunk<'a>(
    cursor: &mut Cursor<'a>,
    codec: Codec,
    unpacked: usize,
) -> Result<(Option<i64>, &'a [u8]), Fault> {
    if codec == Codec::None {
        return Ok((None, cursor.take(unpacked)?));
    }
    let at = cursor.position();
    let size = cursor.i64()?;
    if size <= 0 {
        if size.unsigned_abs() != unpacked as u64 && unpacked != 0 {
            return Err(Fault::invalid(
                at,
                format!("an unpacked chunk of {} bytes instead of {unpacked}", size.unsigned_abs()),
            ));
        }
        return Ok((Some(size), cursor.take(unpacked)?));
    }
    let packed = cursor.take(usize::try_from(size).unwrap_or(usize::MAX))?;
    if unpacked == 0 {
        // Some writers compress an empty block to a bare header; no value depends on it.
        return Ok((Some(0), &[]));
    }
    if codec == Codec::Blosc {
        blosc::check(packed, unpacked).map_err(|fault| fault.at(at))?;
    }
    // A zip stream needs no validation: it is unpacked by safe code into `unpacked` bytes.
    Ok((Some(size), packed))
}
