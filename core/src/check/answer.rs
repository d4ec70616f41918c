//! What a case's image should be.

use super::Layout;

/// A known mean with the standard error that it is known with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Value {
    /// The mean.
    pub mean: f64,
    /// Its standard error: of quadrature, or of the renderer that made it.
    pub error: f64,
}

/// What a case's image should be.
#[derive(Clone, Debug)]
pub enum Answer {
    /// A closed form, quadrature, or another renderer's picture: one value per block and channel.
    Known(Vec<Value>),
    /// Nobody knows: the estimators are held against each other, pair by pair.
    Agreement,
}

impl Answer {
    /// Exact values, the same colour in every block.
    #[must_use]
    pub fn uniform(colour: [f64; 3], layout: Layout) -> Self {
        Self::blocks(&vec![colour; layout.blocks()])
    }

    /// Exact values, block by block.
    #[must_use]
    pub fn blocks(colours: &[[f64; 3]]) -> Self {
        Self::Known(colours.iter().flatten().map(|mean| Value { mean: *mean, error: 0.0 }).collect())
    }

    /// The same values, known with a relative standard error only.
    #[must_use]
    pub fn within(self, relative: f64) -> Self {
        match self {
            Self::Known(values) => Self::Known(
                values
                    .into_iter()
                    .map(|v| Value { mean: v.mean, error: v.error.hypot(relative * v.mean) })
                    .collect(),
            ),
            Self::Agreement => Self::Agreement,
        }
    }

    /// Mean over all blocks and channels, of independent values.
    #[must_use]
    pub fn whole(&self) -> Option<Value> {
        let Self::Known(values) = self else { return None };
        let n = values.len() as f64;
        let squares: f64 = values.iter().map(|v| v.error * v.error).sum();
        Some(Value { mean: values.iter().map(|v| v.mean).sum::<f64>() / n, error: squares.sqrt() / n })
    }
}
