//! Pinhole camera.

use super::CameraDoc;
use crate::math::Ray;
use glam::{Vec2, Vec3};

/// Pinhole camera with a film of a given size.
///
/// The ray through continuous pixel coordinates (x right, y down) has direction
/// `normalize((2x/W − 1)·tan(fov/2)·right + (1 − 2y/H)·tan(fov/2)·(H/W)·up + forward)`, with −right in a
/// mirrored camera.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    origin: Vec3,
    forward: Vec3,
    /// Half the film's width along `right`, at distance 1.
    right: Vec3,
    up: Vec3,
    pixels_to_film: Vec2,
}

impl Camera {
    /// Freezes an edited camera for a film of `width × height` pixels.
    #[must_use]
    pub fn new(doc: &CameraDoc, width: u32, height: u32) -> Self {
        let origin = Vec3::from(doc.origin);
        let forward = (Vec3::from(doc.target) - origin).normalize();
        let sideways = forward.cross(Vec3::from(doc.up).normalize());
        let right = if sideways.length_squared() > 1e-12 {
            sideways.normalize()
        } else {
            forward.any_orthonormal_vector()
        };
        let tan = (0.5 * doc.fov_deg.to_radians()).tan();
        let (w, h) = (width as f32, height as f32);
        Self {
            origin,
            forward,
            right: if doc.mirror { -right * tan } else { right * tan },
            up: right.cross(forward) * (tan * h / w),
            pixels_to_film: Vec2::new(2.0 / w, 2.0 / h),
        }
    }

    /// Position of the pinhole.
    #[must_use]
    pub fn origin(&self) -> Vec3 {
        self.origin
    }

    /// Film position of a world point, in pixels; `None` behind the camera.
    #[must_use]
    pub fn pixel_of(&self, point: Vec3) -> Option<Vec2> {
        let to_point = point - self.origin;
        let depth = to_point.dot(self.forward);
        if depth <= 1e-6 * to_point.length() {
            return None;
        }
        let x = to_point.dot(self.right) / (depth * self.right.length_squared());
        let y = -to_point.dot(self.up) / (depth * self.up.length_squared());
        Some((Vec2::new(x, y) + Vec2::ONE) / self.pixels_to_film)
    }

    /// Ray through a point of the film, in pixels.
    #[must_use]
    pub fn ray(&self, pixel: Vec2) -> Ray {
        let s = pixel * self.pixels_to_film - Vec2::ONE;
        let direction = (self.right * s.x - self.up * s.y + self.forward).normalize();
        Ray { origin: self.origin, direction }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rays_agree_with_an_independent_renderer() {
        // Oracle scene S1, `check_rays`.
        let doc =
            CameraDoc { origin: [1.6, 1.1, -2.4], target: [0.0; 3], fov_deg: 32.0, ..CameraDoc::default() };
        let camera = Camera::new(&doc, 128, 128);
        for (pixel, direction) in [
            ([0.0, 0.0], [-0.311_724_66, -0.081_921_36, 0.946_634_4]),
            ([128.0, 0.0], [-0.753_922_2, -0.081_921_36, 0.651_836]),
            ([10.5, 100.25], [-0.275_432_5, -0.488_033_3, 0.828_227_1]),
        ] {
            let ray = camera.ray(Vec2::from(pixel));
            assert!((ray.direction - Vec3::from(direction)).length() < 1e-6, "{}", ray.direction);
            let seen = camera.pixel_of(ray.at(3.7)).expect("it lies in front");
            assert!((seen - Vec2::from(pixel)).length() < 1e-2, "{seen}");
            assert!(camera.pixel_of(ray.at(-3.7)).is_none());
        }
    }

    #[test]
    fn a_mirrored_camera_exchanges_left_and_right() {
        let doc = CameraDoc { origin: [1.6, 1.1, -2.4], fov_deg: 32.0, ..CameraDoc::default() };
        let [plain, mirrored] =
            [false, true].map(|mirror| Camera::new(&CameraDoc { mirror, ..doc.clone() }, 120, 80));
        let ray = mirrored.ray(Vec2::new(30.0, 7.0));
        assert!((ray.direction - plain.ray(Vec2::new(90.0, 7.0)).direction).length() < 1e-6);
        let seen = mirrored.pixel_of(ray.at(2.0)).expect("it lies in front");
        assert!((seen - Vec2::new(30.0, 7.0)).length() < 1e-3);
    }
}
