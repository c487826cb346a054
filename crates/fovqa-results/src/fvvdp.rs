//! FovVideoVDP of a sequence: JOD of the mean Q, and what that is made of.

use fovqa_metrics::fvvdp::{FvvdpBand, FvvdpFrame, jod};
use serde::{Deserialize, Serialize};

use crate::report::{FvvdpSight, ScoreReport};
use crate::summary::Spread;

/// FovVideoVDP of a sequence; of a still, a sequence of one frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FvvdpSummary {
    /// Just-objectionable differences: of the mean Q, not the mean of the frames' JOD. `None` where the
    /// sequence has no value.
    pub jod: Option<f64>,
    /// Q, the mean over frames.
    pub q: Option<f64>,
    /// Frames that have a value.
    pub frames: usize,
    /// JOD of the frames, each by itself.
    pub frame_jod: Option<Spread>,
    /// Q by spatial frequency, means over frames, the finest first.
    pub spatial_bands: Vec<SpatialBand>,
    /// What each band of eccentricity has in Q.
    pub shares: Vec<EccentricityShare>,
    /// What lies outside all of them has in it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub share_outside_bands: Option<f64>,
    /// Pixels of the display in a degree at its centre.
    pub pixels_per_degree: f64,
    /// White of the display, cd/m².
    pub peak_cd_m2: f64,
    /// Its black, cd/m².
    pub black_cd_m2: f64,
    /// Whether sensitivity falls off with eccentricity.
    pub foveated: bool,
    /// Frames a second; `None` for a still.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fps: Option<f64>,
    /// Why there is no JOD.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// Q of a band of spatial frequencies.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SpatialBand {
    /// Its frequency at the centre of the display, cycles per degree.
    pub cpd: f64,
    /// Q of its sustained channel.
    pub sustained: f64,
    /// Q of its transient channel; `None` in a still.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub transient: Option<f64>,
}

impl From<&FvvdpBand> for SpatialBand {
    fn from(band: &FvvdpBand) -> Self {
        Self { cpd: band.cpd, sustained: band.sustained, transient: band.transient }
    }
}

/// What a band of eccentricity has in Q.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct EccentricityShare {
    /// Lower edge.
    pub from_deg: f64,
    /// Upper edge.
    pub to_deg: f64,
    /// The share, 0 to 1; `None` where there is no difference at all.
    pub share: Option<f64>,
}

impl FvvdpSummary {
    /// That of a report; `None` where it is not asked for.
    pub fn of(report: &ScoreReport) -> Option<Self> {
        let sight = report.fvvdp.as_ref()?;
        let frames: Vec<&FvvdpFrame> =
            report.frames.iter().filter_map(|frame| frame.fvvdp.as_ref()).collect();
        let mean = |of: &dyn Fn(&FvvdpFrame) -> f64| {
            let sum = frames.iter().map(|frame| of(frame)).sum::<f64>();
            (!frames.is_empty()).then(|| sum / frames.len() as f64)
        };
        let q = mean(&|frame| frame.q);
        let whole = q.filter(|_| sight.missing.is_none());
        let jods = frames.iter().map(|frame| frame.frame_jod);
        let frame_jod = mean(&|frame| frame.frame_jod).map(|mean| Spread {
            mean,
            min: jods.clone().fold(f64::INFINITY, f64::min),
            max: jods.fold(f64::NEG_INFINITY, f64::max),
        });
        let edges = report.view.as_ref().map(|view| view.bands_deg.clone()).unwrap_or_default();
        let share = |index: usize| shared(&frames, index);
        Some(Self {
            jod: match sight.eyes_jod {
                Some([left, right]) => Some(f64::midpoint(left, right)),
                None => whole.map(jod),
            },
            q,
            frames: frames.len(),
            frame_jod,
            spatial_bands: spatial_bands(&frames),
            shares: edges
                .iter()
                .enumerate()
                .map(|(index, &(from_deg, to_deg))| EccentricityShare {
                    from_deg,
                    to_deg,
                    share: share(index),
                })
                .collect(),
            share_outside_bands: share(edges.len()).filter(|share| *share > 0.0),
            pixels_per_degree: sight.pixels_per_degree,
            peak_cd_m2: sight.peak_cd_m2,
            black_cd_m2: sight.black_cd_m2,
            foveated: sight.foveated,
            fps: sight.fps,
            reason: sight.missing.clone(),
        })
    }
}

/// What a band of eccentricity has in the Q of all frames together; `None` where that is 0.
fn shared(frames: &[&FvvdpFrame], index: usize) -> Option<f64> {
    let q: f64 = frames.iter().map(|frame| frame.q).sum();
    let of = |frame: &&FvvdpFrame| Some(frame.shares.as_ref()?.get(index)? * frame.q);
    (q > 0.0).then(|| frames.iter().filter_map(of).sum::<f64>() / q)
}

fn spatial_bands(frames: &[&FvvdpFrame]) -> Vec<SpatialBand> {
    let count = frames.len() as f64;
    let bands = frames.first().map(|frame| frame.bands.as_slice()).unwrap_or_default().iter();
    let mean = |index: usize, of: &dyn Fn(&FvvdpBand) -> Option<f64>| {
        let values = frames.iter().map(|frame| of(frame.bands.get(index)?));
        values.sum::<Option<f64>>().map(|sum| sum / count)
    };
    let band = |(index, band): (usize, &FvvdpBand)| SpatialBand {
        cpd: band.cpd,
        sustained: mean(index, &|band| Some(band.sustained)).unwrap_or(band.sustained),
        transient: mean(index, &|band| band.transient),
    };
    bands.enumerate().map(band).collect()
}

/// A frame of both eyes: means of the two, and of shares what each has of the Q of both.
pub(crate) fn of_both(left: &FvvdpFrame, right: &FvvdpFrame) -> FvvdpFrame {
    let bands = left.bands.iter().zip(&right.bands).map(|(l, r)| FvvdpBand {
        cpd: l.cpd,
        sustained: f64::midpoint(l.sustained, r.sustained),
        transient: l.transient.zip(r.transient).map(|(l, r)| f64::midpoint(l, r)),
    });
    // Eyes of different sizes have bands of their own.
    let alike = left.bands.len() == right.bands.len()
        && left.bands.iter().zip(&right.bands).all(|(l, r)| l.cpd.to_bits() == r.cpd.to_bits());
    let outside = |frame: &FvvdpFrame| frame.shares.as_ref().map_or(0, Vec::len);
    let shares = (0..outside(left).max(outside(right))).map(|index| shared(&[left, right], index));
    let shares: Option<Vec<f64>> = shares.collect();
    FvvdpFrame {
        q: f64::midpoint(left.q, right.q),
        frame_jod: f64::midpoint(left.frame_jod, right.frame_jod),
        bands: if alike { bands.collect() } else { Vec::new() },
        shares: shares.filter(|shares| !shares.is_empty()),
    }
}

/// How both eyes see: as each does, where they see alike.
pub(crate) fn sight_of_both(left: &ScoreReport, right: &ScoreReport) -> Option<FvvdpSight> {
    let (l, r) = (left.fvvdp.as_ref()?, right.fvvdp.as_ref()?);
    let jod = |report| FvvdpSummary::of(report)?.jod;
    let eyes_jod = jod(left).zip(jod(right)).map(|(l, r)| [l, r]);
    let missing = l.missing.as_ref().map(|why| format!("left eye: {why}"));
    let missing = missing.or(r.missing.as_ref().map(|why| format!("right eye: {why}")));
    let missing = missing.or(eyes_jod.is_none().then(|| "an eye has no value".to_owned()));
    Some(FvvdpSight { missing, eyes_jod, ..l.clone() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{FrameResult, ViewResult};
    use fovqa_metrics::PairScores;
    use std::collections::BTreeMap;

    fn frame(number: i64, q: f64, shares: Option<Vec<f64>>) -> FrameResult {
        let band = FvvdpBand { cpd: 8.0, sustained: q, transient: Some(2.0 * q) };
        FrameResult {
            frame: number,
            reference: String::new(),
            test: String::new(),
            gaze_px: None,
            gaze_step_deg: None,
            scores: PairScores {
                scores: BTreeMap::new(),
                bands: Vec::new(),
                pixels: 1,
                outside_bands: 0,
                left_out: 0,
                mse: None,
                weighted_squared_error: None,
            },
            profiles: None,
            atd: None,
            fvvdp: Some(FvvdpFrame { q, frame_jod: jod(q), bands: vec![band], shares }),
        }
    }

    fn report(frames: Vec<FrameResult>) -> ScoreReport {
        ScoreReport {
            view: Some(ViewResult {
                size: [1, 1],
                focal_px: [1.0; 2],
                gaze_px: [0.5; 2],
                eccentricity: "angular",
                bands_deg: vec![(0.0, 5.0), (5.0, 10.0)],
            }),
            frames,
            fvvdp: Some(FvvdpSight {
                pixels_per_degree: 13.0,
                peak_cd_m2: 100.0,
                black_cd_m2: 0.1,
                foveated: true,
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
        let [left, right] =
            [100.0, 300.0].map(|q| report(vec![frame(0, q, Some(vec![1.0, 0.0, 0.0]))]));
        let sight = sight_of_both(&left, &right).unwrap();
        assert_eq!(sight.eyes_jod, Some([jod(100.0), jod(300.0)]));
        let frames = [&left, &right].map(|report| report.frames[0].fvvdp.clone().unwrap());
        let both = of_both(&frames[0], &frames[1]);
        assert_eq!((both.q, both.frame_jod), (200.0, f64::midpoint(jod(100.0), jod(300.0))));
        assert_eq!(both.shares, Some(vec![1.0, 0.0, 0.0]));
        let both = ScoreReport { fvvdp: Some(sight), ..report(Vec::new()) };
        let wanted = f64::midpoint(jod(100.0), jod(300.0));
        assert_eq!(FvvdpSummary::of(&both).unwrap().jod, Some(wanted));
    }
}
