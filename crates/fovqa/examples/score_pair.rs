//! Two pictures in memory, scored by eccentricity: `cargo run --example score_pair`.

use fovqa::{Metric, MetricChoice, PairScores, ScoreOptions, Settings, ViewSpec, score};
use ndarray::Array3;

/// A picture of height x width x channel: smooth colours with fine stripes on them.
pub(crate) fn reference() -> Array3<u8> {
    Array3::from_shape_fn((200, 240, 3), |(y, x, channel)| {
        let smooth = (x + y * (channel + 1)) / 4 % 192;
        let stripes = if (x / 2) % 2 == 0 { 0 } else { 40 };
        (smooth + stripes) as u8
    })
}

/// The same as a foveated renderer would show it: away from the gaze, 4x4 pixels share one shading sample.
pub(crate) fn foveated(
    reference: &Array3<u8>,
    gaze_px: [usize; 2],
    radius_px: usize,
) -> Array3<u8> {
    Array3::from_shape_fn(reference.dim(), |(y, x, channel)| {
        let (dx, dy) = (x.abs_diff(gaze_px[0]), y.abs_diff(gaze_px[1]));
        let [x, y] =
            if dx * dx + dy * dy < radius_px * radius_px { [x, y] } else { [x / 4 * 4, y / 4 * 4] };
        reference[[y, x, channel]]
    })
}

/// Scores the pair under a vertical field of view of 60°, and keeps the map of SSIM.
pub(crate) fn score_pair(
    reference: &Array3<u8>,
    test: &Array3<u8>,
) -> Result<PairScores, fovqa::Error> {
    let view = ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(60.0) };
    let options = ScoreOptions {
        settings: Settings { view: Some(view), ..Settings::default() },
        metrics: MetricChoice::Named(vec![Metric::Psnr, Metric::Fpsnr, Metric::Ssim]),
        maps: true,
        ..ScoreOptions::default()
    };
    score(reference.view(), test.view(), &options)
}

#[allow(clippy::print_stdout, reason = "an example shows its result")]
fn main() -> Result<(), fovqa::Error> {
    let reference = reference();
    let scores = score_pair(&reference, &foveated(&reference, [120, 100], 60))?;
    for metric in [Metric::Psnr, Metric::Fpsnr, Metric::Ssim] {
        let value = scores.value(metric).unwrap_or(f64::NAN);
        println!("{:6} {value:.3} {}", metric.info().label, metric.info().unit);
    }
    for map in &scores.maps {
        let (height, width) = map.values.dim();
        println!(
            "map {}: {width}x{height}, mean {:.3}",
            map.name,
            map.values.mean().unwrap_or(0.0)
        );
    }
    for warning in &scores.warnings {
        println!("warning: {warning}");
    }
    Ok(())
}
