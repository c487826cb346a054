//! All profiles of one picture, from one pass.

use fovqa_frame::{Frame, LumaKind, LumaSignal, SignalTables};

use super::haar::{self, HaarBand};
use super::pass::{Contrast, Wanted, run};
use super::rms_contrast;
use crate::regions::{BlockRegions, Regions};
use crate::registry::Metric;
use crate::registry::Params;
use crate::temporal::KeptPlane;

/// What there is to say of one picture.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Profile {
    /// RMS contrast of each band, where it is asked for; `None` in a band without pixels, or without a
    /// mean to divide by.
    pub rms_contrast: Option<Vec<Option<f64>>>,
    /// The wavelet level by level from 1 on, band by band, where it is asked for.
    pub haar: Option<Vec<Vec<HaarBand>>>,
}

/// Measures pictures one by one.
#[derive(Debug, Clone, PartialEq)]
pub struct Profiler {
    rms_contrast: Option<rms_contrast::Params>,
    haar: Option<haar::Params>,
}

impl Profiler {
    /// A profiler for those of the metrics that are profiles.
    pub fn new(metrics: &[Metric], params: &Params) -> Self {
        let wants = |metric| metrics.contains(&metric);
        Self {
            rms_contrast: wants(Metric::RmsContrast).then_some(params.rms_contrast),
            haar: wants(Metric::Haar).then_some(params.haar),
        }
    }

    /// Levels of the wavelet; `None` where it is not asked for.
    pub fn haar_levels(&self) -> Option<usize> {
        self.haar.map(|haar| haar.levels as usize)
    }

    /// Whether there is nothing to measure.
    pub fn is_idle(&self) -> bool {
        self.rms_contrast.is_none() && self.haar.is_none()
    }

    /// Measures a picture. `plane` takes its luma, for [`crate::temporal`].
    ///
    /// # Panics
    /// When regions, blocks or plane are not of pictures of this size.
    pub fn measure(
        &self,
        frame: &Frame,
        tables: &SignalTables,
        regions: &Regions<'_>,
        blocks: &BlockRegions<'_>,
        plane: Option<&mut KeptPlane>,
    ) -> Profile {
        assert_eq!(regions.rows(), frame.height(), "regions of this picture");
        let plane = plane.map(|plane| plane.resized(frame.width(), frame.height()));
        let luma = LumaSignal::new(frame, tables, LumaKind::Luma);
        let luminance = self
            .rms_contrast
            .filter(|params| params.signal == LumaKind::Luminance)
            .map(|params| LumaSignal::new(frame, tables, params.signal));
        let contrast =
            self.rms_contrast.map(|_| luminance.as_ref().map_or(Contrast::Luma, Contrast::Of));
        let blocks = self.haar.map(|haar| {
            assert_eq!(blocks.levels(), haar.levels as usize, "blocks of these levels");
            blocks
        });
        let sums = run(&Wanted { luma: &luma, contrast, regions, blocks }, plane);
        let bands = regions.bands();
        let rms_contrast = self.rms_contrast.map(|params| {
            sums.moments[..bands].iter().map(|m| m.contrast(params.normalise)).collect()
        });
        let haar = self.haar.zip(blocks).map(|(params, blocks)| {
            let levels = sums.haar.iter().enumerate().map(|(index, level)| {
                let counts = blocks.counts(index + 1);
                let bands = level[..bands].iter().zip(counts);
                bands.map(|(sums, blocks)| haar::band(sums, blocks, params.orientations)).collect()
            });
            levels.collect()
        });
        Profile { rms_contrast, haar }
    }
}
