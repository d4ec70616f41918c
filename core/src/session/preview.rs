//! A coarse picture for the eye: one path per block of pixels, thrown away afterwards.

use super::pass::StillWanted;
use crate::estimator::{Kernel, Settings};
use crate::scene::Scene;
use rayon::prelude::*;

/// Renders one path at the middle of every `stride × stride` block and spreads it over the block;
/// `None` if it was cancelled. Sample numbers beyond any film's keep it apart from the estimate.
pub(super) fn render(
    scene: &Scene,
    kernel: Kernel,
    settings: &Settings,
    stride: usize,
    wanted: &StillWanted,
) -> Option<Vec<[f32; 3]>> {
    let (width, height) = (scene.width as usize, scene.height as usize);
    let mut image = vec![[0.0f32; 3]; width * height];
    let done =
        image.par_chunks_mut(width * stride).enumerate().with_max_len(1).try_for_each(|(band, rows)| {
            if !wanted.yes() {
                return None;
            }
            let y = (band * stride + stride / 2).min(height - 1);
            for left in (0..width).step_by(stride) {
                let x = (left + stride / 2).min(width - 1);
                let rgb = kernel(scene, settings, x as u32, y as u32, u64::MAX - 1).rgb;
                let value = if rgb.is_finite() { rgb.to_array() } else { [0.0; 3] };
                for row in rows.chunks_mut(width) {
                    let right = (left + stride).min(width);
                    row[left..right].fill(value);
                }
            }
            Some(())
        });
    done.map(|()| image)
}
