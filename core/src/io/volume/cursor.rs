//! A bounded little-endian reader; no read leaves its window, and every error states its position.

use super::error::Fault;

/// Maximum length of a name or text in bytes. Real ones are below 100; a damaged length is not.
const MAX_TEXT_BYTES: usize = 1 << 16;

/// Sequential reader of `bytes[position..end]`.
#[derive(Debug, Clone)]
pub(super) struct Cursor<'a> {
    bytes: &'a [u8],
    position: usize,
}

impl<'a> Cursor<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, position: 0 }
    }

    /// Cursor at `start` that cannot pass `end`; offsets remain those of the whole file.
    pub(super) fn window(bytes: &'a [u8], start: u64, end: u64) -> Result<Self, Fault> {
        let window = usize::try_from(start).ok().zip(usize::try_from(end).ok());
        match window {
            Some((start, end)) if start <= end && end <= bytes.len() => {
                Ok(Self { bytes: &bytes[..end], position: start })
            }
            _ => Err(Fault::invalid(
                None,
                format!("bytes {start} to {end} of a file of {} bytes", bytes.len()),
            )),
        }
    }

    /// Offset from the start of the file, in bytes.
    pub(super) fn position(&self) -> u64 {
        self.position as u64
    }

    /// Bytes left in the window.
    pub(super) fn remaining(&self) -> usize {
        self.bytes.len() - self.position
    }

    /// Reads the next `len` bytes.
    pub(super) fn take(&mut self, len: usize) -> Result<&'a [u8], Fault> {
        if len > self.remaining() {
            return Err(Fault::invalid(
                self.position(),
                format!("{len} bytes expected, but only {} are left", self.remaining()),
            ));
        }
        let taken = &self.bytes[self.position..self.position + len];
        self.position += len;
        Ok(taken)
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], Fault> {
        let mut array = [0; N];
        array.copy_from_slice(self.take(N)?);
        Ok(array)
    }

    pub(super) fn u8(&mut self) -> Result<u8, Fault> {
        Ok(self.array::<1>()?[0])
    }

    pub(super) fn u16(&mut self) -> Result<u16, Fault> {
        Ok(u16::from_le_bytes(self.array()?))
    }

    pub(super) fn u32(&mut self) -> Result<u32, Fault> {
        Ok(u32::from_le_bytes(self.array()?))
    }

    pub(super) fn i32(&mut self) -> Result<i32, Fault> {
        Ok(i32::from_le_bytes(self.array()?))
    }

    pub(super) fn u64(&mut self) -> Result<u64, Fault> {
        Ok(u64::from_le_bytes(self.array()?))
    }

    pub(super) fn i64(&mut self) -> Result<i64, Fault> {
        Ok(i64::from_le_bytes(self.array()?))
    }

    pub(super) fn f32(&mut self) -> Result<f32, Fault> {
        Ok(f32::from_le_bytes(self.array()?))
    }

    pub(super) fn f64(&mut self) -> Result<f64, Fault> {
        Ok(f64::from_le_bytes(self.array()?))
    }

    pub(super) fn i32x3(&mut self) -> Result<[i32; 3], Fault> {
        Ok([self.i32()?, self.i32()?, self.i32()?])
    }

    /// Reads `N` 64-bit words.
    pub(super) fn words<const N: usize>(&mut self) -> Result<[u64; N], Fault> {
        let mut words = [0; N];
        for (word, bytes) in words.iter_mut().zip(self.take(8 * N)?.chunks_exact(8)) {
            for (shift, &byte) in bytes.iter().enumerate() {
                *word |= u64::from(byte) << (8 * shift);
            }
        }
        Ok(words)
    }

    /// Reads a length-prefixed text, as written by OpenVDB. Invalid UTF-8 is replaced.
    pub(super) fn text(&mut self) -> Result<String, Fault> {
        let start = self.position();
        let len = self.u32()? as usize;
        if len > MAX_TEXT_BYTES {
            return Err(Fault::invalid(start, format!("a name of {len} bytes")));
        }
        Ok(String::from_utf8_lossy(self.take(len)?).into_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn window_is_never_left() {
        let bytes: Vec<u8> = (0..10).collect();
        let mut cursor = Cursor::window(&bytes, 2, 7).unwrap();
        assert_eq!(cursor.u32().unwrap(), 0x0504_0302);
        assert_eq!(cursor.position(), 6);
        assert!(cursor.u32().is_err(), "one byte is left in the window");
        assert_eq!(cursor.u8().unwrap(), 6);
        assert!(Cursor::window(&bytes, 3, 11).is_err());
        assert!(Cursor::window(&bytes, 8, 7).is_err());
    }

    #[test]
    fn absurd_text_length_is_refused() {
        let bytes = [0xff; 16];
        assert!(Cursor::new(&bytes).text().is_err());
    }
}
