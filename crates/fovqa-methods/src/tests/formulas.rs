//! Compares rates and mappings with the printed formulas (corrected where they are misprinted),
//! which are written out here independently.

#![allow(clippy::float_cmp, reason = "what is exact is compared exactly")]

use std::f64::consts::PI;

use fovqa_params::ParamValue;

use super::{centred, method, number, setting};
use crate::vafr::{self, Vafr};
use crate::visual_polar::VisualPolar;
use crate::{Foveation, Method, Place, Reach, Setting, rmfr};

#[track_caller]
fn near(found: f64, want: f64, relative: f64) {
    assert!((found - want).abs() <= relative * want.abs(), "{found} for {want}");
}

fn word(word: &str) -> ParamValue {
    ParamValue::Text(word.into())
}

/// Radial and tangential cycles per degree at a planar eccentricity, in the paper's convention.
fn cpd(foveation: &dyn Foveation, setting: &Setting, e: f64) -> [f64; 2] {
    let place = Place::polar(setting.radius_px(e), 0.0);
    let rates = foveation.rates(place).unwrap();
    let cos = e.to_radians().cos();
    let half_scale = PI / 180.0 * setting.focal_px() / (cos * cos) / 2.0;
    [rates.radial * half_scale, rates.tangential * half_scale]
}

#[test]
fn kfr_is_the_printed_rate() {
    // The gaze is off centre: L is the distance to the lower left corner.
    let setting = setting(2560, 1440, 110.0, [1700.0, 500.0]);
    near(setting.focal_px(), 720.0 / 55f64.to_radians().tan(), 1e-12);
    let ln_l = f64::hypot(1700.0, 940.0).ln();
    for (sigma, alpha) in [(2.6, 4.0), (1.8, 4.0), (3.0, 2.5)] {
        let kfr = method("kfr", &[("sigma", number(sigma)), ("alpha", number(alpha))]);
        let kfr = kfr.apply(&setting).unwrap();
        let (w, h) = (2560.0 / sigma, 1440.0 / sigma);
        for e in [0.3, 5.0, 33.0, 60.0] {
            let (sin, cos) = f64::to_radians(e).sin_cos();
            let z = setting.radius_px(e).ln() / ln_l;
            let [radial, tangential] = cpd(kfr.as_ref(), &setting, e);
            let want = 0.5 * alpha * z.powf(alpha - 1.0) * w * PI / (180.0 * ln_l * sin * cos);
            near(radial, want, 1e-12);
            near(tangential, h / (720.0 * sin * cos), 1e-12);
            // θ = 90° is at a quarter of the rows.
            let place = Place::polar(setting.radius_px(e), 90.0);
            let [u, v] = kfr.mapping().unwrap().to_buffer(0, place);
            near(u, w * z.powf(alpha), 1e-12);
            near(v, h / 4.0, 1e-12);
        }
    }
}

/// Within a pixel r is set to 1 and θ is unchanged, except at the gaze itself; there is no rate
/// there.
#[test]
fn log_polar_methods_within_a_pixel() {
    let setting = centred(1440, 1600, 110.0);
    for name in ["kfr", "lafr"] {
        let foveation = Method::find(name).unwrap().apply(&setting).unwrap();
        for radius_px in [0.3, 0.7, 1.0] {
            let place = Place::polar(radius_px, 90.0);
            assert_eq!(foveation.rates(place), None, "{name} {radius_px}");
            let [u, v] = foveation.mapping().unwrap().to_buffer(0, place);
            let rows = foveation.mapping().unwrap().buffer(0)[1];
            assert!(
                u.abs() < 1e-12 && (v - rows / 4.0).abs() < 1e-9,
                "{name} {radius_px}: {u} {v}"
            );
        }
        assert!(foveation.rates(Place::polar(1.001, 0.0)).is_some(), "{name}");
        let [u, v] = foveation.mapping().unwrap().to_buffer(0, Place::at([0.0, 0.0]));
        assert!(u.abs() < 1e-12 && v.abs() < 1e-12, "{name}");
    }
}

#[test]
fn lafr_is_the_repaired_formula() {
    let setting = centred(1440, 1700, 110.0);
    let ln_l = f64::hypot(720.0, 850.0).ln();
    for (sigma, a, alpha, beta, foveal_deg) in
        [(1.8, 0.25, 0.85, 0.7, 4.89), (2.2, 0.3, 0.8, 0.9, 6.0), (8.0, 0.25, 0.78, 0.5, 4.0)]
    {
        let values = [sigma, a, alpha, beta, foveal_deg].map(number);
        let names = ["sigma", "a", "alpha", "beta", "foveal_deg"];
        let params: Vec<_> = names.into_iter().zip(values).collect();
        let lafr = method("lafr", &params).apply(&setting).unwrap();
        let z_at = |e: f64| setting.radius_px(e).ln() / ln_l;
        let big_z = z_at(foveal_deg);
        let f = 1.0 - (alpha * big_z.powf(1.0 - a) / (1.0 - a)).log(big_z);
        let u_f = (big_z * (1.0 - f)).powf(1.0 / f);
        for e in [0.5, 3.0, foveal_deg, 7.0, 20.0, 50.0, 60.0] {
            let z = z_at(e);
            let want = if e <= foveal_deg {
                ((1.0 - f) * z).powf(1.0 / f)
            } else {
                let q: f64 = (1.0 / z - 1.0 / big_z) / (1.0 / big_z - 1.0);
                ((2.0 * q.acos() - PI) / PI).powf(beta / 0.7) * (1.0 - u_f) + u_f
            };
            let place = Place::polar(setting.radius_px(e), 0.0);
            near(lafr.mapping().unwrap().to_buffer(0, place)[0], 1440.0 / sigma * want, 1e-9);
            let sin_cos = e.to_radians().sin() * e.to_radians().cos();
            near(cpd(lafr.as_ref(), &setting, e)[1], 1700.0 / sigma / (720.0 * sin_cos), 1e-12);
        }
    }
}

/// At the farthest corner Q is -1, where the arc cosine has no finite slope.
#[test]
fn lafr_ends_at_the_corner() {
    for width in (300..3000).step_by(37) {
        let setting = centred(width, 1440, 110.0);
        let lafr = Method::find("lafr").unwrap().apply(&setting).unwrap();
        let corner = Place { radius_px: setting.corner_px(), direction: [1.0, 0.0] };
        let mapping = lafr.mapping().unwrap();
        near(mapping.to_buffer(0, corner)[0], width as f64 / 1.8, 1e-6);
        // A distance that rounding puts beyond the corner does not leave the buffer either.
        let over = Place { radius_px: corner.radius_px * (1.0 + 1e-9), ..corner };
        near(mapping.to_buffer(0, over)[0], width as f64 / 1.8, 1e-6);
        assert!(lafr.rates(corner).is_none_or(|rates| rates.radial.is_finite()), "{width}");
    }
}

#[test]
fn lafr_states_the_range_of_alpha() {
    let setting = centred(1440, 1600, 110.0);
    let with = |name, value| method("lafr", &[(name, number(value))]).apply(&setting);
    let error = with("foveal_deg", 0.05).unwrap_err().to_string();
    assert!(error.contains("(1 px)"), "{error}");
    let error = with("alpha", 50.0).unwrap_err().to_string();
    let range = error.split("alpha must be between ").nth(1).unwrap();
    let ends: Vec<f64> = range.split(' ').filter_map(|word| word.parse().ok()).collect();
    assert_eq!(ends.len(), 2, "{error}");
    // Near the lower limit U_f is below the smallest float.
    for alpha in [ends[0] - 2e-4, ends[1] + 2e-4] {
        assert!(with("alpha", alpha).is_err(), "{alpha}");
    }
    for alpha in [ends[0] + 5e-3, ends[1] - 2e-4] {
        assert!(with("alpha", alpha).is_ok(), "{alpha}");
    }
}

#[test]
fn rmfr_is_its_density_per_axis() {
    let setting = setting(1440, 1600, 110.0, [300.0, 1000.0]);
    let rmfr = method("rmfr", &[("fx", number(0.3)), ("fy", number(0.5)), ("sigma", number(2.0))]);
    let rmfr = rmfr.apply(&setting).unwrap();
    let (fx, fy) = (0.3 * 1440.0, 0.5 * 1600.0);
    let rate = |f: f64, a: f64, t: f64| f * (f + a) / (2.0 * (t.abs() + f).powi(2));
    for (x, y, ax, ay) in [
        (200.0, 300.0, 1140.0, 600.0),
        (-200.0, 300.0, 300.0, 600.0),
        (-100.0, -700.0, 300.0, 1000.0),
        (900.0, -50.0, 1140.0, 1000.0),
        // On an axis and at the gaze, 0 counts as positive.
        (500.0, 0.0, 1140.0, 600.0),
        (0.0, -500.0, 1140.0, 1000.0),
        (0.0, 0.0, 1140.0, 600.0),
    ] {
        let place = Place::at([x, y]);
        let (jx, jy) = (rate(fx, ax, x), rate(fy, ay, y));
        near(rmfr.density(place), jx * jy, 1e-12);
        let rates = rmfr.rates(place).unwrap();
        let [dx, dy] = place.direction;
        near(rates.radial, (jx * dx).hypot(jy * dy), 1e-12);
        near(rates.tangential, (jx * dy).hypot(jy * dx), 1e-12);
        let want = [300.0, 1000.0];
        let buffer = rmfr.mapping().unwrap().to_buffer(0, place);
        let at =
            |gaze: f64, t: f64, f: f64, a: f64| f64::midpoint(gaze, t * (f + a) / (t.abs() + f));
        near(buffer[0], at(want[0], x, fx, ax), 1e-12);
        near(buffer[1], at(want[1], y, fy, ay), 1e-12);
    }
    // At the gaze, looking to the left and up, the sides in these directions apply.
    let rates = rmfr.rates(Place::polar(0.0, 180.0)).unwrap();
    near(rates.radial, rate(fx, 300.0, 0.0), 1e-12);
    let rates = rmfr.rates(Place::polar(0.0, 270.0)).unwrap();
    near(rates.radial, rate(fy, 1000.0, 0.0), 1e-12);
    near(rmfr::half_axis(3.0, -0.5), -3.0 * 0.5 / 2.5, 1e-12);
}

#[test]
fn deamp_is_an_rmfr_in_each_layer() {
    // 90° vertical: half sizes are 800 and 720, times tan e / tan 45°.
    let setting = setting(1440, 1600, 90.0, [500.0, 700.0]);
    let deamp = method("deamp", &[("fx", number(0.3)), ("fy", number(0.45))]);
    let deamp = deamp.apply(&setting).unwrap();
    let (fx, fy) = (0.3 * 1440.0, 0.45 * 1600.0);
    let [t10, t22] = [10.0, 22.5].map(|e: f64| e.to_radians().tan());
    let rate = |f: f64, a: f64, t: f64, sigma: f64| f * (f + a) / (sigma * (t + f).powi(2));
    for (x, y, sigma) in [
        (719.0 * t10, 799.0 * t10, 2.51),
        (721.0 * t10, 0.0, 3.6),
        (0.0, 801.0 * t10, 3.6),
        (719.0 * t22, 799.0 * t22, 3.6),
        (721.0 * t22, 10.0, 4.8),
        (10.0, 801.0 * t22, 4.8),
    ] {
        let (jx, jy) = (rate(fx, 940.0, x, sigma), rate(fy, 900.0, y, sigma));
        near(deamp.density(Place::at([x, y])), jx * jy, 1e-12);
        let (jx, jy) = (rate(fx, 500.0, x, sigma), rate(fy, 700.0, y, sigma));
        if x > 0.0 && y > 0.0 {
            near(deamp.density(Place::at([-x, -y])), jx * jy, 1e-12);
        }
    }
}

#[test]
fn guenter_layers_are_discs_with_their_scales() {
    let setting = centred(2000, 1500, 100.0);
    let list = |l: &[f64]| ParamValue::List(l.to_vec());
    let params = [("bounds_deg", list(&[8.0, 30.0])), ("scales", list(&[0.5, 3.0, 7.0]))];
    let guenter = method("guenter", &params).apply(&setting).unwrap();
    for (e, scale) in [(0.0, 0.5), (7.9, 0.5), (8.1, 3.0), (29.9, 3.0), (30.1, 7.0), (50.0, 7.0)] {
        for direction_deg in [0.0, 45.0, 200.0] {
            let place = Place::polar(setting.radius_px(e), direction_deg);
            let rates = guenter.rates(place).unwrap();
            near(rates.radial * scale, 1.0, 1e-12);
            near(rates.tangential * scale, 1.0, 1e-12);
        }
    }
}

#[test]
fn the_linear_fall_off_is_a_probability() {
    let setting = centred(1440, 1600, 110.0);
    let linear = Method::find("linear").unwrap().apply(&setting).unwrap();
    for (e, p) in [
        (0.0, 1.0),
        (9.0, 1.0),
        (12.5, 0.76175),
        (15.0, 1.0 - 0.953 / 2.0),
        (20.0, 0.047),
        (50.0, 0.047),
    ] {
        let place = Place::polar(setting.radius_px(e), 30.0);
        near(linear.density(place), p, 1e-12);
        let rates = linear.rates(place).unwrap();
        near(rates.radial, p.sqrt(), 1e-12);
        near(rates.tangential, p.sqrt(), 1e-12);
    }
}

fn vafr(params: &[(&str, ParamValue)]) -> Box<dyn Foveation> {
    method("vafr", params).apply(&centred(2560, 1440, 110.0)).unwrap()
}

#[test]
fn vafr_follows_any_acuity_and_ratio() {
    let setting = centred(2560, 1440, 110.0);
    let guenter = |e: f64| 1.0 / (0.0275 * e + 1.0 / 48.0);
    let geisler = |e: f64| 2.3 * 64f64.ln() / (0.106 * (e + 2.3));
    let pairs = ParamValue::Pairs(vec![[5.0, 0.8], [30.0, 0.3]]);
    for e in [0.0, 2.0, 17.5, 50.0, 64.0] {
        let [radial, tangential] =
            cpd(vafr(&[("acuity", word("linear_mar"))]).as_ref(), &setting, e);
        near(radial, guenter(e), 1e-12);
        near(tangential, guenter(e), 1e-12);
        let params = [("acuity", word("linear_mar")), ("cap_cpd", number(9.0))];
        near(cpd(vafr(&params).as_ref(), &setting, e)[0], guenter(e).min(9.0), 1e-12);
        let params = [("acuity", word("geisler_perry")), ("factor", number(0.5))];
        near(cpd(vafr(&params).as_ref(), &setting, e)[0], 0.5 * geisler(e), 1e-12);
        // The ratio is linear between the knots and constant outside.
        let ratio = (0.8 - 0.5 * (e - 5.0) / 25.0).clamp(0.3, 0.8);
        let [radial, tangential] = cpd(vafr(&[("ratio", pairs.clone())]).as_ref(), &setting, e);
        near(tangential / radial, ratio, 1e-12);
        // Isotropic in visual angle means f / cos e in the paper's convention.
        let [radial, tangential] = cpd(vafr(&[("columns", word("angle"))]).as_ref(), &setting, e);
        near(tangential * e.to_radians().cos(), radial, 1e-12);
    }
}

/// Rows of a column, and the number of samples by Simpson's rule with steps that include every
/// knot.
#[test]
fn vafr_counts_columns_times_rows() {
    let setting = centred(2560, 1440, 140.0);
    let corner = setting.eccentricity_deg(f64::hypot(1280.0, 720.0));
    let f = |e: f64| {
        let knots = [(0.0, 40.0), (10.0, 10.0), (20.0, 6.0), (30.0, 5.0), (60.0, 4.0)];
        let i = knots.iter().position(|knot| knot.0 > e).unwrap_or(4).min(4);
        let ((e0, f0), (e1, f1)) = (knots[i - 1], knots[i]);
        1.0 / (1.0 / f0 + (1.0 / f1 - 1.0 / f0) * (e - e0) / (e1 - e0))
    };
    let ratio = |e: f64| (0.8 - 0.5 * (e - 5.0) / 25.0).clamp(0.3, 0.8);
    let rows = |e: f64| 360.0 * (2.0 * e).to_radians().sin() * f(e) * ratio(e);
    let pairs = ParamValue::Pairs(vec![[5.0, 0.8], [30.0, 0.3]]);
    let share = ("reprojected_share", number(0.5));
    let simpson = |from: f64, to: f64| {
        let steps = 4000;
        let step = (to - from) / f64::from(steps);
        (0..=steps)
            .map(|i| {
                let weight = if i == 0 || i == steps { 1 } else { 2 + 2 * (i % 2) };
                // At a knot acuity has the same value from both sides.
                let e = from + f64::from(i) * step;
                f64::from(weight) * rows(e) * 2.0 * f(e) * step / 3.0
            })
            .sum::<f64>()
    };
    let all = method("vafr", &[("ratio", pairs.clone())]).apply(&setting).unwrap().counts();
    let inside: f64 =
        [0.0, 5.0, 10.0, 20.0, 30.0, 60.0].windows(2).map(|e| simpson(e[0], e[1])).sum();
    near(all.samples, inside, 1e-9);
    near(all.samples_beyond, simpson(60.0, corner), 1e-9);
    // The longest column is found by trying all steps.
    let found = Vafr::new(
        &vafr::Params { ratio: vec![[5.0, 0.8], [30.0, 0.3]], ..vafr::Params::default() },
        &setting,
    )
    .unwrap()
    .longest_column(60.0);
    let walked = (0..=60_000).map(|i| f64::from(i) * 1e-3).map(|e| (e, rows(e)));
    let longest = walked.fold((0.0, 0.0), |best, at| if at.1 > best.1 { at } else { best });
    assert!((found.0 - longest.0).abs() < 2e-3 && (found.1 - longest.1).abs() < 1e-3, "{found:?}");
    near(all.buffers[0][1], longest.1, 1e-6);

    // After reprojection, (1 + s) / 2 of every number of samples is left to shade.
    let rep = method("vafr", &[("ratio", pairs), share]).apply(&setting).unwrap().counts();
    for (rep, all) in [
        (rep.samples, all.samples),
        (rep.samples_on_screen, all.samples_on_screen),
        (rep.samples_beyond, all.samples_beyond),
        (rep.samples_seen, all.samples_seen),
    ] {
        near(rep, 0.75 * all, 1e-12);
    }
    near(all.samples_seen, all.samples_on_screen, 1e-12);
    assert_eq!(vafr(&[]).note(), None);
}

#[test]
fn vafr_beyond_its_field() {
    let wide = centred(2560, 1440, 140.0);
    let far = Place::polar(wide.radius_px(65.0), 77.0);
    for beyond in ["clamp", "black"] {
        let vafr = method("vafr", &[("beyond", word(beyond))]).apply(&wide).unwrap();
        assert_eq!(vafr.rates(far), None, "{beyond}");
        let (mapping, end) = (vafr.mapping().unwrap(), Place::polar(wide.radius_px(60.0), 77.0));
        let [found, want] = [far, end].map(|place| mapping.to_buffer(0, place));
        near(found[0], want[0], 1e-12);
        near(found[1], want[1], 1e-12);
        assert_eq!(mapping.buffer(0), vafr.counts().buffers[0]);
    }
    let vafr = Method::find("vafr").unwrap();
    let extended = vafr.apply(&wide).unwrap();
    assert!(extended.rates(far).is_some());
    // The buffer continues to the corner; the paper's count does not.
    let [columns, _] = extended.mapping().unwrap().buffer(0);
    let [counted, _] = extended.counts().buffers[0];
    assert!(columns > counted + 50.0, "{columns} {counted}");
    near(counted, 900.1, 1e-4);
    // If columns grow up to the very corner, the longest one is there.
    let flat = ParamValue::List(vec![40.0, 10.0, 6.0, 5.0, 5.0]);
    let params = [("columns", word("angle")), ("knots_cpd", flat)];
    let growing = method("vafr", &params).apply(&wide).unwrap();
    let sin = |e: f64| e.to_radians().sin();
    let corner = wide.eccentricity_deg(wide.corner_px());
    near(growing.mapping().unwrap().buffer(0)[1], 720.0 * sin(corner) * 5.0, 1e-9);
    near(growing.counts().buffers[0][1], 720.0 * sin(60.0) * 5.0, 1e-9);
    // A frame inside the field has the paper's buffer nevertheless, and nothing beyond it.
    let narrow = vafr.apply(&centred(640, 480, 40.0)).unwrap();
    assert_eq!(narrow.mapping().unwrap().buffer(0), narrow.counts().buffers[0]);
    near(narrow.counts().buffers[0][0], 900.1, 1e-4);
    assert!(narrow.counts().samples_beyond == 0.0);
}

#[test]
fn visual_polar_is_as_dense_as_its_acuity() {
    let v = |e: f64| if e <= 5.79 { 1.0 } else { 7.49 / (0.3 * e + 1.0).powi(2) };
    let setting = setting(1000, 800, 100.0, [300.0, 500.0]);
    let polar = VisualPolar::new(&crate::visual_polar::Params::default(), &setting);
    let mut sum = 0.0;
    for y in 0..800 {
        for x in 0..1000 {
            let r = f64::hypot(f64::from(x) + 0.5 - 300.0, f64::from(y) + 0.5 - 500.0);
            sum += v((r / setting.focal_px()).atan().to_degrees());
        }
    }
    let c = 0.4 * 800_000.0 / sum;
    for e in [0.0, 3.0, 5.7, 5.8, 10.0, 40.0] {
        let r = setting.radius_px(e);
        let place = Place::polar(r, 10.0);
        near(polar.density(place), c * v(e), 1e-4);
        let rates = polar.rates(place).unwrap();
        near(rates.radial * rates.tangential, polar.density(place), 1e-12);
        // Inside, both rates are equal; outside, there are as many samples around as at the border.
        let around = setting.radius_px(5.79) * polar.density(Place::at([0.0, 0.0])).sqrt();
        if e < 5.79 {
            near(rates.radial, rates.tangential, 1e-12);
        } else {
            near(rates.tangential * r, around, 1e-12);
        }
    }
    // All samples: the integral of the density over the disc up to the farthest corner.
    let (inner, corner) = (setting.radius_px(5.79), f64::hypot(700.0, 500.0));
    let steps = 20_000;
    let step = (corner - inner) / f64::from(steps);
    let ring = |r: f64| 2.0 * PI * r * v((r / setting.focal_px()).atan().to_degrees());
    let outside: f64 = (0..steps).map(|i| ring(inner + (f64::from(i) + 0.5) * step) * step).sum();
    near(polar.counts().samples, c * (PI * inner * inner + outside), 1e-4);
    let exact = polar.density(Place::at([0.0, 0.0])) * (PI * inner * inner + outside);
    near(polar.counts().samples, exact, 1e-8);

    // A frame inside 5.79°: the density is 0.4 everywhere, and rows only become shorter.
    let small = centred(300, 400, 8.0);
    let polar = Method::find("visual-polar").unwrap().apply(&small).unwrap();
    let counts = polar.counts();
    near(counts.samples, 0.4 * PI * 250.0 * 250.0, 1e-12);
    near(counts.buffers[0][0], 250.0 * 0.4f64.sqrt(), 1e-12);
    near(counts.buffers[0][1], 2.0 * PI * 250.0 * 0.4f64.sqrt(), 1e-12);
}

#[test]
fn how_far_curves_reach() {
    let setting = centred(1440, 1600, 110.0);
    for method in Method::all() {
        let reach = match method.key() {
            "kfr" | "lafr" => Reach::Corner,
            "rmfr" | "deamp" => Reach::Border,
            _ => Reach::Any,
        };
        assert_eq!(method.apply(&setting).unwrap().reach(), reach, "{}", method.key());
    }
}

#[test]
fn notes_are_only_given_where_they_apply() {
    let setting = centred(1440, 1600, 90.0);
    let note = |method: &Method| method.apply(&setting).unwrap().note();
    for name in ["full", "vafr", "kfr", "lafr", "rmfr", "guenter", "linear", "cps"] {
        assert_eq!(note(&Method::find(name).unwrap()), None, "{name}");
    }
    assert!(note(&method("guenter", &[("fit", word("optimised"))])).is_some());
    // 90° vertical and less horizontal: 10° is 10° only vertically.
    let said = note(&Method::find("deamp").unwrap()).unwrap();
    assert!(said.contains("10° is 9.02° x 10.00°"), "{said}");
    let square = centred(1600, 1600, 90.2);
    let said = Method::find("deamp").unwrap().apply(&square).unwrap().note().unwrap();
    assert!(said.contains("45° is 45.10° x 45.10°"), "{said}");
}
