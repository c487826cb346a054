//! Compares single steps with golden values of the reference program.

use serde_json::Value;

use super::*;
use crate::fidelity::fvvdp::bands::bands;
use crate::fidelity::fvvdp::pyramid::expand;
use crate::fidelity::fvvdp::temporal_filters::TemporalFilters;

fn stage(name: &str) -> Vec<Value> {
    golden().stages[name].as_array().unwrap().clone()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

/// All numbers of a nested array.
fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(values) => values.iter().flat_map(numbers).collect(),
        value => vec![number(value)],
    }
}

#[test]
fn displays_turn_values_into_luminance() {
    let displays = stage("photometry");
    assert_eq!(displays.len(), 10);
    for given in &displays {
        let name = given["display"].as_str().unwrap();
        let photometry = Photometry::new(find_display(name).unwrap().luminance.unwrap());
        assert_near(
            name,
            [photometry.peak_cd_m2(), photometry.black_cd_m2()],
            [number(&given["Y_peak"]), number(&given["Y_black"])],
            [1e-8, 0.0],
        );
        let inputs = given["input"].as_array().unwrap().iter().map(|input| match input.as_str() {
            Some(code) => code.strip_suffix("/255").unwrap().parse::<f64>().unwrap() / 255.0,
            None => number(input),
        });
        let found = inputs.map(|input| photometry.emitted_cd_m2(input));
        // PQ is steep: the reference program computes the power of 1/78.8 in `f32`, and an error of
        // one bit there becomes hundreds of bits in the luminance.
        let relative = if photometry.eotf() == Eotf::Pq { 3e-5 } else { 1e-6 };
        assert_near(name, found, numbers(&given["luminance"]), [relative, 0.0]);
    }
}

#[test]
fn filters_have_their_taps_at_every_frame_rate() {
    let filters = stage("temporal_filters");
    assert_eq!(filters.len(), 11);
    for given in &filters {
        let fps = number(&given["fps"]);
        let found = TemporalFilters::new(fps);
        assert_eq!(found.len() as u64, given["taps"].as_u64().unwrap(), "{fps} fps");
        for (taps, name) in found.taps.iter().zip(["sustained", "transient"]) {
            // The tap of the present frame, 1e-36, counts as 0 beside the others. The reference
            // program computes transient taps as differences in `f32` over a step of milliseconds.
            let what = format!("{name} at {fps} fps");
            assert_near(&what, taps.iter().copied(), numbers(&given[name]), [1e-6, 3e-7]);
        }
    }
}

#[test]
fn directions_and_magnifications_agree() {
    let displays = stage("geometry");
    assert_eq!(displays.len(), 10);
    for given in &displays {
        let name = given["display"].as_str().unwrap();
        let [width, height] = find_display(name).unwrap().resolution;
        let own = ViewSpec::Display(find_display(name).unwrap().clone());
        let geometry = Geometry::new(own.resolve(width, height).unwrap().view, None);
        let ppd = number(&given["ppd_centre"]);
        assert_near(name, [geometry.pixels_per_degree], [ppd], [1e-7, 0.0]);
        let [left, top] = geometry.direction_deg([0.0, 0.0]);
        let [right, bottom] = geometry.direction_deg([width as f64, height as f64]);
        let size = [right - left, top - bottom];
        assert_near(name, size, numbers(&given["size_deg"]), [1e-7, 0.0]);
        // In `f32`, the reference program loses digits between two tangents that are nearly equal.
        let directions = numbers(&given["view_dirs_deg"]);
        let from_centre = directions.as_chunks::<2>().0.iter().map(|[x, y]| libm::hypot(*x, *y));
        let found = from_centre.map(|deg| geometry.magnification(deg));
        assert_near(name, found, numbers(&given["magnification"]), [2e-3, 0.0]);
        // A picture of another size is stretched over the whole display.
        let stretched = on_display(name, 100, 50);
        let given = &given["view_direction_100x50"];
        let points = numbers(&given["xy"]);
        let found = points.as_chunks::<2>().0.iter().flat_map(|at| stretched.direction_deg(*at));
        assert_near(name, found, numbers(&given["deg"]), [0.0, 1.1e-5]);
    }
}

#[test]
fn bands_have_their_sizes_and_frequencies() {
    let layouts = stage("band_layout");
    assert_eq!(layouts.len(), 9);
    for given in &layouts {
        let [width, height] = ["W", "H"].map(|key| number(&given[key]) as usize);
        let view = ViewSpec::FovDiagonal { diagonal_deg: 40.0 }.resolve(width, height).unwrap();
        let found = bands(&Geometry::new(view.view, Some(number(&given["ppd"]))));
        let what = format!("{width}x{height}");
        let used = number(&given["bands_used"]) as usize;
        assert_eq!(found.len(), used, "{what}");
        let wanted = numbers(&given["rho"]).into_iter().take(used);
        assert_near(&what, found.iter().map(|band| band.cpd), wanted, [1e-7, 0.0]);
        for (band, size) in found.iter().zip(given["sizes_hw"].as_array().unwrap()) {
            assert_eq!([band.size.1 as f64, band.size.0 as f64], numbers(size)[..], "{what}");
            let directions = band.directions.each_ref().map(Vec::len);
            assert_eq!(directions, [band.size.0, band.size.1], "{what}");
        }
    }
}

#[test]
fn levels_are_reduced_and_expanded_for_each_parity() {
    let sizes = stage("pyramid_ops");
    assert_eq!(sizes.len(), 4);
    for given in &sizes {
        let [width, height] = ["W", "H"].map(|key| number(&given[key]) as usize);
        let fine = grid(width, height, |j, i| (3 * i * i + 5 * j + (7 * i + 3 * j) % 5) as f32);
        let coarse = reduced(&fine, RightEdge::ByRows);
        let what = format!("{width}x{height}");
        assert_near(&what, values(&coarse), numbers(&given["reduce"]), [1e-5, 0.0]);
        let back = expand(&coarse, (width, height));
        assert_near(&what, values(&back), numbers(&given["expand_of_reduce"]), [1e-5, 0.0]);
    }
}

#[test]
fn sensitivity_is_interpolated_between_the_nodes() {
    let points = stage("csf_points");
    assert_eq!(points.len(), 48);
    for given in &points {
        let [omega, rho, luminance, ecc, wanted] =
            ["omega", "rho", "L", "ecc", "S"].map(|key| number(&given[key]));
        let channel = usize::from(omega > 0.0);
        // Golden sensitivities are those of the table, before the correction in dB of amplitude.
        let corrected = wanted * 10f64.powf(16.2596 / 20.0);
        let found = sensitivity(channel, rho, luminance, ecc);
        assert_near(&given.to_string(), [found], [corrected], [1e-4, 0.0]);
    }
}
