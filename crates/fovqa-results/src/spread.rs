//! Mean, smallest and largest of several values.

/// Mean and extremes over the frames.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Spread {
    /// The mean.
    pub mean: f64,
    /// The smallest value.
    pub min: f64,
    /// The largest value.
    pub max: f64,
}

/// Collects values for a [`Spread`].
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Gathered {
    sum: f64,
    pub(crate) count: usize,
    extremes: Option<(f64, f64)>,
}

impl Gathered {
    pub(crate) fn add(&mut self, value: Option<f64>) {
        let Some(value) = value else { return };
        let (min, max) = self.extremes.unwrap_or((value, value));
        self.extremes = Some((min.min(value), max.max(value)));
        self.sum += value;
        self.count += 1;
    }

    /// The mean and extremes; `None` if there is no value.
    pub(crate) fn spread(&self) -> Option<Spread> {
        self.extremes.map(|(min, max)| Spread { mean: self.sum / self.count as f64, min, max })
    }
}
