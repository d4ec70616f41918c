//! Pan and zoom of an image on the canvas, as pure functions.

use egui::{Pos2, Rect, Vec2, pos2};

/// Pan and zoom of an image on a canvas. Image coordinates are in pixels from the top left corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImageView {
    /// Image point at the centre of the canvas, and zoom; `None` while the image is fitted.
    placed: Option<Placed>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Placed {
    centre: Vec2,
    zoom: f32,
}

impl Default for ImageView {
    fn default() -> Self {
        Self::FIT
    }
}

impl ImageView {
    /// Fits the whole image into the canvas.
    pub const FIT: Self = Self { placed: None };
    /// Range of the zoom, screen points per image pixel.
    pub const ZOOM_RANGE: std::ops::RangeInclusive<f32> = 0.05..=256.0;
    /// Margin around a fitted image: fraction of the canvas, and its maximum in points.
    const MARGIN: (f32, f32) = (0.02, 16.0);

    /// Centres the image at `zoom` points per pixel.
    #[must_use]
    pub fn at_zoom(zoom: f32, image: Vec2) -> Self {
        Self { placed: Some(Placed { centre: 0.5 * image, zoom }) }
    }

    /// Whether the image is fitted to the canvas.
    #[must_use]
    pub fn is_fitted(&self) -> bool {
        self.placed.is_none()
    }

    fn resolve(&self, canvas: Rect, image: Vec2) -> Placed {
        self.placed.unwrap_or_else(|| {
            let (share, most) = Self::MARGIN;
            let margin = (share * canvas.size().min_elem()).min(most);
            let room = (canvas.size() - Vec2::splat(2.0 * margin)).max(Vec2::splat(1.0));
            let zoom = (room / image.max(Vec2::splat(1.0))).min_elem();
            Placed {
                centre: 0.5 * image,
                zoom: zoom.clamp(*Self::ZOOM_RANGE.start(), *Self::ZOOM_RANGE.end()),
            }
        })
    }

    /// Screen points per image pixel.
    #[must_use]
    pub fn zoom(&self, canvas: Rect, image: Vec2) -> f32 {
        self.resolve(canvas, image).zoom
    }

    /// Screen rectangle of the whole image.
    #[must_use]
    pub fn screen_rect(&self, canvas: Rect, image: Vec2) -> Rect {
        let Placed { centre, zoom } = self.resolve(canvas, image);
        Rect::from_min_size(canvas.center() - centre * zoom, image * zoom)
    }

    /// Converts a screen point to image coordinates.
    #[must_use]
    pub fn image_from_screen(&self, canvas: Rect, image: Vec2, at: Pos2) -> Pos2 {
        let Placed { centre, zoom } = self.resolve(canvas, image);
        (centre + (at - canvas.center()) / zoom).to_pos2()
    }

    /// Converts image coordinates to a screen point.
    #[must_use]
    pub fn screen_from_image(&self, canvas: Rect, image: Vec2, at: Pos2) -> Pos2 {
        let Placed { centre, zoom } = self.resolve(canvas, image);
        canvas.center() + (at.to_vec2() - centre) * zoom
    }

    /// Pixel under a screen point; `None` outside of the image.
    #[must_use]
    pub fn pixel_at(&self, canvas: Rect, image: Vec2, at: Pos2) -> Option<[usize; 2]> {
        let p = self.image_from_screen(canvas, image, at);
        let inside = p.x >= 0.0 && p.y >= 0.0 && p.x < image.x && p.y < image.y;
        inside.then_some([p.x as usize, p.y as usize])
    }

    /// Pans the image by a screen distance.
    #[must_use]
    pub fn panned(&self, canvas: Rect, image: Vec2, by: Vec2) -> Self {
        let Placed { centre, zoom } = self.resolve(canvas, image);
        // The centre of the canvas stays on the image, so that part of the image is always visible.
        let centre = (centre - by / zoom).clamp(Vec2::ZERO, image);
        Self { placed: Some(Placed { centre, zoom }) }
    }

    /// Zooms by a factor about the screen point `at`.
    #[must_use]
    pub fn zoomed(&self, canvas: Rect, image: Vec2, at: Pos2, factor: f32) -> Self {
        let Placed { zoom, .. } = self.resolve(canvas, image);
        let fixed = self.image_from_screen(canvas, image, at).to_vec2();
        let zoom = (zoom * factor).clamp(*Self::ZOOM_RANGE.start(), *Self::ZOOM_RANGE.end());
        let centre = (fixed - (at - canvas.center()) / zoom).clamp(Vec2::ZERO, image);
        Self { placed: Some(Placed { centre, zoom }) }
    }

    /// Range of pixels that are at least partly on the canvas, `[x0, y0, x1, y1]`, ends exclusive.
    #[must_use]
    pub fn visible_pixels(&self, canvas: Rect, image: Vec2) -> [usize; 4] {
        let corner = |p: Pos2| self.image_from_screen(canvas, image, p);
        let (min, max) = (corner(canvas.min), corner(canvas.max));
        let low = pos2(min.x.floor(), min.y.floor()).clamp(Pos2::ZERO, image.to_pos2());
        let high = pos2(max.x.ceil(), max.y.ceil()).clamp(Pos2::ZERO, image.to_pos2());
        [low.x as usize, low.y as usize, high.x as usize, high.y as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::vec2;

    const IMAGE: Vec2 = vec2(960.0, 540.0);

    fn canvas() -> Rect {
        Rect::from_min_size(pos2(300.0, 40.0), vec2(992.0, 700.0))
    }

    #[test]
    fn fitting_shows_everything_with_a_margin() {
        let rect = ImageView::FIT.screen_rect(canvas(), IMAGE);
        assert!(canvas().shrink(13.9).contains_rect(rect));
        assert!((rect.center() - canvas().center()).length() < 1e-3);
        assert!((ImageView::FIT.zoom(canvas(), IMAGE) - 964.0 / 960.0).abs() < 1e-5);
    }

    #[test]
    fn zooming_keeps_the_point_under_the_pointer() {
        let at = pos2(700.0, 300.0);
        let mut view = ImageView::FIT;
        let before = view.image_from_screen(canvas(), IMAGE, at);
        for factor in [1.3, 2.0, 8.0, 0.25] {
            view = view.zoomed(canvas(), IMAGE, at, factor);
            let after = view.image_from_screen(canvas(), IMAGE, at);
            assert!((before - after).length() < 0.05, "{before:?} {after:?}");
        }
    }

    #[test]
    fn screen_and_image_are_inverse() {
        let view = ImageView::at_zoom(3.0, IMAGE).panned(canvas(), IMAGE, vec2(50.0, -70.0));
        let at = pos2(12.25, 500.5);
        let screen = view.screen_from_image(canvas(), IMAGE, at);
        assert!((view.image_from_screen(canvas(), IMAGE, screen) - at).length() < 1e-3);
    }

    #[test]
    fn the_picture_cannot_be_lost() {
        let view = ImageView::at_zoom(1.0, IMAGE).panned(canvas(), IMAGE, vec2(1e6, -1e6));
        assert!(view.screen_rect(canvas(), IMAGE).expand(1.0).contains(canvas().center()));
        let far = view.zoomed(canvas(), IMAGE, canvas().center(), 1e9);
        assert!(far.zoom(canvas(), IMAGE) <= *ImageView::ZOOM_RANGE.end());
    }

    #[test]
    fn pixels_are_found_only_on_the_picture() {
        let view = ImageView::FIT;
        let rect = view.screen_rect(canvas(), IMAGE);
        assert_eq!(view.pixel_at(canvas(), IMAGE, rect.min + vec2(0.5, 0.5)), Some([0, 0]));
        assert_eq!(view.pixel_at(canvas(), IMAGE, rect.max - vec2(0.5, 0.5)), Some([959, 539]));
        assert_eq!(view.pixel_at(canvas(), IMAGE, rect.min - vec2(1.0, 0.0)), None);
        let [x0, y0, x1, y1] = view.visible_pixels(canvas(), IMAGE);
        assert_eq!([x0, y0, x1, y1], [0, 0, 960, 540]);
    }
}
