//! The part of a run's summary that tables and figures show. A run can have very many comparisons,
//! so only these numbers are kept of each.

mod bands;

use std::collections::BTreeMap;
use std::path::Path;

use fovqa_metrics::{Metric, MetricKind};
use fovqa_results::{
    BudgetSummary, ComparisonSummary, DoubtRecord, EccentricityShare, ErrorRecord, FileError,
    GuideSource, Statistics, TemporalSummaries, TemporalSummary, ViewRecord, read_summary,
};

use bands::of;
pub(crate) use bands::{Band, Compared, SpectrumBand, SpectrumPoint, WaveletBand};

/// The comparisons of a run, and its errors.
#[derive(Debug, Default)]
pub(crate) struct Overview {
    comparisons: Vec<Measured>,
    /// For each scene and method, the index of the comparison that represents them. If the scene
    /// has two eyes, it is the one of both.
    overall: BTreeMap<String, BTreeMap<String, usize>>,
    pub(crate) errors: Vec<ErrorRecord>,
    /// Likely mistakes in pairs that were scored, in words.
    pub(crate) mistakes: Vec<String>,
}

/// One method in one scene, for one eye or both.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Measured {
    /// Whether the values belong to the left or the right eye alone.
    pub(crate) is_of_one_eye: bool,
    /// Whether the values belong to both eyes together.
    pub(crate) is_of_both_eyes: bool,
    /// Number of frames that were scored.
    pub(crate) frames: usize,
    /// The view; `None` if there is none, and for both eyes together.
    pub(crate) view: Option<ViewRecord>,
    scores: Box<[(Metric, Score)]>,
    pub(crate) bands: Box<[Band]>,
    /// The wavelet statistics by level and band.
    pub(crate) wavelet: Box<[WaveletBand]>,
    /// The power spectrum of each band.
    pub(crate) spectrum: Box<[SpectrumBand]>,
    /// The temporal metrics of the sequence.
    pub(crate) temporal: TemporalSummaries,
    /// JOD of FovVideoVDP.
    pub(crate) jod: Option<f64>,
    /// Why there is no JOD, if it is known.
    pub(crate) jod_missing: Option<Box<str>>,
    /// `left`, `right` or `both`; empty if the scene has one image per frame.
    pub(crate) eye: String,
    /// The budget of an emulated method.
    pub(crate) budget: Option<BudgetSummary>,
    /// Samples of an emulated method in percent of the frame's pixels.
    pub(crate) samples_percent: Option<f64>,
    /// Its quads in percent of the frame's.
    pub(crate) quads_percent: Option<f64>,
    /// Share of each eccentricity band in the Q of FovVideoVDP.
    pub(crate) shares: Box<[EccentricityShare]>,
}

/// The score of a metric over the frames.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Score {
    pub(crate) mean: f64,
    /// For decibels, the number of frames without any error.
    pub(crate) identical_frames: Option<usize>,
}

impl Overview {
    /// Reads the overview from a results folder.
    pub(crate) fn read(folder: &Path) -> Result<Self, FileError> {
        let mut overview = Self::default();
        let errors = read_summary(folder, |comparison| overview.add(&comparison))?;
        Ok(Self { errors, ..overview })
    }

    fn add(&mut self, comparison: &ComparisonSummary) {
        let measured = Measured::of(comparison);
        self.mistakes.extend(comparison.plausibility.iter().map(|of| mistake(comparison, of)));
        self.insert(&comparison.scene, comparison.label(), measured);
    }

    /// Adds a comparison.
    pub(crate) fn insert(&mut self, scene: &str, method: String, measured: Measured) {
        if !measured.is_of_one_eye {
            let methods = self.overall.entry(scene.to_owned()).or_default();
            methods.entry(method).or_insert(self.comparisons.len());
        }
        self.comparisons.push(measured);
    }

    /// The values of a method in a scene: of each eye, if there are two.
    pub(crate) fn eyes_of(&self, scene: &str, method: &str) -> Vec<&Measured> {
        let overall = self.overall.get(scene).and_then(|methods| methods.get(method));
        let Some(&overall) = overall else { return Vec::new() };
        match self.comparisons.get(overall) {
            // Both together follow the two eyes.
            Some(both) if both.is_of_both_eyes => {
                self.comparisons[overall.saturating_sub(2)..overall].iter().collect()
            }
            alone => alone.into_iter().collect(),
        }
    }

    /// All comparisons.
    pub(crate) fn all(&self) -> &[Measured] {
        &self.comparisons
    }

    /// The values of a method in a scene. If the scene has two eyes, these are the values of both
    /// together.
    pub(crate) fn of(&self, scene: &str, method: &str) -> Option<&Measured> {
        self.comparisons.get(*self.overall.get(scene)?.get(method)?)
    }
}

impl Measured {
    /// Made-up values, for figures that are laid out before anything is scored. With a number of
    /// levels of the wavelet, there are values by eccentricity.
    pub(crate) fn expected(metrics: &[Metric], frames: usize, levels: Option<usize>) -> Self {
        let has = |metric: Metric| metrics.contains(&metric);
        let bands = levels.map_or(0, |_| 2);
        let edges = (0..bands).map(|band| (f64::from(band) * 10.0, f64::from(band + 1) * 10.0));
        let compared = || Compared::new([1.0, 2.0, 2.0].map(Some));
        let of_band = |(from_deg, to_deg)| Band {
            from_deg,
            to_deg,
            means: metrics.iter().map(|metric| (*metric, Some(1.0 + from_deg))).collect(),
            compared: metrics.iter().map(|metric| (*metric, compared())).collect(),
        };
        let level = |level: usize| {
            edges.clone().map(move |(from_deg, to_deg)| WaveletBand {
                level: level as u8,
                from_deg,
                to_deg,
                statistics: [compared(); 3],
            })
        };
        let share = |(from_deg, to_deg)| EccentricityShare { from_deg, to_deg, share: Some(0.5) };
        let score = |metric: &Metric| (*metric, Score { mean: 1.0, identical_frames: None });
        let of_metric = |metric: &&Metric| metric.is(MetricKind::Fidelity);
        let spectrum = |(from_deg, to_deg)| {
            let points = Box::new([SpectrumPoint { cpd: 1.0, values: compared() }]);
            SpectrumBand { from_deg, to_deg, cutoff_cpd: Some(1.0), points }
        };
        let over_time = |metric: &&Metric| metric.is(MetricKind::Temporal);
        let temporal = |metric: &Metric| {
            let summary = TemporalSummary {
                reference: Some(1.0),
                test: Some(1.0),
                ratio: Some(1.0),
                left_out: None,
                left_out_test: None,
                frames: frames.saturating_sub(1),
                motion: GuideSource::default(),
                depth: GuideSource::default(),
                reason: None,
            };
            (*metric, summary)
        };
        let levels = 1..=levels.filter(|_| has(Metric::Haar)).unwrap_or(0);
        let shares = edges.clone().filter(|_| has(Metric::Fvvdp)).map(share);
        Self {
            is_of_one_eye: false,
            is_of_both_eyes: false,
            frames,
            view: None,
            scores: metrics.iter().filter(of_metric).map(score).collect(),
            bands: edges.clone().map(of_band).collect(),
            wavelet: levels.flat_map(level).collect(),
            spectrum: edges.clone().filter(|_| has(Metric::Spectrum)).map(spectrum).collect(),
            temporal: TemporalSummaries(metrics.iter().filter(over_time).map(temporal).collect()),
            jod: has(Metric::Fvvdp).then_some(9.0),
            jod_missing: None,
            eye: String::new(),
            budget: None,
            samples_percent: None,
            quads_percent: None,
            shares: shares.collect(),
        }
    }

    fn of(comparison: &ComparisonSummary) -> Self {
        let score = |(metric, of): (&Metric, &Statistics)| {
            (*metric, Score { mean: of.mean, identical_frames: of.identical_frames })
        };
        let fvvdp = comparison.fvvdp.as_ref();
        Self {
            is_of_one_eye: !matches!(comparison.eye.as_str(), "" | "both"),
            is_of_both_eyes: comparison.eye == "both",
            frames: comparison.frames,
            view: comparison.view.clone(),
            scores: comparison.metrics.iter().map(score).collect(),
            bands: comparison.bands.iter().map(Band::of).collect(),
            wavelet: comparison.haar.iter().map(WaveletBand::of).collect(),
            spectrum: comparison.spectrum.iter().map(SpectrumBand::of).collect(),
            temporal: comparison.temporal.clone(),
            jod: fvvdp.and_then(|fvvdp| fvvdp.jod),
            jod_missing: fvvdp.and_then(|fvvdp| fvvdp.reason.as_deref()).map(Into::into),
            eye: comparison.eye.clone(),
            budget: comparison.samples.as_ref().and_then(|samples| samples.budget.clone()),
            samples_percent: comparison.samples.as_ref().map(|samples| samples.share * 100.0),
            quads_percent: comparison
                .samples
                .as_ref()
                .and_then(|samples| samples.quads_share)
                .map(|share| share * 100.0),
            shares: fvvdp.map(|fvvdp| fvvdp.shares.as_slice().into()).unwrap_or_default(),
        }
    }

    /// Width and height of the frames; `None` without a view.
    pub(crate) fn frame_px(&self) -> Option<[usize; 2]> {
        self.view.as_ref().map(|view| [view.width, view.height])
    }

    /// The scores of whole frames.
    pub(crate) fn scores(&self) -> impl Iterator<Item = &Score> {
        self.scores.iter().map(|(_, score)| score)
    }

    /// The score of a metric.
    pub(crate) fn score(&self, metric: Metric) -> Option<&Score> {
        of(&self.scores, metric)
    }

    /// Whether there are any values of a metric.
    pub(crate) fn is_scored(&self, metric: Metric) -> bool {
        match metric.info().kind {
            _ if metric == Metric::Fvvdp => self.jod.is_some(),
            MetricKind::Fidelity => self.score(metric).is_some(),
            MetricKind::Temporal => self.temporal.of(metric).is_some_and(|of| of.frames > 0),
            MetricKind::Profile if metric == Metric::Haar => !self.wavelet.is_empty(),
            MetricKind::Profile if metric == Metric::Spectrum => !self.spectrum.is_empty(),
            MetricKind::Profile => self.bands.iter().any(|band| band.compared(metric).is_some()),
        }
    }

    /// The value in table columns and bars: the mean over the frames or, for temporal metrics, the
    /// percentage that the papers use.
    pub(crate) fn value(&self, metric: Metric) -> Option<f64> {
        match metric {
            Metric::Fvvdp => self.jod,
            metric if metric.is(MetricKind::Temporal) => {
                Some(self.temporal.of(metric)?.ratio? * 100.0)
            }
            metric => Some(self.score(metric)?.mean),
        }
    }
}

/// A likely mistake, with its place.
fn mistake(comparison: &ComparisonSummary, doubt: &DoubtRecord) -> String {
    let eye = &comparison.eye;
    let eye = if eye.is_empty() { String::new() } else { format!(", {eye} eye") };
    let more = match doubt.frames {
        0 | 1 => String::new(),
        frames => format!(" and {} more", frames - 1),
    };
    let DoubtRecord { frame, message, .. } = doubt;
    format!("{}, {}{eye}, frame {frame}{more}: {message}", comparison.scene, comparison.label())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn comparison(scene: &str, method: &str, eye: &str, frames: usize) -> ComparisonSummary {
        ComparisonSummary {
            scene: scene.to_owned(),
            method: method.to_owned(),
            parameters: String::new(),
            eye: eye.to_owned(),
            frames,
            errors: 0,
            view: None,
            metrics: BTreeMap::new(),
            bands: Vec::new(),
            haar: Vec::new(),
            spectrum: Vec::new(),
            temporal: TemporalSummaries::default(),
            fvvdp: None,
            samples: None,
            plausibility: Vec::new(),
        }
    }

    #[test]
    fn likely_mistakes_say_where_they_are() {
        let mut overview = Overview::default();
        let of = |frames| DoubtRecord {
            check: "exposure".to_owned(),
            frame: 7,
            frames,
            message: "it is dark".to_owned(),
        };
        for (eye, frames) in [("left", 1), ("", 3)] {
            let mut comparison = comparison("s", "m", eye, 8);
            comparison.plausibility.push(of(frames));
            overview.add(&comparison);
        }
        let wanted =
            ["s, m, left eye, frame 7: it is dark", "s, m, frame 7 and 2 more: it is dark"];
        assert_eq!(overview.mistakes, wanted);
    }

    #[test]
    fn both_eyes_stand_for_a_method_in_a_scene() {
        let mut overview = Overview::default();
        for (eye, frames) in [("left", 1), ("right", 2), ("both", 3)] {
            overview.add(&comparison("s", "m", eye, frames));
        }
        overview.add(&comparison("s", "n", "", 4));
        overview.add(&comparison("t", "m", "left", 5));
        let frames = |scene, method| overview.of(scene, method).map(|of| of.frames);
        assert_eq!((frames("s", "m"), frames("s", "n")), (Some(3), Some(4)));
        assert_eq!((frames("t", "m"), frames("u", "m"), frames("s", "o")), (None, None, None));
        assert_eq!(overview.all().len(), 5);
    }
}
