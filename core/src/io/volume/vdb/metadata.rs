//! Named, typed metadata values of the file and of each grid.
//!
//! Layout after `openvdb/MetaMap.cc`: a count, then name, type, length in bytes, value.

use std::collections::BTreeMap;

use super::super::cursor::Cursor;
use super::super::error::Fault;

/// Metadata entries; values are decoded on access.
#[derive(Debug, Clone, Default)]
pub(super) struct Metadata<'a> {
    entries: BTreeMap<String, (String, &'a [u8])>,
}

impl<'a> Metadata<'a> {
    pub(super) fn read(cursor: &mut Cursor<'a>) -> Result<Self, Fault> {
        let count = cursor.u32()?;
        let mut entries = BTreeMap::new();
        // No memory is reserved for `count`: a wrong count reaches the end of the file.
        for _ in 0..count {
            let (name, kind) = (cursor.text()?, cursor.text()?);
            let len = cursor.u32()? as usize;
            entries.insert(name, (kind, cursor.take(len)?));
        }
        Ok(Self { entries })
    }

    /// Bytes of an entry with this name and type.
    fn get(&self, name: &str, kind: &str) -> Option<Cursor<'a>> {
        let (actual, bytes) = self.entries.get(name)?;
        (actual == kind).then(|| Cursor::new(bytes))
    }

    pub(super) fn text(&self, name: &str) -> Option<String> {
        let mut cursor = self.get(name, "string")?;
        let bytes = cursor.take(cursor.remaining()).ok()?;
        Some(String::from_utf8_lossy(bytes).into_owned())
    }

    pub(super) fn boolean(&self, name: &str) -> Option<bool> {
        self.get(name, "bool")?.u8().ok().map(|byte| byte != 0)
    }

    pub(super) fn int64(&self, name: &str) -> Option<i64> {
        self.get(name, "int64")?.i64().ok()
    }

    pub(super) fn vec3i(&self, name: &str) -> Option<[i32; 3]> {
        self.get(name, "vec3i")?.i32x3().ok()
    }
}
