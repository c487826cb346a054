//! The samples that an emulated method shades, over the frames.

use fovqa_metrics::{Image, Key, Subject};

use crate::report::FrameResult;

/// The samples of an emulated method per frame, as means over the frames. For two eyes together, the
/// samples of both are added, and the share is that of the pixels of both.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
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
    /// Blocks of 2x2 samples with a sample that is shaded, of methods whose samples lie in the frame's
    /// grid or in rectangular buffers. For two eyes together, those of both.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub quads: Option<f64>,
    /// The quads over those of the frame.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub quads_share: Option<f64>,
    /// The budget, if the method has one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub budget: Option<BudgetSummary>,
}

/// A budget and how it was met, as means over the frames: it is solved anew for each gaze.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct BudgetSummary {
    /// The share of the frame's pixels that was asked for.
    pub share: f64,
    /// The share of the method's buffers before their sizes are rounded.
    pub ideal_share: f64,
    /// The parameter that was solved: one value, or those of a list. Empty for both eyes together,
    /// because each has its own.
    pub value: Vec<f64>,
}

impl SampleSummary {
    /// The means over some frames; `None` if they were not emulated.
    pub fn of(frames: &[FrameResult]) -> Option<Self> {
        let mean_of = |key: Key| {
            let values = frames.iter().filter_map(|frame| frame.rows.value(key));
            let (sum, count) = values.fold((0.0, 0), |(sum, n), value| (sum + value, n + 1));
            (count > 0).then(|| sum / f64::from(count))
        };
        let key = |subject| Key::pixels(subject).of_image(Image::Test);
        let mean = |subject| mean_of(key(subject));
        let budget = mean(Subject::BudgetShare).zip(mean(Subject::BudgetIdealShare));
        let value = || -> Vec<f64> {
            let listed = |level| mean_of(key(Subject::BudgetValue).on_level(level));
            let list = (1..=usize::from(u8::MAX)).map_while(listed);
            mean(Subject::BudgetValue).map_or_else(|| list.collect(), |value| vec![value])
        };
        Some(Self {
            samples: mean(Subject::Samples)?,
            on_screen: mean(Subject::SamplesOnScreen)?,
            beyond: mean(Subject::SamplesBeyond)?,
            share: mean(Subject::SamplesShare)?,
            reshaded_share: mean(Subject::ReshadedShare),
            quads: mean(Subject::Quads),
            quads_share: mean(Subject::QuadsShare),
            budget: budget.map(|(share, ideal_share)| BudgetSummary {
                share,
                ideal_share,
                value: value(),
            }),
        })
    }
}
