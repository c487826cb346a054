//! Shading rates and acuity against independent implementations: through the command, and for what
//! it does not print through the library.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use fovqa_methods::deamp::{Deamp, Params, Projection};
use fovqa_methods::{Method, Place, Setting, rmfr};
use fovqa_vision::ViewSpec;

use crate::fovqa::{Run, command, root, shared};

/// Largest relative deviation; the values are printed with ten digits.
const RELATIVE: f64 = 1e-6;
const STEP_DEG: f64 = 0.25;

/// How many rows of a file there are.
#[derive(Clone, Copy, PartialEq)]
enum Rows {
    Thinned,
    All,
}

/// The numbers of a file's columns.
fn table<const N: usize>(text: &str, columns: [&str; N]) -> Vec<[f64; N]> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let headers = reader.headers().unwrap().clone();
    let at = columns.map(|name| headers.iter().position(|header| header == name).unwrap());
    let rows = reader.records().map(|record| {
        let record = record.unwrap();
        at.map(|i| record[i].parse().unwrap())
    });
    rows.collect()
}

fn golden<const N: usize>(folder: &Path, name: &str, columns: [&str; N]) -> Vec<[f64; N]> {
    let rows = table(&fs::read_to_string(folder.join(format!("{name}.csv"))).unwrap(), columns);
    assert!(rows.len() > 5, "{name}");
    rows
}

#[track_caller]
fn near(what: &str, got: f64, want: f64) {
    assert!((got - want).abs() <= RELATIVE * want.abs().max(1e-9), "{what}: {got} for {want}");
}

fn check_command(folder: &Path, rows: Rows) {
    let text = fs::read_to_string(folder.join("cases.json")).unwrap();
    let cases: BTreeMap<String, Vec<String>> = serde_json::from_str(&text).unwrap();
    assert_eq!(cases.len(), 29);
    let columns = ["eccentricity_deg", "radial_cpd", "tangential_cpd"];
    for (name, arguments) in &cases {
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let step = STEP_DEG.to_string();
        let arguments = [&["curves"], &arguments[..], &["--step", &step, "--format", "csv"]];
        let run = Run::from(command(&arguments.concat()).output().unwrap()).ok();
        let (found, wanted) = (table(&run.stdout, columns), golden(folder, name, columns));
        for [e, radial, tangential] in &wanted {
            let is_it = |row: &&[f64; 3]| (row[0] - e).abs() < 1e-9;
            let row = found.iter().find(is_it).unwrap_or_else(|| panic!("{name}: no {e}°"));
            near(&format!("{name} {e}° radial"), row[1], *radial);
            near(&format!("{name} {e}° tangential"), row[2], *tangential);
        }
        // From the gaze, or from the first step where there is no rate at the gaze, to where the
        // golden curve ends: at 60° or at the frame's border.
        let [first, last] = [&wanted[0], &wanted[wanted.len() - 1]].map(|row| row[0]);
        let at_gaze = !name.contains("lmfr") && !name.contains("lafr");
        let begin = if at_gaze { 0.0 } else { STEP_DEG };
        let count = ((last - begin) / STEP_DEG).round() as usize + 1;
        assert_eq!(found.len(), count, "{name} from {begin}° to {last}°");
        for (i, row) in found.iter().enumerate() {
            near(&format!("{name} row {i}"), row[0], begin + i as f64 * STEP_DEG);
        }
        if rows == Rows::All {
            let left_out = ((first - begin) / STEP_DEG).round() as usize;
            assert_eq!(found.len(), wanted.len() + left_out, "{name}");
        }
    }
}

fn setting(width: usize, height: usize, vertical_deg: f64) -> Setting {
    let spec = ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(vertical_deg) };
    let view = spec.resolve(width, height).unwrap().view;
    Setting::new(&view, [width as f64 / 2.0, height as f64 / 2.0]).unwrap()
}

/// D Fig. 5b: the share of pixels rendered within an angle.
fn check_accumulated(folder: &Path) {
    let two = Params {
        sigmas: vec![2.6],
        bounds_deg: vec![45.0],
        projection: Projection::Linear,
        ..Params::default()
    };
    let four =
        Params { sigmas: vec![2.51, 4.8], bounds_deg: vec![22.5, 45.0], ..Params::default() };
    let square = setting(1600, 1600, 90.0);
    for (name, params) in
        [("deamp_fig5b_2L_sigma2.6_linear", two), ("deamp_fig5b_4L_2.51_4.8_tan", four)]
    {
        let deamp = Deamp::new(&params, &square).unwrap();
        let columns = ["layer_angle_deg", "accumulated_share", "half_angle_deg"];
        for [layer, share, half] in golden(folder, name, columns) {
            near(name, layer, 2.0 * half);
            near(&format!("{name} {half}°"), deamp.share_within(half), share);
        }
        let whole = deamp.share_within(deamp.whole_deg());
        let counts = Method::Deamp(params).apply(&square).unwrap().counts();
        near(name, counts.samples / square.pixels(), whole);
    }
}

/// R Fig. 3, f = 2.
fn check_half_axis(folder: &Path) {
    for [d, at, normalised] in golden(folder, "rmfr_fig3_f2", ["d_o", "d_i", "d_i_normalised"]) {
        near(&format!("{d}"), rmfr::half_axis(2.0, d), at);
        near(&format!("{d}"), rmfr::half_axis(2.0, d) / rmfr::half_axis(2.0, 1.0), normalised);
    }
}

/// R Fig. 11: samples per pixel of area.
fn check_density(folder: &Path) {
    let setting = setting(1440, 1600, 110.0);
    for (name, method) in [("rmfr_fig11_linear_x", "linear"), ("rmfr_fig11_rmfr_x", "rmfr")] {
        let foveation = Method::find(method).unwrap().apply(&setting).unwrap();
        for [e, samples] in golden(folder, name, ["eccentricity_deg", "samples_per_pixel"]) {
            let place = Place::polar(setting.radius_px(e), 0.0);
            near(&format!("{name} {e}°"), foveation.density(place), samples);
        }
    }
}

fn check(folder: &Path, rows: Rows) {
    check_command(folder, rows);
    check_accumulated(folder);
    check_half_axis(folder);
    check_density(folder);
}

#[test]
fn curves_of_the_committed_rows() {
    check(&root().join("tests/golden/curves"), Rows::Thinned);
}

#[test]
fn curves_of_every_row() {
    if let Some(folder) = shared("golden/curves") {
        check(&folder, Rows::All);
    }
}
