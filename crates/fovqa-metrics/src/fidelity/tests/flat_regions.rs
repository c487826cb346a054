//! SSIM where the window is flat or nearly flat. Squares of values in 32 bits would lose the digits
//! that are compared with C2, and every such window would have the same error, which a mean over
//! pixels does not reduce.

use super::*;
use crate::fidelity::scorer::Scorer;

/// The tolerance that the documentation promises.
const TOLERANCE: f64 = 1e-5;

fn gray(width: usize, height: usize, code: impl Fn(usize, usize) -> u8) -> Frame {
    let codes = (0..width * height).map(|i| code(i % width, i / width)).collect();
    Frame::new(width, height, Channels::Gray, Samples::U8(codes)).unwrap()
}

/// The score of a pair of gray frames.
fn ssim(params: &Params, tables: &SignalTables, a: &Frame, b: &Frame) -> f64 {
    let scorer = Scorer::new(vec![Metric::Ssim], params.clone());
    let bands = BandMap::without_bands(a.width(), a.height());
    let pair = PairSignal::new(a, b, tables);
    let scores = scorer.score(&pair, &Regions::unmasked(&bands), None).unwrap();
    score(&scores.rows, Metric::Ssim)
}

/// Without structure SSIM is (2 a b + C1) / (a² + b² + C1).
#[test]
fn flat_grays_of_every_pair_of_codes() {
    let (params, tables) = (Params::default(), SignalTables::new(SignalParams::default()));
    let flat: Vec<Frame> = (0..=255).map(|code| gray(11, 11, |_, _| code)).collect();
    let mut worst = 0.0f64;
    for (a, reference) in flat.iter().enumerate() {
        for (b, test) in flat.iter().enumerate() {
            let [a, b] = [a, b].map(|code| code as f64 / 255.0);
            let wanted = (2.0 * a * b + 1e-4) / (a * a + b * b + 1e-4);
            worst = worst.max((ssim(&params, &tables, reference, test) - wanted).abs());
        }
    }
    assert!(worst <= TOLERANCE, "{worst}");
}

/// Flat areas and their borders: steps down, across and slanted, ramps, spots, a little noise.
fn patterns(low: u8, high: u8) -> Vec<Box<dyn Fn(usize, usize) -> u8>> {
    let ramp = move |t: f64| {
        let (low, high) = (f64::from(low), f64::from(high));
        (low + (high - low) * t.clamp(0.0, 1.0)).round() as u8
    };
    let either = move |is_high: bool| if is_high { high } else { low };
    vec![
        Box::new(move |_, _| low),
        Box::new(move |_, _| high),
        Box::new(move |x, _| either(x >= 19)),
        Box::new(move |_, y| either(y >= 13)),
        Box::new(move |x, y| either(x + y >= 30)),
        Box::new(move |x, _| ramp((x as f64 - 12.0) / 16.0)),
        Box::new(move |x, y| ramp((x as f64 + 2.0 * y as f64 - 40.0) / 20.0)),
        Box::new(move |x, y| either((x, y) == (20, 12))),
        Box::new(move |x, y| low.saturating_add(((x * 7 + y * 13) % 5 == 0).into())),
    ]
}

#[test]
fn steps_and_ramps_beside_flats() {
    const W: usize = 40;
    const H: usize = 26;
    let tables = SignalTables::new(SignalParams::default());
    let mut worst = 0.0f64;
    // The unrolled window, and windows of other radii.
    for (sigma, radius) in [(1.5, 5), (2.0, 7), (0.6, 2)] {
        let mut params = Params::default();
        params.set(Metric::Ssim, "sigma", &ParamValue::Number(sigma)).unwrap();
        for (low, high) in [(80, 252), (0, 255), (0, 1), (254, 255), (3, 12), (120, 136)] {
            let frames: Vec<Frame> =
                patterns(low, high).iter().map(|pattern| gray(W, H, pattern)).collect();
            for (i, a) in frames.iter().enumerate() {
                for (j, b) in frames.iter().enumerate() {
                    let [pa, pb] = [a, b].map(|frame| {
                        (0..W * H)
                            .map(|i| f64::from(frame.sample(0, i % W, i / W)) / 255.0)
                            .collect::<Vec<_>>()
                    });
                    let [map, _] = literal_maps(&pa, &pb, W, H, sigma, radius);
                    let found = ssim(&params, &tables, a, b);
                    let off = (found - mean(map.into_iter())).abs();
                    assert!(off <= TOLERANCE, "sigma {sigma}, {low} {high}, {i} {j}: {off}");
                    worst = worst.max(off);
                }
            }
        }
    }
    // The error is much smaller than promised: only noise of the last bit.
    assert!(worst <= 3e-6, "{worst}");
}
