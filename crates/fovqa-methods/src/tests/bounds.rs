//! At a bound the inner piece applies, however the distance was rounded.

use fovqa_params::ParamValue;
use fovqa_vision::{EccentricityKind, PixelScale, Tangential};

use super::{method, number, setting, view};
use crate::{BudgetSamples, Method, Place, Rates, Setting};

/// Frames of many focal lengths, because the rounding of a tangent and its inverse differs between
/// them.
fn frames() -> impl Iterator<Item = (usize, f64)> {
    [600, 800, 1184, 1440, 1600, 2160, 3240]
        .into_iter()
        .flat_map(|side| (40..=130).step_by(5).map(move |fov_deg| (side, f64::from(fov_deg))))
}

/// Rates at an eccentricity as a curve computes them: with the distances of both kinds of
/// eccentricity, in directions along the axes.
fn rates_at(method: &Method, side: usize, fov_deg: f64, e: f64) -> Vec<Option<Rates>> {
    let (view, middle) = (view(side, side, fov_deg), [side as f64 / 2.0; 2]);
    let foveation = method.apply(&Setting::new(&view, middle).unwrap()).unwrap();
    let mut found = Vec::new();
    for kind in [EccentricityKind::Planar, EccentricityKind::Angular] {
        for direction_deg in [0.0, 90.0, 180.0, 270.0] {
            let direction = Place::polar(0.0, direction_deg).direction;
            let scale =
                PixelScale::at(&view, middle, kind, Tangential::Paper, direction, e).unwrap();
            found.push(foveation.rates(Place { radius_px: scale.radius_px, direction }));
        }
    }
    found
}

#[track_caller]
fn all_are(found: &[Option<Rates>], want: f64, what: &str) {
    for rates in found {
        assert!((rates.unwrap().radial / want - 1.0).abs() < 1e-9, "{what}: {rates:?} for {want}");
    }
}

#[test]
fn a_rate_that_is_asked_for_exactly_is_not_rounded_up() {
    let word = |word: &str| ParamValue::Text(word.into());
    for (side, fov) in frames() {
        let cps = |transition, quantise| {
            method("cps", &[("transition_deg", number(transition)), ("quantise", word(quantise))])
        };
        let what = format!("{side} px, {fov}°");
        // 1 - 0.75 (25 - 15) / T is 1/4 for T = 10 and 1/2 for T = 15; it is 3/4 at 20° and 3/8 at
        // 27.5° for T = 15.
        all_are(&rates_at(&cps(10.0, "ceil"), side, fov, 25.0), 0.25, &what);
        all_are(&rates_at(&cps(15.0, "ceil"), side, fov, 25.0), 0.5, &what);
        all_are(&rates_at(&cps(15.0, "nearest"), side, fov, 20.0), 1.0, &what);
        all_are(&rates_at(&cps(15.0, "nearest"), side, fov, 27.5), 0.5, &what);
        // The next rate applies just on the other side of the bound.
        all_are(&rates_at(&cps(15.0, "ceil"), side, fov, 24.999), 1.0, &what);
        all_are(&rates_at(&cps(10.0, "ceil"), side, fov, 24.999), 0.5, &what);
        all_are(&rates_at(&cps(15.0, "nearest"), side, fov, 20.001), 0.5, &what);
        all_are(&rates_at(&cps(15.0, "nearest"), side, fov, 27.501), 0.25, &what);
    }
}

#[test]
fn layers_hold_at_their_bounds() {
    let guenter = Method::find("guenter").unwrap();
    for (side, fov) in frames() {
        let what = format!("{side} px, {fov}°");
        for (e, rate) in [(10.0, 1.0), (10.001, 0.5), (20.0, 0.5), (20.001, 1.0 / 12.35)] {
            all_are(&rates_at(&guenter, side, fov, e), rate, &what);
        }
    }
    // In a frame of 90° the layers' angles are the true ones. The density jumps by (3.6 / 2.51)².
    let deamp = Method::find("deamp").unwrap();
    for side in (400..3000).step_by(50) {
        let half = side as f64 / 2.0;
        for (e, sigma) in [(10.0, 2.51), (10.001, 3.6), (22.5, 3.6), (22.501, 4.8)] {
            let f = 0.38 * side as f64;
            let from = half * f64::tan(f64::to_radians(e)) + f;
            let want = f * (f + half) / (from * from * sigma);
            all_are(&rates_at(&deamp, side, 90.0, e), want, &format!("{side} px"));
        }
    }
}

#[test]
fn vafr_and_lafr_have_a_rate_where_a_piece_ends() {
    let clamped = method("vafr", &[("beyond", ParamValue::Text("clamp".into()))]);
    let lafr = Method::find("lafr").unwrap();
    for (side, fov) in frames() {
        for rates in rates_at(&clamped, side, fov, 60.0) {
            assert!(rates.is_some(), "{side} px, {fov}°");
        }
        let rates =
            |e| rates_at(&lafr, side, fov, e).into_iter().map(|rates| rates.unwrap().radial);
        // The rate of the inner kernel continues up to e_f and jumps beyond it.
        for (at, (before, behind)) in rates(4.89).zip(rates(4.889).zip(rates(4.891))) {
            assert!(
                (at / before - 1.0).abs() < 0.01 && behind > 2.0 * at,
                "{before} {at} {behind}"
            );
        }
    }
}

/// The limits of the factor multiplied by σ may exceed the limits of σ by a rounding error.
#[test]
fn any_sigmas_reach_a_budget() {
    let setting = setting(400, 400, 90.0, [200.0, 200.0]);
    for i in 10..500 {
        let sigma = f64::from(i) / 100.0;
        let deamp = method(
            "deamp",
            &[
                ("sigmas", ParamValue::List(vec![sigma])),
                ("bounds_deg", ParamValue::List(vec![45.0])),
            ],
        );
        let Method::Deamp(found) =
            deamp.at_budget(&setting, 0.25, BudgetSamples::Buffer).unwrap().method
        else {
            panic!()
        };
        assert!((found.sigmas[0] - 2.0).abs() < 1e-9, "{sigma}: {:?}", found.sigmas);
    }
}
