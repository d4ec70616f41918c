//! Frozen spectra, as the renderer evaluates them.

use super::combined::{Combined, Rule};
use super::polyline::Polyline;
use super::{LAMBDA_MAX_NM, LAMBDA_MIN_NM, Outside, SpectrumDoc, observer, presets};
use glam::Vec3;

/// Quantity that a spectrum describes; it determines the conversion from linear sRGB.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Extinction, albedo or reflectance: equal sRGB components are constant over wavelength.
    Coefficient,
    /// Radiance: equal sRGB components are daylight, so that the film reproduces the given colour.
    Radiance,
}

/// Frozen spectrum: a function of wavelength, and its three components in RGB mode.
///
/// A component in RGB mode is the spectrum's mean under the positive part of the sensor's response for that
/// channel. A constant stays constant, and a mean never leaves the range of the spectrum.
#[derive(Clone, Debug)]
pub struct Spectrum {
    shape: Shape,
    rgb: Vec3,
    /// Film colour in spectral mode, if the spectrum is radiance.
    film: Vec3,
}

#[derive(Clone, Debug)]
enum Shape {
    Constant(f32),
    Points(Polyline),
    Rgb(Vec3),
    RgbRadiance(Vec3),
    Combined(Box<Combined>),
}

impl Spectrum {
    /// Freezes an editable spectrum. Unknown presets were rejected when the spectrum was read or validated;
    /// here they are zero.
    #[must_use]
    pub fn new(doc: &SpectrumDoc, quantity: Quantity) -> Self {
        let shape = match doc {
            SpectrumDoc::Constant(value) => Shape::Constant(*value),
            SpectrumDoc::Points { points, outside } => Shape::Points(Polyline::new(points.clone(), *outside)),
            SpectrumDoc::Preset(id) => presets::find(id)
                .and_then(|p| SpectrumDoc::parse_points(p.points).ok())
                .map_or(Shape::Constant(0.0), |points| Shape::Points(Polyline::new(points, Outside::Hold))),
            SpectrumDoc::Rgb(rgb) => match quantity {
                Quantity::Coefficient => Shape::Rgb((*rgb).into()),
                Quantity::Radiance => Shape::RgbRadiance((*rgb).into()),
            },
        };
        let shape = shape.simplified();
        let rgb = match &shape {
            Shape::Constant(value) => Vec3::splat(*value),
            Shape::Rgb(rgb) | Shape::RgbRadiance(rgb) => *rgb,
            Shape::Points(_) | Shape::Combined(_) => observer::band_means(|lambda| shape.at(lambda)),
        };
        let film = shape.film_colour();
        Self { shape, rgb, film }
    }

    /// Creates a spectrum with the same value at every wavelength.
    #[must_use]
    pub fn constant(value: f32) -> Self {
        let shape = Shape::Constant(value);
        Self { film: shape.film_colour(), shape, rgb: Vec3::splat(value) }
    }

    /// Applies `rule` to two spectra, at every wavelength and in every component of RGB mode.
    #[must_use]
    pub fn combined(a: Self, b: Self, rule: Rule) -> Self {
        if let (Shape::Constant(a), Shape::Constant(b)) = (&a.shape, &b.shape) {
            return Self::constant(rule(*a, *b));
        }
        let rgb = Vec3::from_array(std::array::from_fn(|c| rule(a.rgb[c], b.rgb[c])));
        let shape = Shape::Combined(Box::new(Combined { a, b, rule, factor: 1.0 }));
        Self { rgb, film: shape.film_colour(), shape }
    }

    /// Wavelengths between which the spectrum is linear, besides the rows of the sensor's table.
    pub(super) fn knots(&self) -> Vec<f32> {
        self.shape.knots()
    }

    /// Multiplies every value by `factor`.
    #[must_use]
    pub fn scaled(mut self, factor: f32) -> Self {
        self.rgb *= factor;
        self.film *= factor;
        match &mut self.shape {
            Shape::Constant(value) => *value *= factor,
            Shape::Points(line) => line.scale(factor),
            Shape::Rgb(rgb) | Shape::RgbRadiance(rgb) => *rgb *= factor,
            Shape::Combined(combined) => combined.factor *= factor,
        }
        self
    }

    /// Value at a wavelength in nanometres.
    #[must_use]
    pub fn at(&self, lambda_nm: f32) -> f32 {
        self.shape.at(lambda_nm)
    }

    /// Components in RGB mode.
    #[must_use]
    pub fn rgb(&self) -> Vec3 {
        self.rgb
    }

    /// Returns whether the value is the same at every wavelength and in every component of RGB mode.
    #[must_use]
    pub fn is_flat(&self) -> bool {
        matches!(self.shape, Shape::Constant(_))
    }

    /// Linear sRGB on the film in spectral mode, if the spectrum is radiance: ∫ response(λ) Le(λ) dλ.
    #[must_use]
    pub fn film_colour(&self) -> Vec3 {
        self.film
    }

    /// Maximum over the rendered wavelengths.
    #[must_use]
    pub fn max_over_wavelengths(&self) -> f32 {
        let mut max = self.at(LAMBDA_MIN_NM).max(self.at(LAMBDA_MAX_NM));
        match &self.shape {
            Shape::Constant(_) => {}
            // The maximum of a piecewise linear function is at a point or at an end of the range.
            Shape::Points(line) => {
                for p in
                    line.points().iter().filter(|p| (LAMBDA_MIN_NM..=LAMBDA_MAX_NM).contains(&p.lambda_nm))
                {
                    max = max.max(p.value);
                }
            }
            Shape::Rgb(rgb) => max = rgb.max_element(),
            Shape::Combined(combined) => max = combined.largest(),
            Shape::RgbRadiance(_) => {
                let mut lambda = LAMBDA_MIN_NM;
                while lambda <= LAMBDA_MAX_NM {
                    max = max.max(self.at(lambda));
                    lambda += 5.0;
                }
            }
        }
        max
    }
}

impl Spectrum {
    /// Maximum over the rendered wavelengths and the three components of RGB mode.
    #[must_use]
    pub fn largest(&self) -> f32 {
        self.max_over_wavelengths().max(self.rgb.max_element())
    }

    /// Returns whether the value is above zero at every rendered wavelength and in every component of RGB
    /// mode.
    #[must_use]
    pub fn is_positive(&self) -> bool {
        let steps = (LAMBDA_MAX_NM - LAMBDA_MIN_NM) as u16;
        let lambdas = (0..=steps).map(|i| LAMBDA_MIN_NM + f32::from(i));
        let knots = self.knots().into_iter().filter(|l| (LAMBDA_MIN_NM..=LAMBDA_MAX_NM).contains(l));
        self.rgb.min_element() > 0.0 && lambdas.chain(knots).all(|lambda_nm| self.at(lambda_nm) > 0.0)
    }
}

impl Shape {
    /// Replaces a shape that is constant by `Constant`.
    fn simplified(self) -> Self {
        match self {
            Self::Points(line) if line.is_flat() => {
                Self::Constant(line.points().first().map_or(0.0, |p| p.value))
            }
            Self::Rgb(rgb) if rgb == Vec3::splat(rgb.x) => Self::Constant(rgb.x),
            other => other,
        }
    }

    fn film_colour(&self) -> Vec3 {
        observer::film_colour(|lambda| self.at(lambda), self.knots().into_iter())
    }

    fn knots(&self) -> Vec<f32> {
        match self {
            Self::Points(line) => line.points().iter().map(|p| p.lambda_nm).collect(),
            Self::Combined(combined) => combined.knots(),
            Self::Constant(_) | Self::Rgb(_) | Self::RgbRadiance(_) => Vec::new(),
        }
    }

    fn at(&self, lambda_nm: f32) -> f32 {
        match self {
            Self::Constant(value) => *value,
            Self::Points(line) => line.at(lambda_nm),
            Self::Rgb(rgb) => observer::basis(lambda_nm).dot(*rgb),
            Self::RgbRadiance(rgb) => observer::basis(lambda_nm).dot(*rgb) * observer::daylight(lambda_nm),
            Self::Combined(combined) => combined.at(lambda_nm),
        }
    }
}

impl SpectrumDoc {
    /// Value at a wavelength in nanometres, for a coefficient.
    #[must_use]
    pub fn value_at(&self, lambda_nm: f32) -> f32 {
        Spectrum::new(self, Quantity::Coefficient).at(lambda_nm)
    }

    /// All values, for validation.
    #[must_use]
    pub fn values(&self) -> Vec<f32> {
        match self {
            Self::Constant(value) => vec![*value],
            Self::Rgb(rgb) => rgb.to_vec(),
            Self::Points { .. } | Self::Preset(_) => self
                .control_points()
                .map(|(points, _)| points.iter().map(|p| p.value).collect())
                .unwrap_or_default(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn report() -> SpectrumDoc {
        SpectrumDoc::Preset("report-plume".into())
    }

    #[test]
    fn points_are_linear_between_and_hold_or_vanish_beyond() {
        let s = Spectrum::new(&report(), Quantity::Coefficient);
        for (lambda, expected) in
            [(360.0, 8.0), (430.0, 8.0), (485.0, 24.0), (540.0, 40.0), (556.0, 24.0), (700.0, 8.0)]
        {
            assert!((s.at(lambda) - expected).abs() < 1e-4, "{lambda}");
        }
        assert_eq!(s.max_over_wavelengths(), 40.0);
        let (points, _) = report().control_points().expect("a preset of points");
        let zero =
            Spectrum::new(&SpectrumDoc::Points { points, outside: Outside::Zero }, Quantity::Coefficient);
        assert_eq!([zero.at(429.0), zero.at(430.0), zero.at(572.0), zero.at(573.0)], [0.0, 8.0, 8.0, 0.0]);
    }

    #[test]
    fn rgb_components_of_a_constant_are_the_constant_and_stay_within_range() {
        assert_eq!(Spectrum::constant(0.7).rgb(), Vec3::splat(0.7));
        let rgb = Spectrum::new(&report(), Quantity::Coefficient).rgb();
        assert!(
            rgb.min_element() >= 8.0 && rgb.max_element() <= 40.0 && rgb.y > rgb.x && rgb.y > rgb.z,
            "{rgb}"
        );
    }
}
