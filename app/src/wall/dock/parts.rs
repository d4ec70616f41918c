//! Contributions to the image of the selected view, by technique, scattering order, null collisions or hero.
//!
//! They are traced separately with the first samples of every pixel, and sum to the image of those samples.

use super::{Cx, Tab, empty};
use crate::theme::Palette;
use crate::wall::inspector::PartsQuestion;
use egui::{Button, ColorImage, ComboBox, Image, RichText, ScrollArea, TextureOptions, Ui, vec2};
use majorant_core::film::display::DisplayTransform;
use majorant_core::inspect::{Split, Strategies};
use majorant_core::scene::ViewDoc;
use std::fmt::Write;
use std::sync::Arc;

/// Tab of the contributions.
pub struct Parts;

/// Choices of samples per pixel; few suffice to find the source of the noise.
const SPP: [u64; 4] = [4, 16, 64, 256];
/// Seconds for which each contribution is highlighted during playback.
const EACH: f64 = 0.7;

impl Tab for Parts {
    fn id(&self) -> &'static str {
        "parts"
    }

    fn title(&self) -> &'static str {
        "Contributions"
    }

    fn share(&self) -> f32 {
        0.52
    }

    fn for_one_view(&self) -> bool {
        true
    }

    fn csv(&self, cx: &mut Cx<'_>) -> Option<String> {
        let (view, slot) = (cx.wall.selected(), cx.wall.selected_slot()?);
        let state = &cx.inspector.parts;
        let question = PartsQuestion {
            of: (view, slot.state.generation, slot.probe()?.raises()),
            split: state.split,
            spp: state.spp(),
        };
        let parts = state.query.answer_to(&question)?;
        let shares = parts.variance_shares(|_, _| true);
        let mut text = String::from("part,r,g,b,variance_share\n");
        for (k, layer) in parts.layers.iter().enumerate() {
            let ([r, g, b], share) = (layer.whole(), shares.as_ref().map_or(f64::NAN, |s| s[k]));
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{},{r},{g},{b},{share}", layer.name);
        }
        Some(text)
    }

    fn ui(&self, ui: &mut Ui, cx: &mut Cx<'_>) {
        controls_ui(ui, cx);
        let Some((parts, current)) = parts(ui, cx) else {
            return empty(ui, "The contributions are being traced.");
        };
        let view = cx.doc.view_doc(cx.wall.selected()).unwrap_or_else(|| cx.doc.clone()).view;
        upload(ui, cx, &parts, &view);
        let region = cx.doc.compare.region;
        let inside = |x: usize, y: usize| {
            region.is_none_or(|[x0, y0, x1, y1]| {
                (x0 as usize..x1 as usize).contains(&x) && (y0 as usize..y1 as usize).contains(&y)
            })
        };
        let shares = parts.variance_shares(inside);
        let shown = playing(ui, cx, parts.layers.len());
        // Two lines of text and the scroll bar are below the images.
        let height = (ui.available_height() - 3.0 * ui.text_style_height(&egui::TextStyle::Small)).max(40.0);
        ScrollArea::horizontal().auto_shrink(false).show(ui, |ui| {
            ui.horizontal_top(|ui| {
                let size = vec2(height * parts.width as f32 / parts.height.max(1) as f32, height);
                for (k, layer) in parts.layers.iter().enumerate() {
                    // While new contributions are traced, the old images stay, without their numbers.
                    let share = shares.as_ref().filter(|_| current).map(|s| s[k]);
                    let mean = current.then(|| layer.whole().iter().sum::<f64>() / 3.0);
                    let lit = shown.is_none_or(|shown| shown == k);
                    let tint = if lit && current { 255 } else { 110 };
                    part_ui(ui, cx.inspector.parts.uploaded.get(k), layer, (mean, share), size, tint);
                }
            });
        });
    }
}

fn controls_ui(ui: &mut Ui, cx: &mut Cx<'_>) {
    let palette = Palette::get(ui);
    let state = &mut cx.inspector.parts;
    ui.horizontal(|ui| {
        ui.label(RichText::new("by").small().color(palette.weak));
        for split in Split::ALL {
            let on = state.split == split;
            let response = ui.add(Button::selectable(on, RichText::new(split.name()).small()));
            response.widget_info(|| {
                egui::WidgetInfo::selected(egui::Role::Button, true, on, format!("By {}", split.name()))
            });
            if response.clicked() {
                (state.split, state.playing) = (split, None);
            }
        }
        let combo = ComboBox::from_id_salt("spp").selected_text(RichText::new(format!("{} spp", state.spp())).small());
        let combo = combo.show_ui(ui, |ui| {
                for spp in SPP {
                    ui.selectable_value(&mut state.spp, Some(spp), format!("{spp} samples per pixel"));
                }
            });
        combo.response.accessible_name("Samples per pixel");
        for (as_shares, name, tip) in [
            (false, "radiance", "Radiance of each contribution, with the tone mapping of the view"),
            (true, "weights", "Share of each contribution in the radiance of the pixel: by technique, its average MIS weight"),
        ] {
            let on = state.as_shares == as_shares;
            let response = ui.add(Button::selectable(on, RichText::new(name).small())).on_hover_text(tip);
            response.widget_info(|| {
                egui::WidgetInfo::selected(egui::Role::Button, true, on, format!("Contributions as {name}"))
            });
            if response.clicked() {
                state.as_shares = as_shares;
            }
        }
        let playing = state.playing.is_some();
        let text = if playing { "Stop" } else { "Play" };
        let play = ui.add(Button::new(RichText::new(text).small())).on_hover_text("Highlights one contribution after another");
        if play.clicked() {
            state.playing = (!playing).then(|| ui.input(|input| input.time));
        }
        if state.query.is_running() {
            ui.spinner();
        }
        let text = "mean, and share of the variance";
        ui.label(RichText::new(text).small().color(palette.weak)).on_hover_text(
            "Cov(contribution, image) / Var(image) of one sample, in the box if one is drawn; the shares sum to one. \
             Negative: anticorrelated with the other contributions.",
        );
    });
}

/// Returns the contributions and whether they are current; the previous ones while new ones are traced.
fn parts(ui: &Ui, cx: &mut Cx<'_>) -> Option<(Arc<Strategies>, bool)> {
    let slot = cx.wall.selected_slot()?;
    let state = &mut cx.inspector.parts;
    let Some(probe) = slot.probe().cloned() else {
        // While a scene is built, the contributions are those of an older one.
        return state.query.newest().map(|parts| (Arc::clone(parts), false));
    };
    let (split, spp) = (state.split, state.spp());
    let question =
        PartsQuestion { of: (cx.wall.selected(), slot.state.generation, probe.raises()), split, spp };
    let ctx = ui.ctx().clone();
    state.query.ask(
        &question,
        move || ctx.request_repaint(),
        move |cancel| probe.strategies(split, 0..spp, cancel),
    )
}

/// Updates the textures of the contributions if these, the exposure or the mode have changed.
fn upload(ui: &Ui, cx: &mut Cx<'_>, parts: &Arc<Strategies>, view: &ViewDoc) {
    let state = &mut cx.inspector.parts;
    let same = state.hung_of.as_ref().is_some_and(|uploaded| Arc::ptr_eq(uploaded, parts));
    if same && state.exposure == view.exposure_ev && state.hung_as_shares == state.as_shares {
        return;
    }
    state.hung_as_shares = state.as_shares;
    let display = DisplayTransform::new(view);
    let grey = |rgb: &[f32; 3]| rgb.iter().sum::<f32>();
    let whole = |i: usize| parts.layers.iter().map(|layer| grey(&layer.mean[i])).sum::<f32>();
    let as_shares = state.as_shares;
    let shown = |(i, rgb): (usize, &[f32; 3])| {
        if !as_shares {
            return display.encode(*rgb);
        }
        // The share of a black pixel is zero.
        let share = grey(rgb) / whole(i).max(f32::MIN_POSITIVE);
        [(share.clamp(0.0, 1.0) * 255.0) as u8; 3]
    };
    let texture = |(k, layer): (usize, &majorant_core::inspect::Layer)| {
        let bytes: Vec<u8> = layer.mean.iter().enumerate().flat_map(shown).collect();
        let image = ColorImage::from_rgb([parts.width, parts.height], &bytes);
        ui.ctx().load_texture(format!("contribution {k}"), image, TextureOptions::LINEAR)
    };
    state.uploaded = parts.layers.iter().enumerate().map(texture).collect();
    (state.hung_of, state.exposure) = (Some(Arc::clone(parts)), view.exposure_ev);
}

/// Index of the highlighted contribution during playback.
fn playing(ui: &Ui, cx: &Cx<'_>, parts: usize) -> Option<usize> {
    let since = cx.inspector.parts.playing?;
    ui.ctx().request_repaint_after(std::time::Duration::from_secs_f64(0.5 * EACH));
    let shown = ((ui.input(|input| input.time) - since) / EACH) as usize;
    Some(shown % parts.max(1))
}

fn part_ui(
    ui: &mut Ui,
    texture: Option<&egui::TextureHandle>,
    layer: &majorant_core::inspect::Layer,
    (mean, share): (Option<f64>, Option<f64>),
    size: egui::Vec2,
    tint: u8,
) {
    let palette = Palette::get(ui);
    ui.vertical(|ui| {
        if let Some(texture) = texture {
            let image = Image::new((texture.id(), size)).tint(egui::Color32::from_gray(tint));
            ui.add(image.alt_text(format!("Contribution: {}", layer.name)));
        }
        ui.label(RichText::new(&layer.name).small().color(palette.strong));
        let mean = mean.map_or("…".to_owned(), |mean| format!("{mean:.4}"));
        let share = share.map_or(String::new(), |s| format!("   {:.0} %", 100.0 * s));
        ui.label(RichText::new(format!("{mean}{share}")).small().color(palette.weak));
    });
}
