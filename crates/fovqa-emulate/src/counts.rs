//! How many samples an emulated frame stands for.

/// Samples of a method's rounded buffers. Whole numbers but for methods of a continuous rate and for
/// reprojected samples.
#[derive(Debug, Clone, PartialEq)]
pub struct Counts {
    /// Columns and rows of each buffer, the innermost first; of columns of different lengths, the
    /// longest. Empty for methods without a buffer.
    pub buffers: Vec<[usize; 2]>,
    /// What is shaded, within the method's own field.
    pub samples: f64,
    /// Of these and of the ones beyond, those whose place is in the frame.
    pub samples_on_screen: f64,
    /// What is shaded beyond the method's own field (VaFR beyond 60°).
    pub samples_beyond: f64,
    /// Coarse pixel shading: blocks of 2x2 samples with a sample in use.
    pub quads: Option<u64>,
}

impl Counts {
    /// Of a method that shades each sample once, all of them in the frame.
    pub(crate) fn on_screen(buffers: Vec<[usize; 2]>, samples: f64) -> Self {
        let samples_on_screen = samples;
        Self { buffers, samples, samples_on_screen, samples_beyond: 0.0, quads: None }
    }

    /// All samples, also those beyond the method's own field.
    pub fn all(&self) -> f64 {
        self.samples + self.samples_beyond
    }

    /// What remains if only `shaded` of all samples are shaded, all of them in the frame: those whose
    /// pixels cannot be taken from the other eye. The share is the same within the field and beyond it.
    #[must_use]
    pub fn reshaded(&self, shaded: f64) -> Self {
        let part = |samples: f64| samples * shaded / self.all();
        Self {
            buffers: self.buffers.clone(),
            samples: part(self.samples),
            samples_on_screen: shaded,
            samples_beyond: part(self.samples_beyond),
            quads: None,
        }
    }

    /// The share of `pixels` pixels that is shaded, with what lies beyond the method's own field.
    pub fn share(&self, pixels: f64) -> f64 {
        self.all() / pixels
    }
}
