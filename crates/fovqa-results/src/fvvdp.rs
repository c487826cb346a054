//! FovVideoVDP of a sequence: the JOD of the mean Q, and the values that it is computed from.

use fovqa_metrics::fvvdp::jod;
use fovqa_metrics::{Key, Metric, Subject, pool};
use serde::{Deserialize, Serialize};

use crate::report::{FrameResult, FvvdpViewing, ScoreReport};
use crate::spread::{Gathered, Spread};

/// FovVideoVDP of a sequence. A still image is a sequence of one frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FvvdpSummary {
    /// Quality in just-objectionable differences (JOD), computed from the mean Q. It is not the
    /// mean of the frames' JOD. `None` if the sequence has no value.
    pub jod: Option<f64>,
    /// Mean of Q over the frames.
    pub q: Option<f64>,
    /// Number of frames that have a value.
    pub frames: usize,
    /// JOD of the individual frames.
    pub frame_jod: Option<Spread>,
    /// Q per spatial frequency, as means over the frames, beginning with the highest frequency.
    pub spatial_bands: Vec<SpatialBand>,
    /// Share of each eccentricity band in Q.
    pub shares: Vec<EccentricityShare>,
    /// Share in Q of the pixels outside all bands.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub share_outside_bands: Option<f64>,
    /// Pixels per degree at the centre of the display.
    pub pixels_per_degree: f64,
    /// Luminance of the display's white in cd/m².
    pub peak_cd_m2: f64,
    /// Luminance of the display's black in cd/m².
    pub black_cd_m2: f64,
    /// Whether sensitivity decreases with eccentricity.
    pub foveated: bool,
    /// Frames per second; `None` for a still image.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fps: Option<f64>,
    /// Why there is no JOD.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// Q of one band of spatial frequencies.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SpatialBand {
    /// Frequency of the band at the centre of the display, in cycles per degree.
    pub cpd: f64,
    /// Q of the sustained channel.
    pub sustained: f64,
    /// Q of the transient channel; `None` for a still image.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub transient: Option<f64>,
}

/// Share of an eccentricity band in Q.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct EccentricityShare {
    /// Lower edge in degrees.
    pub from_deg: f64,
    /// Upper edge in degrees.
    pub to_deg: f64,
    /// The share, from 0 to 1; `None` if there is no difference at all.
    pub share: Option<f64>,
}

impl FvvdpSummary {
    /// The summary of a report; `None` if the metric is not requested.
    pub fn of(report: &ScoreReport) -> Option<Self> {
        let sight = report.fvvdp.as_ref()?;
        let [frame_jod, q, share, outside] = ["frame_jod", "q", "share", "share_outside_bands"]
            .map(|statistic| Key::named(Subject::Metric(Metric::Fvvdp), statistic));
        let frames = || report.frames.iter().map(|frame| &frame.rows);
        let values = |key: Option<Key>| frames().filter_map(move |rows| rows.value(key?));
        let q = spread(values(q));
        let whole = q.filter(|_| sight.missing.is_none());
        let pooled = |key: Option<Key>| {
            let key = key?;
            let rows = frames().filter_map(|rows| rows.get(key));
            pool(key.statistic().frames, rows.map(|row| (row.value, row.parts))).0
        };
        let shares = report.edges().iter().enumerate().map(|(band, &(from_deg, to_deg))| {
            let share = pooled(share.map(|key| key.in_band(band)));
            EccentricityShare { from_deg, to_deg, share }
        });
        Some(Self {
            jod: match sight.eyes_jod {
                Some([left, right]) => Some(f64::midpoint(left, right)),
                None => whole.map(|q| jod(q.mean)),
            },
            q: q.map(|q| q.mean),
            frames: values(frame_jod).count(),
            frame_jod: spread(values(frame_jod)),
            spatial_bands: spatial_bands(sight, &report.frames),
            shares: shares.collect(),
            share_outside_bands: pooled(outside).filter(|share| *share > 0.0),
            pixels_per_degree: sight.pixels_per_degree,
            peak_cd_m2: sight.peak_cd_m2,
            black_cd_m2: sight.black_cd_m2,
            foveated: sight.foveated,
            fps: sight.fps,
            reason: sight.missing.clone(),
        })
    }
}

/// Mean and extremes; `None` if there is no value.
fn spread(values: impl Iterator<Item = f64>) -> Option<Spread> {
    let mut gathered = Gathered::default();
    values.for_each(|value| gathered.add(Some(value)));
    gathered.spread(Key::of(Metric::Fvvdp).statistic())
}

/// Q per spatial frequency, as means over the frames. Empty if the frames have no bands in common.
pub(crate) fn spatial_bands(sight: &FvvdpViewing, frames: &[FrameResult]) -> Vec<SpatialBand> {
    let mean = |statistic: &str, level: usize| {
        let key = Key::named(Subject::Metric(Metric::Fvvdp), statistic)?.on_level(level);
        spread(frames.iter().filter_map(|frame| frame.rows.value(key))).map(|q| q.mean)
    };
    let bands = (1..).zip(&sight.frequencies_cpd).map_while(|(level, &cpd)| {
        let sustained = mean("q_sustained", level)?;
        Some(SpatialBand { cpd, sustained, transient: mean("q_transient", level) })
    });
    bands.collect()
}

/// Whether both eyes have the same bands of spatial frequency. Eyes with different frame sizes have
/// different bands.
pub(crate) fn same_frequencies(left: &ScoreReport, right: &ScoreReport) -> bool {
    let bits = |report: &ScoreReport| {
        let sight = report.fvvdp.iter();
        sight.flat_map(|sight| &sight.frequencies_cpd).map(|cpd| cpd.to_bits()).collect::<Vec<_>>()
    };
    bits(left) == bits(right)
}

/// The common viewing conditions of both eyes; `None` if they differ.
pub(crate) fn sight_of_both(left: &ScoreReport, right: &ScoreReport) -> Option<FvvdpViewing> {
    let (l, r) = (left.fvvdp.as_ref()?, right.fvvdp.as_ref()?);
    let jod = |report| FvvdpSummary::of(report)?.jod;
    let eyes_jod = jod(left).zip(jod(right)).map(|(l, r)| [l, r]);
    let missing = l.missing.as_ref().map(|why| format!("left eye: {why}"));
    let missing = missing.or(r.missing.as_ref().map(|why| format!("right eye: {why}")));
    let missing = missing.or(eyes_jod.is_none().then(|| "an eye has no value".to_owned()));
    Some(FvvdpViewing { missing, eyes_jod, ..l.clone() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::both_eyes::both_eyes;
    use crate::report::ViewResult;
    use fovqa_metrics::Rows;
    use fovqa_metrics::fvvdp::{FvvdpBand, FvvdpFrame};

    fn frame(number: i64, q: f64, shares: Option<Vec<f64>>) -> FrameResult {
        let band = FvvdpBand { cpd: 8.0, sustained: q, transient: Some(2.0 * q) };
        let mut rows = Rows::default();
        FvvdpFrame { q, frame_jod: jod(q), bands: vec![band], shares }.rows(2, &mut rows);
        FrameResult {
            frame: number,
            reference: "".into(),
            test: "".into(),
            gaze_px: None,
            gaze_step_deg: None,
            doubts: Vec::new(),
            rows: rows.into(),
        }
    }

    fn report(frames: Vec<FrameResult>) -> ScoreReport {
        ScoreReport {
            view: Some(ViewResult {
                size: [1, 1],
                focal_px: [1.0; 2],
                gaze_px: [0.5; 2],
                eccentricity: fovqa_vision::EccentricityKind::Angular,
                bands_deg: vec![(0.0, 5.0), (5.0, 10.0)],
            }),
            frames,
            fvvdp: Some(FvvdpViewing {
                pixels_per_degree: 13.0,
                peak_cd_m2: 100.0,
                black_cd_m2: 0.1,
                foveated: true,
                frequencies_cpd: vec![8.0],
                fps: Some(30.0),
                missing: None,
                eyes_jod: None,
            }),
            ..ScoreReport::default()
        }
    }

    #[test]
    fn the_jod_is_of_the_mean_q_and_shares_are_of_all_q() {
        let frames = vec![
            frame(0, 100.0, Some(vec![0.5, 0.25, 0.25])),
            frame(1, 300.0, Some(vec![1.0, 0.0, 0.0])),
            frame(2, 0.0, None),
        ];
        let summary = FvvdpSummary::of(&report(frames)).unwrap();
        let q = 400.0 / 3.0;
        assert_eq!(summary.jod, Some(jod(q)));
        let mean = (jod(100.0) + jod(300.0) + 10.0) / 3.0;
        let spread = summary.frame_jod.unwrap();
        assert!((spread.mean - mean).abs() < 1e-12 && mean - jod(q) > 0.01, "two numbers");
        assert_eq!((spread.min, spread.max), (jod(300.0), 10.0));
        let shares: Vec<_> = summary.shares.iter().map(|share| share.share).collect();
        assert_eq!(shares, [Some(0.875), Some(0.0625)]);
        assert_eq!(summary.share_outside_bands, Some(0.0625));
        assert_eq!(summary.spatial_bands[0].transient, Some(2.0 * q));
    }

    #[test]
    fn a_broken_sequence_has_no_jod() {
        let mut broken = report(vec![frame(0, 100.0, None)]);
        broken.fvvdp.as_mut().unwrap().missing = Some("frame 1 could not be scored".to_owned());
        let summary = FvvdpSummary::of(&broken).unwrap();
        assert_eq!((summary.jod, summary.frames), (None, 1));
        assert!(summary.reason.is_some() && summary.q.is_some());
        assert!(FvvdpSummary::of(&ScoreReport::default()).is_none());
    }

    #[test]
    fn both_eyes_are_the_mean_of_their_scores() {
        let [left, right] = [(100.0, 1.0), (300.0, 0.0)]
            .map(|(q, inner)| report(vec![frame(0, q, Some(vec![inner, 1.0 - inner, 0.0]))]));
        let both = both_eyes(&left, &right);
        let summary = FvvdpSummary::of(&both).unwrap();
        let wanted = f64::midpoint(jod(100.0), jod(300.0));
        assert_eq!((summary.jod, summary.q), (Some(wanted), Some(200.0)));
        assert_eq!(summary.frame_jod.map(|spread| spread.mean), Some(wanted));
        let shares: Vec<_> = summary.shares.iter().map(|share| share.share).collect();
        assert_eq!(shares, [Some(0.25), Some(0.75)], "of the Q of both");
    }
}
