//! The mean under the foveal weight f²: FPSNR's of the squared error, and foveated SSIM's of the map,
//! Σ f² map / Σ f² over the pixels where it is defined (our own, beside FPSNR; in [-1, 1], higher is
//! better).

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

    /// `None` without any weight.
    pub(crate) fn mean(&self) -> Option<f64> {
        (self.weight > 0.0).then(|| self.weighted / self.weight)
    }
}
