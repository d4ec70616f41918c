//! Orbit, pan and dolly: pure functions of a camera and a gesture.

use glam::{Quat, Vec3};
use majorant_core::scene::CameraDoc;

/// Minimum angle between view direction and up axis, degrees: the orientation is undefined at the pole.
const POLE_DEG: f32 = 2.0;

/// Orbits the camera about its target by `dx` and `dy` half turns (turntable): a drag across the full width
/// of the image is half a turn.
#[must_use]
pub fn orbit(camera: &CameraDoc, dx: f32, dy: f32) -> CameraDoc {
    let Some((offset, up)) = offset_and_up(camera) else { return camera.clone() };
    let dx = if camera.mirror { -dx } else { dx };
    let turned = Quat::from_axis_angle(up, -dx * std::f32::consts::PI) * offset;
    let polar = turned.angle_between(up);
    let limit = POLE_DEG.to_radians();
    let wanted = (polar - dy * std::f32::consts::PI).clamp(limit, std::f32::consts::PI - limit);
    let right = up.cross(turned).normalize_or(up.any_orthonormal_vector());
    let lifted = Quat::from_axis_angle(right, wanted - polar) * turned;
    CameraDoc { origin: (Vec3::from(camera.target) + lifted).into(), ..camera.clone() }
}

/// Translates camera and target so that the plane through the target follows the pointer;
/// `dx` and `dy` are fractions of the image's width.
#[must_use]
pub fn pan(camera: &CameraDoc, dx: f32, dy: f32) -> CameraDoc {
    let Some((offset, up)) = offset_and_up(camera) else { return camera.clone() };
    let dx = if camera.mirror { -dx } else { dx };
    let width = 2.0 * offset.length() * (0.5 * camera.fov_deg.to_radians()).tan();
    let right = up.cross(offset).normalize_or(up.any_orthonormal_vector());
    let screen_up = offset.cross(right).normalize_or(up);
    let shift = (screen_up * dy - right * dx) * width;
    CameraDoc {
        origin: (Vec3::from(camera.origin) + shift).into(),
        target: (Vec3::from(camera.target) + shift).into(),
        ..camera.clone()
    }
}

/// Multiplies the distance to the target by `factor`: below 1 the camera moves closer.
#[must_use]
pub fn dolly(camera: &CameraDoc, factor: f32) -> CameraDoc {
    let target = Vec3::from(camera.target);
    let offset = (Vec3::from(camera.origin) - target) * factor;
    // At the target the view direction would be undefined.
    if !offset.is_finite() || offset.length() < 1e-4 {
        return camera.clone();
    }
    CameraDoc { origin: (target + offset).into(), ..camera.clone() }
}

/// Vector from target to camera, and the unit up axis; `None` for a degenerate camera.
fn offset_and_up(camera: &CameraDoc) -> Option<(Vec3, Vec3)> {
    let offset = Vec3::from(camera.origin) - Vec3::from(camera.target);
    let up = Vec3::from(camera.up).try_normalize()?;
    (offset.length() > 0.0 && offset.is_finite()).then_some((offset, up))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn distance(camera: &CameraDoc) -> f32 {
        Vec3::from(camera.origin).distance(Vec3::from(camera.target))
    }

    #[test]
    fn orbit_keeps_target_and_distance() {
        let camera = CameraDoc::default();
        let turned = orbit(&camera, 0.3, -0.1);
        assert_eq!(turned.target, camera.target);
        assert!((distance(&turned) - distance(&camera)).abs() < 1e-4);
        let half = orbit(&camera, 1.0, 0.0);
        assert!(Vec3::from(half.origin).distance(Vec3::new(0.0, 0.0, -3.0)) < 1e-4);
    }

    #[test]
    fn dragging_right_turns_the_scene_right_and_down_shows_its_top() {
        let camera = CameraDoc::default();
        assert!(orbit(&camera, 0.1, 0.0).origin[0] < 0.0);
        assert!(orbit(&camera, 0.0, 0.1).origin[1] > 0.0);
    }

    #[test]
    fn orbit_stops_before_the_pole() {
        let mut camera = CameraDoc::default();
        for _ in 0..20 {
            camera = orbit(&camera, 0.0, 0.3);
        }
        let elevation = (camera.origin[1] / distance(&camera)).asin().to_degrees();
        assert!((elevation - 88.0).abs() < 0.1, "{elevation}");
    }

    #[test]
    fn pan_follows_the_pointer() {
        let camera = CameraDoc::default();
        let moved = pan(&camera, 1.0, 0.0);
        // A drag by the full width moves the scene by the visible width at the target.
        let width = 2.0 * 3.0 * (17.5_f32.to_radians()).tan();
        assert!((moved.target[0] + width).abs() < 1e-4);
        assert!((distance(&moved) - 3.0).abs() < 1e-5);
        assert!(pan(&camera, 0.0, 0.5).target[1] > 0.0);
    }

    #[test]
    fn dolly_scales_the_distance_and_never_arrives() {
        let camera = CameraDoc::default();
        assert!((distance(&dolly(&camera, 0.5)) - 1.5).abs() < 1e-6);
        assert_eq!(dolly(&camera, 0.0), camera);
        assert_eq!(dolly(&camera, f32::NAN), camera);
    }

    #[test]
    fn a_degenerate_camera_is_left_alone() {
        let camera = CameraDoc { origin: [0.0; 3], ..CameraDoc::default() };
        assert_eq!(orbit(&camera, 0.1, 0.1), camera);
        assert_eq!(pan(&camera, 0.1, 0.1), camera);
    }
}
