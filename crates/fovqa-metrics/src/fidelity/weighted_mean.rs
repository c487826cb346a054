//! The mean with the foveal weight f²: for FPSNR of the squared error, and for foveated SSIM of the
//! map, Σ f² map / Σ f² over the pixels where it is defined.

/// The two sums of a weighted mean.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct WeightedMean {
    pub(crate) weighted: f64,
    pub(crate) weight: f64,
}

impl WeightedMean {
    pub(crate) fn add(&mut self, (weighted, weight): (f64, f64)) {
        self.weighted += weighted;
        self.weight += weight;
    }

    pub(crate) fn merge(&mut self, other: &Self) {
        self.add((other.weighted, other.weight));
    }

    /// The mean; `None` if the total weight is 0.
    pub(crate) fn mean(&self) -> Option<f64> {
        (self.weight > 0.0).then(|| self.weighted / self.weight)
    }
}
