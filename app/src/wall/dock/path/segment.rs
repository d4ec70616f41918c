//! Plot of extinction, majorant and collisions along the ray of the selected event.

use super::super::Cx;
use super::event::colour;
use crate::theme::Palette;
use crate::wall::inspector::{Replayed, Segment};
use egui::{Align2, FontId, Pos2, Rect, Shape, Stroke, Ui, pos2};
use majorant_core::inspect::{Along, BenchPlan, RayBench};
use majorant_core::math::Ray;
use majorant_core::scene::Mode;
use majorant_core::spectrum::Carried;
use majorant_core::transmittance::TransmittanceKind;
use majorant_core::transport::{CancelToken, Note};
use std::sync::Arc;

/// Height of the plot, in points.
pub(super) const HEIGHT: f32 = 64.0;

/// Ray of an event, with the index of the note at which it begins.
fn ray_of(replayed: &Replayed, note: usize) -> Option<(usize, Ray)> {
    replayed.recording.notes[..=note].iter().enumerate().rev().find_map(|(i, told)| match told {
        Note::Camera { ray, .. } | Note::Connect { ray, .. } => Some((i, *ray)),
        // The new ray of a vertex applies from the next event on.
        Note::Direction { ray, .. } | Note::Boundary { ray, .. } if i < note => Some((i, *ray)),
        _ => None,
    })
}

/// Draws the plot of the selected event; its curves are recomputed when the ray changes.
pub(super) fn segment_ui(ui: &Ui, cx: &mut Cx<'_>, replayed: &Arc<Replayed>, rect: Rect) {
    let palette = Palette::get(ui);
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, 3.0, palette.well);
    let view = cx.wall.selected();
    let Some(probe) = cx.wall.slots().get(view).and_then(|slot| slot.probe().cloned()) else { return };
    let state = &mut cx.inspector.path;
    let Some(row) = replayed.ledger.rows.get(state.step) else { return };
    let Some((began, ray)) = ray_of(replayed, row.note) else { return };
    let same = |known: &Segment| Arc::ptr_eq(&known.of, replayed) && known.began == began;
    if !state.segment.as_ref().is_some_and(same) {
        let (mode, component) = match replayed.ledger.carried {
            Carried::Wavelengths(nm, _) => (Mode::Spectral, nm[0]),
            Carried::Channels(channels, _) => (Mode::Rgb, channels[0]),
            Carried::Grey => (Mode::Rgb, 1.0),
        };
        let along = Along::Medium { scene: probe.scene(), ray, mode, component };
        let kind = TransmittanceKind::ALONG_THE_PATH;
        let plan = BenchPlan { kind, estimates: 0, seed: 0, example: 0 };
        let bench = RayBench::new(&along, &plan, CancelToken::NEVER);
        state.segment = Some(Segment { of: Arc::clone(replayed), began, bench });
    }
    let font = FontId::proportional(11.0);
    let corner = rect.left_top() + egui::vec2(6.0, 3.0);
    let Some(bench) = state.segment.as_ref().and_then(|segment| segment.bench.as_ref()) else {
        painter.text(corner, Align2::LEFT_TOP, "this ray misses the medium", font, palette.weak);
        return;
    };
    painter.text(corner, Align2::LEFT_TOP, "extinction and majorant along the ray", font, palette.weak);
    let largest = bench.majorants.iter().map(|m| m[2]).fold(f32::MIN_POSITIVE, f32::max);
    let inner = rect.shrink2(egui::vec2(6.0, 4.0)).with_min_y(rect.top() + 16.0);
    let at = |t: f32, value: f32| -> Pos2 {
        let x = egui::lerp(inner.x_range(), (t / bench.length.max(f32::MIN_POSITIVE)).clamp(0.0, 1.0));
        pos2(x, egui::lerp(inner.bottom()..=inner.top(), (value / largest).clamp(0.0, 1.0)))
    };
    let bound = Stroke::new(1.2, palette.warning);
    for [t0, t1, majorant] in &bench.majorants {
        painter.line_segment([at(*t0, *majorant), at(*t1, *majorant)], bound);
        for t in [*t0, *t1] {
            painter.line_segment([at(t, 0.0), at(t, *majorant)], Stroke::new(0.5, palette.line));
        }
    }
    let line = bench.extinction.iter().map(|[t, mu]| at(*t, *mu)).collect();
    painter.add(Shape::line(line, Stroke::new(1.4, palette.accent)));
    // Events of the same ray, the selected one circled.
    for (i, event) in replayed.ledger.rows.iter().enumerate() {
        let (Some(point), Some(found)) = (event.point, &event.found) else { continue };
        if ray_of(replayed, event.note).is_some_and(|(other, _)| other == began) {
            let t = (point - ray.origin).dot(ray.direction) - bench.start;
            let here = at(t, found.absorption[0] + found.scattering[0]);
            painter.circle_filled(here, 3.0, colour(event, palette));
            if i == state.step {
                painter.circle_stroke(here, 6.0, Stroke::new(1.6, palette.strong));
            }
        }
    }
}
