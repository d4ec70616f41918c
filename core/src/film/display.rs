//! Display transform from linear radiance to display colour: exposure, tone curve, gamma. Shared by window
//! and PNG export.

use serde::{Deserialize, Serialize};

/// Settings of the display transform.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ViewDoc {
    /// Exposure in stops: radiance is multiplied by 2 to this power.
    pub exposure_ev: f32,
    /// Tone curve.
    pub tone: ToneCurve,
    /// Display gamma. Absent: the sRGB curve.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gamma: Option<f32>,
}

impl Default for ViewDoc {
    fn default() -> Self {
        Self { exposure_ev: 0.0, tone: ToneCurve::Filmic, gamma: None }
    }
}

/// Tone curve, which maps radiance into the display's range.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ToneCurve {
    /// Clips at 1, without tone mapping.
    Linear,
    /// x / (1 + luminance), after Reinhard et al. 2002.
    Reinhard,
    /// Filmic curve with shoulder and toe, per channel (Narkowicz's fit of ACES).
    #[default]
    Filmic,
}

/// Display transform, prepared for application to many pixels.
#[derive(Clone, Copy, Debug)]
pub struct DisplayTransform {
    exposure: f32,
    tone: ToneCurve,
    /// 1/γ, or the sRGB curve.
    inverse_gamma: Option<f32>,
}

impl DisplayTransform {
    /// Creates the transform from its settings.
    #[must_use]
    pub fn new(view: &ViewDoc) -> Self {
        Self { exposure: view.exposure_ev.exp2(), tone: view.tone, inverse_gamma: view.gamma.map(f32::recip) }
    }

    /// Converts one linear sRGB value to 8 bits per channel. Non-finite values become magenta.
    #[must_use]
    pub fn encode(&self, linear: [f32; 3]) -> [u8; 3] {
        if linear.iter().any(|x| !x.is_finite()) {
            return [255, 0, 255];
        }
        // Bounded, so that no tone curve divides infinity by infinity.
        let exposed = linear.map(|x| (x * self.exposure).clamp(0.0, 1e15));
        self.toned(exposed).map(|x| {
            let x = x.clamp(0.0, 1.0);
            let encoded = match self.inverse_gamma {
                Some(power) => x.powf(power),
                None => srgb_curve(x),
            };
            (encoded * 255.0 + 0.5) as u8
        })
    }

    fn toned(&self, rgb: [f32; 3]) -> [f32; 3] {
        match self.tone {
            ToneCurve::Linear => rgb,
            ToneCurve::Reinhard => {
                let luminance = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
                rgb.map(|x| x / (1.0 + luminance))
            }
            ToneCurve::Filmic => rgb.map(|x| {
                // K. Narkowicz, "ACES filmic tone mapping curve" (2015), with his exposure of 0.6.
                let x = 0.6 * x;
                x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)
            }),
        }
    }
}

/// The sRGB transfer curve (IEC 61966-2-1).
fn srgb_curve(x: f32) -> f32 {
    if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_view_is_srgb_and_clips() {
        let view = ViewDoc { tone: ToneCurve::Linear, ..ViewDoc::default() };
        let t = DisplayTransform::new(&view);
        assert_eq!(t.encode([0.0, 1.0, 9.0]), [0, 255, 255]);
        assert_eq!(t.encode([0.216, -1.0, 0.0]), [128, 0, 0]);
        assert_eq!(t.encode([f32::NAN, 0.0, 0.0]), [255, 0, 255]);
        let brighter = DisplayTransform::new(&ViewDoc { exposure_ev: 1.0, ..view });
        assert_eq!(brighter.encode([0.108; 3]), [128; 3]);
    }

    #[test]
    fn the_brightest_is_white_under_every_curve() {
        for tone in [ToneCurve::Linear, ToneCurve::Reinhard, ToneCurve::Filmic] {
            let t = DisplayTransform::new(&ViewDoc { tone, gamma: None, exposure_ev: 64.0 });
            assert_eq!(t.encode([1e30; 3]), [255; 3]);
        }
    }

    #[test]
    fn every_curve_rises() {
        for tone in [ToneCurve::Linear, ToneCurve::Reinhard, ToneCurve::Filmic] {
            let t = DisplayTransform::new(&ViewDoc { tone, gamma: Some(2.2), exposure_ev: -1.0 });
            let shown: Vec<u8> = (0..200u8).map(|i| t.encode([f32::from(i) * 0.05; 3])[0]).collect();
            assert!(shown.is_sorted());
        }
    }
}
