//! summary.json contains the statistics of a run over its frames, by scene, method and metric.

use std::collections::BTreeMap;

use fovqa_metrics::Metric;
use fovqa_plan::swept_label;
use fovqa_vision::EccentricityKind;
use serde::de::{Deserialize, Deserializer, Error};
use serde::ser::{Serialize, SerializeMap, Serializer};

use super::compared::{HaarRecord, SideValues, in_summary_band, summary_haar};
use super::doubts::DoubtRecord;
use super::spectrum::{SpectrumRecord, summary_spectra};
use super::values::{AnyStats, MetricMap, Number, Stats};
use crate::fvvdp::FvvdpSummary;
use crate::report::{Comparison, ViewResult};
use crate::samples::SampleSummary;
use crate::spread::Spread;
use crate::summary::{BandSummary, Statistics, Summary};
use crate::temporal::TemporalSummaries;

/// Name and version of the format.
pub const SUMMARY_SCHEMA: &str = "fovqa.summary/1";

/// One method in one scene, for one eye or both.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct ComparisonSummary {
    /// The scene.
    pub scene: String,
    /// The method.
    pub method: String,
    /// Values of swept parameters; empty if there is no sweep.
    pub parameters: String,
    /// `left`, `right` or `both`; empty if the scene has one image per frame.
    pub eye: String,
    /// Number of frames that were scored.
    pub frames: usize,
    /// Number of frames, or whole comparisons, that could not be scored.
    pub errors: usize,
    /// The view; `None` if there is none, and for both eyes.
    pub view: Option<ViewRecord>,
    /// Each metric over the frames.
    #[serde(serialize_with = "metrics_out", deserialize_with = "metrics_in")]
    pub metrics: BTreeMap<Metric, Statistics>,
    /// The statistics per eccentricity band.
    pub bands: Vec<BandStatistics>,
    /// The wavelet statistics by level and band.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub haar: Vec<HaarRecord<Spread>>,
    /// The power spectrum by band.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub spectrum: Vec<SpectrumRecord<Spread>>,
    /// Temporal metrics, each by its key.
    #[serde(flatten)]
    pub temporal: TemporalSummaries,
    /// FovVideoVDP.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fvvdp: Option<FvvdpSummary>,
    /// The samples of an emulated method.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub samples: Option<SampleSummary>,
    /// Likely mistakes in its pairs.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub plausibility: Vec<DoubtRecord>,
}

/// A view, as `score` prints it.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct ViewRecord {
    /// Width in pixels.
    pub width: usize,
    /// Height in pixels.
    pub height: usize,
    /// Focal length in pixels, along x and y.
    pub focal_px: [f64; 2],
    /// Gaze in pixels. If the gaze moves, this is the gaze of the first frame.
    pub gaze_px: [f64; 2],
    /// `angular` or `planar`.
    pub eccentricity: EccentricityKind,
}

/// The statistics of one band over the frames.
#[derive(Debug, Clone, PartialEq)]
pub struct BandStatistics {
    /// Lower edge in degrees.
    pub from_deg: f64,
    /// Upper edge in degrees.
    pub to_deg: f64,
    /// Number of pixels in all frames together.
    pub pixels: u64,
    /// The statistics of each metric; `None` if no frame has a value.
    pub metrics: BTreeMap<Metric, Option<Statistics>>,
    /// Measures that are computed for reference and test in the same way.
    pub compared: BTreeMap<Metric, SideValues<Spread>>,
}

/// Something that could not be scored.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct ErrorRecord {
    /// The scene.
    pub scene: String,
    /// The method.
    pub method: String,
    /// Values of swept parameters; empty if the method is not swept.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub parameters: String,
    /// The eye; empty if the scene has one image per frame.
    pub eye: String,
    /// Frame number; `None` if the whole comparison could not be scored.
    pub frame: Option<i64>,
    /// What is wrong.
    pub message: String,
}

impl ErrorRecord {
    /// The errors of a comparison.
    pub(super) fn all(comparison: &Comparison) -> impl Iterator<Item = Self> {
        let (method, parameters) = comparison.written();
        comparison.report.failures.iter().map(move |failure| Self {
            scene: comparison.scene.clone(),
            method: method.to_owned(),
            parameters: parameters.to_owned(),
            eye: comparison.eye.to_owned(),
            frame: failure.frame,
            message: failure.message.clone(),
        })
    }
}

impl ComparisonSummary {
    pub(crate) fn of(comparison: &Comparison) -> Self {
        let report = &comparison.report;
        let summary = Summary::of(report);
        // Each eye has its own view, but both together have none.
        let view = report.view.as_ref().filter(|_| comparison.eye != "both");
        let (method, parameters) = comparison.written();
        Self {
            scene: comparison.scene.clone(),
            method: method.to_owned(),
            parameters: parameters.to_owned(),
            eye: comparison.eye.to_owned(),
            frames: report.frames.len(),
            errors: report.failures.len(),
            view: view.map(ViewRecord::of),
            bands: BandStatistics::all(&summary),
            haar: summary_haar(&summary),
            spectrum: summary_spectra(&summary),
            temporal: summary.temporal,
            fvvdp: summary.fvvdp,
            samples: summary.samples,
            plausibility: DoubtRecord::all(&report.frames),
            metrics: summary.statistics,
        }
    }
}

impl ComparisonSummary {
    /// The name of the method among all methods of the run: with the parameters of a point of a sweep.
    pub fn label(&self) -> String {
        swept_label(&self.method, &self.parameters)
    }
}

impl ErrorRecord {
    /// The name of the method among all methods of the run: with the parameters of a point of a sweep.
    pub fn label(&self) -> String {
        swept_label(&self.method, &self.parameters)
    }
}

impl BandStatistics {
    /// All bands of a summary.
    pub(crate) fn all(summary: &Summary) -> Vec<Self> {
        let bands = summary.bands.iter().enumerate();
        let statistics = |(index, band): (usize, &BandSummary)| Self {
            from_deg: band.from_deg,
            to_deg: band.to_deg,
            pixels: band.pixels,
            metrics: band.statistics.clone(),
            compared: in_summary_band(summary, index),
        };
        bands.map(statistics).collect()
    }
}

impl ViewRecord {
    pub(crate) fn of(view: &ViewResult) -> Self {
        Self {
            width: view.size[0],
            height: view.size[1],
            focal_px: view.focal_px,
            gaze_px: view.gaze_px,
            eccentricity: view.eccentricity,
        }
    }
}

fn metrics_out<S: Serializer>(
    metrics: &BTreeMap<Metric, Statistics>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    stats(metrics).serialize(serializer)
}

fn metrics_in<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<BTreeMap<Metric, Statistics>, D::Error> {
    let MetricMap(metrics) = MetricMap::<AnyStats>::deserialize(deserializer)?;
    Ok(metrics.into_iter().map(|(metric, stats)| (metric, stats.0)).collect())
}

/// The statistics as JSON.
pub(crate) fn stats(metrics: &BTreeMap<Metric, Statistics>) -> MetricMap<Stats> {
    let stats =
        |(&metric, &statistics): (&Metric, &Statistics)| (metric, Stats { metric, statistics });
    MetricMap(metrics.iter().map(stats).collect())
}

impl Serialize for BandStatistics {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("from_deg", &self.from_deg)?;
        map.serialize_entry("to_deg", &self.to_deg)?;
        map.serialize_entry("pixels", &self.pixels)?;
        for (&metric, statistics) in &self.metrics {
            let stats = statistics.map(|statistics| Stats { metric, statistics });
            map.serialize_entry(metric.key(), &stats)?;
        }
        for (metric, sides) in &self.compared {
            map.serialize_entry(metric.key(), sides)?;
        }
        map.end()
    }
}

impl<'de> Deserialize<'de> for BandStatistics {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(serde::Deserialize)]
        #[serde(untagged)]
        enum Value {
            Number(Number),
            Statistics(Option<AnyStats>),
            Compared(SideValues<Spread>),
        }
        let mut values: BTreeMap<String, Value> = BTreeMap::deserialize(deserializer)?;
        let mut number = |key: &'static str| match values.remove(key) {
            Some(Value::Number(number)) => Ok(number.0),
            _ => Err(D::Error::missing_field(key)),
        };
        let (from_deg, to_deg) = (number("from_deg")?, number("to_deg")?);
        let pixels = number("pixels")? as u64;
        let (mut metrics, mut compared) = (BTreeMap::new(), BTreeMap::new());
        for (key, value) in values {
            let Some(metric) = Metric::find(&key) else { continue };
            match value {
                Value::Statistics(stats) => {
                    metrics.insert(metric, stats.map(|stats| stats.0));
                }
                Value::Compared(sides) => {
                    compared.insert(metric, sides);
                }
                Value::Number(_) => {}
            }
        }
        Ok(Self { from_deg, to_deg, pixels, metrics, compared })
    }
}

#[cfg(test)]
mod tests {
    use super::super::compared::{HaarSides, HaarValues};
    use super::super::spectrum::{SpectrumBin, SpectrumValues};
    use super::*;
    use crate::fvvdp::{EccentricityShare, SpatialBand};
    use crate::report::GuideSource;
    use crate::samples::BudgetSummary;
    use crate::temporal::TemporalSummary;

    fn fvvdp(spread: Spread) -> FvvdpSummary {
        FvvdpSummary {
            jod: Some(0.1 + 0.2),
            q: Some(123.4),
            frames: 2,
            frame_jod: Some(spread),
            spatial_bands: vec![SpatialBand { cpd: 6.5, sustained: 1.5, transient: None }],
            shares: vec![EccentricityShare { from_deg: 0.0, to_deg: 5.0, share: None }],
            share_outside_bands: Some(0.25),
            pixels_per_degree: 13.0,
            peak_cd_m2: 100.0,
            black_cd_m2: 0.1,
            foveated: true,
            fps: Some(23.976),
            reason: None,
        }
    }

    fn spectrum(spread: Spread) -> SpectrumRecord<Spread> {
        let power = SpectrumValues { power: Some(spread), density: None };
        SpectrumRecord {
            from_deg: 0.0,
            to_deg: 5.0,
            blocks: 3,
            cutoff_cpd: Some(std::f64::consts::SQRT_2),
            bins: vec![SpectrumBin {
                cpd: 0.125,
                samples: 24,
                reference: power,
                test: SpectrumValues { power: None, density: Some(spread) },
                ratio: None,
            }],
        }
    }

    #[test]
    fn what_is_written_is_read_again() {
        let statistics = Statistics {
            mean: 27.5,
            min: 0.1 + 0.2,
            max: f64::INFINITY,
            identical_frames: Some(1),
            pooled: Some(26.25),
        };
        let ssim = Statistics { identical_frames: None, pooled: None, max: 1.0, ..statistics };
        let spread = Spread { mean: 0.1 + 0.2, min: 0.0, max: 1.0, pooled: Some(0.7) };
        let sides = SideValues {
            reference: Some(spread),
            test: Some(Spread { mean: 0.5, ..spread }),
            ratio: Some(0.5 / 0.3),
            reason: None,
        };
        let nothing = SideValues {
            reference: None,
            test: None,
            ratio: None,
            reason: Some("no value".to_owned()),
        };
        let values = HaarValues { mean_abs: Some(spread), max_abs: Some(spread), energy: None };
        let of = HaarSides {
            reference: values.clone(),
            test: values,
            ratio: HaarValues { mean_abs: Some(1.0), max_abs: Some(1.0), energy: None },
            reason: Some("the reference is 0".to_owned()),
        };
        let haar = HaarRecord {
            level: 3,
            from_deg: 0.0,
            to_deg: 5.0,
            coefficients: 12,
            orientations: BTreeMap::from([("lh".to_owned(), of.clone())]),
            all: of,
        };
        let spectrum = spectrum(spread);
        let record = ComparisonSummary {
            scene: "s".to_owned(),
            method: "m".to_owned(),
            parameters: String::new(),
            eye: "left".to_owned(),
            frames: 3,
            errors: 1,
            view: Some(ViewRecord {
                width: 3,
                height: 4,
                focal_px: [1.1, 2.2],
                gaze_px: [0.5, 0.25],
                eccentricity: EccentricityKind::Angular,
            }),
            metrics: BTreeMap::from([(Metric::Psnr, statistics), (Metric::Ssim, ssim)]),
            bands: vec![BandStatistics {
                from_deg: 0.0,
                to_deg: 5.0,
                pixels: 7,
                metrics: BTreeMap::from([(Metric::Psnr, Some(statistics)), (Metric::Ssim, None)]),
                compared: BTreeMap::from([
                    (Metric::RmsContrast, sides.clone()),
                    (Metric::Atd, nothing),
                ]),
            }],
            samples: Some(SampleSummary {
                samples: 1.5,
                on_screen: 1.0,
                beyond: 0.0,
                share: 0.125,
                reshaded_share: Some(0.25),
                quads: Some(3.0),
                quads_share: Some(0.375),
                budget: Some(BudgetSummary { share: 0.1, ideal_share: 0.1, value: vec![2.5, 3.0] }),
            }),
            haar: vec![haar],
            spectrum: vec![spectrum],
            temporal: TemporalSummaries(BTreeMap::from([(
                Metric::Atd,
                TemporalSummary {
                    reference: Some(0.25),
                    test: Some(0.1 + 0.2),
                    ratio: Some(1.2),
                    left_out: Some(0.01),
                    left_out_test: None,
                    frames: 2,
                    motion: GuideSource::Reference,
                    depth: GuideSource::None,
                    reason: None,
                },
            )])),
            fvvdp: Some(fvvdp(spread)),
            plausibility: vec![DoubtRecord {
                check: "gaze".to_owned(),
                frame: -1,
                frames: 2,
                message: "elsewhere".to_owned(),
            }],
        };
        let text = serde_json::to_string_pretty(&record).unwrap();
        assert_eq!(serde_json::from_str::<ComparisonSummary>(&text).unwrap(), record, "{text}");
    }
}
