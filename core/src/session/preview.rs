//! Coarse preview with one path per block of pixels, discarded afterwards.

use super::pass::Work;
use rayon::prelude::*;

/// Sample number beyond those of any film: a preview shares no random numbers with the estimate.
const PREVIEW_SAMPLE: u64 = u64::MAX;

/// Renders one path at the middle of every `stride × stride` block and fills the block with it. Returns
/// `None` if it was cancelled.
pub(super) fn render(work: &Work, stride: usize) -> Option<Vec<[f32; 3]>> {
    let (width, height) = (work.probe.scene.width as usize, work.probe.scene.height as usize);
    let mut image = vec![[0.0f32; 3]; width * height];
    if image.is_empty() {
        return Some(image);
    }
    let bands = image.par_chunks_mut(width * stride).enumerate().with_max_len(1);
    let done = bands.try_for_each(|(band, rows)| {
        let y = (band * stride + stride / 2).min(height - 1);
        for left in (0..width).step_by(stride) {
            let x = (left + stride / 2).min(width - 1);
            let rgb = work.path(x, y, PREVIEW_SAMPLE).rgb;
            if !work.cancel.is_active() {
                return None;
            }
            // Non-finite values are shown as they are.
            let value = rgb.to_array();
            for row in rows.chunks_mut(width) {
                row[left..(left + stride).min(width)].fill(value);
            }
        }
        Some(())
    });
    done.map(|()| image)
}
