//! Text rendering into images.

use ab_glyph::{Font, FontRef, PxScale, ScaleFont};
use image::{Rgb, RgbImage};

/// Font with a fallback for characters that it lacks, such as superscripts.
pub(super) struct Typeface {
    fonts: Vec<FontRef<'static>>,
}

impl Typeface {
    /// Loads the fonts of the user interface.
    pub fn new() -> Self {
        let files = [epaint_default_fonts::UBUNTU_LIGHT, epaint_default_fonts::HACK_REGULAR];
        Self { fonts: files.into_iter().filter_map(|bytes| FontRef::try_from_slice(bytes).ok()).collect() }
    }

    fn font(&self, c: char) -> Option<&FontRef<'static>> {
        self.fonts.iter().find(|f| f.glyph_id(c).0 != 0)
    }

    /// Width of a line in pixels.
    pub fn width(&self, line: &str, size: f32) -> f32 {
        let advance = |c| self.font(c).map_or(0.0, |f| f.as_scaled(size).h_advance(f.glyph_id(c)));
        line.chars().map(advance).sum()
    }

    /// Draws a line in a grey from 0 (black) to 1, with its upper left corner at (x, y).
    pub fn draw(&self, image: &mut RgbImage, (x, y): (u32, u32), line: &str, size: f32, grey: f32) {
        let Some(first) = self.fonts.first() else { return };
        let (mut at, baseline) = (x as f32, y as f32 + first.as_scaled(size).ascent());
        for c in line.chars() {
            let Some(font) = self.font(c) else { continue };
            let glyph = font.glyph_id(c).with_scale_and_position(PxScale::from(size), (at, baseline));
            at += font.as_scaled(size).h_advance(glyph.id);
            let Some(outline) = font.outline_glyph(glyph) else { continue };
            let corner = outline.px_bounds().min;
            outline.draw(|dx, dy, cover| {
                let (px, py) = (corner.x + dx as f32, corner.y + dy as f32);
                if px < 0.0 || py < 0.0 {
                    return;
                }
                if let Some(Rgb(pixel)) = image.get_pixel_mut_checked(px as u32, py as u32) {
                    let cover = cover.clamp(0.0, 1.0);
                    *pixel = pixel.map(|v| (f32::from(v) * (1.0 - cover) + 255.0 * grey * cover + 0.5) as u8);
                }
            });
        }
    }

    /// Breaks text at spaces into lines of at most `width` pixels.
    pub fn wrapped(&self, text: &str, size: f32, width: f32) -> Vec<String> {
        let mut lines = vec![String::new()];
        for word in text.split_whitespace() {
            let Some(line) = lines.last_mut() else { break };
            let longer = if line.is_empty() { word.to_owned() } else { format!("{line} {word}") };
            if line.is_empty() || self.width(&longer, size) <= width {
                *line = longer;
            } else {
                lines.push(word.to_owned());
            }
        }
        lines
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_are_drawn_in_place_and_nowhere_else() {
        let face = Typeface::new();
        let mut image = RgbImage::from_pixel(200, 40, Rgb([255; 3]));
        let line = "relMSE 1.23 × 10⁻⁴ ±";
        face.draw(&mut image, (10, 8), line, 16.0, 0.0);
        let width = face.width(line, 16.0);
        assert!(width > 100.0 && width < 190.0, "{width}");
        let ink = |x: u32| (0..40).any(|y| image.get_pixel(x, y).0[0] < 128);
        assert!((10..10 + width as u32).filter(|x| ink(*x)).count() > 60);
        assert!(!(0..9).chain(12 + width as u32..200).any(ink));
        // Every character used in numbers exists.
        for c in "0123456789.,−±×∞–⁻⁰¹²³⁴⁵⁶⁷⁸⁹[]()%".chars() {
            assert!(face.font(c).is_some(), "{c}");
        }
    }

    #[test]
    fn lines_keep_their_width_and_every_word() {
        let face = Typeface::new();
        let text = "one two three four five six seven eight nine";
        let lines = face.wrapped(text, 14.0, 80.0);
        assert!(lines.len() > 2 && lines.iter().all(|l| face.width(l, 14.0) <= 80.0));
        assert_eq!(lines.join(" "), text);
    }
}
