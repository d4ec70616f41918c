//! Editable spectrum: a number, control points, a colour or the name of a preset.

use serde::de::{self, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;

use super::presets;

/// Extrapolation of a spectrum beyond its first and last control point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Outside {
    /// The value of the nearest control point.
    #[default]
    Hold,
    /// Zero.
    Zero,
}

/// Control point of a spectrum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControlPoint {
    /// Wavelength in nanometres.
    pub lambda_nm: f32,
    /// Value, in the unit of the quantity that the spectrum describes.
    pub value: f32,
}

/// An editable spectrum.
///
/// | in a scene file | meaning |
/// | --- | --- |
/// | `0.99` | the same value at every wavelength |
/// | `"430:8, 540:40, 572:8"` | control points, `wavelength in nm : value`, linear between |
/// | `"rayleigh"` | a preset by its id, see [`crate::spectrum::presets`] |
/// | `{ points = "430:8, 540:40", outside = "zero" }` | control points, zero beyond the ends (default `hold`)
/// |
/// | `{ rgb = [0.9, 0.5, 0.2] }` | linear sRGB |
#[derive(Clone, Debug, PartialEq)]
pub enum SpectrumDoc {
    /// One value at every wavelength.
    Constant(f32),
    /// Control points in increasing order of wavelength, linear between.
    Points {
        /// Control points; at least one.
        points: Vec<ControlPoint>,
        /// Extrapolation beyond the ends.
        outside: Outside,
    },
    /// Linear sRGB components.
    Rgb([f32; 3]),
    /// Id of a preset.
    Preset(String),
}

impl SpectrumDoc {
    /// Parses `"430:8, 540:40"`: control points separated by commas, with increasing wavelengths in nm.
    ///
    /// # Errors
    /// A message with the invalid point and the expected form.
    pub fn parse_points(text: &str) -> Result<Vec<ControlPoint>, String> {
        let mut points: Vec<ControlPoint> = Vec::new();
        for part in text.split(',').map(str::trim).filter(|p| !p.is_empty()) {
            let (lambda, value) = part.split_once(':').ok_or_else(|| {
                format!("`{part}` is not a control point: write `wavelength in nm : value`, e.g. `540:40`")
            })?;
            let number = |s: &str| {
                s.trim().parse::<f32>().map_err(|_| format!("`{}` in `{part}` is not a number", s.trim()))
            };
            let point = ControlPoint { lambda_nm: number(lambda)?, value: number(value)? };
            if let Some(last) = points.last()
                && point.lambda_nm <= last.lambda_nm
            {
                return Err(format!(
                    "control points must increase in wavelength: {} nm follows {} nm",
                    point.lambda_nm, last.lambda_nm
                ));
            }
            points.push(point);
        }
        if points.is_empty() {
            return Err("a spectrum needs at least one control point such as `540:40`".into());
        }
        Ok(points)
    }

    /// Formats control points as in a scene file.
    #[must_use]
    pub fn format_points(points: &[ControlPoint]) -> String {
        let parts: Vec<String> = points.iter().map(|p| format!("{}:{}", p.lambda_nm, p.value)).collect();
        parts.join(", ")
    }

    /// Control points for an editor: those of `Points` and presets; `None` for constants and colours.
    #[must_use]
    pub fn control_points(&self) -> Option<(Vec<ControlPoint>, Outside)> {
        match self {
            Self::Points { points, outside } => Some((points.clone(), *outside)),
            Self::Preset(id) => {
                let points = Self::parse_points(presets::find(id)?.points).ok()?;
                Some((points, Outside::Hold))
            }
            Self::Constant(_) | Self::Rgb(_) => None,
        }
    }
}

impl Serialize for SpectrumDoc {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeMap;
        match self {
            Self::Constant(value) => serializer.serialize_f32(*value),
            Self::Preset(id) => serializer.serialize_str(id),
            Self::Points { points, outside: Outside::Hold } => {
                serializer.serialize_str(&Self::format_points(points))
            }
            Self::Points { points, outside } => {
                let mut map = serializer.serialize_map(Some(2))?;
                map.serialize_entry("points", &Self::format_points(points))?;
                map.serialize_entry("outside", outside)?;
                map.end()
            }
            Self::Rgb(rgb) => {
                let mut map = serializer.serialize_map(Some(1))?;
                map.serialize_entry("rgb", rgb)?;
                map.end()
            }
        }
    }
}

impl<'de> Deserialize<'de> for SpectrumDoc {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(SpectrumVisitor)
    }
}

struct SpectrumVisitor;

impl<'de> Visitor<'de> for SpectrumVisitor {
    type Value = SpectrumDoc;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(
            "a spectrum: a number, control points such as \"430:8, 540:40\", a preset's name, \
             { points = \"…\", outside = \"zero\" } or { rgb = [r, g, b] }",
        )
    }

    fn visit_f64<E: de::Error>(self, value: f64) -> Result<SpectrumDoc, E> {
        Ok(SpectrumDoc::Constant(value as f32))
    }

    fn visit_i64<E: de::Error>(self, value: i64) -> Result<SpectrumDoc, E> {
        Ok(SpectrumDoc::Constant(value as f32))
    }

    fn visit_u64<E: de::Error>(self, value: u64) -> Result<SpectrumDoc, E> {
        Ok(SpectrumDoc::Constant(value as f32))
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<SpectrumDoc, E> {
        if text.contains(':') {
            let points = SpectrumDoc::parse_points(text).map_err(E::custom)?;
            return Ok(SpectrumDoc::Points { points, outside: Outside::Hold });
        }
        match presets::find(text) {
            Some(preset) => Ok(SpectrumDoc::Preset(preset.id.to_owned())),
            None => Err(E::custom(format!(
                "`{text}` is neither control points (\"430:8, 540:40\") nor a preset ({})",
                presets::ids().join(", ")
            ))),
        }
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<SpectrumDoc, A::Error> {
        let (mut points, mut outside, mut rgb) = (None::<String>, None::<Outside>, None::<[f32; 3]>);
        while let Some(key) = map.next_key::<String>()? {
            match key.as_str() {
                "points" => points = Some(map.next_value()?),
                "outside" => outside = Some(map.next_value()?),
                "rgb" => rgb = Some(map.next_value()?),
                other => return Err(de::Error::unknown_field(other, &["points", "outside", "rgb"])),
            }
        }
        match (points, rgb) {
            (Some(text), None) => Ok(SpectrumDoc::Points {
                points: SpectrumDoc::parse_points(&text).map_err(de::Error::custom)?,
                outside: outside.unwrap_or_default(),
            }),
            (None, Some(rgb)) if outside.is_none() => Ok(SpectrumDoc::Rgb(rgb)),
            _ => Err(de::Error::custom("give either `points` (with `outside`) or `rgb`")),
        }
    }
}
