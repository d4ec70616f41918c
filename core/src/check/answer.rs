//! Expected value of the image of a case.

use super::Layout;

/// A mean with its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Value {
    /// The mean.
    pub mean: f64,
    /// Standard error, of the quadrature or of the renderer that computed the value.
    pub error: f64,
}

/// Expected image of a case.
#[derive(Clone, Debug)]
pub enum Answer {
    /// A closed form, quadrature, or the image of another renderer: one value per block and channel.
    Known(Vec<Value>),
    /// No known value: the estimators are compared with each other, pair by pair.
    Agreement,
}

impl Answer {
    /// Exact values with the same colour in every block.
    #[must_use]
    pub fn uniform(colour: [f64; 3], layout: Layout) -> Self {
        Self::blocks(&vec![colour; layout.blocks()])
    }

    /// Exact values of each block.
    #[must_use]
    pub fn blocks(colours: &[[f64; 3]]) -> Self {
        Self::Known(colours.iter().flatten().map(|mean| Value { mean: *mean, error: 0.0 }).collect())
    }

    /// Adds a relative standard error to the known values.
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

    /// Mean over all blocks and channels, which are treated as independent. `None` without known values.
    #[must_use]
    pub fn whole(&self) -> Option<Value> {
        let Self::Known(values) = self else { return None };
        let n = values.len() as f64;
        let squares: f64 = values.iter().map(|v| v.error * v.error).sum();
        Some(Value { mean: values.iter().map(|v| v.mean).sum::<f64>() / n, error: squares.sqrt() / n })
    }
}
