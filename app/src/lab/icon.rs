//! Icon of the window: a density curve below a dashed majorant.

use egui::IconData;

const SIDE: usize = 64;

/// Rasterises the icon.
pub(super) fn icon() -> IconData {
    let mut rgba = Vec::with_capacity(4 * SIDE * SIDE);
    for y in 0..SIDE {
        for x in 0..SIDE {
            rgba.extend(pixel(x as f32 + 0.5, y as f32 + 0.5));
        }
    }
    IconData { rgba, width: SIDE as u32, height: SIDE as u32 }
}

fn pixel(x: f32, y: f32) -> [u8; 4] {
    // A rounded square, antialiased by the distance to its edge.
    let corner = |t: f32| (t - 32.0).abs() - 20.0;
    let (dx, dy) = (corner(x).max(0.0), corner(y).max(0.0));
    let inside = (11.5 - dx.hypot(dy)).clamp(0.0, 1.0);
    let density = 50.0 - 28.0 * (-((x - 27.0) / 11.0).powi(2)).exp();
    let dash = (y - 17.0).abs() < 1.6 && x % 10.0 < 6.0 && (9.0..55.0).contains(&x);
    let colour = if dash {
        [92, 174, 230]
    } else if (y - density).abs() < 1.8 {
        [242, 243, 245]
    } else if y > density {
        [40, 92, 128]
    } else {
        [29, 30, 32]
    };
    [colour[0], colour[1], colour[2], (255.0 * inside) as u8]
}
