use fovqa_metrics::Metric;
use fovqa_plan::{Aggregate, Allowance};
use fovqa_statistics::distributions::t_upper_quantile;

use super::super::random::Noise;
use super::*;

/// A rule with the direction of its metric. The limit in it does not matter.
fn rule(metric: Metric, relative: bool) -> GateRule {
    let allowance = relative.then_some(Allowance::Units(0.0));
    let mut quantity = Quantity::of(metric, Aggregate::Mean);
    if metric == Metric::RmsContrast {
        "ratio".clone_into(&mut quantity.image);
    }
    GateRule {
        line: 1,
        name: None,
        quantity,
        scene: None,
        method: None,
        eye: None,
        at_least: None,
        at_most: None,
        max_drop: allowance,
        max_rise: None,
        spread: None,
    }
}

fn proposed(metrics: &[Metric], relative: bool, rows: &[Vec<f64>], rate: f64) -> Vec<Proposal> {
    let proposal = |(index, metric): (usize, &Metric)| {
        let place = (format!("s{index}"), "m".to_owned(), String::new());
        let samples = Samples::of(rows.iter().map(|row| vec![row[index]]).collect());
        (Proposal::new(&rule(*metric, relative), &place, &samples), samples)
    };
    with_limits(metrics.iter().enumerate().map(proposal).collect(), rate)
}

fn column(values: &[f64]) -> Vec<Vec<f64>> {
    values.iter().map(|value| vec![*value]).collect()
}

#[test]
fn a_limit_is_a_prediction_limit_rounded_outwards() {
    // Mean 28.65, standard deviation 0.05; t(0.99, 2) = 6.9646, so the margin is 0.4021.
    let rows = column(&[28.6, 28.65, 28.7]);
    let limits = |metric, relative| proposed(&[metric], relative, &rows, 0.01)[0].limits.clone();
    assert_eq!(limits(Metric::Psnr, false), [ProposedLimit::AtLeast(28.24)]);
    assert_eq!(limits(Metric::Mse, false), [ProposedLimit::AtMost(29.06)]);
    // 6.9646 · 0.05 · √2 = 0.4925
    assert_eq!(limits(Metric::Psnr, true), [ProposedLimit::MaxDrop(0.5)]);
    assert_eq!(limits(Metric::Mse, true), [ProposedLimit::MaxRise(0.5)]);
    // Two limits: t(0.995, 2) = 9.9248, so each margin is 0.5730.
    let both = limits(Metric::RmsContrast, false);
    assert_eq!(both, [ProposedLimit::AtLeast(28.07), ProposedLimit::AtMost(29.23)]);
}

#[test]
fn identical_runs_leave_room_for_rounding_noise() {
    let limits = |metric, relative, value: f64| {
        proposed(&[metric], relative, &column(&[value; 4]), 0.01)[0].limits.clone()
    };
    assert_eq!(limits(Metric::Psnr, false, 28.5), [ProposedLimit::AtLeast(28.499)]);
    assert_eq!(limits(Metric::Psnr, true, 28.5), [ProposedLimit::MaxDrop(0.001)]);
    assert_eq!(limits(Metric::Ssim, true, 0.5), [ProposedLimit::MaxDrop(5e-6)]);
    assert_eq!(limits(Metric::Mse, false, 0.0), [ProposedLimit::AtMost(1e-9)]);
    assert_eq!(limits(Metric::Mse, true, 0.0), [ProposedLimit::MaxRise(1e-9)]);
}

#[test]
fn no_limit_is_stricter_than_a_run() {
    // At a rate of 0.5, the margin alone would be 0.
    let rows = column(&[1.0, 2.0, 9.0]);
    let limits = |metric, relative| proposed(&[metric], relative, &rows, 0.5)[0].limits.clone();
    let [ProposedLimit::AtLeast(least)] = limits(Metric::Psnr, false)[..] else { panic!() };
    let [ProposedLimit::AtMost(most)] = limits(Metric::Mse, false)[..] else { panic!() };
    let [ProposedLimit::MaxDrop(drop)] = limits(Metric::Psnr, true)[..] else { panic!() };
    assert!((0.8..1.0).contains(&least), "{least}");
    assert!(most > 9.0 && most < 9.6, "{most}");
    assert!(drop > 8.0 && drop < 8.9, "{drop}");
}

#[test]
fn infinite_values_have_no_limit_and_no_share_of_the_rate() {
    let rows = [vec![1.0, f64::INFINITY], vec![2.0, f64::INFINITY], vec![3.0, 40.0]];
    let found = proposed(&[Metric::Mse, Metric::Psnr], false, &rows, 0.01);
    let alone = proposed(&[Metric::Mse], false, &column(&[1.0, 2.0, 3.0]), 0.01);
    assert_eq!(found[0].limits, alone[0].limits);
    assert!(found[1].limits.is_empty());
}

#[test]
fn limits_of_frames_keep_in_every_frame() {
    let mut of_frames = rule(Metric::Psnr, false);
    of_frames.quantity = of_frames.quantity.of_frames();
    let place = ("s".to_owned(), "m".to_owned(), String::new());
    // The last frame is identical to its reference, and the second one has the lowest values.
    let rows =
        [[30.0, 20.0, f64::INFINITY], [30.2, 20.1, f64::INFINITY], [30.1, 20.2, f64::INFINITY]];
    let limits = |relative: bool| {
        let mut rule = of_frames.clone();
        rule.max_drop = relative.then_some(Allowance::Units(0.0));
        let samples = Samples::of(rows.iter().map(|row| row.to_vec()).collect());
        let proposal = Proposal::new(&rule, &place, &samples);
        with_limits(vec![(proposal, samples)], 0.01)[0].limits.clone()
    };
    // Two frames, four degrees of freedom, standard deviation 0.1: t(0.995, 4) = 4.6041.
    let [ProposedLimit::AtLeast(least)] = limits(false)[..] else { panic!() };
    let wanted = 20.1 - 4.604_095 * 0.1 * (4.0f64 / 3.0).sqrt();
    assert!(least <= wanted && least > wanted - 0.011, "{least} {wanted}");
    let [ProposedLimit::MaxDrop(drop)] = limits(true)[..] else { panic!() };
    let wanted = 4.604_095 * 0.1 * 2.0f64.sqrt();
    assert!(drop >= wanted && drop < wanted + 0.011, "{drop} {wanted}");
}

#[test]
fn values_are_rounded_to_the_second_digit_of_their_margin() {
    assert!((rounded(123_456.0, 5000.0, f64::floor) - 123_400.0).abs() < 1e-9);
    assert!((rounded(28.5241, 0.178, f64::floor) - 28.52).abs() < 1e-12);
    assert!((rounded(1e-310, 1e-320, f64::floor) - 1e-310).abs() < 1e-315, "no power of ten");
    assert!(rounded(f64::INFINITY, f64::INFINITY, f64::ceil).is_infinite());
}

#[test]
fn few_runs_are_named() {
    let of = |runs: usize| {
        let rows: Vec<Vec<f64>> = (0..runs).map(|run| vec![run as f64]).collect();
        let proposals = proposed(&[Metric::Psnr], false, &rows, 0.01);
        Calibration { runs, false_alarms: 0.01, proposals }.in_words()
    };
    let two = of(2);
    for words in
        ["2 repeated runs", "at most 0.01 for its limit", "17 times as wide", "from 5 runs"]
    {
        assert!(two.contains(words), "{words}: {two}");
    }
    assert!(of(3).contains("3 runs say little") && !of(5).contains("say little"));
}

/// Six values of one build: their metrics, and their means and standard deviations.
const METRICS: [Metric; 6] =
    [Metric::Psnr, Metric::Ssim, Metric::Mse, Metric::RmsContrast, Metric::Psnr, Metric::Mse];
const BUILD: [(f64, f64); 6] =
    [(30.0, 0.2), (0.95, 0.003), (0.01, 1e-3), (0.8, 0.02), (40.0, 1.5), (500.0, 30.0)];
const TRIALS: usize = 1000;

fn run(noise: &mut Noise) -> Vec<f64> {
    BUILD.iter().map(|(mean, deviation)| mean + deviation * noise.normal()).collect()
}

/// Whether a new run fails any limit. `baseline` is another run of the same build.
fn fails(proposals: &[Proposal], new: &[f64], baseline: &[f64]) -> bool {
    proposals.iter().zip(new).zip(baseline).any(|((proposal, new), baseline)| {
        proposal.limits.iter().any(|limit| match *limit {
            ProposedLimit::AtLeast(limit) => *new < limit,
            ProposedLimit::AtMost(limit) => *new > limit,
            ProposedLimit::MaxDrop(drop) => baseline - new > drop,
            ProposedLimit::MaxRise(rise) => new - baseline > rise,
        })
    })
}

#[test]
fn an_unchanged_build_fails_as_seldom_as_stated() {
    let mut noise = Noise(1);
    for (relative, runs, rate) in [false, true].into_iter().flat_map(|relative| {
        [3, 5, 10]
            .into_iter()
            .flat_map(move |runs| [(relative, runs, 0.01), (relative, runs, 0.05)])
    }) {
        let mut failed = 0;
        let (mut margins, mut deviation) = (0.0, 0.0);
        for _ in 0..TRIALS {
            let rows: Vec<Vec<f64>> = (0..runs).map(|_| run(&mut noise)).collect();
            let proposals = proposed(&METRICS, relative, &rows, rate);
            let (baseline, new) = (run(&mut noise), run(&mut noise));
            failed += usize::from(fails(&proposals, &new, &baseline));
            margins += match proposals[0].limits[0] {
                ProposedLimit::AtLeast(limit) => proposals[0].mean - limit,
                ProposedLimit::MaxDrop(drop) => drop,
                _ => panic!("of PSNR, higher is better"),
            };
            deviation += proposals[0].deviation;
        }
        let trials = TRIALS as f64;
        let found = failed as f64 / trials;
        let sigma = (rate * (1.0 - rate) / trials).sqrt();
        let what = format!("relative {relative}, {runs} runs, rate {rate}: {found}");
        assert!(found <= rate + 3.0 * sigma, "{what}");
        assert!(found >= 0.3 * rate, "{what}: the limits are too wide");
        // RMS contrast has two limits, so there are seven.
        let factor = if relative { 2.0 } else { 1.0 + 1.0 / f64::from(runs) };
        let exact = t_upper_quantile(rate / 7.0, f64::from(runs) - 1.0) * f64::sqrt(factor);
        let ratio = margins / deviation / exact;
        assert!((0.999..1.06).contains(&ratio), "{what}: margins are {ratio} times the exact one");
    }
}

#[test]
fn frames_of_an_unchanged_build_fail_as_seldom_as_stated() {
    const FRAMES: usize = 40;
    let mut noise = Noise(2);
    let rate = 0.05;
    // Frames that vary alike, and frames of which some vary four times as much as others.
    for unlike in [0.0, 3.0] {
        let mut row = || -> Vec<f64> {
            let deviation = |frame: usize| 1.0 + unlike * frame as f64 / FRAMES as f64;
            (0..FRAMES).map(|frame| deviation(frame) * noise.normal()).collect()
        };
        let mut failed = 0;
        for _ in 0..TRIALS {
            let rows = [row(), row(), row()];
            let spread = Spread::of_frames(&rows).unwrap();
            let margin = spread.of_new_run(rate);
            let new = row();
            failed += usize::from((0..FRAMES).any(|frame| {
                let mean = rows.iter().map(|row| row[frame]).sum::<f64>() / 3.0;
                new[frame] < mean - margin
            }));
        }
        let found = failed as f64 / TRIALS as f64;
        assert!(found <= rate, "{unlike}: {found}");
    }
}
