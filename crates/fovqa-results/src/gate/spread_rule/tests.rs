use fovqa_metrics::Better;

use super::super::random::Noise;
use super::*;

/// The adjusted p-values of tests of several values of one build.
fn p_values(noise: &mut Noise, count: usize, runs: (usize, usize), shift: f64) -> Vec<f64> {
    let test = |index: usize| {
        let better = [Better::Higher, Better::Lower, Better::Neither][index % 3];
        let worse = if better == Better::Lower { shift } else { -shift };
        let deviation = 0.1 + index as f64;
        let mut sample = |runs: usize, mean: f64| -> Vec<f64> {
            (0..runs).map(|_| mean + deviation * noise.normal()).collect()
        };
        let old = sample(runs.1, 30.0);
        let new = sample(runs.0, 30.0 + worse * deviation);
        TTest::new(&new, &old, better, |_| 1e-9).unwrap().p()
    };
    (0..count).map(test).collect()
}

#[test]
fn an_unchanged_build_fails_as_seldom_as_alpha_says() {
    const TRIALS: usize = 2000;
    let mut noise = Noise(3);
    for runs in [(1, 5), (3, 3), (4, 6)] {
        for alpha in [0.01, 0.05] {
            let failed = |adjust: Adjustment, noise: &mut Noise| {
                let fails = |_: &usize| {
                    let p = adjusted(&p_values(noise, 6, runs, 0.0), adjust);
                    p.iter().any(|p| *p <= alpha)
                };
                (0..TRIALS).filter(fails).count() as f64 / TRIALS as f64
            };
            let sigma = (alpha * (1.0 - alpha) / TRIALS as f64).sqrt();
            let holm = failed(Adjustment::Holm, &mut noise);
            assert!(holm <= alpha + 3.0 * sigma, "{runs:?} {alpha}: {holm}");
            // Welch's test with few runs is conservative, but not by much.
            assert!(holm >= 0.1 * alpha, "{runs:?} {alpha}: {holm}");
            // Without a correction, six tests fail more often.
            let without = failed(Adjustment::None, &mut noise);
            assert!(without > alpha + 3.0 * sigma, "{runs:?} {alpha}: {without}");
        }
    }
}

#[test]
fn a_large_change_is_found() {
    let mut noise = Noise(4);
    let found = (0..200).filter(|_| {
        let p = adjusted(&p_values(&mut noise, 3, (4, 6), 10.0), Adjustment::Holm);
        p.iter().all(|p| *p <= 0.01)
    });
    let found = found.count();
    assert!(found > 150, "{found} of 200");
}

#[test]
fn the_reason_names_value_baseline_and_test() {
    let quantity = Quantity {
        band_deg: Some([0.0, 5.0]),
        ..Quantity::of(Metric::Ssim, fovqa_plan::Aggregate::Mean)
    };
    let test = |adjust| SpreadTest { alpha: 0.01, adjust };
    let found = TTest::new(&[0.912], &[0.925, 0.926, 0.924], Better::Higher, |_| 0.0).unwrap();
    assert_eq!(
        reason(test(Adjustment::Holm), &quantity, &found, 0.004_04),
        "ssim mean, 0° to 5° is 0.912, lower than the baseline's 0.925 (one run: t = -11, 2 degrees of freedom, \
         p = 0.004 after Holm, alpha 0.01)"
    );
    let found = TTest::new(&[0.9; 2], &[0.925; 2], Better::Neither, |_| 0.0).unwrap();
    assert_eq!(
        reason(test(Adjustment::None), &quantity, &found, 0.0),
        "ssim mean, 0° to 5° is 0.9, lower than the baseline's 0.925 (the repeated runs do not vary, p = 0, \
         alpha 0.01)"
    );
}

#[test]
fn numbers_have_few_digits() {
    for (value, text) in [
        (0.912_345_678, "0.912346"),
        (-12.0, "-12"),
        (0.0, "0"),
        (1.234_567_8e-7, "1.23457e-7"),
        (f64::NEG_INFINITY, "-inf"),
    ] {
        assert_eq!(short(value), text);
    }
    assert_eq!(
        (digits(-5.234, 2), digits(0.000_812, 2)),
        ("-5.2".to_owned(), "0.00081".to_owned())
    );
}
