//! Edge and point features, whose appearance and disappearance is noticed.

use super::kernel::{Kernel, PIXELS_PER_DEGREE};

/// Width of the detected features, degrees (Andersson et al. 2020, section 4.2).
const WIDTH: f32 = 0.082;

/// A Gaussian and its first and second derivative. Edges and points are detected by a derivative along one
/// axis and the Gaussian along the other.
pub(super) fn kernels() -> [Kernel; 3] {
    let sigma = 0.5 * WIDTH * PIXELS_PER_DEGREE;
    let radius = (3.0 * sigma).ceil() as usize;
    let gaussian = |x: f32| (-(x * x) / (2.0 * sigma * sigma)).exp();
    let blur = Kernel::sampled(radius, gaussian);
    let sum = blur.sum();
    [
        blur.scaled(1.0 / sum),
        Kernel::sampled(radius, |x| -x * gaussian(x)).balanced(),
        Kernel::sampled(radius, |x| (x * x / (sigma * sigma) - 1.0) * gaussian(x)).balanced(),
    ]
}

/// Edge and point responses of one pixel along x and y.
#[derive(Clone, Copy)]
pub(super) struct Features {
    pub edge: [f32; 2],
    pub point: [f32; 2],
}

/// ΔE_f = √(max(|Δ‖edge‖|, |Δ‖point‖|)/√2), from 0 to 1 (Andersson et al. 2020, equation 6).
#[inline]
pub(super) fn difference(p: Features, q: Features) -> f32 {
    let length = |[x, y]: [f32; 2]| (x * x + y * y).sqrt();
    let edge = (length(p.edge) - length(q.edge)).abs();
    let point = (length(p.point) - length(q.point)).abs();
    (std::f32::consts::FRAC_1_SQRT_2 * edge.max(point)).sqrt()
}
