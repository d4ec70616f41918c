//! Damaged copies of files, identical in every run.

/// Random number generator SplitMix64 (Steele et al. 2014).
pub struct SplitMix64(pub u64);

impl SplitMix64 {
    pub fn next_u64(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Returns a number below `n`.
    pub fn below(&mut self, n: usize) -> usize {
        (self.next_u64() % n as u64) as usize
    }
}

/// `count` prefixes of the file, half of them within the first 4 KiB (headers).
pub fn truncations(bytes: &[u8], count: usize, seed: u64) -> impl Iterator<Item = Vec<u8>> + '_ {
    let mut random = SplitMix64(seed);
    (0..count).map(move |i| {
        let range = if i % 2 == 0 { bytes.len().min(4096) } else { bytes.len() };
        bytes[..random.below(range)].to_vec()
    })
}

/// `count` copies with one changed byte, half of them within the first 4 KiB.
pub fn byte_flips(bytes: &[u8], count: usize, seed: u64) -> impl Iterator<Item = Vec<u8>> + '_ {
    let mut random = SplitMix64(seed);
    (0..count).map(move |i| {
        let range = if i % 2 == 0 { bytes.len().min(4096) } else { bytes.len() };
        let mut copy = bytes.to_vec();
        copy[random.below(range)] ^= 1 + random.below(255) as u8;
        copy
    })
}

/// `count` copies with one changed byte in the header of a Blosc chunk: sizes, flags, block table and split
/// sizes, to which decoders are most sensitive. Chunks are found by pattern.
pub fn blosc_flips(bytes: &[u8], count: usize, seed: u64) -> impl Iterator<Item = Vec<u8>> + '_ {
    let heads: Vec<usize> = (0..bytes.len().saturating_sub(32))
        .filter(|&i| matches!(bytes[i..i + 4], [2, 1, _, 2 | 4 | 6 | 12]))
        .collect();
    let mut random = SplitMix64(seed);
    (0..count.min(count * heads.len())).map(move |_| {
        let mut copy = bytes.to_vec();
        copy[heads[random.below(heads.len())] + random.below(32)] ^= 1 + random.below(255) as u8;
        copy
    })
}
