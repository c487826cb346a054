//! Counts in closed form, the result of the optimiser, and the limits of budgets.

#![allow(clippy::float_cmp, reason = "what is exact is compared exactly")]

use std::f64::consts::PI;

use fovqa_params::ParamValue;

use super::{centred, method, number, setting};
use crate::deamp::Deamp;
use crate::guenter::{self, Guenter};
use crate::{BudgetError, BudgetSamples, Counts, Method, Place, Setting, deamp};

#[track_caller]
fn near(found: f64, want: f64, relative: f64) {
    assert!((found - want).abs() <= relative * want.abs(), "{found} for {want}");
}

fn list(l: &[f64]) -> ParamValue {
    ParamValue::List(l.to_vec())
}

fn word(word: &str) -> ParamValue {
    ParamValue::Text(word.into())
}

fn counts(method: &Method, setting: &Setting) -> Counts {
    method.apply(setting).unwrap().counts()
}

#[test]
fn buffers_are_the_frame_over_sigma() {
    let setting = setting(1440, 1600, 110.0, [100.0, 1600.0]);
    for (name, sigma) in [("full", 1.0), ("rmfr", 2.6), ("kfr", 2.6), ("lafr", 1.8)] {
        let counts = counts(&Method::find(name).unwrap(), &setting);
        near(counts.buffers[0][0], 1440.0 / sigma, 1e-12);
        near(counts.buffers[0][1], 1600.0 / sigma, 1e-12);
        near(counts.samples, 1440.0 * 1600.0 / (sigma * sigma), 1e-12);
        assert!(counts.samples_beyond == 0.0);
        let all = name == "full" || name == "rmfr";
        assert_eq!(counts.samples_on_screen == counts.samples, all, "{name}");
        assert!(counts.samples_seen == counts.samples_on_screen);
    }
}

/// The part of a log-polar buffer on the screen ends, at each angle, where the frame ends.
#[test]
fn log_polar_samples_on_screen() {
    for gaze in [[720.0, 800.0], [1438.0, 900.0], [40.0, 1530.0], [0.3, 800.0], [1440.0, 0.0]] {
        let setting = setting(1440, 1600, 110.0, gaze);
        for name in ["kfr", "lafr"] {
            let foveation = Method::find(name).unwrap().apply(&setting).unwrap();
            let mapping = foveation.mapping().unwrap();
            let [_, rows] = mapping.buffer(0);
            let steps = 200_000;
            let sum: f64 = (0..steps)
                .map(|i| 2.0 * PI * (f64::from(i) + 0.5) / f64::from(steps))
                .map(|angle| {
                    let (dy, dx) = angle.sin_cos();
                    let to = |g: f64, d: f64, side: f64| {
                        if d > 0.0 { (side - g) / d } else { -g / d }
                    };
                    let r = to(gaze[0], dx, 1440.0).min(to(gaze[1], dy, 1600.0));
                    mapping.to_buffer(0, Place::polar(r, 0.0))[0]
                })
                .sum();
            let found = foveation.counts().samples_on_screen;
            near(found, sum * rows / f64::from(steps), 2e-6);
        }
    }
}

#[test]
fn deamp_counts_its_rings() {
    let params = deamp::Params::default();
    for (gaze, fov) in [([720.0, 800.0], 90.0), ([300.0, 1500.0], 110.0), ([0.0, 1600.0], 70.0)] {
        let setting = setting(1440, 1600, fov, gaze);
        // The number of samples times σ on an axis up to t: ∫ f (f + A) / (t + f)² dt = t (f + A) /
        // (t + f).
        let axis = |i: usize, half: f64| {
            let side = [1440.0, 1600.0][i];
            let f = 0.38 * side;
            let to = |a: f64| {
                let t = half.min(a);
                t * (f + a) / (t + f)
            };
            to(gaze[i]) + to(side - gaze[i])
        };
        let area = |half: [f64; 2]| axis(0, half[0]) * axis(1, half[1]);
        let [t10, t22] = [10.0, 22.5].map(|e: f64| e.to_radians().tan());
        let inner = area([720.0 * t10, 800.0 * t10]);
        let middle = area([720.0 * t22, 800.0 * t22]);
        let whole = area([1440.0, 1600.0]);
        near(whole, 1440.0 * 1600.0, 1e-12);
        let want =
            inner / (2.51 * 2.51) + (middle - inner) / (3.6 * 3.6) + (whole - middle) / (4.8 * 4.8);
        let deamp = Deamp::new(&params, &setting).unwrap();
        let counts = counts(&Method::Deamp(params.clone()), &setting);
        near(counts.samples, want, 1e-12);
        near(counts.samples_seen, want, 1e-12);
        // Buffers include the samples that a finer layer covers.
        for (i, half) in [[720.0 * t10, 800.0 * t10], [720.0 * t22, 800.0 * t22], [1440.0, 1600.0]]
            .into_iter()
            .enumerate()
        {
            near(counts.buffers[i][0] * params.sigmas[i], axis(0, half[0]), 1e-12);
            near(counts.buffers[i][1] * params.sigmas[i], axis(1, half[1]), 1e-12);
        }
        near(deamp.share_within(10.0), inner / (2.51 * 2.51 * 1440.0 * 1600.0), 1e-12);
        near(deamp.outer_share(), 1.0 - t22 * t22, 1e-12);
    }
}

#[test]
fn refused_at_the_very_ends() {
    let setting = centred(1440, 1600, 110.0);
    let refused = |name: &str, params: &[(&str, ParamValue)], what: &str| {
        let error = method(name, params).apply(&setting).unwrap_err().to_string();
        assert!(error.contains(what), "{error}");
    };
    for bounds in [[0.0, 20.0, 45.0], [10.0, 20.0, 90.0], [10.0, 10.0, 45.0]] {
        refused("deamp", &[("bounds_deg", list(&bounds))], "must increase between 0° and 90°");
    }
    for bounds in [[0.0, 20.0], [10.0, 90.0], [10.0, 10.0]] {
        refused("guenter", &[("bounds_deg", list(&bounds))], "must increase between 0° and 90°");
    }
    refused("guenter", &[("scales", list(&[1.0, 2.0, 0.09]))], "0.1 and 1000");
    refused("deamp", &[("sigmas", list(&[1.0, 2.0, 0.09]))], "0.1 and 1000");
    refused("linear", &[("outer_deg", number(10.0))], "must be above");
    let pairs = |pairs: &[[f64; 2]]| [("ratio", ParamValue::Pairs(pairs.to_vec()))];
    refused("vafr", &pairs(&[[5.0, 1.0], [5.0, 2.0]]), "must increase");
    refused("vafr", &pairs(&[[5.0, 0.009]]), "0.01 and 100");
    assert!(method("deamp", &[("sigmas", list(&[0.1, 1.0, 1000.0]))]).apply(&setting).is_ok());
}

#[test]
fn guenter_counts_squares_and_discs() {
    // Both discs leave the frame on the left, and the outer one also below.
    let gaze = [100.0, 1200.0];
    let setting = setting(1440, 1600, 110.0, gaze);
    let focal = 800.0 / 55f64.to_radians().tan();
    let [r1, r2] = [15.0, 40.0].map(|e: f64| focal * e.to_radians().tan());
    let params = [("bounds_deg", list(&[15.0, 40.0])), ("scales", list(&[1.0, 2.0, 5.0]))];
    let guenter = method("guenter", &params);
    let found = counts(&guenter, &setting);
    assert!(r1 > 100.0 && r1 < 400.0 && r2 > 400.0 && r2 < 1200.0);
    let inner = (100.0 + r1) * 2.0 * r1;
    let outer = (100.0 + r2) * (r2 + 400.0);
    near(found.samples, inner + outer / 4.0 + 1440.0 * 1600.0 / 25.0, 1e-12);
    near(found.buffers[0][0], 100.0 + r1, 1e-12);
    near(found.buffers[1][1], f64::midpoint(r2, 400.0), 1e-12);
    // A disc minus the segment beyond a line at a distance.
    let segment = |r: f64, d: f64| r * r * (d / r).acos() - d * (r * r - d * d).sqrt();
    let disc1 = PI * r1 * r1 - segment(r1, 100.0);
    // The corner of the outer disc beyond both lines is subtracted twice.
    let (x, y) = (100.0, 400.0);
    let both = {
        let (ax, ay) = ((r2 * r2 - y * y).sqrt(), (r2 * r2 - x * x).sqrt());
        let turn = (ax / r2).acos();
        let sector = 0.5 * r2 * r2 * ((x / r2).acos() - turn);
        sector - 0.5 * x * (ay - y) - 0.5 * y * (ax - x)
    };
    let disc2 = PI * r2 * r2 - segment(r2, x) - segment(r2, y) + both;
    let seen = disc1 + (disc2 - disc1) / 4.0 + (1440.0 * 1600.0 - disc2) / 25.0;
    near(found.samples_seen, seen, 1e-9);
    let Method::Guenter(params) = &guenter else { panic!() };
    let discs = Guenter::new(params, &setting).unwrap().samples_in_discs();
    near(discs, disc1 + disc2 / 4.0 + 1440.0 * 1600.0 / 25.0, 1e-9);
}

/// Compares the result with every pair of the grid.
#[test]
fn guenter_finds_the_least_of_all_pairs() {
    for (width, height, fov, gaze, m, omega0_deg) in [
        (1440, 1600, 110.0, [720.0, 800.0], 0.0275, 1.0 / 48.0),
        (1440, 1600, 110.0, [100.0, 1600.0], 0.022, 1.0 / 30.0),
        (5760, 3240, 110.0, [2880.0, 1620.0], 0.022, 1.0 / 48.0),
        (11520, 6480, 110.0, [2000.0, 3240.0], 0.01, 1.0 / 48.0),
        (640, 360, 50.0, [320.0, 180.0], 0.0275, 1.0 / 48.0),
        // Scales bring no gain here: the optimum has the two smallest layers, not one of them
        // twice.
        (1440, 1600, 110.0, [720.0, 800.0], 0.0, 1.0 / 48.0),
    ] {
        let setting = setting(width, height, fov, gaze);
        let (w, h) = (width as f64, height as f64);
        let focal = h / 2.0 / f64::to_radians(fov / 2.0).tan();
        let shown = (2.0 / focal).atan().to_degrees();
        // A display that shows less than acuity is not supersampled.
        let scale = |e: f64| f64::max((m * e + omega0_deg) / shown, 1.0);
        let square = |e: f64| {
            let r = focal * e.to_radians().tan();
            (gaze[0].min(r) + (w - gaze[0]).min(r)) * (gaze[1].min(r) + (h - gaze[1]).min(r))
        };
        let far = f64::hypot(gaze[0].max(w - gaze[0]), gaze[1].max(h - gaze[1]));
        let steps = ((far / focal).atan().to_degrees() * 4.0).ceil() as u32;
        let mut best = (f64::INFINITY, [0.0; 2]);
        for i in 1..steps {
            for j in i + 1..=steps {
                let [e1, e2] = [i, j].map(|i| f64::from(i) / 4.0);
                let samples =
                    square(e1) + square(e2) / scale(e1).powi(2) + w * h / scale(e2).powi(2);
                if samples < best.0 * (1.0 - 1e-12) {
                    best = (samples, [e1, e2]);
                }
            }
        }
        let params = guenter::Params {
            fit: guenter::Fit::Optimised,
            m,
            omega0_deg,
            ..guenter::Params::default()
        };
        let found = Guenter::new(&params, &setting).unwrap();
        assert_eq!(found.bounds_deg(), best.1, "{width}x{height}");
        near(counts(&Method::Guenter(params), &setting).samples, best.0, 1e-12);
        let [first, second, third] = found.scales();
        near(first, 1.0, 0.0);
        near(second, scale(best.1[0]), 1e-12);
        near(third, scale(best.1[1]), 1e-12);
    }
}

#[test]
fn coarse_pixels_count_rings() {
    // All rings lie inside the frame.
    let setting = centred(2000, 2400, 100.0);
    let focal = 1200.0 / 50f64.to_radians().tan();
    let disc = |e: f64| PI * (focal * e.to_radians().tan()).powi(2);
    let cps = |quantise| {
        let params = [("transition_deg", number(12.0)), ("quantise", word(quantise))];
        counts(&method("cps", &params), &setting)
    };
    let rings = |half: f64, quarter: f64| {
        disc(half) + (disc(quarter) - disc(half)) / 4.0 + (4_800_000.0 - disc(quarter)) / 16.0
    };
    // The rate is down to 1/2 at 2/3 of the way and to 1/4 at its end; it is 3/4 after a third and
    // 3/8 after 5/6.
    let [ceil, nearest, continuous] = ["ceil", "nearest", "continuous"].map(cps);
    near(ceil.samples, rings(23.0, 27.0), 1e-9);
    near(nearest.samples, rings(19.0, 25.0), 1e-9);
    let steps = 100_000;
    let step = 12.0 / f64::from(steps);
    let between: f64 = (0..steps)
        .map(|i| 15.0 + f64::from(i) * step)
        .map(|e| (disc(e + step) - disc(e)) * (1.0 - 0.75 * (e + step / 2.0 - 15.0) / 12.0).powi(2))
        .sum();
    let want = disc(15.0) + between + (4_800_000.0 - disc(27.0)) / 16.0;
    near(continuous.samples, want, 1e-9);
    for counts in [ceil, nearest, continuous] {
        assert!(
            counts.samples_on_screen == counts.samples && counts.samples_seen == counts.samples
        );
    }
}

#[test]
fn the_linear_fall_off_in_closed_form() {
    let setting = centred(2000, 2400, 100.0);
    let focal = 1200.0 / 50f64.to_radians().tan();
    let radius = |e: f64| focal * e.to_radians().tan();
    // ∫ r atan(r / f) dr.
    let moment = |e: f64| {
        let r = radius(e);
        ((r * r + focal * focal) * e.to_radians() - focal * r) / 2.0
    };
    let disc = |e: f64| PI * radius(e).powi(2);
    // 2π ∫ r (1 - 0.953 (e - 10) / 10) dr from 10° to 20°.
    let ring = 1.953 * (disc(20.0) - disc(10.0))
        - 0.0953 * 2.0 * PI * (moment(20.0) - moment(10.0)).to_degrees();
    let want = disc(10.0) + ring + 0.047 * (4_800_000.0 - disc(20.0));
    near(counts(&Method::find("linear").unwrap(), &setting).samples, want, 1e-10);
}

/// The smallest and the largest share that a free parameter reaches.
fn range(method: &Method, setting: &Setting, of: BudgetSamples) -> [f64; 2] {
    match method.at_budget(setting, -1.0, of).unwrap_err() {
        BudgetError::OutOfReach { least, most, .. } => [least, most],
        error => panic!("{error}"),
    }
}

#[test]
fn budgets_reach_as_far_as_their_parameters() {
    let setting = centred(1440, 1600, 110.0);
    let pixels = 1440.0 * 1600.0;
    let share = |name: &str, params: &[(&str, ParamValue)]| {
        counts(&method(name, params), &setting).samples / pixels
    };
    let of = |name: &str| range(&Method::find(name).unwrap(), &setting, BudgetSamples::Buffer);
    // σ runs from 0.1 to 1000.
    for name in ["rmfr", "kfr", "lafr"] {
        near(of(name)[0], 1e-6, 1e-9);
        near(of(name)[1], 100.0, 1e-9);
    }
    let [least, most] = of("deamp");
    let sigmas = |factor: f64| [("sigmas", list(&[2.51, 3.6, 4.8].map(|sigma| sigma * factor)))];
    near(least, share("deamp", &sigmas(999.999_999_999 / 4.8)), 1e-9);
    near(most, share("deamp", &sigmas(0.100_000_000_001 / 2.51)), 1e-9);
    let [least, most] = of("guenter");
    let scales = |outer: f64| [("scales", list(&[1.0, 2.0, outer]))];
    near(least, share("guenter", &scales(1000.0)), 1e-12);
    near(most, share("guenter", &scales(2.0)), 1e-12);
    let [least, most] = of("linear");
    near(least, share("linear", &[("outer_deg", number(10.000_001))]), 1e-6);
    near(most, share("linear", &[("outer_deg", number(89.9))]), 1e-12);
    let [least, most] = of("cps");
    near(least, share("cps", &[("transition_deg", number(0.001))]), 1e-12);
    near(most, share("cps", &[("transition_deg", number(1000.0))]), 1e-12);
    // The number of samples grows with the square of the factor; those beyond 60° count.
    let [least, most] = of("vafr");
    let all = counts(&Method::find("vafr").unwrap(), &setting);
    assert!(all.samples_beyond > 0.0);
    near(least, 1e-6 * (all.samples + all.samples_beyond) / pixels, 1e-9);
    near(most, 1e6 * (all.samples + all.samples_beyond) / pixels, 1e-9);
    let polar = Method::find("visual_polar").unwrap();
    let [least, most] = range(&polar, &setting, BudgetSamples::OnScreen);
    near(least, 1e-4, 1e-9);
    near(most, 16.0, 1e-9);
    let error = polar.at_budget(&setting, f64::INFINITY, BudgetSamples::OnScreen).unwrap_err();
    assert!(error.to_string().contains("allows 1.000e-4 to 16.0000"), "{error}");
}

#[test]
fn budgets_keep_parameters_that_are_not_free() {
    let setting = setting(1440, 1600, 110.0, [500.0, 900.0]);
    for method in Method::all().into_iter().filter(|method| method.key() != "full") {
        for of in [BudgetSamples::Buffer, BudgetSamples::OnScreen] {
            // The limits themselves can be reached.
            for share in range(&method, &setting, of) {
                assert!(method.at_budget(&setting, share, of).is_ok(), "{} {share}", method.key());
            }
        }
        // The value, set by name, gives the same method.
        let found = method.at_budget(&setting, 0.2, BudgetSamples::OnScreen).unwrap();
        let value = found.value;
        let mut set = method.clone();
        set.set(found.parameter, &value).unwrap();
        assert_eq!(set, found.method);
    }
    let Method::Guenter(found) = Method::find("guenter")
        .unwrap()
        .at_budget(&setting, 0.1, BudgetSamples::Buffer)
        .unwrap()
        .method
    else {
        panic!()
    };
    assert_eq!((found.scales[0], found.scales[1]), (1.0, 2.0));
    let Method::Deamp(found) = Method::find("deamp")
        .unwrap()
        .at_budget(&setting, 0.1, BudgetSamples::Buffer)
        .unwrap()
        .method
    else {
        panic!()
    };
    near(found.sigmas[2] / found.sigmas[0], 4.8 / 2.51, 1e-12);
    near(found.sigmas[1] / found.sigmas[0], 3.6 / 2.51, 1e-12);
    assert_eq!(BudgetSamples::default(), BudgetSamples::Buffer);
}

/// Optimised layers are determined once, and then their outermost scale is the free parameter.
#[test]
fn a_budget_of_optimised_layers() {
    let setting = centred(5760, 3240, 110.0);
    let params = guenter::Params { fit: guenter::Fit::Optimised, ..guenter::Params::default() };
    let optimum = Guenter::new(&params, &setting).unwrap();
    let found = Method::Guenter(params).at_budget(&setting, 0.05, BudgetSamples::Buffer).unwrap();
    near(counts(&found.method, &setting).samples / setting.pixels(), 0.05, 1e-9);
    let Method::Guenter(fixed) = found.method else { panic!() };
    assert_eq!(fixed.fit, guenter::Fit::Fixed);
    assert_eq!(fixed.bounds_deg, optimum.bounds_deg());
    assert_eq!(fixed.scales[..2], optimum.scales()[..2]);
}
