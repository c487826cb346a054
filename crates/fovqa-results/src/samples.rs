//! The samples that an emulated method shades, over the frames.

use fovqa_metrics::{Image, Key, Subject};

use crate::report::FrameResult;

/// The samples of an emulated method per frame, as means over the frames. For two eyes together, the
/// samples of both are added, and the share is that of the pixels of both.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct SampleSummary {
    /// Samples within the method's own field.
    pub samples: f64,
    /// Samples whose position is in the frame.
    pub on_screen: f64,
    /// Samples beyond the method's own field.
    pub beyond: f64,
    /// All samples over the pixels of the frame.
    pub share: f64,
    /// The share of the eye's own samples that it shades, if it takes the others from the other eye.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reshaded_share: Option<f64>,
}

impl SampleSummary {
    /// The means over some frames; `None` if they were not emulated.
    pub fn of(frames: &[FrameResult]) -> Option<Self> {
        let mean = |subject: Subject| {
            let key = Key::pixels(subject).of_image(Image::Test);
            let values = frames.iter().filter_map(|frame| frame.rows.value(key));
            let (sum, count) = values.fold((0.0, 0), |(sum, n), value| (sum + value, n + 1));
            (count > 0).then(|| sum / f64::from(count))
        };
        Some(Self {
            samples: mean(Subject::Samples)?,
            on_screen: mean(Subject::SamplesOnScreen)?,
            beyond: mean(Subject::SamplesBeyond)?,
            share: mean(Subject::SamplesShare)?,
            reshaded_share: mean(Subject::ReshadedShare),
        })
    }
}
