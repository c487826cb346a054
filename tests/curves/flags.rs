//! `fovqa curves` from flags: one curve as CSV, and what is wrong with flags.

use crate::curves::files::json;
use crate::fovqa::{Folder, Run, command};

const HEADSET: [&str; 4] = ["--resolution", "1440x1600", "--fov-vertical", "110"];

fn curves(arguments: &[&str]) -> Run {
    command(&[&["curves"], arguments].concat()).output().unwrap().into()
}

/// Rows of a curve: eccentricity, radial, tangential.
fn rows(run: &Run) -> Vec<[f64; 3]> {
    let mut lines = run.stdout.lines();
    assert_eq!(lines.next(), Some("eccentricity_deg,radial_cpd,tangential_cpd"));
    let row = |line: &str| -> Vec<f64> { line.split(',').map(|v| v.parse().unwrap()).collect() };
    lines.map(|line| row(line).try_into().unwrap()).collect()
}

#[test]
fn steps_ends_and_directions_are_as_asked() {
    let of = |arguments: &[&str]| rows(&curves(&[arguments, &HEADSET].concat()).ok());
    // tan e · f = W/2 at 52.1°, H/2 at 55°: separable curves end there.
    let x = of(&["--method", "rmfr", "--step", "0.1"]);
    assert_eq!(x.len(), 522);
    assert!((x[3][0] - 0.3).abs() < 1e-15 && (x[521][0] - 52.1).abs() < 1e-12);
    let y = of(&["--method", "rmfr", "--step", "0.1", "--direction", "90"]);
    assert_eq!(y.len(), 551);
    assert_eq!(
        of(&["--method", "rmfr", "--direction", "450"]),
        of(&["--method", "rmfr", "--direction", "90"])
    );
    assert_eq!(of(&["--method", "guenter", "--step", "20", "--to", "80"]).len(), 5);
    assert_eq!(of(&["--method", "cps"]).len(), 241);
    // The farthest corner is at 62.4°; nearer than one pixel there is no row.
    let kfr = of(&["--method", "kfr", "--to", "80", "--step", "0.05"]);
    assert!((kfr[0][0] - 0.15).abs() < 1e-12, "1 px is 0.1023°");
    assert!((kfr[kfr.len() - 1][0] - 62.5).abs() < 0.06, "{:?}", kfr.last());
    // With the gaze at the right border nothing is left to the right of it.
    let border = of(&["--method", "rmfr", "--gaze", "1440,800"]);
    assert_eq!(border.len(), 1);
}

#[test]
fn conventions_change_what_they_say() {
    let of = |more: &[&str]| {
        let vafr = ["--method", "vafr", "--step", "30"];
        rows(&curves(&[&vafr, &HEADSET[..], more].concat()).ok())
    };
    let (paper, angle) = (of(&[]), of(&["--tangential", "angle"]));
    for ([e, radial, tangential], [_, same, smaller]) in paper.into_iter().zip(angle) {
        assert!((radial - tangential).abs() < 1e-9 && (radial - same).abs() < 1e-12);
        assert!((smaller - tangential * e.to_radians().cos()).abs() < 1e-9);
    }
    // At the principal point eccentricity is one; beside it a degree inwards has fewer pixels.
    let [planar, angular] = [of(&["--eccentricity", "planar"]), of(&["--eccentricity", "angular"])];
    assert!(planar.iter().zip(&angular).all(|(a, b)| (a[1] - b[1]).abs() < 1e-9));
    let aside = |kind: &str| {
        let full = ["--method", "full", "--step", "5", "--gaze", "1440,800", "--direction", "180"];
        rows(&curves(&[&full, &HEADSET[..], &["--eccentricity", kind]].concat()).ok())
    };
    let (planar, angular) = (aside("planar"), aside("angular"));
    assert!(angular[0][1] > 2.0 * planar[0][1], "at 52° off the axis a degree has 1/cos² as many");
    assert!(angular[1][1] < angular[0][1]);
}

#[test]
fn a_budget_sets_the_free_parameter() {
    let share = |budget: &str| {
        let folder = Folder::new();
        let text = format!(
            "name = \"b\"\n[view]\ndisplay = \"vive_pro_eye\"\n[[curve]]\nname = \"A\"\n\
             method = {{ model = \"kfr\", sigma = 1.5 }}\n{budget}"
        );
        folder.write("b.toml", text);
        folder.run(&["curves", "b.toml"]).ok();
        let record = json(&folder, "reports/b/curves.json");
        let shading = &record["curves"][0]["shading"];
        let pixels = 1440.0 * 1600.0;
        let on_screen = shading["samples_on_screen"].as_f64().unwrap() / pixels;
        (shading["share"].as_f64().unwrap(), on_screen, record["curves"][0]["parameters"].clone())
    };
    let (all, _, parameters) = share("budget = 0.1");
    assert!((all - 0.1).abs() < 1e-9);
    assert!(parameters.as_str().unwrap().starts_with("sigma=3.16227"), "{parameters}");
    let (_, on_screen, _) = share("budget = 0.1\nbudget_of = \"on_screen\"");
    assert!((on_screen - 0.1).abs() < 1e-9);
    let flags = ["--method", "guenter", "--budget", "0.9"];
    curves(&[&flags, &HEADSET[..]].concat())
        .fails(2, &["cannot reach a budget of 0.9", "allows 0.03"]);
    let full = ["--method", "full", "--budget", "0.5"];
    curves(&[&full, &HEADSET[..]].concat())
        .fails(2, &["full has no parameter that a budget could set"]);
}

/// Arguments, and what has to be said of them.
const WRONG: &[(&[&str], &[&str])] = &[
    (&[], &["--method <NAME>"]),
    (&["--method", "rmf"], &["did you mean rmfr?", "visual-polar"]),
    (&["--acuity", "piecwise"], &["did you mean piecewise?"]),
    (&["--method", "rmfr", "--acuity", "piecewise"], &["cannot be used with"]),
    (&["--method", "rmfr"], &["give one, such as --fov-vertical 110"]),
    (&["--method", "rmfr", "--fov-vertical", "110"], &["give it, such as --resolution"]),
    (
        &["--method", "kfr", "--fov-vertical", "180", "--resolution", "8x8"],
        &["180° is not between 0° and 180°"],
    ),
    (
        &["--method", "kfr", "--fov-vertical", "0", "--resolution", "8x8"],
        &["0° is not between 0° and 180°"],
    ),
    (&["--method", "kfr", "--fov-vertical", "-5", "--resolution", "8x8"], &["-5° is not between"]),
    (
        &["--method", "kfr", "--fov-vertical", "90", "--resolution", "0x8"],
        &["each from 1 to 100000"],
    ),
    (&["--method", "kfr", "--fov-vertical", "90", "--resolution", "8"], &["WIDTHxHEIGHT"]),
    (&["--method", "kfr", "--set", "sigma=0"], &["sigma cannot be 0", "0.1 to 1000"]),
    (&["--method", "kfr", "--set", "sigma=-2.6"], &["sigma cannot be -2.6", "0.1 to 1000"]),
    (&["--method", "kfr", "--set", "sigma=nan"], &["sigma cannot be", "0.1 to 1000"]),
    (&["--method", "kfr", "--set", "sgma=2"], &["no parameter \"sgma\"", "it has sigma, alpha"]),
    (&["--method", "kfr", "--set", "sigma"], &["write PARAM=VALUE"]),
    (&["--method", "cps", "--set", "quantise=floor"], &["ceil or nearest or continuous"]),
    (
        &["--acuity", "piecewise", "--set", "knots_deg=[0,20,10,30,60]"],
        &["must start at 0° and increase"],
    ),
    (
        &["--acuity", "piecewise", "--set", "knots_cpd=[40,10]"],
        &["5 eccentricities and 2 frequencies"],
    ),
    (
        &["--acuity", "piecewise", "--set", "knots_cpd=[40,10,6,5,0]"],
        &["0 cpd is not between 0.01 and 1000"],
    ),
    (
        &["--acuity", "piecewise", "--set", "cap_cpd=0"],
        &["cap_cpd cannot be 0", "0.01 to 1000, or none"],
    ),
    (&["--acuity", "linear-mar", "--fov-vertical", "190"], &["190° is not between"]),
    (&["--acuity", "piecewise", "--step", "0"], &["write degrees from 0.001 to 60"]),
    (&["--acuity", "piecewise", "--to", "200"], &["above 0 and at most 179"]),
    (&["--acuity", "piecewise", "--budget", "0.1"], &["--budget needs --method"]),
    (&["--acuity", "piecewise", "--output", "out"], &["cannot be used with"]),
    (&["nothing.toml", "--step", "0.5"], &["cannot be used with"]),
    (&["nothing.toml", "--display", "vive-pro-eye"], &["cannot be used with"]),
    (&["--acuity", "piecewise", "--gaze", "1e7,0"], &["within a million pixels"]),
    (&["nothing.toml"], &["there is no such file"]),
    (&["nothing.toml", "--method", "kfr"], &["cannot be used with"]),
];

#[test]
fn every_wrong_flag_is_said() {
    for (arguments, words) in WRONG {
        let screen: &[&str] =
            if arguments.iter().any(|a| a.starts_with("--fov")) || !arguments.contains(&"--set") {
                &[]
            } else {
                &HEADSET
            };
        curves(&[arguments, screen].concat()).fails(2, words);
    }
    let deamp = ["--method", "deamp", "--set", "sigmas=[2,3]"];
    curves(&[&deamp, &HEADSET[..]].concat()).fails(2, &["one of each per layer"]);
}

#[test]
fn what_has_to_be_said_is_a_note() {
    let of = |arguments: &[&str]| curves(&[arguments, &HEADSET].concat()).ok();
    of(&["--method", "visual-polar"]).says(&["note: Visual-Polar is a reconstruction"]);
    of(&["--method", "deamp"])
        .says(&["note: the angles of DEAMP's layers scale", "45° is 52.12° x 55.00°"]);
    of(&["--method", "kfr", "--budget", "0.1"]).says(&["the budget gives sigma=3.16227"]);
    // KFR has no rate within a pixel, and so a curve that ends there has none at all.
    of(&["--method", "kfr", "--to", "0.09", "--step", "0.05"]).says(&["no rate is defined"]);
    of(&["--method", "rmfr", "--gaze", "5000,-3", "--direction", "135"])
        .says(&["the gaze (5000, -3) is outside the frame; (1440, 0) on its border is used"]);
    assert_eq!(of(&["--method", "rmfr"]).stderr, "");
    let stretched = ["--method", "full", "--display", "vive-pro-eye", "--resolution", "720x1600"];
    curves(&stretched).ok().says(&["pixels of 720x1600 are not square", "geometric mean"]);
    let angular = rows(&curves(&[&stretched[..], &["--eccentricity", "angular"]].concat()).ok());
    assert!((angular[0][1] - 3.288).abs() < 1e-3, "half as many pixels along x: {:?}", angular[0]);
}

#[test]
fn methods_are_listed_with_their_parameters() {
    let listed = Run::from(command(&["list", "methods"]).output().unwrap()).ok().stdout;
    for words in [
        "full (Full)",
        "visual-polar (Visual-Polar (reconstruction))",
        "--set sigma=2.6",
        "--set bounds_deg=[10, 22.5, 45]",
        "source: Meng et al. 2018",
        "piecewise (Piecewise MAR)",
        "--set cap_cpd=\"none\"",
    ] {
        assert!(listed.contains(words), "{words}:\n{listed}");
    }
}
