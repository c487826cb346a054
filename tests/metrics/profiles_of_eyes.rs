//! Profiles of scenes with two eyes.

use std::collections::BTreeMap;

use crate::fovqa::Folder;
use crate::frames::moving_frames::{MOTION, float, motion, moving, part, write};
use crate::runs::experiment_folder::{self, rows};

/// Two eyes with a view, a gaze and motion of their own each, scored with default metrics.
fn two_eyes() -> Folder {
    let folder = Folder::new();
    for frame in 0..3 {
        for (seed, eye) in ["left", "right"].into_iter().enumerate() {
            let ([x, y], scale) = match eye {
                "left" => (["motion.X", "motion.Y"], 1.0),
                _ => (["Vector.X", "Vector.Y"], -3.0),
            };
            let [mx, my] = MOTION.map(|motion| float(move |_, _| scale * motion));
            let motion = [(x, mx), (y, my)];
            let of = |seed| part(moving(seed, 2 * frame));
            write(&folder, &format!("gt/{eye}/{frame}.exr"), of(seed).with(&motion));
            write(&folder, &format!("a/{eye}/{frame}.exr"), of(seed + 5));
        }
    }
    folder.write(
        "e.toml",
        "name = \"e\"\n[view]\nbands_deg = [0, 15, 30, 80]\n\
         left = { fov_vertical_deg = 60, gaze = [5, 20] }\nright = { fov_vertical_deg = 50, gaze = [60, 3] }\n\
         [[scene]]\nname = \"s\"\nreference = { left = \"gt/left\", right = \"gt/right\" }\n\
         right = { motion = { channels = [\"Vector.X\", \"Vector.Y\"], sign = [-1, -1] } }\n\
         [[method]]\nname = \"A\"\ntest = \"a/{eye}\"\n",
    );
    folder.run(&["run", "e.toml"]).ok();
    folder
}

/// A cell of results.csv from the column `frame` on: frame, image, metric, statistic, level, from and to.
type Place = [String; 7];

/// The values of one eye by their place.
fn of_eye(folder: &Folder, eye: &str) -> BTreeMap<Place, Option<f64>> {
    let columns = ["frame", "image", "metric", "statistic", "level", "from_deg", "to_deg"];
    let rows = rows(folder, "reports/e").into_iter().filter(|row| row["eye"] == eye);
    rows.map(|row| (columns.map(|column| row[column].clone()), row["value"].parse().ok())).collect()
}

#[test]
fn each_eye_has_its_own_view_gaze_and_motion() {
    let folder = two_eyes();
    // As one scores it alone; the right one's motion points to the next frame in its files.
    for (eye, fov, gaze) in [("left", "60", "5,20"), ("right", "50", "60,3")] {
        let (reference, test) = (format!("gt/{eye}"), format!("a/{eye}"));
        if eye == "right" {
            for frame in 0..3 {
                let motion = motion(MOTION.map(|motion| 3.0 * motion));
                let gt = part(moving(1, 2 * frame)).with(&motion);
                write(&folder, &format!("{reference}/{frame}.exr"), gt);
            }
        }
        let arguments = ["--fov-vertical", fov, "--gaze", gaze, "--bands", "0,15,30,80"];
        let csv =
            folder.score(&[&[&*reference, &*test, "--format", "csv"], &arguments[..]].concat());
        let csv = csv.ok().stdout;
        let rows = csv.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
        let rows = rows.filter(|row| row[4].parse::<u64>().is_ok());
        let alone: BTreeMap<Place, Option<f64>> = rows
            .map(|row| (std::array::from_fn(|i| row[4 + i].clone()), row[11].parse().ok()))
            .collect();
        assert_eq!(of_eye(&folder, eye), alone, "{eye}");
    }
}

/// The mean of two values by their weights; of those that are there.
fn pooled(values: [Option<f64>; 2], weights: [f64; 2]) -> Option<f64> {
    let there =
        || values.into_iter().zip(weights).filter_map(|(value, weight)| Some((value?, weight)));
    let weight: f64 = there().map(|(_, weight)| weight).sum();
    (weight > 0.0).then(|| there().map(|(value, weight)| value * weight).sum::<f64>() / weight)
}

#[test]
fn both_eyes_have_what_they_have_together() {
    let folder = two_eyes();
    let [both, left, right] = ["both", "left", "right"].map(|eye| of_eye(&folder, eye));
    let one = |eye: &BTreeMap<Place, Option<f64>>, place: [&str; 7]| eye[&place.map(str::to_owned)];
    let eyes = |place: [&str; 7]| [one(&left, place), one(&right, place)];
    let is = |place: [&str; 7], want: Option<f64>| match (one(&both, place), want) {
        (Some(found), Some(want)) => {
            assert!((found - want).abs() <= 1e-12 * want, "{place:?}: {found} for {want}");
        }
        (found, want) => assert_eq!(found, want, "{place:?}"),
    };
    for (frame, image) in
        ["0", "1", "2"].into_iter().flat_map(|f| ["reference", "test"].map(|i| (f, i)))
    {
        for (from, to) in [("0.0", "15.0"), ("15.0", "30.0"), ("30.0", "80.0")] {
            let contrast = [frame, image, "rms_contrast", "", "", from, to];
            is(contrast, pooled(eyes(contrast), [1.0; 2]));
            for level in ["1", "2", "3", "4", "5"] {
                let count = [frame, "pair", "haar", "coefficients", level, from, to];
                let counts = eyes(count).map(Option::unwrap);
                is(count, Some(counts[0] + counts[1]));
                let of = |statistic| [frame, image, "haar", statistic, level, from, to];
                for statistic in ["mean_abs", "energy"] {
                    is(of(statistic), pooled(eyes(of(statistic)), counts));
                }
                let largest = eyes(of("max_abs")).into_iter().flatten().reduce(f64::max);
                is(of("max_abs"), largest);
            }
        }
        if frame != "0" {
            let of = |statistic| [frame, image, "atd", statistic, "", "", ""];
            let left_out = eyes(of("left_out"));
            let valid = left_out.map(|share| 1.0 - share.unwrap());
            is(of(""), pooled(eyes(of("")), valid));
            is(of("left_out"), pooled(left_out, [1.0; 2]));
        }
    }
    let summary = experiment_folder::json(&folder, "reports/e/summary.json");
    let atd = summary["comparisons"].as_array().unwrap().iter().map(|c| &c["atd"]);
    let (reference, left_out): (Vec<_>, Vec<_>) = atd
        .map(|atd| [&atd["reference"], &atd["left_out"]].map(|value| value.as_f64().unwrap()))
        .map(|[reference, left_out]| (reference, left_out))
        .unzip();
    let [left, right, both] = left_out[..] else { panic!("left, right and both") };
    assert!(left < both && both < right, "the right one moves farther: {left_out:?}");
    let [left, right, both] = reference[..] else { panic!("left, right and both") };
    assert!((both - f64::midpoint(left, right)).abs() > 1e-9, "by valid pixels: {reference:?}");
}
