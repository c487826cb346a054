//! Differences over time: their values, what is left out, gaps, gaze steps.

use fovqa_testkit::exr_files::{Part, Values};
use fovqa_testkit::synthetic::{codes, disturbed};
use serde_json::{Value, json};

use super::temporal_masks::{HOLES, with_hole};
use crate::fovqa::Folder;
use crate::frames::moving_frames::{
    ENCODED, H, MOTION, SIZE, W, atd, beyond_borders, experiment, half, is_steady, motion, moved,
    moving, near, noise, part, plane, restless, with_atd, write,
};
use crate::runs::experiment_folder::{self, rows};

/// A frame and the one before it, for the definition pixel by pixel; now, then before.
pub(super) struct Literal {
    pub(super) size: (usize, usize),
    pub(super) luma: [Vec<f32>; 2],
    pub(super) depth: Option<[Vec<f32>; 2]>,
    pub(super) counts: [Vec<bool>; 2],
    pub(super) motion: [f64; 2],
}

impl Literal {
    pub(super) fn new(now: Vec<f32>, before: Vec<f32>, motion: [f32; 2]) -> Self {
        let counts = [vec![true; now.len()], vec![true; now.len()]];
        let motion = motion.map(f64::from);
        Self { size: SIZE, luma: [now, before], depth: None, counts, motion }
    }

    /// The mean difference, and the share of what counts that is left out.
    pub(super) fn atd(&self) -> (f64, f64) {
        let (width, height) = self.size;
        let (mut sum, mut valid, mut pixels) = (0.0, 0, 0);
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            let i = y * width + x;
            pixels += i32::from(self.counts[0][i]);
            if let Some(before) = self.before(x, y).filter(|_| self.counts[0][i]) {
                sum += (f64::from(self.luma[0][i]) - before).abs();
                valid += 1;
            }
        }
        (sum / f64::from(valid), 1.0 - f64::from(valid) / f64::from(pixels))
    }

    /// The luma at the source of a pixel.
    pub(super) fn before(&self, x: usize, y: usize) -> Option<f64> {
        let (width, height) = self.size;
        let at = |x: f64, y: f64| {
            let within = |at: f64, side: usize| at.clamp(0.0, side as f64 - 1.0) as usize;
            within(y, height) * width + within(x, width)
        };
        let source = [x as f64 + 0.5 + self.motion[0], y as f64 + 0.5 + self.motion[1]];
        if !(0.0..width as f64).contains(&source[0]) || !(0.0..height as f64).contains(&source[1]) {
            return None;
        }
        if let Some([now, before]) = &self.depth {
            let now = f64::from(now[y * width + x]);
            let before = f64::from(before[at(source[0].floor(), source[1].floor())]);
            if (before - now).abs() > 0.05 * now {
                return None;
            }
        }
        let first = source.map(|at| (at - 0.5).floor());
        let mut value = 0.0;
        for [dx, dy] in [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]] {
            let tap = [first[0] + dx, first[1] + dy];
            let share = |axis: usize| 1.0 - (source[axis] - 0.5 - tap[axis]).abs();
            let (weight, tap) = (share(0) * share(1), at(tap[0], tap[1]));
            if weight > 0.0 {
                self.counts[1][tap].then_some(())?;
                value += weight * f64::from(self.luma[1][tap]);
            }
        }
        Some(value)
    }
}

#[test]
fn what_moves_with_its_motion_does_not_differ() {
    let folder = moved(3);
    let json = atd(&folder, &[]);
    let all = &json["sequence"]["atd"];
    is_steady(all);
    assert_eq!((&all["motion"], &all["depth"]), (&json!("reference"), &json!("none")));
    assert_eq!((&all["ratio"], &all["reason"]), (&Value::Null, &json!("the reference is 0")));
    assert_eq!((&all["frames"], all.get("left_out_test")), (&json!(2), None));
    // Half floats say the same; without motion everything differs.
    for frame in 0..3 {
        let [x, y] = MOTION.map(|motion| half(move |_, _| motion));
        let gt = part(moving(1, frame)).with(&[("motion.X", x), ("motion.Y", y)]);
        write(&folder, &format!("gt/{frame:04}.exr"), gt);
    }
    is_steady(&atd(&folder, &[])["sequence"]["atd"]);
    let still = &atd(&folder, &["--motion", "none"])["sequence"]["atd"];
    assert!(still["reference"].as_f64().unwrap() > 0.1 && still["left_out"] == 0.0, "{still}");
}

#[test]
fn differences_stand_in_each_band() {
    let folder = moved(2);
    let view = ["--fov-vertical", "60", "--bands", "0,10,20,90"];
    let still = atd(&folder, &[&view[..], &ENCODED, &["--motion", "none"]].concat());
    let (mut sum, mut pixels) = (0.0, 0.0);
    for band in still["frames"][1]["bands"].as_array().unwrap() {
        let share = band["pixels"].as_f64().unwrap();
        sum += share * band["atd"]["test"].as_f64().unwrap();
        pixels += share;
    }
    near(&still["frames"][1]["atd"]["test"], sum / pixels);
    assert_eq!(still["frames"][0]["bands"][0].get("atd"), None, "nothing before the first");
    for band in atd(&folder, &view)["frames"][1]["bands"].as_array().unwrap() {
        let of = |side: &str| band["atd"][side].clone();
        assert_eq!(
            (of("reference"), of("test"), of("ratio")),
            (json!(0.0), json!(0.0), json!(null))
        );
    }
}

#[test]
fn a_part_of_a_pixel_fetches_the_bilinear_value() {
    let folder = Folder::new();
    let still = |seed| plane(move |x, y| noise(seed, x as i64, y as i64));
    for vector in [[0.5, 0.0], [-0.5, 0.25], [1.75, -3.5]] {
        for frame in 0..2 {
            let of = |seed| part(move |x, y| noise(seed, x as i64, y as i64));
            write(&folder, &format!("gt/{frame}.exr"), of(frame).with(&motion(vector)));
            write(&folder, &format!("test/{frame}.exr"), of(frame + 5));
        }
        let found = &atd(&folder, &ENCODED)["frames"][1]["atd"];
        for (side, seed) in [("reference", 0), ("test", 5)] {
            let (mean, left_out) = Literal::new(still(seed + 1), still(seed), vector).atd();
            near(&found[side], mean);
            near(&found["left_out"], left_out);
        }
    }
}

/// Five columns were nearer before, and one of them by less than the tolerance.
#[test]
fn what_comes_into_sight_is_left_out_and_counted() {
    let folder = Folder::new();
    let depth = |frame: usize| {
        move |x: usize, _: usize| match (frame, x) {
            (0, 10..15) => 1.0,
            (0, 15) => 1.9375,
            _ => 2.0,
        }
    };
    for frame in 0..2 {
        let gt = part(moving(1, frame)).with(&motion(MOTION)).with(&[("Z", half(depth(frame)))]);
        write(&folder, &format!("gt/{frame}.exr"), gt);
        write(&folder, &format!("test/{frame}.exr"), part(moving(2, 3 * frame)));
    }
    let mut literal = Literal::new(plane(moving(2, 3)), plane(moving(2, 0)), MOTION);
    let all = |tolerance: &str| {
        let arguments = ["--set", &format!("atd.depth_tolerance={tolerance}")];
        atd(&folder, &[&ENCODED[..], &arguments].concat())["sequence"]["atd"].clone()
    };
    let off = all("off");
    is_steady(&json!({"reference": off["reference"], "test": 0.0, "left_out": off["left_out"]}));
    assert_eq!(off["depth"], "none");
    near(&off["test"], literal.atd().0);
    let found = all("0.05");
    literal.depth = Some([plane(depth(1)), plane(depth(0))]);
    let (mean, left_out) = literal.atd();
    near(&found["test"], mean);
    near(&found["left_out"], left_out);
    near(&found["left_out"], beyond_borders() + (5 * (H - 2)) as f64 / (W * H) as f64);
    assert_eq!((&found["reference"], &found["depth"]), (&json!(0.0), &json!("reference")));
    let strict = all("0.01");
    near(&strict["left_out"], beyond_borders() + (6 * (H - 2)) as f64 / (W * H) as f64);
}

#[test]
fn without_motion_vectors_the_difference_is_plain() {
    let folder = Folder::new();
    let picture = |frame: usize| codes(W, H, 3, frame as u64);
    for frame in 0..3 {
        folder.png(&format!("gt/{frame}.png"), W, H, &picture(frame));
        folder.png(&format!("test/{frame}.png"), W, H, &disturbed(&picture(frame), 40.0, 1));
    }
    let run = folder.score(&["gt", "test", "--format", "json"]).ok();
    let run = run.says(&["ATD is computed without motion vectors"]);
    assert_eq!(run.stderr.matches("without motion vectors").count(), 1, "{}", run.stderr);
    let json = run.json();
    let all = &json["sequence"]["atd"];
    assert_eq!((&all["motion"], &all["depth"]), (&json!("none"), &json!("none")));
    assert_eq!(all["left_out"], 0.0);
    let luma = |codes: Vec<u8>| -> Vec<f64> {
        let of = |c: &[u8]| {
            0.2126 * f64::from(c[0]) + 0.7152 * f64::from(c[1]) + 0.0722 * f64::from(c[2])
        };
        codes.chunks(3).map(|c| of(c) / 255.0).collect()
    };
    let mut means = Vec::new();
    for frame in 1..3 {
        let (now, before) = (luma(picture(frame)), luma(picture(frame - 1)));
        let sum: f64 = now.iter().zip(&before).map(|(now, before)| (now - before).abs()).sum();
        means.push(sum / (W * H) as f64);
        near(&json["frames"][frame]["atd"]["reference"], means[frame - 1]);
    }
    near(&all["reference"], f64::midpoint(means[0], means[1]));
    let ratio = all["test"].as_f64().unwrap() / all["reference"].as_f64().unwrap();
    assert_eq!(all["ratio"], ratio);
    let named = folder.score(&["gt", "test", "--metrics", "psnr"]).ok();
    assert!(!named.stderr.contains("motion"), "{}", named.stderr);
}

#[test]
fn one_frame_has_no_difference() {
    let folder = Folder::with_pair();
    let run = folder.score(&["a.png", "b.png", "--metrics", "atd", "--format", "json"]).ok();
    let all = &run.json()["sequence"]["atd"];
    for key in ["reference", "test", "ratio", "left_out"] {
        assert_eq!(all.get(key), Some(&Value::Null), "{key}");
    }
    assert_eq!((&all["reason"], &all["frames"]), (&json!("needs two frames"), &json!(0)));
    let run = folder.score(&["a.png", "b.png", "--format", "json"]).ok();
    assert_eq!(run.json()["sequence"], json!({}));
    assert!(!run.stderr.contains("ATD"), "nobody asked for it: {}", run.stderr);
    let csv = folder.score(&["a.png", "b.png", "--format", "csv"]).ok().stdout;
    assert!(!csv.contains("atd"), "{csv}");
}

#[test]
fn every_other_frame_has_none_before_it() {
    let folder = moved(6);
    let json = atd(&folder, &["--frames", "0..6:2"]);
    assert_eq!(with_atd(&json), [(0, false), (2, false), (4, false)]);
    assert_eq!(json["sequence"]["atd"]["reason"], "no two of the frames follow each other");
    assert_eq!(json["sequence"]["atd"]["reference"], Value::Null);
    // Numbers that count in tens follow each other all the same.
    for frame in 0..6 {
        for side in ["gt", "test"] {
            let from = folder.path(&format!("{side}/{frame:04}.exr"));
            std::fs::rename(from, folder.path(&format!("tens/{side}/{frame}0.exr"))).unwrap();
        }
    }
    let json = folder.json(&["tens/gt", "tens/test", "--metrics", "atd"]);
    is_steady(&json["sequence"]["atd"]);
    assert_eq!(json["sequence"]["atd"]["frames"], 5);
}

#[test]
fn a_frame_behind_a_gap_has_no_difference() {
    let folder = restless(5);
    let whole = atd(&folder, &[]);
    // Whichever side it is that lacks the frame.
    for missing in ["test/0002.exr", "gt/0002.exr"] {
        let kept = std::fs::read(folder.path(missing)).unwrap();
        std::fs::remove_file(folder.path(missing)).unwrap();
        let json = atd(&folder, &["--allow-missing"]);
        assert_eq!(with_atd(&json), [(0, false), (1, true), (3, false), (4, true)], "{missing}");
        for (index, frame) in [(1, 1), (3, 4)] {
            assert_eq!(json["frames"][index], whole["frames"][frame]);
        }
        folder.write(missing, kept);
    }
}

#[test]
fn a_damaged_frame_costs_its_own_difference_and_the_next() {
    let folder = restless(5);
    let whole = atd(&folder, &[]);
    folder.write("test/0002.exr", "no picture");
    let run = folder.score(&["gt", "test", "--metrics", "atd", "--format", "json"]);
    assert_eq!(run.code, 3);
    let json = run.json();
    assert_eq!(with_atd(&json), [(0, false), (1, true), (3, false), (4, true)]);
    for (index, frame) in [(1, 1), (3, 4)] {
        assert_eq!(json["frames"][index], whole["frames"][frame]);
    }
    assert_eq!(json["sequence"]["atd"]["frames"], 2);
}

/// What one method lacks costs the others nothing, and itself the frame behind it.
#[test]
fn a_damaged_frame_of_one_method_costs_no_other() {
    let folder = restless(4);
    for frame in 0..4 {
        write(&folder, &format!("b/{frame:04}.exr"), part(moving(3, frame * frame)));
    }
    folder.write("test/0001.exr", "no picture");
    let method = "[[method]]\nname = \"B\"\ntest = \"b\"\n[metrics]";
    folder.write("e.toml", experiment("").replace("[metrics]", method));
    assert_eq!(folder.run(&["run", "e.toml"]).code, 3);
    let rows = rows(&folder, "reports/e");
    let frames = |method: &str| -> Vec<&str> {
        let of = rows.iter().filter(|row| {
            row["method"] == method && row["image"] == "test" && row["statistic"].is_empty()
        });
        of.map(|row| row["frame"].as_str()).collect()
    };
    assert_eq!((frames("A"), frames("B")), (vec!["3"], vec!["1", "2", "3"]));
    let summary = experiment_folder::json(&folder, "reports/e/summary.json");
    let alone = folder.json(&["gt", "b", "--metrics", "atd"]);
    assert_eq!(summary["comparisons"][1]["atd"], alone["sequence"]["atd"]);
}

/// Two methods in one pass find what each finds alone, though a bad pixel of one of them is left out of the
/// reference's value beside it.
#[test]
fn methods_share_the_references_difference_where_it_is_the_same() {
    let folder = restless(3);
    for frame in 0..3 {
        let of = |seed| part(moving(seed, frame * frame));
        write(&folder, &format!("b/{frame:04}.exr"), of(3));
        let hole = part(with_hole(moving(4, frame * frame), HOLES[0]));
        write(&folder, &format!("c/{frame:04}.exr"), if frame == 1 { hole } else { of(4) });
        let own = of(5).with(&motion([0.0; 2]));
        write(&folder, &format!("d/{frame:04}.exr"), own);
    }
    let methods: String = ["b", "c", "d"]
        .map(|name| format!("[[method]]\nname = \"{name}\"\ntest = \"{name}\"\n"))
        .concat();
    let text =
        experiment("nonfinite = \"mask\"\n").replace("[metrics]", &format!("{methods}[metrics]"));
    folder.write("e.toml", text);
    folder.run(&["run", "e.toml"]).ok();
    let summary = experiment_folder::json(&folder, "reports/e/summary.json");
    let reference = |method: usize| summary["comparisons"][method]["atd"]["reference"].clone();
    for (index, test) in ["test", "b", "c", "d"].into_iter().enumerate() {
        let alone = folder.json(&["gt", test, "--metrics", "atd", "--nonfinite", "mask"]);
        assert_eq!(summary["comparisons"][index]["atd"], alone["sequence"]["atd"], "{test}");
    }
    assert_eq!((reference(0), reference(0)), (reference(1), reference(3)));
    assert_ne!(reference(0), reference(2), "a pixel of it is left out");
}

/// Degrees between the rays through two places, for a view of 60° from top to bottom.
fn angle_deg(from: [f64; 2], to: [f64; 2]) -> f64 {
    let focal = H as f64 / 2.0 / 30f64.to_radians().tan();
    let ray = |[x, y]: [f64; 2]| [x - W as f64 / 2.0, y - H as f64 / 2.0, focal];
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let (a, b) = (ray(from), ray(to));
    (dot(a, b) / (dot(a, a) * dot(b, b)).sqrt()).acos().to_degrees()
}

#[test]
fn the_gaze_moves_by_so_many_degrees_a_frame() {
    let gaze = [[32.0, 16.0], [40.0, 16.0], [40.0, 16.0], [10.0, 30.0], [12.0, 28.0]];
    let folder = moved(5);
    let lines = gaze.iter().enumerate().map(|(frame, [x, y])| format!("{frame},{x},{y}\n"));
    let lines = lines.collect::<Vec<_>>().concat();
    folder.write("gaze.csv", format!("frame,x_px,y_px\n{lines}"));
    let arguments = ["--fov-vertical", "60", "--gaze", "gaze.csv"];
    let json = atd(&folder, &arguments);
    let csv = folder
        .score(&[&["gt", "test", "--format", "csv", "--metrics", "atd"], &arguments[..]].concat());
    let csv = csv.ok().stdout;
    let in_csv = |frame: usize| {
        let start = format!(",,,,{frame},pair,gaze_step_deg,,,,,");
        csv.lines().find_map(|line| line.strip_prefix(&start)).map(str::to_owned)
    };
    assert_eq!((json["frames"][0].get("gaze_step_deg"), in_csv(0)), (None, None));
    for frame in 1..5 {
        let step = &json["frames"][frame]["gaze_step_deg"];
        let want = angle_deg(gaze[frame - 1], gaze[frame]);
        assert!((step.as_f64().unwrap() - want).abs() < 1e-5, "{step} for {want}");
        assert_eq!(in_csv(frame).and_then(|cell| cell.parse().ok()), step.as_f64());
    }
    assert_eq!(json["frames"][2]["gaze_step_deg"], 0.0, "it is no gap that it stands still");
    // Behind a gap nobody knows how fast it was, and a gaze that is fixed has no steps.
    std::fs::remove_file(folder.path("test/0002.exr")).unwrap();
    let json = atd(&folder, &[&arguments[..], &["--allow-missing"]].concat());
    let steps = json["frames"].as_array().unwrap().iter();
    let steps: Vec<bool> = steps.map(|frame| frame.get("gaze_step_deg").is_some()).collect();
    assert_eq!(steps, [false, true, false, true]);
    let fixed = atd(&folder, &["--fov-vertical", "60", "--gaze", "3,3", "--frames", "0..2"]);
    assert_eq!(fixed["frames"][1].get("gaze_step_deg"), None);
}

/// All default metrics, over several blocks of rows and several tiles of columns.
#[test]
fn a_sequence_has_the_same_bytes_with_any_threads() {
    const SIZE: (usize, usize) = (600, 200);
    let folder = Folder::new();
    let plane = |value: &dyn Fn(i64, i64) -> f32| -> Vec<f32> {
        (0..SIZE.0 * SIZE.1).map(|i| value((i % SIZE.0) as i64, (i / SIZE.0) as i64)).collect()
    };
    for frame in 0..3 {
        let picture = |seed: usize| Part::rgb(SIZE, |x, y| noise(seed + frame, x as i64, y as i64));
        let guides = [
            ("motion.X", Values::Half(plane(&|x, y| noise(9, x, y) * 20.0 - 10.0))),
            ("motion.Y", Values::Half(plane(&|x, _| (x % 40) as f32 / 16.0))),
            ("Z", Values::Float(plane(&|x, y| 1.0 + noise(8 + frame, x, y) / 10.0))),
        ];
        write(&folder, &format!("gt/{frame}.exr"), picture(20).with(&guides));
        write(&folder, &format!("test/{frame}.exr"), picture(30));
    }
    let score = |format: &str, threads: &str| {
        let arguments =
            ["gt", "test", "--fov-vertical", "90", "--format", format, "--threads", threads];
        folder.score(&arguments).ok().stdout
    };
    for format in ["json", "csv", "table"] {
        assert_eq!(score(format, "1"), score(format, "8"), "{format}");
    }
    assert!(score("csv", "1").contains(",test,atd,,,"));
    folder.write(
        "e.toml",
        experiment("fov_vertical_deg = 90\n").replace("[metrics]\natd = {}\n", ""),
    );
    for threads in ["1", "8"] {
        folder.run(&["run", "e.toml", "--threads", threads, "--output", threads]).ok();
    }
    let [one, eight] = ["1", "8"].map(|of| experiment_folder::bytes(&folder.path(of)));
    assert!(one.contains_key("plots/sequence-atd.svg") && one == eight);
    assert!(rows(&folder, "1").iter().any(|row| row["metric"] == "haar"));
}
