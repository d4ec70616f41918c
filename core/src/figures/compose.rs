//! Composition of a figure as one image, laid out as in the report: rows of panels with labels above and
//! measurements below, and a caption.

use super::FiguresError;
use super::figure::{Cell, Figure};
use super::render::Rendered;
use super::text::Typeface;
use crate::compare::View;
use crate::compare::report::{self, ReportError, encode_png, words};
use crate::scene::ViewDoc;
use image::imageops::{self, FilterType};
use image::{Rgb, RgbImage};
use std::path::Path;

const MARGIN: u32 = 14;
const GUTTER: u32 = 10;
const LABEL: f32 = 15.0;
const SMALL: f32 = 13.0;
/// Line height of small print.
const LEADING: u32 = 18;
/// Minimum width of an image, reached by integer magnification, so that its label fits.
const LEAST_WIDTH: u32 = 190;

/// Tone-mapped image of a view in display colours.
pub(super) fn picture(view: &View, tone: &ViewDoc) -> RgbImage {
    let (width, height) = (view.snapshot.width as u32, view.snapshot.height as u32);
    RgbImage::from_raw(width, height, report::rgb(&view.snapshot.mean, tone)).unwrap_or_default()
}

/// An image with its label above and its note below.
pub(super) struct Placed {
    pub label: String,
    pub image: RgbImage,
    pub note: String,
}

impl Rendered {
    /// Cells of a row, from the left.
    pub(super) fn cells(&self) -> Vec<Placed> {
        let numbers = self.numbers();
        let placed = |cell: &Cell| {
            let (label, view, note) = match cell {
                Cell::Reference => (self.strip.reference.label, &self.reference, String::new()),
                Cell::Panel(panel) => {
                    let n = numbers.get(*panel)?;
                    let relmse = n.row.relmse.unwrap_or(f64::NAN);
                    let note = format!("relMSE {}", words::quantity(relmse, n.relmse_error));
                    (n.panel, &self.experiment.views.get(*panel)?.1, note.replace('\u{a0}', " "))
                }
            };
            let label = format!("{label}, {} spp", view.snapshot.spp);
            Some(Placed { label, image: picture(view, &self.scene.view), note })
        };
        self.strip.cells.iter().filter_map(placed).collect()
    }
}

/// Composes a figure.
pub(super) fn compose(figure: &Figure, rows: &[Rendered]) -> RgbImage {
    let face = Typeface::new();
    let rows: Vec<Vec<Placed>> = rows.iter().map(|r| magnified(r.cells())).collect();
    let row_width = |row: &Vec<Placed>| {
        row.iter().map(|p| p.image.width()).sum::<u32>() + GUTTER * (row.len().max(1) as u32 - 1)
    };
    let width = rows.iter().map(row_width).max().unwrap_or(0).max(LEAST_WIDTH);
    let height = |row: &Vec<Placed>| {
        let tallest = row.iter().map(|p| p.image.height()).max().unwrap_or(0);
        LEADING + 4 + tallest + LEADING + GUTTER
    };
    let caption = format!("Figure {}. {}. {}", figure.id, figure.title, figure.shows);
    let lines = face.wrapped(&caption, SMALL, width as f32);
    let total = 2 * MARGIN + rows.iter().map(height).sum::<u32>() + LEADING * lines.len() as u32;
    let mut page = RgbImage::from_pixel(width + 2 * MARGIN, total, Rgb([255; 3]));
    let mut y = MARGIN;
    for row in &rows {
        let mut x = MARGIN;
        for placed in row {
            face.draw(&mut page, (x, y), &placed.label, LABEL, 0.1);
            let top = y + LEADING + 4;
            imageops::replace(&mut page, &placed.image, i64::from(x), i64::from(top));
            face.draw(&mut page, (x, top + placed.image.height() + 2), &placed.note, SMALL, 0.35);
            x += placed.image.width() + GUTTER;
        }
        y += height(row);
    }
    for line in &lines {
        face.draw(&mut page, (MARGIN, y), line, SMALL, 0.1);
        y += LEADING;
    }
    page
}

fn magnified(mut row: Vec<Placed>) -> Vec<Placed> {
    for placed in &mut row {
        let (w, h) = placed.image.dimensions();
        let times = LEAST_WIDTH.div_ceil(w.max(1)).max(1);
        if times > 1 {
            placed.image = imageops::resize(&placed.image, w * times, h * times, FilterType::Nearest);
        }
    }
    row
}

/// Encodes an image as PNG.
pub(super) fn png(image: &RgbImage) -> Result<Vec<u8>, FiguresError> {
    let size = (image.width() as usize, image.height() as usize);
    Ok(encode_png(image.as_raw(), size).map_err(|e| ReportError::write(Path::new("an image"), e))?)
}
