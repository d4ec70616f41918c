//! Validation of a Blosc 1 chunk before it reaches the C library behind `vdb-rs`.
//!
//! `vdb-rs` takes the unpacked size from the header of the chunk and does not compare the packed size with
//! the number of bytes that it has: a wrong header makes the C code read and write out of bounds. All values
//! from which the decoder derives an address are therefore verified here: sizes, block table, and the sizes
//! of the splits of each block. Layout after c-blosc's `README_CHUNK_FORMAT.rst`.
//!
//! OpenVDB has only ever written LZ4 with byte shuffle; all other formats are refused.

use super::super::cursor::Cursor;
use super::super::error::Fault;

const HEADER_BYTES: usize = 16;
const FORMAT_VERSION: u8 = 2;
const LZ4_FORMAT_VERSION: u8 = 1;

const FLAG_SHUFFLE: u8 = 0x01;
const FLAG_STORED: u8 = 0x02;
const FLAG_UNSPLIT: u8 = 0x10;
const CODEC_SHIFT: u8 = 5;
const CODEC_LZ4: u8 = 1;

/// Maximum value size in bytes of a block that is split by byte plane (`MAX_SPLITS` of c-blosc).
const MAX_SPLITS: usize = 16;
/// Minimum number of values of a block that is split (`MIN_BUFFERSIZE` of c-blosc).
const MIN_SPLIT_VALUES: usize = 128;

/// Checks that `chunk` unpacks to exactly `unpacked` bytes without leaving either buffer.
pub(super) fn check(chunk: &[u8], unpacked: usize) -> Result<(), Fault> {
    let wrong = |what: String| Fault::invalid(None, format!("Blosc chunk: {what}"));
    let mut cursor = Cursor::new(chunk);
    let (version, codec_version) = (cursor.u8()?, cursor.u8()?);
    let (flags, type_bytes) = (cursor.u8()?, usize::from(cursor.u8()?));
    let nbytes = cursor.u32()? as usize;
    let block_bytes = cursor.u32()? as usize;
    let cbytes = cursor.u32()? as usize;

    if version != FORMAT_VERSION {
        return Err(wrong(format!("format version {version} instead of {FORMAT_VERSION}")));
    }
    if nbytes != unpacked {
        return Err(wrong(format!("it unpacks to {nbytes} bytes instead of {unpacked}")));
    }
    if cbytes != chunk.len() {
        return Err(wrong(format!("its header says {cbytes} bytes, but it has {}", chunk.len())));
    }
    let odd_blocks =
        || wrong(format!("blocks of {block_bytes} bytes holding values of {type_bytes}, in {nbytes} bytes"));
    if type_bytes == 0 || block_bytes == 0 || block_bytes > nbytes {
        return Err(odd_blocks());
    }
    if flags & FLAG_STORED != 0 {
        return if cbytes == nbytes + HEADER_BYTES {
            Ok(())
        } else {
            Err(wrong(format!("{nbytes} bytes stored in {cbytes}")))
        };
    }
    let other_flags = flags & 0x1f & !(FLAG_SHUFFLE | FLAG_UNSPLIT);
    if flags >> CODEC_SHIFT != CODEC_LZ4 || codec_version != LZ4_FORMAT_VERSION || other_flags != 0 {
        return Err(Fault::unsupported(
            format!("Blosc chunks other than LZ4 with byte shuffle (flags {flags:#04x})"),
            "Save the file again with OpenVDB's own Blosc settings, or with zip",
        ));
    }
    if !block_bytes.is_multiple_of(type_bytes) {
        return Err(odd_blocks());
    }
    check_blocks(chunk, cursor, nbytes, block_bytes, flags & FLAG_UNSPLIT == 0, type_bytes)
}

/// Validates the table of block starts, and the chain of split sizes in each block.
fn check_blocks(
    chunk: &[u8],
    mut table: Cursor,
    nbytes: usize,
    block_bytes: usize,
    may_split: bool,
    type_bytes: usize,
) -> Result<(), Fault> {
    let blocks = nbytes.div_ceil(block_bytes);
    let data_start = HEADER_BYTES as u64 + 4 * blocks as u64;
    for block in 0..blocks {
        let start = u64::from(table.u32()?);
        if start < data_start {
            return Err(Fault::invalid(None, format!("Blosc block {block} starts at byte {start}")));
        }
        let is_whole = (block + 1) * block_bytes <= nbytes;
        let splits = if may_split
            && is_whole
            && type_bytes <= MAX_SPLITS
            && block_bytes / type_bytes >= MIN_SPLIT_VALUES
        {
            type_bytes
        } else {
            1
        };
        let mut data = Cursor::window(chunk, start, chunk.len() as u64)?;
        for _ in 0..splits {
            let len = data.u32()? as usize;
            data.take(len)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A chunk of `nbytes` with one block and one split of `packed` bytes of payload.
    fn chunk(nbytes: u32, packed: u32) -> Vec<u8> {
        let mut bytes = vec![FORMAT_VERSION, 1, FLAG_SHUFFLE | FLAG_UNSPLIT | CODEC_LZ4 << CODEC_SHIFT, 4];
        for word in [nbytes, nbytes, 24 + packed, 20, packed] {
            bytes.extend(word.to_le_bytes());
        }
        bytes.extend(vec![0; packed as usize]);
        bytes
    }

    #[test]
    fn valid_chunk_passes() {
        assert!(check(&chunk(2048, 100), 2048).is_ok());
    }

    #[test]
    fn stored_chunk_may_be_smaller_than_a_value() {
        let mut bytes = vec![FORMAT_VERSION, 1, FLAG_SHUFFLE | FLAG_STORED, 4];
        for word in [2_u32, 1, 18] {
            bytes.extend(word.to_le_bytes());
        }
        bytes.extend([0; 2]);
        assert!(check(&bytes, 2).is_ok());
        bytes.push(0);
        assert!(check(&bytes, 2).is_err());
    }

    #[test]
    fn every_wrong_header_field_is_detected() {
        let sound = chunk(2048, 100);
        assert!(check(&sound, 1024).is_err(), "unpacked size");
        assert!(check(&sound[..80], 2048).is_err(), "truncated");
        assert!(check(&sound[..15], 2048).is_err(), "short header");
        for (byte, value) in [(0, 1), (1, 9), (2, 0x04), (2, 0x71), (3, 0), (5, 0), (9, 0x10), (12, 1)] {
            let mut lie = sound.clone();
            lie[byte] = value;
            assert!(check(&lie, 2048).is_err(), "byte {byte} = {value}");
        }
        for (byte, value) in [(16, 19), (16, 200), (20, 101), (23, 0xff)] {
            let mut lie = sound.clone();
            lie[byte] = value;
            assert!(check(&lie, 2048).is_err(), "table byte {byte} = {value}");
        }
    }
}
