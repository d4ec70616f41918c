//! Sector of directions that covers a light: a range of angles from an axis and of azimuths about it.

use super::{Light, LightKind};
use crate::math::Frame;
use crate::surface::{Disk, Rectangle};
use glam::Vec3;
use std::f32::consts::{FRAC_PI_2, PI, TAU};

/// Relative margin for rounding, so that no direction to the light falls outside.
const ROOM: f32 = 1e-4;

/// Directions at an angle θ from an axis with near ≤ 1 − cos θ ≤ near + depth, within a range of azimuths.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sector {
    /// 1 − cos θ at the start.
    pub near: f32,
    /// Range of 1 − cos θ.
    pub depth: f32,
    /// First azimuth, in turns.
    pub start: f32,
    /// Range of azimuths, in turns.
    pub turns: f32,
}

impl Sector {
    /// Every direction.
    pub const ALL: Self = Self { near: 0.0, depth: 2.0, start: -0.5, turns: 1.0 };

    /// 1 if the sector contains a direction, given by its 1 − cos θ and its coordinates in the frame; else 0.
    pub fn holds(&self, s: f32, local: Vec3) -> f32 {
        let beyond = s - self.near;
        let after = local.y.atan2(local.x) / TAU - self.start;
        let inside = beyond >= 0.0 && beyond <= self.depth && after - after.floor() <= self.turns;
        f32::from(inside)
    }

    fn new(near: f32, far: f32, start_rad: f32, range_rad: f32) -> Self {
        let near = near * (1.0 - ROOM);
        let turns = range_rad / TAU;
        Self {
            near,
            depth: (far * (1.0 + ROOM)).min(2.0) - near,
            start: start_rad / TAU - ROOM * turns,
            turns: (turns * (1.0 + 2.0 * ROOM)).min(1.0),
        }
    }

    /// Sector of a disc of directions about the unit vector `toward`, in coordinates of the frame. The half
    /// angle is given with its sine, and is less than a right angle.
    fn of_disc(toward: Vec3, sin_half: f32, half: f32) -> Self {
        let off_axis = toward.x.hypot(toward.y);
        let angle = off_axis.atan2(toward.z);
        let one_minus_cos = |angle: f32| 2.0 * (0.5 * angle).sin().powi(2);
        let (near, far) = (one_minus_cos((angle - half).max(0.0)), one_minus_cos((angle + half).min(PI)));
        if angle <= half || angle + half >= PI {
            return Self::new(near, far, -PI, TAU);
        }
        let aside = (sin_half / off_axis).min(1.0).asin();
        Self::new(near, far, toward.y.atan2(toward.x) - aside, 2.0 * aside)
    }

    /// Sector of a rectangle whose corners are given in order, in coordinates of a frame at the viewpoint.
    fn of_corners(corners: &[Vec3; 4]) -> Self {
        let edges = || corners.iter().zip(corners.iter().cycle().skip(1)).map(|(a, b)| (*a, *b));
        // Azimuths: the full circle if the axis passes through, else less than half a turn, between two
        // corners.
        let side = |a: Vec3, b: Vec3| a.x * b.y - a.y * b.x;
        let about = edges().all(|(a, b)| side(a, b) >= 0.0) || edges().all(|(a, b)| side(a, b) <= 0.0);
        // A corner on the axis itself has no azimuth.
        let off_axis = |c: &Vec3| c.x * c.x + c.y * c.y;
        let any =
            corners.iter().copied().fold(corners[0], |a, b| if off_axis(&b) > off_axis(&a) { b } else { a });
        let (mut first, mut last) = (any, any);
        for corner in corners {
            if side(first, *corner) < 0.0 {
                first = *corner;
            }
            if side(last, *corner) > 0.0 {
                last = *corner;
            }
        }
        // Angles: extremes are at corners, inside edges, or on the axis if it passes through.
        let (mut near, mut far) = (2.0f32, 0.0f32);
        for (a, b) in edges() {
            let turns_round = turning_point(a, b - a).map(|t| one_minus_cos(a + (b - a) * t));
            for s in [Some(one_minus_cos(a)), turns_round].into_iter().flatten() {
                (near, far) = (near.min(s), far.max(s));
            }
        }
        if about {
            let normal = (corners[1] - corners[0]).cross(corners[2] - corners[1]);
            let ahead = corners[0].dot(normal) * normal.z > 0.0;
            (near, far) = if ahead { (0.0, far) } else { (near, 2.0) };
            return Self::new(near, far, -PI, TAU);
        }
        let range = side(first, last).atan2(first.x * last.x + first.y * last.y);
        Self::new(near, far, first.y.atan2(first.x), range)
    }
}

/// 1 − cos of the angle between a vector and the axis, without cancellation.
fn one_minus_cos(v: Vec3) -> f32 {
    let length = v.length();
    if v.z > 0.0 { (v.x * v.x + v.y * v.y) / (length * (length + v.z)) } else { 1.0 - v.z / length }
}

/// Parameter t on `from` + t `edge`, 0 < t < 1, at which the angle to the axis has an extremum.
fn turning_point(from: Vec3, edge: Vec3) -> Option<f32> {
    let along = from.dot(edge);
    let t =
        (edge.z * from.length_squared() - from.z * along) / (from.z * edge.length_squared() - edge.z * along);
    (t > 0.0 && t < 1.0).then_some(t)
}

impl Light {
    /// Sector about a frame's axis that covers the whole light as seen from `from`. `None` for environments,
    /// and where no light is received.
    pub(super) fn sector(&self, from: Vec3, frame: &Frame) -> Option<Sector> {
        let of_ball = |center: Vec3, radius: f32| {
            let to_center = center - from;
            let distance = to_center.length();
            let sin = radius / distance;
            (sin < 1.0).then(|| Sector::of_disc(frame.to_local(to_center / distance), sin, sin.asin()))
        };
        match &self.kind {
            LightKind::Rectangle(light) => {
                let Rectangle { center, half_u, half_v, normal, .. } = light.shape;
                let middle = center - from;
                let corners = [half_u + half_v, half_v - half_u, -half_u - half_v, half_u - half_v];
                (middle.dot(normal) < 0.0)
                    .then(|| Sector::of_corners(&corners.map(|corner| frame.to_local(middle + corner))))
            }
            LightKind::Disk(light) => {
                let Disk { center, normal, radius } = light.shape;
                if (center - from).dot(normal) < 0.0 { of_ball(center, radius) } else { None }
            }
            LightKind::Sphere(light) => of_ball(light.shape.center, light.shape.radius),
            LightKind::Mesh(light) => of_ball(light.center(), light.radius()),
            LightKind::Sun(sun) => {
                let half = sun.half_angle();
                (half < FRAC_PI_2).then(|| Sector::of_disc(frame.to_local(sun.toward()), half.sin(), half))
            }
            LightKind::Environment(_) | LightKind::EnvironmentMap(_) => None,
        }
    }
}
