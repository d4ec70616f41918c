//! Values at the components of a path.

use super::Lanes;
use crate::math;
use std::ops::{Add, AddAssign, Div, Index, Mul, MulAssign, Neg, Sub};

/// One value for each of the `N` components of a path: 4 wavelengths, 3 colour channels, or a single one.
/// Component 0 is the hero, whose coefficients drive all sampling decisions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampled<const N: usize>(pub [f32; N]);

impl<const N: usize> Sampled<N> {
    /// All zero.
    pub const ZERO: Self = Self([0.0; N]);
    /// All one.
    pub const ONE: Self = Self([1.0; N]);

    /// The same value for all components.
    #[must_use]
    pub const fn splat(value: f32) -> Self {
        Self([value; N])
    }

    /// Applies `f` to every component.
    #[must_use]
    pub fn map(self, f: impl FnMut(f32) -> f32) -> Self {
        Self(self.0.map(f))
    }

    /// Applies `f` to every pair of components.
    #[must_use]
    pub fn zip(self, other: Self, mut f: impl FnMut(f32, f32) -> f32) -> Self {
        Self(std::array::from_fn(|i| f(self.0[i], other.0[i])))
    }

    /// Value of the hero.
    #[must_use]
    pub const fn hero(&self) -> f32 {
        self.0[0]
    }

    /// Mean over the components: the balance heuristic's average over possible heroes.
    #[must_use]
    pub fn mean(self) -> f32 {
        self.0.iter().sum::<f32>() / N as f32
    }

    /// Maximum over the components.
    #[must_use]
    pub fn max_component(self) -> f32 {
        self.0.iter().copied().fold(f32::NEG_INFINITY, f32::max)
    }

    /// Returns whether every component is exactly zero.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.0.iter().all(|x| *x == 0.0)
    }

    /// Exponential of every component.
    #[must_use]
    #[inline]
    pub fn exp(self) -> Self {
        self.map(math::exp)
    }

    /// The values as a fixed-size array, padded with zeros.
    #[must_use]
    pub fn lanes(self) -> Lanes {
        let mut lanes = [0.0; 4];
        for (lane, value) in lanes.iter_mut().zip(self.0) {
            *lane = value;
        }
        lanes
    }

    /// Absolute values.
    #[must_use]
    pub fn abs(self) -> Self {
        self.map(f32::abs)
    }
}

macro_rules! componentwise {
    ($trait:ident, $method:ident, $op:tt) => {
        impl<const N: usize> $trait for Sampled<N> {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                self.zip(other, |a, b| a $op b)
            }
        }
        impl<const N: usize> $trait<f32> for Sampled<N> {
            type Output = Self;
            fn $method(self, other: f32) -> Self {
                self.map(|a| a $op other)
            }
        }
    };
}
componentwise!(Add, add, +);
componentwise!(Sub, sub, -);
componentwise!(Mul, mul, *);
componentwise!(Div, div, /);

impl<const N: usize> AddAssign for Sampled<N> {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<const N: usize> MulAssign for Sampled<N> {
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl<const N: usize> MulAssign<f32> for Sampled<N> {
    fn mul_assign(&mut self, other: f32) {
        *self = *self * other;
    }
}

impl<const N: usize> Neg for Sampled<N> {
    type Output = Self;
    fn neg(self) -> Self {
        self.map(|a| -a)
    }
}

impl<const N: usize> Index<usize> for Sampled<N> {
    type Output = f32;
    fn index(&self, i: usize) -> &f32 {
        &self.0[i]
    }
}
