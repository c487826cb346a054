//! Combines two eyes into one report: the frames that both have, with each value pooled as its
//! metric requires.

use std::collections::BTreeMap;
use std::sync::Arc;

use fovqa_metrics::{FrameRows, Layouts, Metric, Row, Rows, Subject};

use crate::fvvdp;
use crate::report::{FrameResult, GuideSource, GuideSources, ScoreReport};

/// The combined report of both eyes. It contains the frames that both have, matched by their
/// numbers.
pub fn both_eyes(left: &ScoreReport, right: &ScoreReport) -> ScoreReport {
    let alike = left.edges() == right.edges();
    let fvvdp = fvvdp::sight_of_both(left, right);
    let same_frequencies = fvvdp::same_frequencies(left, right);
    // Bands with different edges or frequencies cannot be combined.
    let in_common = |row: &Row| {
        let of_bands = row.key.band.is_some()
            || row.key.statistic().is_of_bands
            || row.key.subject == Subject::PixelsOutsideBands;
        let of_frequencies = row.key.metric() == Some(Metric::Fvvdp) && row.key.level.is_some();
        (alike || !of_bands) && (same_frequencies || !of_frequencies)
    };
    let right_frames: BTreeMap<i64, &FrameResult> =
        right.frames.iter().map(|frame| (frame.frame, frame)).collect();
    let mut layouts = Layouts::default();
    let frames = left.frames.iter().filter_map(|l| {
        let r = right_frames.get(&l.frame)?;
        let both = FrameRows::of_both_eyes(&l.rows, &r.rows);
        let both = both.iter().copied().filter(in_common).collect::<Rows>();
        Some(FrameResult {
            frame: l.frame,
            reference: Arc::clone(&l.reference),
            test: Arc::clone(&l.test),
            gaze_px: None,
            gaze_step_deg: None,
            // Each eye has its own.
            doubts: Vec::new(),
            rows: layouts.pack(&both),
        })
    });
    ScoreReport {
        view: left.view.clone().filter(|_| alike),
        metrics: left.metrics.iter().copied().filter(|m| right.metrics.contains(m)).collect(),
        frames: frames.collect(),
        failures: Vec::new(),
        gaze_held: None,
        guide_sources: GuideSources {
            motion: common(left.guide_sources.motion, right.guide_sources.motion),
            depth: common(left.guide_sources.depth, right.guide_sources.depth),
        },
        frames_needed: left.frames_needed.clone(),
        fvvdp,
    }
}

/// What holds for both eyes: none if one of them has none.
fn common(left: GuideSource, right: GuideSource) -> GuideSource {
    match (left, right) {
        (GuideSource::None, _) | (_, GuideSource::None) => GuideSource::None,
        (GuideSource::Reference, GuideSource::Reference) => GuideSource::Reference,
        _ => GuideSource::Test,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::ViewResult;
    use fovqa_metrics::Key;

    #[test]
    fn motion_of_both_is_what_both_have() {
        use GuideSource::{None, Reference, Test};
        for (left, right, both) in [
            (None, Reference, None),
            (Test, None, None),
            (Reference, Reference, Reference),
            (Reference, Test, Test),
            (Test, Test, Test),
        ] {
            assert_eq!(common(left, right), both, "{left:?} {right:?}");
        }
        let of = |motion| ScoreReport {
            guide_sources: GuideSources { motion, depth: Reference },
            ..ScoreReport::default()
        };
        let guides = both_eyes(&of(Reference), &of(None)).guide_sources;
        assert_eq!(guides, GuideSources { motion: None, depth: Reference });
    }

    fn frame(frame: i64) -> FrameResult {
        let mut rows = Rows::default();
        rows.score(Key::of(Metric::Ssim), 0.5);
        rows.score(Key::of(Metric::Ssim).in_band(0), 0.5);
        rows.count(Key::pixels(Subject::PixelsOutsideBands), 3);
        FrameResult {
            frame,
            reference: "".into(),
            test: "".into(),
            gaze_px: None,
            gaze_step_deg: None,
            doubts: Vec::new(),
            rows: rows.into(),
        }
    }

    #[test]
    fn frames_meet_by_number_and_bands_by_their_edges() {
        let seen = |to_deg| ViewResult {
            size: [1, 1],
            focal_px: [1.0; 2],
            gaze_px: [0.5; 2],
            eccentricity: fovqa_vision::EccentricityKind::Angular,
            bands_deg: vec![(0.0, to_deg)],
        };
        let report = |frames: &[i64], to_deg: f64| ScoreReport {
            view: Some(seen(to_deg)),
            metrics: vec![Metric::Ssim],
            frames: frames.iter().map(|n| frame(*n)).collect(),
            ..ScoreReport::default()
        };
        let both = both_eyes(&report(&[1, 2, 4], 5.0), &report(&[2, 3, 4], 5.0));
        assert_eq!(both.frames.iter().map(|f| f.frame).collect::<Vec<_>>(), [2, 4]);
        assert_eq!(both.frames[0].rows.iter().count(), 3);
        let outside = Key::pixels(Subject::PixelsOutsideBands);
        assert_eq!(both.frames[0].rows.number(outside), 6);
        let both = both_eyes(&report(&[1], 5.0), &report(&[1], 10.0));
        assert!(both.view.is_none() && both.frames[0].rows.iter().count() == 1);
    }
}
