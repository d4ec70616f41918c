//! Bit masks of tree nodes: one bit per child or voxel, x slowest, z fastest.

/// Number of set bits.
pub(super) fn count_ones(words: &[u64]) -> usize {
    words.iter().map(|word| word.count_ones() as usize).sum()
}

/// Positions of the set bits, in ascending order.
pub(super) fn ones(words: &[u64]) -> impl Iterator<Item = usize> + '_ {
    words.iter().enumerate().flat_map(|(index, &word)| {
        std::iter::successors((word != 0).then_some(word), |&rest| {
            let rest = rest & (rest - 1);
            (rest != 0).then_some(rest)
        })
        .map(move |rest| 64 * index + rest.trailing_zeros() as usize)
    })
}

/// Offset of entry `index` of a node with 2^`log2_dim` entries of size `edge` per axis.
pub(super) fn entry_offset(index: usize, log2_dim: u32, edge: i32) -> [i32; 3] {
    let low = (1 << log2_dim) - 1;
    [index >> (2 * log2_dim), (index >> log2_dim) & low, index & low].map(|n| n as i32 * edge)
}

/// Component-wise sum. Node origins are validated so that no voxel exceeds the range of i32.
pub(super) fn add(a: [i32; 3], b: [i32; 3]) -> [i32; 3] {
    [a[0].saturating_add(b[0]), a[1].saturating_add(b[1]), a[2].saturating_add(b[2])]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ones_lists_set_bits_in_order() {
        let words = [1 | 1 << 63, 0, 1 << 5];
        assert_eq!(ones(&words).collect::<Vec<_>>(), [0, 63, 133]);
        assert_eq!(count_ones(&words), 3);
    }

    #[test]
    fn z_is_fastest() {
        assert_eq!(entry_offset(1, 3, 1), [0, 0, 1]);
        assert_eq!(entry_offset(8, 3, 1), [0, 1, 0]);
        assert_eq!(entry_offset(64, 3, 1), [1, 0, 0]);
        assert_eq!(entry_offset(16 * 16, 4, 8), [8, 0, 0]);
    }
}
