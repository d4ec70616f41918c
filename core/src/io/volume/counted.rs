//! A reader that reports its progress.

use std::io::{Read, Result, Seek, SeekFrom};

/// Bytes between two reports.
const EVERY: u64 = 64 * 1024;

/// Forwards reads and reports to `watch` the fraction of `length` bytes that has been read.
pub(super) struct Counted<'a, R> {
    reader: R,
    at: u64,
    told: u64,
    length: u64,
    watch: &'a dyn Fn(f64),
}

impl<'a, R> Counted<'a, R> {
    /// Wraps a reader at its beginning.
    pub fn new(reader: R, length: usize, watch: &'a dyn Fn(f64)) -> Self {
        Self { reader, at: 0, told: 0, length: length.max(1) as u64, watch }
    }
}

impl<R: Read> Read for Counted<'_, R> {
    fn read(&mut self, buffer: &mut [u8]) -> Result<usize> {
        let read = self.reader.read(buffer)?;
        self.at += read as u64;
        if self.at >= self.told + EVERY || self.at == self.length {
            self.told = self.at;
            (self.watch)(self.at as f64 / self.length as f64);
        }
        Ok(read)
    }
}

impl<R: Seek> Seek for Counted<'_, R> {
    fn seek(&mut self, to: SeekFrom) -> Result<u64> {
        self.at = self.reader.seek(to)?;
        Ok(self.at)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::RefCell;
    use std::io::Cursor;

    #[test]
    fn shares_rise_to_one() {
        let told = RefCell::new(Vec::new());
        let watch = |share| told.borrow_mut().push(share);
        let bytes = vec![7u8; 300_000];
        let mut reader = Counted::new(Cursor::new(&bytes), bytes.len(), &watch);
        let mut read = Vec::new();
        reader.read_to_end(&mut read).unwrap();
        assert_eq!(read, bytes);
        let told = told.borrow();
        assert!(told.len() > 2 && told.windows(2).all(|pair| pair[0] <= pair[1]), "{told:?}");
        assert_eq!(told.last(), Some(&1.0));
    }
}
