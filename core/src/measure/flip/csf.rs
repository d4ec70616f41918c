//! Contrast sensitivity functions: filters of lightness and the two opponent colours.

use std::f32::consts::PI;

use super::kernel::{Kernel, PIXELS_PER_DEGREE};

/// Amplitude and width (degrees²) of the Gaussians of Andersson et al. (2020), table 1: achromatic,
/// red–green.
const NARROW: [[f32; 2]; 2] = [[1.0, 0.0047], [1.0, 0.0053]];
/// The two Gaussians whose sum is the filter of blue–yellow.
const BLUE_YELLOW: [[f32; 2]; 2] = [[34.1, 0.04], [13.5, 0.025]];

/// Filters of Y, Cx and, as a sum of two, Cz. Applied along x and then along y, each equals the paper's
/// filter.
pub(super) fn kernels() -> [Kernel; 4] {
    let widest = BLUE_YELLOW[0][1];
    let radius = (3.0 * (widest / (2.0 * (PI * PI))).sqrt() * PIXELS_PER_DEGREE).ceil() as usize;
    let gaussian = |amplitude: f32, width: f32| {
        Kernel::sampled(radius, |x| {
            let degrees = x * (1.0 / PIXELS_PER_DEGREE);
            amplitude * (-(PI * PI) * (degrees * degrees) / width).exp()
        })
    };
    let [lightness, red_green] = NARROW.map(|[_, width]| {
        let kernel = gaussian(1.0, width);
        let sum = kernel.sum();
        kernel.scaled(1.0 / sum)
    });
    // Each is applied twice, so its amplitude is the square root of a√(π/b).
    let [first, second] = BLUE_YELLOW.map(|[a, b]| gaussian((a * (PI / b).sqrt()).sqrt(), b));
    let total = (first.sum().powi(2) + second.sum().powi(2)).sqrt();
    [lightness, red_green, first.scaled(1.0 / total), second.scaled(1.0 / total)].map(Kernel::trimmed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uniform_images_are_unchanged() {
        let [lightness, red_green, first, second] = kernels();
        for weight in [lightness.sum(), red_green.sum(), first.sum().powi(2) + second.sum().powi(2)] {
            assert!((weight - 1.0).abs() < 1e-6, "{weight}");
        }
        // 3σ of the widest, σ = √(0.04/2π²)° = 3.02 pixels; the lightness filter is three times as narrow.
        assert_eq!(first.radius(), 10);
        assert!(lightness.radius() < 8);
    }
}
