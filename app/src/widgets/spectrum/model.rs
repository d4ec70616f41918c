//! Edits of a spectrum, independent of widgets: change its kind, and add, move and remove points.

use majorant_core::spectrum::{
    ControlPoint, LAMBDA_MAX_NM, LAMBDA_MIN_NM, Outside, Quantity, Spectrum, SpectrumDoc, presets,
};

/// Minimum distance between two points, nm.
const GAP_NM: f32 = 1.0;

/// Kind of a spectrum in the editor; a preset is a named set of points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Constant value.
    Constant,
    /// Control points.
    Points,
    /// Linear sRGB.
    Rgb,
    /// Named preset.
    Preset,
}

/// Returns the kind of a spectrum.
#[must_use]
pub fn kind(doc: &SpectrumDoc) -> Kind {
    match doc {
        SpectrumDoc::Constant(_) => Kind::Constant,
        SpectrumDoc::Points { .. } => Kind::Points,
        SpectrumDoc::Rgb(_) => Kind::Rgb,
        SpectrumDoc::Preset(_) => Kind::Preset,
    }
}

/// Value at a wavelength; for RGB, the component of its band.
fn sample(doc: &SpectrumDoc, lambda_nm: f32) -> f32 {
    match doc {
        SpectrumDoc::Rgb([r, g, b]) => match lambda_nm {
            l if l < 500.0 => *b,
            l if l < 590.0 => *g,
            _ => *r,
        },
        _ => Spectrum::new(doc, Quantity::Coefficient).at(lambda_nm),
    }
}

/// Rounds to three significant digits, enough for a converted spectrum.
fn short(value: f32) -> f32 {
    format!("{value:.2e}").parse().unwrap_or(value)
}

/// Converts a spectrum to another kind, by sampling at representative wavelengths.
#[must_use]
pub fn converted(doc: &SpectrumDoc, to: Kind) -> SpectrumDoc {
    match to {
        Kind::Constant => SpectrumDoc::Constant(short(sample(doc, 550.0))),
        Kind::Rgb => SpectrumDoc::Rgb([610.0, 550.0, 465.0].map(|l| short(sample(doc, l)))),
        Kind::Points => {
            let (points, outside) = points_of(doc);
            SpectrumDoc::Points { points, outside }
        }
        Kind::Preset => SpectrumDoc::Preset(presets::PRESETS.first().map_or("", |p| p.id).into()),
    }
}

/// Control points with which editing begins.
#[must_use]
pub fn points_of(doc: &SpectrumDoc) -> (Vec<ControlPoint>, Outside) {
    doc.control_points().unwrap_or_else(|| {
        let points = [430.0, 540.0, 640.0]
            .map(|lambda_nm| ControlPoint { lambda_nm, value: short(sample(doc, lambda_nm)) });
        (points.to_vec(), Outside::Hold)
    })
}

/// Inserts a point in order of wavelength; returns its index, or `None` if another point is too close.
pub fn add(points: &mut Vec<ControlPoint>, at: ControlPoint) -> Option<usize> {
    let at = ControlPoint { lambda_nm: at.lambda_nm.clamp(LAMBDA_MIN_NM, LAMBDA_MAX_NM), ..at };
    let index = points.partition_point(|p| p.lambda_nm < at.lambda_nm);
    let crowded = points.iter().any(|p| (p.lambda_nm - at.lambda_nm).abs() < GAP_NM);
    if crowded {
        return None;
    }
    points.insert(index, at);
    Some(index)
}

/// Moves a point, clamped to the range between its neighbours and to the values `[least, most]`.
pub fn shift(points: &mut [ControlPoint], index: usize, to: ControlPoint, [least, most]: [f32; 2]) {
    let low =
        index.checked_sub(1).and_then(|i| points.get(i)).map_or(LAMBDA_MIN_NM, |p| p.lambda_nm + GAP_NM);
    let high = points.get(index + 1).map_or(LAMBDA_MAX_NM, |p| p.lambda_nm - GAP_NM);
    if let Some(point) = points.get_mut(index) {
        if low <= high {
            point.lambda_nm = to.lambda_nm.clamp(low, high);
        }
        point.value = to.value.clamp(least, most);
    }
}

/// Removes a point unless it is the only one.
pub fn remove(points: &mut Vec<ControlPoint>, index: usize) {
    if points.len() > 1 && index < points.len() {
        points.remove(index);
    }
}

/// Top of the value axis: a round number above the largest value.
#[must_use]
pub fn plot_top(largest: f32) -> f32 {
    if !(largest > 0.0 && largest.is_finite()) {
        return 1.0;
    }
    let wanted = largest * 1.12;
    let decade = 10_f32.powf(wanted.log10().floor());
    let step = [1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];
    step.into_iter().map(|s| s * decade).find(|top| *top >= wanted).unwrap_or(10.0 * decade)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(lambda_nm: f32, value: f32) -> ControlPoint {
        ControlPoint { lambda_nm, value }
    }

    #[test]
    fn points_stay_in_order_and_in_range() {
        let mut points = vec![point(430.0, 8.0), point(540.0, 40.0), point(572.0, 8.0)];
        shift(&mut points, 1, point(900.0, -3.0), [0.0, f32::MAX]);
        assert_eq!(points[1], point(571.0, 0.0));
        shift(&mut points, 2, point(2000.0, 5.0), [0.0, 1.0]);
        assert_eq!(points[2], point(LAMBDA_MAX_NM, 1.0));
        shift(&mut points, 0, point(0.0, 2.0), [0.0, f32::MAX]);
        assert_eq!(points[0].lambda_nm, LAMBDA_MIN_NM);
        shift(&mut points, 9, point(500.0, 2.0), [0.0, f32::MAX]);
        assert_eq!(points.len(), 3);
    }

    #[test]
    fn points_are_added_in_place_and_the_last_one_stays() {
        let mut points = vec![point(430.0, 8.0), point(572.0, 8.0)];
        assert_eq!(add(&mut points, point(500.0, 1.0)), Some(1));
        assert_eq!(add(&mut points, point(500.4, 1.0)), None);
        for _ in 0..5 {
            remove(&mut points, 0);
        }
        assert_eq!(points, vec![point(572.0, 8.0)]);
    }

    #[test]
    fn kinds_keep_what_they_can() {
        let constant = SpectrumDoc::Constant(0.7);
        let SpectrumDoc::Points { points, .. } = converted(&constant, Kind::Points) else {
            panic!("not points")
        };
        assert!(points.iter().all(|p| p.value == 0.7));
        assert_eq!(converted(&SpectrumDoc::Rgb([0.9, 0.5, 0.2]), Kind::Constant), SpectrumDoc::Constant(0.5));
        assert_eq!(converted(&constant, Kind::Rgb), SpectrumDoc::Rgb([0.7; 3]));
        assert_eq!(kind(&converted(&constant, Kind::Preset)), Kind::Preset);
    }

    #[test]
    fn the_plot_ends_at_round_numbers() {
        assert_eq!(plot_top(0.0), 1.0);
        assert_eq!(plot_top(40.0), 50.0);
        assert!((plot_top(0.95) - 1.5).abs() < 1e-6);
        assert_eq!(plot_top(f32::NAN), 1.0);
    }
}
