//! Two eyes as one: squared errors, wavelet coefficients and differences over time are pooled, other
//! scores are means of the two.

use std::collections::BTreeMap;

use fovqa_metrics::temporal::{AtdBand, AtdFrame};
use fovqa_metrics::{
    BandScores, HaarBand, HaarStatistics, Metric, PairScores, Profile, mse_of_db, psnr_db,
};

use crate::compared::Sides;
use crate::fvvdp;
use crate::report::{AtdGuides, FrameResult, GuideSource, ScoreReport};

/// The report of both eyes: the frames both have, by their numbers.
pub fn both_eyes(left: &ScoreReport, right: &ScoreReport) -> ScoreReport {
    let edges = |report: &ScoreReport| report.view.as_ref().map(|view| view.bands_deg.clone());
    let alike = edges(left) == edges(right);
    let right_frames: BTreeMap<i64, &FrameResult> =
        right.frames.iter().map(|frame| (frame.frame, frame)).collect();
    let frames = left.frames.iter().filter_map(|l| {
        let r = right_frames.get(&l.frame)?;
        let mut scores = pooled(&l.scores, &r.scores);
        let mut profiles =
            l.profiles.as_ref().zip(r.profiles.as_ref()).map(|(l, r)| both(l, r, profile));
        let mut fvvdp = l.fvvdp.as_ref().zip(r.fvvdp.as_ref()).map(|(l, r)| fvvdp::of_both(l, r));
        let mut atd = l.atd.as_ref().zip(r.atd.as_ref()).map(|(l, r)| both(l, r, difference));
        // Bands of other edges have nothing in common.
        if !alike {
            scores.bands.clear();
            profiles = None;
            if let Some(fvvdp) = &mut fvvdp {
                fvvdp.shares = None;
            }
            for side in atd.iter_mut().flat_map(|atd| [&mut atd.reference, &mut atd.test]) {
                side.bands.clear();
            }
        }
        Some(FrameResult {
            frame: l.frame,
            reference: l.reference.clone(),
            test: l.test.clone(),
            gaze_px: None,
            gaze_step_deg: None,
            scores,
            profiles,
            atd,
            fvvdp,
        })
    });
    ScoreReport {
        view: left.view.clone().filter(|_| alike),
        metrics: left.metrics.iter().copied().filter(|m| right.metrics.contains(m)).collect(),
        frames: frames.collect(),
        failures: Vec::new(),
        gaze_held: None,
        atd_guides: AtdGuides {
            motion: common(left.atd_guides.motion, right.atd_guides.motion),
            depth: common(left.atd_guides.depth, right.atd_guides.depth),
        },
        fvvdp: fvvdp::sight_of_both(left, right),
    }
}

/// What holds for both eyes: nothing, where one of them has nothing.
fn common(left: GuideSource, right: GuideSource) -> GuideSource {
    match (left, right) {
        (GuideSource::None, _) | (_, GuideSource::None) => GuideSource::None,
        (GuideSource::Reference, GuideSource::Reference) => GuideSource::Reference,
        _ => GuideSource::Test,
    }
}

/// Reference and test of both eyes.
fn both<T>(left: &Sides<T>, right: &Sides<T>, pool: impl Fn(&T, &T) -> T) -> Sides<T> {
    Sides {
        reference: pool(&left.reference, &right.reference),
        test: pool(&left.test, &right.test),
    }
}

/// Contrasts are averaged, wavelet coefficients pooled.
fn profile(left: &Profile, right: &Profile) -> Profile {
    let rms_contrast = left.rms_contrast.as_ref().zip(right.rms_contrast.as_ref());
    let haar = left.haar.as_ref().zip(right.haar.as_ref());
    Profile {
        rms_contrast: rms_contrast.map(|(left, right)| {
            left.iter().zip(right).map(|(l, r)| either(*l, *r, f64::midpoint)).collect()
        }),
        haar: haar.map(|(left, right)| {
            let levels = left.iter().zip(right);
            levels.map(|(l, r)| l.iter().zip(r).map(|(l, r)| wavelet(l, r)).collect()).collect()
        }),
    }
}

fn wavelet(left: &HaarBand, right: &HaarBand) -> HaarBand {
    let coefficients = left.coefficients + right.coefficients;
    let share = right.coefficients as f64 / (coefficients as f64).max(1.0);
    let pool = |l: HaarStatistics, r: HaarStatistics| HaarStatistics {
        mean_abs: l.mean_abs + (r.mean_abs - l.mean_abs) * share,
        max_abs: l.max_abs.max(r.max_abs),
        energy: l.energy + (r.energy - l.energy) * share,
    };
    HaarBand {
        coefficients,
        statistics: either(left.statistics, right.statistics, pool),
        orientations: either(left.orientations.clone(), right.orientations.clone(), |l, r| {
            Box::new(std::array::from_fn(|i| pool(l[i], r[i])))
        }),
    }
}

/// Differences over time are pooled by valid pixels.
fn difference(left: &AtdFrame, right: &AtdFrame) -> AtdFrame {
    let band = |l: &AtdBand, r: &AtdBand| {
        let valid = l.valid + r.valid;
        let share = r.valid as f64 / (valid as f64).max(1.0);
        AtdBand { mean: either(l.mean, r.mean, |l, r| l + (r - l) * share), valid }
    };
    AtdFrame {
        whole: band(&left.whole, &right.whole),
        pixels: left.pixels + right.pixels,
        bands: left.bands.iter().zip(&right.bands).map(|(l, r)| band(l, r)).collect(),
    }
}

/// What one eye has not is the other's.
fn either<T>(left: Option<T>, right: Option<T>, pool: impl Fn(T, T) -> T) -> Option<T> {
    match (left, right) {
        (Some(left), Some(right)) => Some(pool(left, right)),
        (one, None) | (None, one) => one,
    }
}

fn pooled(left: &PairScores, right: &PairScores) -> PairScores {
    let mse = pooled_mse((left.mse, left.pixels), (right.mse, right.pixels));
    let weighted_squared_error = left
        .weighted_squared_error
        .zip(right.weighted_squared_error)
        .map(|((a, b), (c, d))| (a + c, b + d));
    let scores = left.scores.iter().filter_map(|(&metric, &l)| {
        let r = *right.scores.get(&metric)?;
        let fmse = weighted_squared_error.map(|(squared, weight)| squared / weight);
        let errors = match metric {
            // Its squared error, in other units, is what its decibels say.
            Metric::PuPsnr => {
                let error = |score: f64, of: &PairScores| (Some(mse_of_db(score)), of.pixels);
                pooled_mse(error(l, left), error(r, right))
            }
            _ => mse,
        };
        Some((metric, pooled_score(metric, errors, fmse, l, r)))
    });
    let bands = left.bands.iter().zip(&right.bands).map(|(l, r)| pooled_band(l, r));
    PairScores {
        scores: scores.collect(),
        bands: bands.collect(),
        pixels: left.pixels + right.pixels,
        outside_bands: left.outside_bands + right.outside_bands,
        left_out: left.left_out + right.left_out,
        mse,
        weighted_squared_error,
    }
}

fn pooled_band(left: &BandScores, right: &BandScores) -> BandScores {
    let mse = pooled_mse((left.mse, left.pixels), (right.mse, right.pixels));
    let scores = left.scores.iter().filter_map(|(&metric, &l)| {
        let r = *right.scores.get(&metric)?;
        Some((metric, either(l, r, |l, r| pooled_score(metric, mse, None, l, r))))
    });
    let map_pixels = left.ssim_map_pixels.zip(right.ssim_map_pixels);
    BandScores {
        pixels: left.pixels + right.pixels,
        mse,
        ssim_map_pixels: map_pixels.map(|(left, right)| left + right),
        scores: scores.collect(),
    }
}

/// The mean squared error over the pixels of both.
fn pooled_mse(left: (Option<f64>, u64), right: (Option<f64>, u64)) -> Option<f64> {
    match (left, right) {
        ((Some(l), pixels_l), (Some(r), pixels_r)) => {
            let pixels = pixels_l + pixels_r;
            Some((l * pixels_l as f64 + r * pixels_r as f64) / pixels as f64)
        }
        ((one, _), (None, _)) | ((None, _), (one, _)) => one,
    }
}

fn pooled_score(metric: Metric, mse: Option<f64>, fmse: Option<f64>, l: f64, r: f64) -> f64 {
    match metric {
        Metric::Mse => mse.unwrap_or_else(|| f64::midpoint(l, r)),
        Metric::Psnr | Metric::PuPsnr => mse.map_or_else(|| f64::midpoint(l, r), psnr_db),
        Metric::Fpsnr => fmse.map_or_else(|| f64::midpoint(l, r), psnr_db),
        Metric::Ssim
        | Metric::MsSsim
        | Metric::Fssim
        | Metric::Fvvdp
        | Metric::RmsContrast
        | Metric::Haar
        | Metric::Atd => f64::midpoint(l, r),
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "fractions of two are exact")]
mod tests {
    use super::*;
    use crate::report::ViewResult;

    fn scores(mse: f64, ssim: f64, pixels: u64) -> PairScores {
        let scores = BTreeMap::from([
            (Metric::Mse, mse),
            (Metric::Psnr, psnr_db(mse)),
            (Metric::Ssim, ssim),
            (Metric::Fpsnr, psnr_db(mse)),
        ]);
        let bands = vec![
            BandScores {
                pixels,
                mse: Some(mse),
                ssim_map_pixels: Some(pixels / 2),
                scores: BTreeMap::from([(Metric::Mse, Some(mse)), (Metric::Ssim, Some(ssim))]),
            },
            BandScores {
                pixels: 0,
                mse: None,
                ssim_map_pixels: Some(0),
                scores: BTreeMap::from([(Metric::Ssim, None)]),
            },
        ];
        PairScores {
            scores,
            bands,
            pixels,
            outside_bands: 1,
            left_out: 2,
            mse: Some(mse),
            weighted_squared_error: Some((mse * 8.0, 8.0)),
        }
    }

    #[test]
    fn errors_are_pooled_and_scores_averaged() {
        let both = pooled(&scores(0.25, 0.5, 100), &scores(0.5, 1.0, 300));
        assert_eq!(both.scores[&Metric::Mse], 0.4375);
        assert_eq!(both.scores[&Metric::Psnr], psnr_db(0.4375));
        assert_eq!(both.scores[&Metric::Ssim], 0.75);
        assert_eq!(both.scores[&Metric::Fpsnr], psnr_db(0.375), "by weight, not by pixels");
        assert_eq!((both.pixels, both.outside_bands, both.left_out), (400, 2, 4));
        assert_eq!(both.bands[0].scores[&Metric::Mse], Some(0.4375));
        assert_eq!(both.bands[0].ssim_map_pixels, Some(200));
        assert_eq!(both.bands[1].scores[&Metric::Ssim], None);
    }

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
            atd_guides: AtdGuides { motion, depth: Reference },
            ..ScoreReport::default()
        };
        let guides = both_eyes(&of(Reference), &of(None)).atd_guides;
        assert_eq!(guides, AtdGuides { motion: None, depth: Reference });
    }

    #[test]
    fn frames_meet_by_number() {
        let frame = |frame| FrameResult {
            frame,
            reference: String::new(),
            test: String::new(),
            gaze_px: None,
            gaze_step_deg: None,
            scores: scores(0.5, 0.5, 1),
            profiles: None,
            atd: None,
            fvvdp: None,
        };
        let report = |frames: &[i64]| ScoreReport {
            metrics: vec![Metric::Mse],
            frames: frames.iter().map(|n| frame(*n)).collect(),
            ..ScoreReport::default()
        };
        let both = both_eyes(&report(&[1, 2, 4]), &report(&[2, 3, 4]));
        assert_eq!(both.frames.iter().map(|f| f.frame).collect::<Vec<_>>(), [2, 4]);
        assert_eq!(both.frames[0].scores.bands.len(), 2);
        let seen = |to_deg| ViewResult {
            size: [1, 1],
            focal_px: [1.0; 2],
            gaze_px: [0.5; 2],
            eccentricity: "angular",
            bands_deg: vec![(0.0, 5.0), (5.0, to_deg)],
        };
        let [left, right] =
            [10.0, 20.0].map(|to| ScoreReport { view: Some(seen(to)), ..report(&[1]) });
        let both = both_eyes(&left, &right);
        assert!(both.view.is_none() && both.frames[0].scores.bands.is_empty());
    }
}
