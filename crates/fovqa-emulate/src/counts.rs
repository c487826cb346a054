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
    /// Blocks of 2x2 samples of the buffers, of methods with rectangular buffers. Where nested buffers
    /// repeat samples, so do these blocks.
    pub buffer_quads: Option<u64>,
}

impl Counts {
    /// Of a method that shades each sample once, all of them in the frame.
    pub(crate) fn on_screen(buffers: Vec<[usize; 2]>, samples: f64) -> Self {
        Self {
            buffers,
            samples,
            samples_on_screen: samples,
            samples_beyond: 0.0,
            quads: None,
            buffer_quads: None,
        }
    }

    /// Of a method whose buffers are rectangles, so that a rasteriser would fill them.
    pub(crate) fn rectangular(buffers: Vec<[usize; 2]>, samples: f64) -> Self {
        let buffer_quads = buffers.iter().copied().map(quads).sum();
        Self { buffer_quads: Some(buffer_quads), ..Self::on_screen(buffers, samples) }
    }

    /// The quads that a rasteriser would shade; `None` for polar buffers, continuous rates and
    /// reprojected samples, which do not fill blocks of 2x2.
    pub fn shaded_quads(&self) -> Option<u64> {
        self.quads.or(self.buffer_quads)
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
            buffer_quads: None,
        }
    }

    /// The share of `pixels` pixels that is shaded, with what lies beyond the method's own field.
    pub fn share(&self, pixels: f64) -> f64 {
        self.all() / pixels
    }
}

/// The number of quads, blocks of 2x2 samples, of a rectangle: those at its right and bottom edge may
/// be cut.
pub fn quads([width, height]: [usize; 2]) -> u64 {
    width.div_ceil(2) as u64 * height.div_ceil(2) as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quads_are_those_of_rectangular_buffers() {
        assert_eq!(quads([4, 6]), 6);
        assert_eq!(quads([5, 7]), 12);
        let counts = Counts::rectangular(vec![[5, 7], [2, 2]], 39.0);
        assert_eq!(counts.shaded_quads(), Some(13));
        assert_eq!(counts.reshaded(20.0).shaded_quads(), None);
    }
}
