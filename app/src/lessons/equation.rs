//! TeX equations, typeset by RaTeX in the fonts of KaTeX and drawn in the colour of the surrounding text.

use egui::{ColorImage, Context, Id, TextureHandle, TextureOptions, Vec2};
use ratex_layout::{LayoutOptions, layout, to_display_list};
use ratex_render::{RenderOptions, render_to_png};
use ratex_types::{Color, MathStyle};
use std::collections::HashMap;
use std::sync::{Arc, Mutex};

/// Padding around the ink, in points, so that slanted letters are not clipped.
pub const PADDING: f32 = 1.0;

/// Number of cached equations from which those not shown in the last frame are evicted.
const KEPT: usize = 64;

/// TeX style of an equation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Place {
    /// Display style, on a line of its own: large operators, limits above and below.
    Display,
    /// Text style, within a sentence.
    Inline,
}

/// A rasterized equation, white on a transparent background, so that it can be tinted with any colour.
pub struct Equation {
    /// Coverage in the alpha channel.
    pub texture: TextureHandle,
    /// Size, in points.
    pub size: Vec2,
    /// Distance from the top to the baseline, in points.
    pub baseline: f32,
}

/// Checks that a text is valid TeX.
///
/// # Errors
/// The parser's message for invalid TeX.
pub fn check(tex: &str) -> Result<(), String> {
    ratex_parser::parse(tex).map(|_| ()).map_err(|error| error.message)
}

#[derive(Clone, PartialEq, Eq, Hash)]
struct Key {
    tex: String,
    place: Place,
    // Bit patterns of floats, which can be hashed.
    em: u32,
    pixels_per_point: u32,
}

#[derive(Default)]
struct Cache {
    equations: HashMap<Key, (Arc<Equation>, u64)>,
}

/// Returns an equation typeset at a font size of `em` points, from the cache if it was set before.
///
/// # Errors
/// The parser's message for invalid TeX.
pub fn equation(ctx: &Context, tex: &str, place: Place, em: f32) -> Result<Arc<Equation>, String> {
    let pixels_per_point = ctx.pixels_per_point();
    let key =
        Key { tex: tex.to_owned(), place, em: em.to_bits(), pixels_per_point: pixels_per_point.to_bits() };
    let cache: Arc<Mutex<Cache>> = ctx.data_mut(|data| {
        data.get_temp_mut_or_default::<Arc<Mutex<Cache>>>(Id::unique("equation cache")).clone()
    });
    let mut cache = cache.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let now = ctx.cumulative_frame_nr();
    if let Some((equation, used)) = cache.equations.get_mut(&key) {
        *used = now;
        return Ok(Arc::clone(equation));
    }
    let equation = Arc::new(set(ctx, tex, place, em, pixels_per_point)?);
    if cache.equations.len() >= KEPT {
        cache.equations.retain(|_, (_, used)| *used + 1 >= now);
    }
    cache.equations.insert(key, (Arc::clone(&equation), now));
    Ok(equation)
}

fn set(ctx: &Context, tex: &str, place: Place, em: f32, pixels_per_point: f32) -> Result<Equation, String> {
    let style = match place {
        Place::Display => MathStyle::Display,
        Place::Inline => MathStyle::Text,
    };
    let parsed = ratex_parser::parse(tex).map_err(|error| error.message)?;
    let list = to_display_list(&layout(&parsed, &LayoutOptions { style, ..LayoutOptions::default() }));
    let options = RenderOptions {
        font_size: em,
        padding: PADDING,
        background_color: Color { r: 0.0, g: 0.0, b: 0.0, a: 0.0 },
        font_dir: String::new(),
        device_pixel_ratio: pixels_per_point,
    };
    let png = render_to_png(&list, &options)?;
    let picture = image::load_from_memory(&png).map_err(|error| error.to_string())?.into_rgba8();
    let size = [picture.width() as usize, picture.height() as usize];
    let coverage: Vec<u8> = picture.pixels().map(|pixel| pixel.0[3]).collect();
    let white = ColorImage::new(size, coverage.into_iter().map(egui::Color32::from_white_alpha).collect());
    Ok(Equation {
        texture: ctx.load_texture("equation", white, TextureOptions::LINEAR),
        size: Vec2::new(size[0] as f32, size[1] as f32) / pixels_per_point,
        baseline: list.height as f32 * em + PADDING,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_equation_has_ink_and_a_baseline_within() {
        let ctx = Context::default();
        let set = |tex: &str, place| equation(&ctx, tex, place, 16.0).unwrap();
        let sum = r"\sum_{i=1}^{k} x_i";
        let [shown, within] = [Place::Display, Place::Inline].map(|place| set(sum, place));
        assert!(shown.baseline > 10.0 && shown.baseline < shown.size.y);
        assert!(shown.size.y > 1.5 * within.size.y, "only display style sets limits above and below");
        assert!(Arc::ptr_eq(&within, &set(sum, Place::Inline)), "the cached equation is returned");
    }

    #[test]
    fn invalid_tex_is_an_error() {
        assert!(check(r"\frac{1}{2}").is_ok());
        assert!(check(r"\frac{1}{").is_err() && check(r"\nosuchcommand").is_err());
    }
}
