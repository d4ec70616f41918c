//! Memory for large arrays, in huge pages where the system has them.
//!
//! Look-ups access a grid at random. In pages of 4 KiB nearly every look-up misses the TLB once a grid is
//! larger than a few megabytes; in pages of 2 MiB hardly any does.

use bytemuck::Pod;
use memmap2::MmapMut;
use std::marker::PhantomData;
use std::ops::Deref;
use std::sync::Arc;

/// Minimum size in bytes of values that get their own pages.
const LARGE: usize = 8 << 20;

/// Immutable values.
#[derive(Clone, Debug)]
pub(super) enum Pages<T> {
    /// On the heap.
    Heap(Arc<[T]>),
    /// In separate pages, with the number of values.
    Own(Arc<MmapMut>, usize, PhantomData<T>),
}

impl<T: Pod + Send + Sync> From<Vec<T>> for Pages<T> {
    fn from(values: Vec<T>) -> Self {
        let bytes = size_of_val(&values[..]);
        match Self::own(&values) {
            Some(pages) if bytes >= LARGE => pages,
            _ => Self::Heap(values.into()),
        }
    }
}

impl<T: Pod> Pages<T> {
    /// Copies values to separate pages; `None` if the system cannot allocate them.
    fn own(values: &[T]) -> Option<Self> {
        let bytes: &[u8] = bytemuck::cast_slice(values);
        let mut map = MmapMut::map_anon(bytes.len()).ok()?;
        #[cfg(target_os = "linux")]
        {
            // Fails where huge pages are disabled; small pages work as well.
            let _ = map.advise(memmap2::Advice::HugePage);
        }
        map.copy_from_slice(bytes);
        Some(Self::Own(Arc::new(map), values.len(), PhantomData))
    }
}

impl<T: Pod> Deref for Pages<T> {
    type Target = [T];

    #[inline]
    fn deref(&self) -> &[T] {
        match self {
            Self::Heap(values) => values,
            Self::Own(map, count, _) => &bytemuck::cast_slice(&map[..])[..*count],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_the_same_in_any_pages() {
        let values: Vec<[f32; 3]> = (0..LARGE / 12 + 7).map(|i| [i as f32, 1.0, -2.0]).collect();
        let large = Pages::from(values.clone());
        assert!(matches!(large, Pages::Own(..)) && large[..] == values[..]);
        let small = Pages::from(values[..1000].to_vec());
        assert!(matches!(small, Pages::Heap(_)) && small[..] == values[..1000]);
    }
}
