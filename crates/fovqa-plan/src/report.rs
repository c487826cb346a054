//! What the report of a run shows of its frames.

use fovqa_metrics::Metric;
use fovqa_params::words;
use serde::{Deserialize, Serialize};

words! {
    /// A frame of a scene, by its place or its score.
    pub enum FrameWord {
        /// The first frame.
        First "first" "the first frame";
        /// The frame with the worst score of any method.
        Worst "worst" "the frame with the worst score of any method";
        /// The frame whose score, averaged over the methods, is the median.
        Median "median" "the frame whose score, averaged over the methods, is the median";
    }
}

/// A frame of each scene that the report shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum FrameChoice {
    /// A frame by its place or its score.
    Of(FrameWord),
    /// A frame by its number, where a scene has it.
    Number(i64),
}

impl FrameChoice {
    /// The number of frames of a scene up to which each may turn out to be the worst or the median one,
    /// and is kept until that is known. To score a frame again takes the frames before it as well, if
    /// anything is filtered over time, so that it costs more than to keep the pictures of a short scene.
    pub const FEW_FRAMES: usize = 24;

    /// Whether it may be a frame, as far as that is known before the frames are scored: the `nth` of
    /// `count` frames, from 0, with this number.
    pub fn is_foreseen(self, (nth, count): (usize, usize), number: i64) -> bool {
        match self {
            Self::Of(FrameWord::First) => nth == 0,
            Self::Of(FrameWord::Worst | FrameWord::Median) => count <= Self::FEW_FRAMES,
            Self::Number(chosen) => chosen == number,
        }
    }
}

/// The pairs whose pictures and maps are handed over while they are scored.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct WantedPictures {
    /// The frames of each scene.
    pub frames: Vec<FrameChoice>,
    /// Indices of the methods.
    pub methods: Vec<usize>,
}

impl WantedPictures {
    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.frames.is_empty() || self.methods.is_empty()
    }

    /// Whether those of a method are wanted of the `nth` of `count` frames, which has this number.
    pub fn is_of(&self, method: usize, place: (usize, usize), number: i64) -> bool {
        self.methods.contains(&method)
            && self.frames.iter().any(|frame| frame.is_foreseen(place, number))
    }
}

/// Which frames the report of a run shows, and how large.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ReportSettings {
    /// Longer side of the pictures on the page, in pixels. Smaller frames keep their size.
    pub size: usize,
    /// The frames of each scene; none if the report has no pictures.
    pub frames: Vec<FrameChoice>,
    /// The metric that ranks frames; `None` for the first of [`ReportSettings::ranking_metrics`] that was
    /// scored.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub metric: Option<Metric>,
}

impl Default for ReportSettings {
    fn default() -> Self {
        let frames = [FrameWord::Worst, FrameWord::Median, FrameWord::First];
        Self { size: 512, frames: frames.map(FrameChoice::Of).into(), metric: None }
    }
}

impl ReportSettings {
    /// The metrics that are preferred for ranking frames if none is chosen: those that weight an error by
    /// eccentricity come before those that do not. The other metrics that score frames follow.
    const PREFERRED: [Metric; 8] = [
        Metric::Fpsnr,
        Metric::Fssim,
        Metric::Psnr,
        Metric::Ssim,
        Metric::MsSsim,
        Metric::PuPsnr,
        Metric::Gmsd,
        Metric::Mse,
    ];

    /// The metrics that can rank frames, the preferred one first.
    pub fn ranking_metrics() -> impl Iterator<Item = Metric> {
        Metric::scoring_frames(&Self::PREFERRED)
    }

    /// Whether these are the default settings.
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }

    /// The metric that ranks frames, of those that were scored.
    pub fn ranking(&self, is_scored: impl Fn(Metric) -> bool) -> Option<Metric> {
        match self.metric {
            Some(metric) => Some(metric).filter(|metric| is_scored(*metric)),
            None => Self::ranking_metrics().find(|metric| is_scored(*metric)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_of_few_may_be_any_choice_and_one_of_many_is_known_by_its_place() {
        let [first, worst] = [FrameWord::First, FrameWord::Worst].map(FrameChoice::Of);
        assert!(first.is_foreseen((0, 9), 5) && !first.is_foreseen((1, 9), 6));
        assert!(worst.is_foreseen((0, 1), 5) && worst.is_foreseen((23, 24), 5));
        assert!(!worst.is_foreseen((0, 25), 5));
        let seven = FrameChoice::Number(7);
        assert!(seven.is_foreseen((3, 9), 7) && !seven.is_foreseen((7, 9), 8));
    }

    #[test]
    fn frames_are_ranked_by_the_foveated_metric_that_was_scored() {
        let settings = ReportSettings::default();
        let of = |scored: &[Metric]| settings.ranking(|metric| scored.contains(&metric));
        assert_eq!(of(&[Metric::Mse, Metric::Psnr, Metric::Fpsnr]), Some(Metric::Fpsnr));
        assert_eq!(of(&[Metric::Mse, Metric::Ssim]), Some(Metric::Ssim));
        assert_eq!(of(&[Metric::Haar, Metric::Fvvdp]), None);
        for metric in Metric::ALL.into_iter().filter(|metric| metric.scores_frames()) {
            assert_eq!(of(&[metric]), Some(metric));
        }
        let asked = ReportSettings { metric: Some(Metric::Ssim), ..settings };
        assert_eq!(asked.ranking(|_| true), Some(Metric::Ssim));
        assert_eq!(asked.ranking(|metric| metric == Metric::Psnr), None);
    }
}
