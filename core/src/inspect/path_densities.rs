//! Contribution f and densities p_uni and p_nee of a path, from their definition.

use super::product::{Product, Products, times};
use crate::spectrum::Lanes;
use crate::transport::{CollisionRecord, WeightRecord};

/// Contribution of a path and its densities under each technique, as products over the events so far.
#[derive(Clone, Copy)]
pub(super) struct PathDensities {
    pub f: Products,
    pub uni: Products,
    pub nee: Products,
    /// Density of the path under equiangular sampling of its vertex; valid on an equiangular branch only.
    pub eq: Products,
    /// Probability that a connection selects the light at the last vertex, where the density of a connection
    /// omits it.
    pub choice: f32,
    /// Numbers of real vertices and of null collisions so far.
    pub order: u32,
    pub nulls: u32,
    /// Whether all factors so far have a density.
    pub defined: bool,
    /// Path weights of the estimator; `None` where it has none, or has not reported them yet.
    pub kept: Option<WeightRecord>,
    /// Row of the event whose path weights have yet to be reported.
    pub awaiting: Option<usize>,
}

impl PathDensities {
    pub const CAMERA: Self = Self {
        f: [Product::ONE; 4],
        uni: [Product::ONE; 4],
        nee: [Product::ONE; 4],
        eq: [Product::ONE; 4],
        choice: 1.0,
        order: 0,
        nulls: 0,
        defined: true,
        kept: None,
        awaiting: None,
    };

    pub fn pass(&mut self, optical_depth: &Lanes) {
        for products in [&mut self.f, &mut self.uni, &mut self.nee, &mut self.eq] {
            for (product, tau) in products.iter_mut().zip(optical_depth) {
                *product = product.attenuated(f64::from(*tau));
            }
        }
    }

    pub fn null(&mut self, c: &CollisionRecord) {
        self.nulls += 1;
        times(&mut self.f, &c.null);
        times(&mut self.uni, &c.null_density);
        times(&mut self.nee, &c.majorant);
        times(&mut self.eq, &c.majorant);
    }

    pub fn scatter(&mut self, c: &CollisionRecord) {
        times(&mut self.f, &c.scattering);
        times(&mut self.uni, &c.scattering_density);
    }

    /// Starts an equiangular branch at the origin of the path's ray.
    pub fn begin_equiangular(&self) -> Self {
        Self { eq: self.uni, defined: true, ..*self }
    }

    /// Updates the densities for the vertex of an equiangular branch, sampled with this density.
    pub fn scatter_equiangular(&mut self, c: &CollisionRecord, density: f32, choice: f32) {
        self.scatter(c);
        times(&mut self.eq, &[density; 4]);
        self.choice = choice;
    }

    pub fn choose_direction(&mut self, value: f32, density: f32) {
        self.nee = self.uni;
        times(&mut self.f, &[value; 4]);
        times(&mut self.uni, &[density; 4]);
    }

    /// Updates the densities for leaving a surface whose lobes depend on the component.
    pub fn leave(&mut self, value: &Lanes, density: &Lanes, connects: bool) {
        self.nee = self.uni;
        if !connects {
            times(&mut self.nee, &[0.0; 4]);
        }
        self.adjust(value, density);
    }

    /// Multiplies f and p_uni.
    pub fn adjust(&mut self, value: &Lanes, density: &Lanes) {
        times(&mut self.f, value);
        times(&mut self.uni, density);
    }

    pub fn connected(&self, value: f32, walk_density: f32, light_density: f32) -> Self {
        let mut link = *self;
        link.nee = self.uni;
        times(&mut link.f, &[value; 4]);
        times(&mut link.uni, &[walk_density; 4]);
        times(&mut link.nee, &[light_density * self.choice; 4]);
        times(&mut link.eq, &[light_density; 4]);
        link
    }

    /// Le_j f_j over the mean of the densities, where the mean is over components and sums over techniques.
    pub fn value(&self, emitted: &Lanes, densities: &[&Products], count: usize, grey: bool) -> Option<Lanes> {
        if !self.defined {
            return None;
        }
        let all = || densities.iter().flat_map(|p| &p[..count]).map(|p| p.ln());
        let largest = all().fold(f64::NEG_INFINITY, f64::max);
        let mean = all().map(|ln| (ln - largest).exp()).sum::<f64>() / count as f64;
        let ln = largest + mean.ln();
        // On grey paths one weight applies to all channels of the film.
        let weight =
            |i: usize| if i < count || grey { self.f[if grey { 0 } else { i }].over(ln) } else { 0.0 };
        Some(std::array::from_fn(|i| (f64::from(emitted[i]) * weight(i)) as f32))
    }
}
