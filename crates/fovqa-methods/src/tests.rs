//! Properties that every method has, and the counts of the papers.

mod bounds;
mod counting;
mod formulas;
mod geometry;

use fovqa_params::ParamValue;
use fovqa_vision::{View, ViewSpec};
use proptest::prelude::*;

use crate::deamp::Deamp;
use crate::guenter::Guenter;
use crate::vafr::Vafr;
use crate::{
    BudgetError, BudgetSamples, Foveation, Mapping, Method, Place, Rates, Setting, deamp, guenter,
    rmfr, vafr,
};

fn view(width: usize, height: usize, fov_vertical_deg: f64) -> View {
    let spec = ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(fov_vertical_deg) };
    spec.resolve(width, height).unwrap().view
}

fn setting(width: usize, height: usize, fov_vertical_deg: f64, gaze: [f64; 2]) -> Setting {
    Setting::new(&view(width, height, fov_vertical_deg), gaze).unwrap()
}

fn centred(width: usize, height: usize, fov_vertical_deg: f64) -> Setting {
    setting(width, height, fov_vertical_deg, [width as f64 / 2.0, height as f64 / 2.0])
}

/// A method with parameters that are set by name.
fn method(name: &str, params: &[(&str, ParamValue)]) -> Method {
    let mut method = Method::find(name).unwrap();
    for (param, value) in params {
        method.set(param, value).unwrap();
    }
    method
}

fn number(n: f64) -> ParamValue {
    ParamValue::Number(n)
}

/// Every method that has a mapping, and variants whose mappings have other branches.
fn mapped() -> Vec<Method> {
    let ratio = ParamValue::Pairs(vec![[5.0, 1.0], [30.0, 0.5]]);
    let angle = ParamValue::Text("angle".into());
    let flat = ParamValue::List(vec![40.0, 10.0, 6.0, 5.0, 5.0]);
    let mut methods: Vec<Method> = Method::all().to_vec();
    methods.extend([
        method("kfr", &[("sigma", number(1.8))]),
        method("lafr", &[("sigma", number(8.0)), ("alpha", number(0.78)), ("beta", number(0.9))]),
        method("rmfr", &[("fx", number(0.1)), ("fy", number(2.0))]),
        method("vafr", &[("columns", angle), ("ratio", ratio)]),
        method("vafr", &[("knots_cpd", flat), ("cap_cpd", number(9.0)), ("factor", number(0.5))]),
        method("deamp", &[("projection", ParamValue::Text("linear".into()))]),
        method("guenter", &[("fit", ParamValue::Text("optimised".into()))]),
    ]);
    methods
}

/// Rates computed from the mapping itself, by central differences.
fn numerical(mapping: &dyn Mapping, layer: usize, place: Place) -> Rates {
    let h = place.radius_px * 1e-4;
    let [x, y] = place.offset_px();
    let [dx, dy] = place.direction;
    let buffer = |along: f64, across: f64| {
        mapping.to_buffer(
            layer,
            Place::at([x + along * dx - across * dy, y + along * dy + across * dx]),
        )
    };
    // The differences are of fourth order, so that steps can be large compared with rounding
    // errors.
    let slope = |at: &dyn Fn(f64) -> [f64; 2]| -> [f64; 2] {
        let [a, b, c, d] = [at(-2.0 * h), at(-h), at(h), at(2.0 * h)];
        [0, 1].map(|i| (a[i] - 8.0 * b[i] + 8.0 * c[i] - d[i]) / (12.0 * h))
    };
    let along = slope(&|s| buffer(s, 0.0));
    let across = slope(&|s| buffer(0.0, s));
    if mapping.is_polar() {
        Rates { radial: along[0].abs(), tangential: across[1].abs() }
    } else {
        let norm = |v: [f64; 2]| libm::hypot(v[0], v[1]);
        Rates { radial: norm(along), tangential: norm(across) }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn mappings_turn_back_and_rates_are_their_slopes(
        which in 0..mapped().len(),
        point in (0.0..1.0f64, 0.0..1.0f64),
        gaze in (0.0..1.0f64, 0.0..1.0f64),
        (width, height) in (8..3000usize, 8..2000usize),
        fov in 40.0..140.0f64,
    ) {
        let (w, h) = (width as f64, height as f64);
        let gaze_px = [gaze.0 * w, gaze.1 * h];
        let setting = setting(width, height, fov, gaze_px);
        // A method that does not fit a small frame is refused.
        let Ok(foveation) = mapped()[which].apply(&setting) else { return Ok(()) };
        let Some(mapping) = foveation.mapping() else { return Ok(()) };
        let place = Place::at([point.0 * w - gaze_px[0], point.1 * h - gaze_px[1]]);
        prop_assume!(place.radius_px > 1.01);
        let layer = mapping.layer_at(place);
        let buffer = mapping.to_buffer(layer, place);
        let back = mapping.to_screen(layer, buffer);
        let off = [0, 1].map(|i| (back.offset_px()[i] - place.offset_px()[i]).abs());
        prop_assert!(off[0] <= 1e-6 && off[1] <= 1e-6, "{off:?} at {place:?}");
        let [bw, bh] = mapping.buffer(layer);
        prop_assert!(buffer[0] >= -1e-6 && buffer[0] <= bw * (1.0 + 1e-9) + 1e-6);
        prop_assert!(buffer[1] >= -1e-6 && buffer[1] <= bh * (1.0 + 1e-9) + 1e-6);

        // Places near borders, the seam at θ = 0 and the bounds of pieces are left out, because the
        // slopes on both sides differ there.
        let near = |factor: f64| {
            let moved = Place { radius_px: place.radius_px * factor, ..place };
            foveation.rates(moved)
        };
        let (Some(rates), Some(inner), Some(outer)) = (near(1.0), near(0.999), near(1.001)) else {
            return Ok(());
        };
        let smooth = (inner.radial / outer.radial - 1.0).abs() < 0.02;
        let seam = place.direction[0] > 0.0 && place.direction[1].abs() < 0.01;
        let axis = place.direction.iter().any(|d| d.abs() < 0.01);
        let inside = place.radius_px * 1.01 < setting.edge_px(place.direction);
        prop_assume!(smooth && !seam && !axis && inside);
        // Places with a knot of acuity within the steps are left out as well, because the rate
        // itself bends there.
        let (Some(before), Some(behind)) = (near(1.0 - 3e-4), near(1.0 + 3e-4)) else {
            return Ok(());
        };
        let bend = (before.radial + behind.radial) / (2.0 * rates.radial) - 1.0;
        prop_assume!(bend.abs() < 5e-6);
        let found = numerical(mapping, layer, place);
        for (found, rate) in
            [(found.radial, rates.radial), (found.tangential, rates.tangential)]
        {
            prop_assert!((found / rate - 1.0).abs() < 1e-6, "{found} for {rate} at {place:?}");
        }
    }

}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    /// The sums of densities over a grid equal the counts.
    #[test]
    fn counts_are_the_integral_of_the_density(
        which in 0..Method::all().len(), gaze in (0.0..1.0f64, 0.0..1.0f64),
        fov in 60.0..120.0f64,
    ) {
        const SIDE: usize = 400;
        let side = SIDE as f64;
        let setting = setting(SIDE, SIDE, fov, [gaze.0 * side, gaze.1 * side]);
        let Ok(foveation) = Method::all()[which].apply(&setting) else { return Ok(()) };
        let [gx, gy] = setting.gaze_px();
        let mut sum = 0.0;
        for y in 0..2 * SIDE {
            for x in 0..2 * SIDE {
                let centre = [x, y].map(|i| 0.5 * (i as f64 + 0.5));
                sum += foveation.density(Place::at([centre[0] - gx, centre[1] - gy])) / 4.0;
            }
        }
        let seen = foveation.counts().samples_seen;
        prop_assert!((sum / seen - 1.0).abs() < 0.02, "{} : {sum} for {seen}", Method::all()[which].key());
    }
}

fn vafr_over(knots_cpd: [f64; 5], cap: Option<f64>, columns: vafr::Columns) -> Vafr {
    let mut params = vafr::Params { columns, ..vafr::Params::default() };
    params.piecewise.knots_cpd = knots_cpd.to_vec();
    params.piecewise.cap_cpd = cap;
    Vafr::new(&params, &centred(2560, 1440, 110.0)).unwrap()
}

const FALLING: [f64; 5] = [40.0, 10.0, 6.0, 5.0, 4.0];
const FLAT: [f64; 5] = [40.0, 10.0, 6.0, 5.0, 5.0];

/// VaFR: 1,061,735 samples; 932 x 1800, the longest column at 45°; 1,267,241 samples isotropic in
/// angle.
#[test]
fn vafr_has_the_papers_counts() {
    let falling = vafr_over(FALLING, None, vafr::Columns::Paper);
    assert!((falling.counts().samples - 1_061_733.7).abs() < 0.5, "{}", falling.counts().samples);
    let [width, rows] = falling.counts().buffers[0];
    assert!((width - 900.1).abs() < 0.05 && (rows - 1637.9).abs() < 0.05, "{width} {rows}");
    assert!((falling.longest_column(60.0).0 - 38.7).abs() < 0.05);
    let flat = vafr_over(FLAT, None, vafr::Columns::Paper);
    let [width, rows] = flat.counts().buffers[0];
    assert!((width - 932.3).abs() < 0.05 && (rows - 1800.0).abs() < 1e-9, "{width} {rows}");
    assert!((flat.longest_column(60.0).0 - 45.0).abs() < 1e-6);
    let angle = vafr_over(FALLING, None, vafr::Columns::Angle);
    assert!((angle.counts().samples - 1_267_241.0).abs() < 1.0, "{}", angle.counts().samples);
    // The cap by a device saves 17.5 and 4.1 % of the samples at 9 and 18 cpd.
    for (cap, saved) in [(9.0, 0.175), (18.0, 0.041)] {
        let capped = vafr_over(FALLING, Some(cap), vafr::Columns::Paper).counts().samples;
        assert!((1.0 - capped / falling.counts().samples - saved).abs() < 5e-4);
    }
}

/// A frame of 110° at 16:9 has 40 % of its pixels beyond 60°.
#[test]
fn vafr_continues_beyond_its_field() {
    let setting = centred(2560, 1440, 110.0);
    let extended = vafr_over(FALLING, None, vafr::Columns::Paper).counts();
    let corner = setting.eccentricity_deg(setting.corner_px());
    let steps = 100_000;
    let step = (corner - 60.0) / f64::from(steps);
    let rows = |e: f64| 360.0 * (2.0 * e).to_radians().sin() / (0.05 * (e - 30.0) / 30.0 + 0.2);
    let sum: f64 = (0..steps)
        .map(|i| 60.0 + (f64::from(i) + 0.5) * step)
        .map(|e| rows(e) * 2.0 / (0.05 * (e - 30.0) / 30.0 + 0.2) * step)
        .sum();
    assert!((extended.samples_beyond / sum - 1.0).abs() < 1e-9, "{sum}");
    let params = vafr::Params { beyond: vafr::Beyond::Clamp, ..vafr::Params::default() };
    let clamped = Vafr::new(&params, &setting).unwrap();
    let counts = clamped.counts();
    assert!(counts.samples_beyond == 0.0 && counts.samples_on_screen < extended.samples_on_screen);
    let inside = setting.integrate(&[0.0, setting.radius_px(60.0)], |r| {
        f64::from(setting.eccentricity_deg(r) <= 60.0)
    });
    assert!((1.0 - inside / setting.pixels() - 0.40).abs() < 0.01, "{}", inside / setting.pixels());
    assert!(clamped.rates(Place::at([setting.radius_px(61.0), 0.0])).is_none());
    let rep = vafr::Params { reprojected_share: Some(0.2), ..vafr::Params::default() };
    let shared = Vafr::new(&rep, &setting).unwrap();
    assert!((shared.counts().samples / extended.samples - 0.6).abs() < 1e-12);
    assert!(shared.note().is_some());
}

#[test]
fn samples_of_the_rectangular_mappings() {
    let square = centred(1600, 1600, 90.0);
    let share = |method: &Method| method.apply(&square).unwrap().counts().samples / square.pixels();
    assert!((share(&Method::find("rmfr").unwrap()) - 0.147_929).abs() < 1e-6);
    // With equal σ the sum telescopes to σ².
    let equal = ParamValue::List(vec![2.6, 2.6, 2.6]);
    assert!((share(&method("deamp", &[("sigmas", equal)])) - 0.147_929).abs() < 1e-6);
    let deamp = |projection| {
        let params = deamp::Params {
            sigmas: vec![2.51, 4.8],
            bounds_deg: vec![22.5, 45.0],
            projection,
            ..deamp::Params::default()
        };
        Deamp::new(&params, &square).unwrap()
    };
    assert!((deamp(deamp::Projection::Tan).outer_share() - 0.828).abs() < 5e-4);
    assert!((deamp(deamp::Projection::Linear).outer_share() - 0.75).abs() < 1e-12);
    assert!(deamp(deamp::Projection::Tan).note().is_none(), "the paper's own frame");
    let wide = Method::find("deamp").unwrap().apply(&centred(1440, 1600, 110.0)).unwrap();
    assert!(wide.note().unwrap().contains("45° is 52.12° x 55.00°"), "{:?}", wide.note());
}

/// RMFR, Fig. 11: the mean densities of a frame of 1440x1600 at 110°.
#[test]
fn mean_densities_of_the_comparison() {
    let setting = centred(1440, 1600, 110.0);
    let mean = |name: &str| {
        let counts = Method::find(name).unwrap().apply(&setting).unwrap().counts();
        counts.samples_seen / setting.pixels()
    };
    assert!((mean("guenter") - 0.030).abs() < 5e-4);
    assert!((mean("linear") - 0.078).abs() < 5e-4);
    let guenter = Guenter::new(&guenter::Params::default(), &setting).unwrap();
    assert!((guenter.samples_in_discs() / setting.pixels() - 0.034).abs() < 5e-4);
    // Clipped squares of side 2r, including covered samples.
    let [r1, r2] = [10.0, 20.0].map(|e| setting.radius_px(e));
    let squares = 4.0 * r1 * r1 + r2 * r2 + setting.pixels() / (12.35 * 12.35);
    assert!((guenter.counts().samples / squares - 1.0).abs() < 1e-12);
}

#[test]
fn guenter_optimises_on_its_grid() {
    let setting = centred(5760, 3240, 110.0);
    let params = guenter::Params { fit: guenter::Fit::Optimised, ..guenter::Params::default() };
    let best = Guenter::new(&params, &setting).unwrap();
    let [e1, e2] = best.bounds_deg();
    let shown = (2.0 / setting.focal_px()).atan().to_degrees();
    let scale = |e: f64| ((0.0275 * e + 1.0 / 48.0) / shown).max(1.0);
    assert!((best.scales()[1] / scale(e1) - 1.0).abs() < 1e-12);
    assert!((best.scales()[2] / scale(e2) - 1.0).abs() < 1e-12);
    let samples = |e1: f64, e2: f64| {
        let params = guenter::Params {
            bounds_deg: vec![e1, e2],
            scales: vec![1.0, scale(e1), scale(e2)],
            ..guenter::Params::default()
        };
        Guenter::new(&params, &setting).unwrap().counts().samples
    };
    for (de1, de2) in [(0.25, 0.0), (-0.25, 0.0), (0.0, 0.25), (0.0, -0.25), (0.25, 0.25)] {
        assert!(samples(e1, e2) <= samples(e1 + de1, e2 + de2), "{e1} {e2}: {de1} {de2}");
    }
    assert!(best.note().unwrap().contains(&format!("{e1}°")));
}

#[test]
fn kfr_off_centre_shades_samples_outside_the_frame() {
    let kfr = Method::find("kfr").unwrap();
    let centre = kfr.apply(&centred(1440, 1600, 110.0)).unwrap().counts();
    let corner = kfr.apply(&setting(1440, 1600, 110.0, [0.0, 0.0])).unwrap().counts();
    assert!(centre.samples_on_screen < centre.samples);
    assert!((corner.samples - centre.samples).abs() < 1e-6);
    // A quarter of the angles, minus the part beyond the border.
    assert!(
        corner.samples_on_screen < 0.25 * corner.samples
            && corner.samples_on_screen > 0.2 * corner.samples
    );
}

#[test]
fn coarse_pixels_have_the_normalised_rate_of_the_filter() {
    let cps = crate::cps::Cps::new(&crate::cps::Params::default(), &centred(1184, 1464, 110.0));
    for (e, request, s) in
        [(0.0, 1.0, 0.0), (15.0, 1.0, 0.0), (25.0, 0.625, 0.5), (50.0, 0.25, 1.0)]
    {
        assert!((cps.request(e) - request).abs() < 1e-12);
        assert!((cps.normalised(e) - s).abs() < 1e-12);
    }
    let rate = |quantise: &str, e: f64| {
        let setting = centred(1184, 1464, 110.0);
        let cps = method("cps", &[("quantise", ParamValue::Text(quantise.into()))]);
        let rates = cps.apply(&setting).unwrap().rates(Place::at([setting.radius_px(e), 0.0]));
        rates.unwrap().radial
    };
    // The requests are 0.8125, 0.7, 0.4, 0.3 at 20°, 23°, 31°, 33 2/3°.
    for (e, ceil, nearest) in
        [(20.0, 1.0, 1.0), (23.0, 1.0, 0.5), (31.0, 0.5, 0.5), (33.5, 0.5, 0.25)]
    {
        assert_eq!(
            [rate("ceil", e), rate("nearest", e)].map(f64::to_bits),
            [ceil, nearest].map(f64::to_bits),
            "{e}"
        );
        let continuous = 1.0 - 0.75 * (e - 15.0) / 20.0;
        assert!((rate("continuous", e) - continuous).abs() < 1e-12);
    }
}

#[test]
fn visual_polar_keeps_its_budget() {
    let setting = centred(1440, 1600, 110.0);
    let polar = Method::find("visual_polar").unwrap().apply(&setting).unwrap();
    let counts = polar.counts();
    assert!((counts.samples_on_screen / setting.pixels() - 0.4).abs() < 1e-12);
    assert!(counts.samples > counts.samples_on_screen);
    let rates = polar.rates(Place::at([1.0, 0.0])).unwrap();
    assert!(rates.radial > 1.0, "the gaze is supersampled");
    assert!(polar.note().unwrap().contains("reconstruction"));
}

#[test]
fn the_papers_figure_of_a_half_axis() {
    for (d, want) in [(0.0, 0.0), (1.0, 2.0), (-1.0, -2.0), (0.5, 2.0 / 3.0)] {
        assert!((rmfr::half_axis(2.0, d) - want).abs() < 1e-12);
    }
}

#[test]
fn a_budget_is_met_or_the_error_states_its_range() {
    let setting = centred(1440, 1600, 110.0);
    for method in Method::all() {
        for of in [BudgetSamples::Buffer, BudgetSamples::OnScreen] {
            let found = match method.at_budget(&setting, 0.12, of) {
                Err(BudgetError::NotFree { method }) => {
                    assert_eq!(method, "full");
                    continue;
                }
                found => found.unwrap().method,
            };
            let counts = found.apply(&setting).unwrap().counts();
            let samples = match of {
                BudgetSamples::Buffer => counts.samples + counts.samples_beyond,
                BudgetSamples::OnScreen => counts.samples_on_screen,
            };
            // The rates of CPS have steps, but its radii are continuous.
            let share = samples / setting.pixels();
            assert!((share / 0.12 - 1.0).abs() < 1e-9, "{}: {share}", method.key());
        }
    }
    let error = Method::find("guenter").unwrap().at_budget(&setting, 0.9, BudgetSamples::Buffer);
    let error = error.unwrap_err().to_string();
    assert!(error.contains("allows 0.03") && error.contains("the outermost of scales"), "{error}");
    assert!(method("rmfr", &[]).at_budget(&setting, f64::NAN, BudgetSamples::Buffer).is_err());
}

/// At the gaze θ is 0, whatever the direction of the curve.
#[test]
fn the_gaze_itself_has_no_angle() {
    let kfr = Method::find("kfr").unwrap().apply(&centred(1440, 1600, 110.0)).unwrap();
    let [u, v] = kfr.mapping().unwrap().to_buffer(0, Place::polar(0.0, 90.0));
    assert!(u.abs() < 1e-12 && v.abs() < 1e-12, "{u} {v}");
}

/// This includes a corner at almost 90°, and acuity so poor that scales would be unbounded.
#[test]
fn optimised_guenter_layers_can_be_used_as_fixed() {
    for (setting, m) in [(centred(2000, 2000, 179.9), 0.0275), (centred(11520, 6480, 110.0), 1.0)] {
        let params = guenter::Params { fit: guenter::Fit::Optimised, m, ..Default::default() };
        let best = Guenter::new(&params, &setting).unwrap();
        assert!(best.bounds_deg()[1] < 90.0 && best.scales()[2] <= 1000.0);
        let fixed = guenter::Params {
            fit: guenter::Fit::Fixed,
            bounds_deg: best.bounds_deg().to_vec(),
            scales: best.scales().to_vec(),
            ..params
        };
        let same = Guenter::new(&fixed, &setting).unwrap();
        assert!((same.counts().samples - best.counts().samples).abs() < 1e-6);
    }
}

#[test]
fn refuses_contradicting_parameters() {
    let list = |l: &[f64]| ParamValue::List(l.to_vec());
    let over = |name: &str, params: &[(&str, ParamValue)], words: &[&str]| {
        let error =
            method(name, params).apply(&centred(1440, 1600, 110.0)).unwrap_err().to_string();
        for word in words {
            assert!(error.contains(word), "{word:?} is not in {error}");
        }
    };
    over("deamp", &[("sigmas", list(&[2.0]))], &["sigmas has 1 values, but bounds_deg has 3"]);
    over(
        "deamp",
        &[("bounds_deg", list(&[10.0, 45.0, 20.0]))],
        &["must increase between 0° and 90°"],
    );
    over("deamp", &[("sigmas", list(&[2.0, 0.0, 3.0]))], &["sigma of 0", "0.1 and 1000"]);
    over("guenter", &[("bounds_deg", list(&[20.0, 10.0]))], &["must increase"]);
    over("guenter", &[("scales", list(&[1.0, 2.0]))], &["2 values, not 3"]);
    over("guenter", &[("scales", list(&[1.0, 2.0, 0.0]))], &["scale of 0", "0.1 and 1000"]);
    over("linear", &[("outer_deg", number(5.0))], &["must be above inner_deg 10"]);
    over("lafr", &[("foveal_deg", number(80.0))], &["the farthest corner"]);
    over("lafr", &[("alpha", number(50.0))], &["do not meet", "alpha must be between"]);
    over(
        "vafr",
        &[("knots_deg", list(&[0.0, 20.0, 10.0, 30.0, 60.0]))],
        &["start at 0° and increase"],
    );
    over("vafr", &[("ratio", ParamValue::Pairs(vec![[5.0, 1.0], [2.0, 1.0]]))], &["must increase"]);
    over("vafr", &[("ratio", ParamValue::Pairs(vec![[5.0, 0.0]]))], &["ratio of 0"]);
    assert!(
        method("kfr", &[])
            .set("sigma", &number(0.0))
            .unwrap_err()
            .to_string()
            .contains("0.1 to 1000")
    );
    let tiny = centred(1, 1, 110.0);
    assert!(method("kfr", &[]).apply(&tiny).unwrap_err().to_string().contains("more than 1 px"));
    let nothing = View { width: 0, ..view(8, 8, 90.0) };
    assert!(Setting::new(&nothing, [0.0, 0.0]).unwrap_err().to_string().contains("0x8"));
    // A gaze outside the frame is clamped to it.
    assert_eq!(
        setting(100, 80, 90.0, [-5.0, 900.0]).gaze_px().map(f64::to_bits),
        [0.0, 80.0].map(f64::to_bits)
    );
}
