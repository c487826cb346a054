//! Compares heat maps with those of the reference program, and their colours with values calculated
//! by hand.

use serde_json::Value;

use super::*;
use crate::fidelity::fvvdp::heat_map::{MapColors, colored};

fn raw(golden: &Golden, id: &str) -> (Grid, Arc<Grid>) {
    let [reference, test] = luminance(golden, id);
    let geometry = on_display("standard_fhd", test[0].width(), test[0].height());
    let fvvdp = Fvvdp::new(geometry, &Params { foveated: false, ..Params::default() });
    let mut map = DifferenceMap::default();
    score(&fvvdp, [&reference, &test], [0.0; 2], Some(&mut map));
    (map.raw(), Arc::clone(&test[0]))
}

fn check(golden: &Golden, id: &str) {
    let case = golden.cases.iter().find(|case| case.id == id).unwrap();
    let wanted = golden.array(case.heatmap_file.as_ref().unwrap());
    let (found, _) = raw(golden, id);
    assert_eq!(wanted.shape, [1, 1, found.height(), found.width()], "{id}");
    // The maps are half floats: half a step is 2^-11 of a value, and both implementations may round
    // a value between two steps.
    let half = [1.2 / 2048.0, 1e-5];
    assert_near(id, values(&found), wanted.floats().into_iter().map(f64::from), half);
}

#[test]
fn the_map_of_a_tiny_still() {
    check(&golden(), "tiny_img");
}

#[test]
fn the_map_of_a_photograph_of_odd_sides() {
    if let Some(golden) = whole_golden() {
        check(&golden, "B_noise_odd");
    }
}

#[test]
fn the_colors_of_a_photograph_of_odd_sides() {
    let Some(golden) = whole_golden() else { return };
    let text = std::fs::read_to_string(golden.file("golden.json")).unwrap();
    let json: Value = serde_json::from_str(&text).unwrap();
    let (raw, test) = raw(&golden, "B_noise_odd");
    for colors in MapColors::ALL {
        let given = &json["colour_heatmaps"][format!("B_noise_odd_{}", colors.name())];
        let found = colored(&raw, &test, colors);
        let wanted = golden.codes(given["file"].as_str().unwrap());
        assert_eq!(found.len(), wanted.len());
        let off = |by: u8| {
            let pairs = found.iter().zip(&wanted);
            pairs.filter(|(found, wanted)| found.abs_diff(**wanted) > by).count()
        };
        // The maps are half floats, and codes are truncated rather than rounded.
        assert_eq!(off(2), 0, "{colors:?}");
        assert!(off(1) * 1000 <= found.len(), "{colors:?}: {} of {}", off(1), found.len());
        for point in given["points"].as_array().unwrap() {
            let [y, x, rgb @ ..] = [0, 1, 2, 3, 4].map(|i| point[i].as_f64().unwrap());
            let at = 3 * (y as usize * raw.width() + x as usize);
            let codes = found[at..at + 3].iter().map(|code| f64::from(*code) / 255.0 + 0.5 / 255.0);
            assert_near("point", codes, rgb, [0.0, 1.5 / 255.0]);
        }
        let mean = |c: usize| {
            let codes = found.iter().skip(c).step_by(3).map(|code| f64::from(*code));
            codes.sum::<f64>() / (found.len() / 3) as f64 / 255.0
        };
        let wanted = given["mean_rgb"].as_array().unwrap().iter().map(|v| v.as_f64().unwrap());
        // Truncated codes are half a step too low on average.
        assert_near("mean", [0, 1, 2].map(|c| mean(c) + 0.5 / 255.0), wanted, [0.0, 0.5 / 255.0]);
    }
}

/// The codes of a colour over a gray, before its luma is equalised.
fn codes([r, g, b]: [f64; 3], gray: f64) -> [u8; 3] {
    let luma = 0.212_656 * r + 0.715_158 * g + 0.072_186 * b + 0.0001;
    [r, g, b].map(|c| (255.0 * (c / luma * gray).min(1.0)).floor() as u8)
}

#[test]
fn colors_have_equal_steps_over_a_flat_gray() {
    let at = |value: f32, colors: MapColors| {
        let raw = grid(5, 4, |_, _| value);
        let codes = colored(&raw, &grid(5, 4, |_, _| 40.0), colors);
        assert!(codes.chunks(3).all(|pixel| pixel == &codes[..3]));
        [codes[0], codes[1], codes[2]]
    };
    // A flat picture is at the lower end of the grays, (1 - 0.6) / 2.
    let gray = 0.2;
    for (value, rgb) in [
        (0.0, [0.2, 0.2, 1.0]),
        (0.25, [0.2, 1.0, 1.0]),
        (0.5, [0.2, 1.0, 0.2]),
        (0.75, [1.0, 1.0, 0.2]),
        (1.0, [1.0, 0.2, 0.2]),
        (7.0, [1.0, 0.2, 0.2]),
    ] {
        assert_eq!(at(value, MapColors::Threshold), codes(rgb, gray), "{value}");
    }
    for (value, rgb) in [
        (0.0, [0.2, 1.0, 1.0]),
        (0.5, [1.0, 1.0, 1.0]),
        (1.0, [1.0, 1.0, 0.2]),
        (7.0, [1.0, 1.0, 0.2]),
    ] {
        assert_eq!(at(value, MapColors::SupraThreshold), codes(rgb, gray), "{value}");
    }
}

#[test]
fn pictures_of_little_contrast_are_laid_out_evenly() {
    // The range is less than 0.6 in the natural logarithm: the grays start at 0.2 and follow the
    // shares of the range.
    let luminance = grid(3, 1, |x, _| [10.0, 12.0, 16.0][x]);
    let raw = grid(3, 1, |_, _| 0.5);
    let found = colored(&raw, &luminance, MapColors::SupraThreshold);
    let log = |v: f64| v.ln() - 10f64.ln();
    for (pixel, v) in found.chunks(3).zip([10.0, 12.0, 16.0]) {
        let gray = log(v) / (log(16.0) + 1e-3) * 0.6 + 0.2;
        for (code, wanted) in pixel.iter().zip(codes([1.0; 3], gray)) {
            assert!(code.abs_diff(wanted) <= 1, "{pixel:?} for {v}");
        }
    }
}

#[test]
fn pictures_of_much_contrast_have_their_histogram_evened_out() {
    // Eight dark pixels and one bright one: the cube roots of the counts are 2 and 1. Zero is
    // replaced by the smallest positive luminance.
    let luminance = grid(3, 3, |x, y| match (x, y) {
        (2, 2) => 100.0,
        (0, 0) => 0.0,
        _ => 1.0,
    });
    let raw = grid(3, 3, |_, _| 0.5);
    let found = colored(&raw, &luminance, MapColors::SupraThreshold);
    for (index, pixel) in found.chunks(3).enumerate() {
        let share = if index == 8 { 1.0 } else { 2.0 / 3.0 };
        assert_eq!(pixel, codes([1.0; 3], share * 0.6 + 0.2), "pixel {index}");
    }
}

#[test]
fn a_black_picture_is_gray_below_its_map() {
    let black = grid(3, 2, |_, _| 0.0);
    let found = colored(&black, &black, MapColors::Threshold);
    assert!(found.chunks(3).all(|pixel| pixel == codes([0.2, 0.2, 1.0], 0.5)));
}
