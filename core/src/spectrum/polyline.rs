//! Piecewise linear spectra.

use super::{ControlPoint, LAMBDA_MAX_NM, LAMBDA_MIN_NM, Outside};

/// Piecewise linear function of wavelength.
#[derive(Clone, Debug)]
pub(super) struct Polyline {
    /// In increasing order of wavelength.
    points: Vec<ControlPoint>,
    outside: Outside,
    /// For every whole nanometre of the rendered range, the number of points at or before it: the start of
    /// the search for a wavelength.
    before: Vec<u32>,
}

impl Polyline {
    pub fn new(points: Vec<ControlPoint>, outside: Outside) -> Self {
        let steps = (LAMBDA_MAX_NM - LAMBDA_MIN_NM) as u16;
        let count =
            |step: u16| points.partition_point(|p| p.lambda_nm <= LAMBDA_MIN_NM + f32::from(step)) as u32;
        let before = (0..=steps).map(count).collect();
        Self { points, outside, before }
    }

    pub fn points(&self) -> &[ControlPoint] {
        &self.points
    }

    /// Returns whether the value is the same at every wavelength.
    pub fn is_flat(&self) -> bool {
        self.outside == Outside::Hold && self.points.windows(2).all(|p| p[0].value == p[1].value)
    }

    pub fn scale(&mut self, factor: f32) {
        self.points.iter_mut().for_each(|p| p.value *= factor);
    }

    pub fn at(&self, lambda_nm: f32) -> f32 {
        let points = &self.points;
        let after = self.after(lambda_nm);
        let beyond = |end: &ControlPoint| match self.outside {
            Outside::Hold => end.value,
            Outside::Zero if end.lambda_nm == lambda_nm => end.value,
            Outside::Zero => 0.0,
        };
        match (after.checked_sub(1).and_then(|i| points.get(i)), points.get(after)) {
            (Some(a), Some(b)) => {
                let s = (lambda_nm - a.lambda_nm) / (b.lambda_nm - a.lambda_nm);
                a.value + (b.value - a.value) * s
            }
            (Some(end), None) | (None, Some(end)) => beyond(end),
            (None, None) => 0.0,
        }
    }

    /// Number of points at or before a wavelength.
    fn after(&self, lambda_nm: f32) -> usize {
        let step = lambda_nm - LAMBDA_MIN_NM;
        let start = if step >= 0.0 { self.before.get(step as usize) } else { None };
        let Some(start) = start else { return self.points.partition_point(|p| p.lambda_nm <= lambda_nm) };
        let start = *start as usize;
        start + self.points[start..].iter().take_while(|p| p.lambda_nm <= lambda_nm).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_short_search_finds_what_the_long_one_does() {
        let at = [300.0, 359.5, 360.0, 400.25, 400.5, 400.75, 401.0, 555.0, 829.5, 830.0, 900.0];
        let points: Vec<_> = at.iter().map(|l| ControlPoint { lambda_nm: *l, value: l.sin() }).collect();
        let line = Polyline::new(points.clone(), Outside::Zero);
        for i in 0..14_000u16 {
            let lambda = 250.0 + f32::from(i) * 0.05;
            let found = points.partition_point(|p| p.lambda_nm <= lambda);
            assert_eq!(line.after(lambda), found, "{lambda}");
        }
        for point in points {
            assert_eq!(line.at(point.lambda_nm), point.value);
        }
    }
}
