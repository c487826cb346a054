//! Computes all profiles of one picture in one pass.

use fovqa_frame::{LumaKind, LumaSignal};

use super::haar;
use super::pass::{Contrast, Wanted, run};
use super::picture_input::PictureInput;
use super::rms_contrast;
use crate::kinds::MetricKind;
use crate::metric::Metric;
use crate::pooling::Parts;
use crate::registry::Params;
use crate::row::{Image, Key, Rows};
use crate::temporal::kept_plane::KeptPlane;

/// Measures the profiles of single pictures.
#[derive(Debug, Clone, PartialEq)]
pub struct Profiler {
    rms_contrast: Option<rms_contrast::Params>,
    haar: Option<haar::Params>,
    /// The profiles with a pass of their own.
    own: Vec<Metric>,
    params: Params,
}

impl Profiler {
    /// A profiler for the profiles among these metrics.
    pub fn new(metrics: &[Metric], params: &Params) -> Self {
        let wants = |metric| metrics.contains(&metric);
        let own = |metric: &Metric| metric.is(MetricKind::Profile) && metric.has_own_pass();
        Self {
            rms_contrast: wants(Metric::RmsContrast).then_some(params.rms_contrast),
            haar: wants(Metric::Haar).then_some(params.haar),
            own: metrics.iter().copied().filter(own).collect(),
            params: params.clone(),
        }
    }

    /// The number of wavelet levels; `None` if the wavelet is not asked for.
    pub fn haar_levels(&self) -> Option<usize> {
        self.haar.map(|haar| haar.levels as usize)
    }

    /// Whether there is nothing to measure.
    pub fn is_idle(&self) -> bool {
        self.rms_contrast.is_none() && self.haar.is_none() && self.own.is_empty()
    }

    /// Measures a picture. `plane` receives its luma for [`crate::temporal`].
    ///
    /// # Panics
    /// When regions, blocks or plane do not have the picture's size.
    pub fn measure(&self, input: &PictureInput<'_>, plane: Option<&mut KeptPlane>) -> Rows {
        let &PictureInput { frame, tables, regions, blocks, image, .. } = input;
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
        let mut rows = Rows::default();
        for metric in &self.own {
            if let Some(found) = self.params.profile(*metric, input) {
                rows.extend(&found);
            }
        }
        if plane.is_none() && contrast.is_none() && blocks.is_none() {
            return rows;
        }
        let sums = run(&Wanted { luma: &luma, contrast, regions, blocks }, plane);
        let bands = regions.bands();
        if let Some(params) = self.rms_contrast {
            let key = Key::of(Metric::RmsContrast).of_image(image);
            for (band, moments) in sums.moments[..bands].iter().enumerate() {
                let value = moments.contrast(params.normalise);
                rows.push(key.in_band(band), value, Parts::Value);
            }
        }
        if let Some((params, blocks)) = self.haar.zip(blocks) {
            for (level, of_level) in (1..).zip(&sums.haar) {
                let counts = blocks.counts(level);
                for (band, (sums, blocks)) in of_level[..bands].iter().zip(counts).enumerate() {
                    let key = Key::of(Metric::Haar).of_image(image).on_level(level).in_band(band);
                    haar::rows(key, sums, blocks, params.orientations, &mut rows);
                    // These numbers are the same for both pictures, and so belong to the pair.
                    if image == Image::Reference {
                        rows.count(haar::coefficients(key), 3 * blocks);
                    }
                }
            }
        }
        rows
    }
}
