//! Places, distances to the frame, and integrals over it.

#![allow(clippy::float_cmp, reason = "what is exact is compared exactly")]

use std::f64::consts::PI;

use super::{setting, view};
use crate::{MethodError, Place, Setting};

fn bits(values: [f64; 2]) -> [u64; 2] {
    values.map(|v| (v + 0.0).to_bits())
}

#[test]
fn places_turn_from_right_to_down() {
    for (deg, x, y) in [(0.0, 1.0, 0.0), (90.0, 0.0, 1.0), (180.0, -1.0, 0.0), (270.0, 0.0, -1.0)] {
        // Multiples of 90° are exact for any number of turns.
        for turns in [-720.0, -360.0, 0.0, 360.0] {
            let place = Place::polar(2.0, deg + turns);
            assert_eq!(bits(place.direction), bits([x, y]), "{deg}° {turns}°");
            assert_eq!(place.angle_deg(), deg);
            assert_eq!(bits(place.offset_px()), bits([2.0 * x, 2.0 * y]));
        }
    }
    for deg in [1.0, 89.0, 91.0, 179.0, 200.0, 269.0, 300.0, 359.0] {
        let place = Place::polar(3.0, deg);
        let (sin, cos) = deg.to_radians().sin_cos();
        assert!((place.direction[0] - cos).abs() + (place.direction[1] - sin).abs() < 1e-14);
        assert!((place.angle_deg() - deg).abs() < 1e-12);
        assert!((Place::polar(3.0, deg - 360.0).angle_deg() - deg).abs() < 1e-12);
    }
    // The angle stays below 360°, however small the missing angle is.
    assert_eq!(Place { radius_px: 1.0, direction: [1.0, -1e-20] }.angle_deg(), 0.0);
    assert_eq!(Place::at([0.0, 0.0]), Place { radius_px: 0.0, direction: [1.0, 0.0] });
}

#[test]
fn distances_reach_the_edges_of_the_frame() {
    let setting = setting(100, 80, 90.0, [30.0, 20.0]);
    assert_eq!([-1.0, 0.0, 1.0].map(|sign| setting.side_px(0, sign)), [30.0, 70.0, 70.0]);
    assert_eq!([-1.0, 0.0, 1.0].map(|sign| setting.side_px(1, sign)), [20.0, 60.0, 60.0]);
    assert!((setting.corner_px() - f64::hypot(70.0, 60.0)).abs() < 1e-12);
    let edge = |deg: f64| setting.edge_px(Place::polar(0.0, deg).direction);
    for (deg, want) in [(0.0, 70.0), (90.0, 60.0), (180.0, 30.0), (270.0, 20.0)] {
        assert_eq!(edge(deg), want);
    }
    assert!((edge(45.0) - 60.0 * 2f64.sqrt()).abs() < 1e-12);
    assert!((edge(225.0) - 20.0 * 2f64.sqrt()).abs() < 1e-12);
    // On the border the distance is 0 outwards and that of the whole frame inwards.
    let border = super::setting(100, 80, 90.0, [100.0, 20.0]);
    assert_eq!(
        [0.0, 180.0].map(|deg| border.edge_px(Place::polar(0.0, deg).direction)),
        [0.0, 100.0]
    );
}

#[test]
fn no_setting_without_a_frame_a_focal_length_and_a_gaze() {
    let good = view(100, 80, 90.0);
    for focal in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let view = fovqa_vision::View { focal_px: [focal; 2], ..good };
        assert!(matches!(Setting::new(&view, [1.0, 1.0]), Err(MethodError::Setting(_))), "{focal}");
    }
    for gaze in [[f64::NAN, 1.0], [1.0, f64::INFINITY]] {
        assert!(Setting::new(&good, gaze).is_err());
    }
    let oblong = fovqa_vision::View { focal_px: [40.0, 90.0], ..good };
    assert!((Setting::new(&oblong, [1.0, 1.0]).unwrap().focal_px() - 60.0).abs() < 1e-12);
    assert!((setting(100, 80, 90.0, [0.0; 2]).eccentricity_deg(40.0) - 45.0).abs() < 1e-12);
}

/// Both integrals give the area of a disc that leaves the frame on one side, and that of the frame.
#[test]
fn integrals_are_areas() {
    let area = |d: f64, r: f64| PI * r * r - (r * r * (d / r).acos() - d * (r * r - d * d).sqrt());
    for (gaze, r, want) in [
        ([500.0, 400.0], 200.0, PI * 40_000.0),
        ([150.0, 400.0], 200.0, area(150.0, 200.0)),
        ([880.0, 400.0], 200.0, area(120.0, 200.0)),
        ([500.0, 130.0], 200.0, area(130.0, 200.0)),
        ([500.0, 790.0], 200.0, area(10.0, 200.0)),
        ([1000.0, 400.0], 200.0, PI * 20_000.0),
        ([1000.0, 800.0], 200.0, PI * 10_000.0),
        ([310.0, 290.0], 5000.0, 800_000.0),
        ([0.0, 750.0], 5000.0, 800_000.0),
    ] {
        let setting = setting(1000, 800, 90.0, gaze);
        let disc = setting.integrate(&[0.0, r], |at| f64::from(at <= r));
        assert!((disc / want - 1.0).abs() < 1e-10, "{gaze:?} {r}: {disc} for {want}");
        let disc = setting.integrate_within(&[r], |edge| PI * edge.min(r).powi(2));
        assert!((disc / want - 1.0).abs() < 1e-8, "{gaze:?} {r} within: {disc} for {want}");
    }
}

/// The integral of 1 / r² from one pixel on is ln r per angle: both integrals handle a density that
/// falls over decades.
#[test]
fn integrals_over_decades() {
    for gaze in [[8000.0, 4000.0], [10.0, 7000.0], [16000.0, 0.0]] {
        let setting = setting(16_000, 8000, 90.0, gaze);
        let by_distance = setting.integrate(&[1.0], |r| 1.0 / (r * r));
        let by_angle = setting.integrate_within(&[1.0], |r| 2.0 * PI * r.max(1.0).ln());
        assert!((by_distance / by_angle - 1.0).abs() < 2e-7, "{gaze:?}: {by_distance} {by_angle}");
    }
}

/// Both integrals give the same area of a disc around any gaze that is cut by several sides.
#[test]
fn both_integrals_agree() {
    for x in [0.0, 3.0, 150.0, 430.0, 850.0, 999.0] {
        for y in [0.0, 10.0, 210.0, 555.0, 790.0] {
            let setting = setting(1000, 800, 90.0, [x, y]);
            for r in [30.0, 200.0, 620.0] {
                let disc = setting.integrate(&[0.0, r], |at| f64::from(at <= r));
                let within = setting.integrate_within(&[r], |edge| PI * edge.min(r).powi(2));
                assert!((disc / within - 1.0).abs() < 3e-6, "{x} {y} {r}: {disc} {within}");
            }
        }
    }
    let setting = setting(16_000, 16_000, 90.0, [8000.0, 8000.0]);
    let by_distance = setting.integrate(&[1.0], |r| 1.0 / (r * r * r));
    let by_angle = setting.integrate_within(&[1.0], |r| 2.0 * PI * (1.0 - 1.0 / r));
    assert!((by_distance / by_angle - 1.0).abs() < 1e-12, "{by_distance} {by_angle}");
}
