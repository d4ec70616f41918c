//! Fresnel's equations for unpolarised light.

/// Reflectance of a boundary between dielectrics and the cosine of the refracted direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dielectric {
    /// Reflected fraction; 1 under total reflection.
    pub reflectance: f32,
    /// Cosine of the angle between the refracted direction and the normal; 0 under total reflection.
    pub cos_refracted: f32,
}

/// Fresnel's equations for a boundary whose far side has `eta` times the refractive index of the near side.
/// `cos_incident` ≥ 0 is the cosine on the near side.
///
/// ```text
///   r_s = (cos θi − η cos θt) / (cos θi + η cos θt),   r_p = (η cos θi − cos θt) / (η cos θi + cos θt)
///   R = (r_s² + r_p²) / 2,                             sin θi = η sin θt
/// ```
#[must_use]
#[inline]
pub fn dielectric(cos_incident: f32, eta: f32) -> Dielectric {
    let sin2_refracted = (1.0 - cos_incident * cos_incident).max(0.0) / (eta * eta);
    if sin2_refracted >= 1.0 {
        return Dielectric { reflectance: 1.0, cos_refracted: 0.0 };
    }
    let cos_refracted = (1.0 - sin2_refracted).sqrt();
    let s = (cos_incident - eta * cos_refracted) / (cos_incident + eta * cos_refracted);
    let p = (eta * cos_incident - cos_refracted) / (eta * cos_incident + cos_refracted);
    Dielectric { reflectance: 0.5 * (s * s + p * p), cos_refracted }
}

/// Reflectance of a conductor with complex index n + i k, relative to the near side (Born & Wolf 1999, §14.2).
#[must_use]
#[inline]
pub fn conductor(cos_incident: f32, n: f32, k: f32) -> f32 {
    let cos2 = cos_incident * cos_incident;
    let sin2 = (1.0 - cos2).max(0.0);
    let t = n * n - k * k - sin2;
    let a2_b2 = (t * t + 4.0 * n * n * k * k).sqrt();
    let a = (0.5 * (a2_b2 + t)).max(0.0).sqrt();
    let s = (a2_b2 + cos2 - 2.0 * a * cos_incident) / (a2_b2 + cos2 + 2.0 * a * cos_incident);
    let p = s * (cos2 * a2_b2 + sin2 * sin2 - 2.0 * a * cos_incident * sin2)
        / (cos2 * a2_b2 + sin2 * sin2 + 2.0 * a * cos_incident * sin2);
    0.5 * (s + p)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_incidence_brewster_and_total_reflection() {
        let normal = dielectric(1.0, 1.5);
        assert!((normal.reflectance - 0.04).abs() < 1e-6 && (normal.cos_refracted - 1.0).abs() < 1e-6);
        // At Brewster's angle tan θ = η the parallel component vanishes: R = r_s²/2.
        let brewster = 1.5f32.atan().cos();
        let s = (1.5f32 * 1.5 - 1.0) / (1.5 * 1.5 + 1.0);
        assert!((dielectric(brewster, 1.5).reflectance - 0.5 * s * s).abs() < 1e-6);
        assert_eq!(dielectric(0.1, 1.0 / 1.5), Dielectric { reflectance: 1.0, cos_refracted: 0.0 });
        assert!((dielectric(0.0, 1.5).reflectance - 1.0).abs() < 1e-6);
        assert!(dielectric(0.3, 1.0).reflectance < 1e-12);
        // The same from both sides.
        let into = dielectric(0.6, 1.33);
        assert!((dielectric(into.cos_refracted, 1.0 / 1.33).reflectance - into.reflectance).abs() < 1e-6);
    }

    #[test]
    fn conductors() {
        let normal = |n: f32, k: f32| ((n - 1.0).powi(2) + k * k) / ((n + 1.0).powi(2) + k * k);
        assert!((conductor(1.0, 0.2, 3.0) - normal(0.2, 3.0)).abs() < 1e-6);
        assert!((conductor(0.0, 0.2, 3.0) - 1.0).abs() < 1e-6);
        // Without absorption it is a dielectric.
        assert!((conductor(0.4, 1.5, 0.0) - dielectric(0.4, 1.5).reflectance).abs() < 1e-5);
    }
}
