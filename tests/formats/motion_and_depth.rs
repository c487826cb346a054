//! Motion and depth for differences over time: from which channels, of which files, and what is wrong with them.

use fovqa_testkit::exr_files::{Part, Values};
use fovqa_testkit::synthetic::codes;
use serde_json::json;

use crate::fovqa::Folder;
use crate::frames::moving_frames::{
    H, MOTION, SIZE, W, atd, beyond_borders, experiment, float, half, is_steady, motion, moved,
    moving, near, part, plane, with_atd, write,
};
use crate::runs::experiment_folder;

/// Motion in any unit and direction, from channels of any name.
#[test]
fn named_channels_have_a_sign_a_scale_and_a_unit() {
    let folder = Folder::new();
    let [mx, my] = MOTION;
    let (w, h) = (W as f32, H as f32);
    for (table, [x, y]) in [
        ("channels = [\"Vector.X\", \"Vector.Y\"], sign = [1, -1]", [mx, -my]),
        ("channels = [\"Vector.X\", \"vector.y\"], sign = [-1, -1]", [-mx, -my]),
        ("channels = [\"Vector.Y\", \"Vector.X\"]", [my, mx]),
        ("channels = [\"Vector.X\", \"Vector.Y\"], unit = \"frame\"", [mx / w, my / h]),
        (
            "channels = [\"Vector.X\", \"Vector.Y\"], unit = \"ndc\", sign = [1, -1]",
            [mx / w * 2.0, -my / h * 2.0],
        ),
        ("channels = [\"Vector.X\", \"Vector.Y\"], scale = 2", [mx / 2.0, my / 2.0]),
        ("channels = [\"Vector.X\", \"Vector.Y\"], scale = [0.5, -4]", [mx * 2.0, my / -4.0]),
        ("preset = \"blender\"", [mx, -my]),
    ] {
        for frame in 0..2 {
            let channels = [("Vector.X", float(|_, _| x)), ("Vector.Y", float(|_, _| y))];
            let gt = part(moving(1, frame)).with(&channels);
            write(&folder, &format!("gt/{frame}.exr"), gt);
            write(&folder, &format!("test/{frame}.exr"), part(moving(2, frame)));
        }
        folder.write("e.toml", experiment(&format!("motion = {{ {table} }}\n")));
        folder.run(&["run", "e.toml"]).ok();
        let summary = experiment_folder::json(&folder, "reports/e/summary.json");
        is_steady(&summary["comparisons"][0]["atd"]);
    }
}

#[test]
fn renderers_are_known_by_their_channels() {
    let [mx, my] = MOTION;
    let (w, h) = (W as f32, H as f32);
    let unreal = "FinalImageMovieRenderQueue_MotionVectors";
    for (preset, names, [x, y]) in [
        ("blender", ["ViewLayer.Vector.X", "ViewLayer.Vector.Y"], [mx, -my]),
        ("falcor", ["mvec.R", "mvec.G"], [mx / w, my / h]),
        (
            "unreal",
            [&*format!("{unreal}.R"), &*format!("{unreal}.G")],
            [0.5 - mx / w / 2.0, 0.5 + my / h / 2.0],
        ),
        ("mitsuba", ["motion.X", "motion.Y"], [mx, my]),
    ] {
        let folder = Folder::new();
        for frame in 0..2 {
            let gt = part(moving(1, frame)).in_layer("ViewLayer.Combined");
            let gt = gt.with(&[(names[0], float(|_, _| x)), (names[1], float(|_, _| y))]);
            write(&folder, &format!("gt/{frame}.exr"), gt);
            write(&folder, &format!("test/{frame}.exr"), part(moving(2, frame)));
        }
        for which in [preset, "auto"] {
            // Whole pixels beyond an offset of a half: the rest of a float's rounding.
            let all = &atd(&folder, &["--motion", which])["sequence"]["atd"];
            is_steady(all);
            assert_eq!(all["motion"], "reference");
        }
    }
    let folder = moved(2);
    let run = folder.score(&["gt", "test", "--metrics", "atd", "--motion", "falcor"]);
    run.says(&["it has no motion channel (searched for mvec.R + mvec.G)"]);
}

#[test]
fn motion_and_depth_may_be_files_of_their_own() {
    let folder = Folder::new();
    let depth =
        |frame: usize| move |x: usize, _: usize| if frame == 0 && x < 8 { 1.0 } else { 2.0 };
    for frame in 0..3 {
        // The colour as PNG, which has neither.
        let code = |seed: usize| {
            let gray = plane(moving(seed, frame)).into_iter().map(|v| (v * 256.0) as u8);
            gray.flat_map(|code| [code; 3]).collect::<Vec<u8>>()
        };
        folder.png(&format!("gt/{frame:04}.png"), W, H, &code(1));
        folder.png(&format!("test/{frame:04}.png"), W, H, &code(2));
        let [x, y] = motion(MOTION).map(|(_, values)| values);
        write(
            &folder,
            &format!("motion/mv_{frame:04}.exr"),
            Part::new(SIZE, &[("X", x), ("Y", y)]),
        );
        let z = Part::new(SIZE, &[("Z", half(depth(frame)))]);
        write(&folder, &format!("depth/{frame:04}.exr"), z);
    }
    let plain = &atd(&folder, &[])["sequence"]["atd"];
    assert_eq!((&plain["motion"], &plain["depth"]), (&json!("none"), &json!("none")));
    is_steady(&atd(&folder, &["--motion-files", "motion"])["sequence"]["atd"]);
    let both = ["--motion-files", "motion/mv_%04d.exr", "--depth-files", "depth"];
    let json = atd(&folder, &both);
    let all = &json["sequence"]["atd"];
    assert_eq!((&all["motion"], &all["depth"]), (&json!("reference"), &json!("reference")));
    assert_eq!((&all["reference"], &all["test"]), (&json!(0.0), &json!(0.0)));
    let pixels = (W * H) as f64;
    // Of the eight near columns, five lie where the source of a pixel can be.
    let seen = (8 * (H - 2)) as f64 / pixels;
    near(&json["frames"][1]["atd"]["left_out"], beyond_borders() + seen);
    near(&json["frames"][2]["atd"]["left_out"], beyond_borders());
    folder.write(
        "e.toml",
        experiment("motion = { files = \"motion\" }\ndepth = { files = \"depth/%04d.exr\" }\n"),
    );
    folder.run(&["run", "e.toml"]).ok();
    let summary = experiment_folder::json(&folder, "reports/e/summary.json");
    assert_eq!(&summary["comparisons"][0]["atd"], all);
    let record = experiment_folder::json(&folder, "reports/e/run.json");
    let inputs = record["inputs"].as_array().unwrap();
    assert!(inputs.iter().any(|input| input["path"] == "motion/mv_0001.exr"), "{inputs:?}");
}

#[test]
fn motion_is_missing_in_the_first_frame_alone() {
    let folder = moved(5);
    write(&folder, "gt/0000.exr", part(moving(1, 0)));
    for which in ["auto", "mitsuba", "motion.X,motion.Y"] {
        is_steady(&atd(&folder, &["--motion", which])["sequence"]["atd"]);
    }
    write(&folder, "gt/0002.exr", part(moving(1, 2)));
    let run = folder.score(&["gt", "test", "--metrics", "atd", "--format", "json"]);
    assert_eq!(run.code, 3);
    let run = run.says(&["frame 2: gt/0002.exr has no motion vectors", "for all frames"]);
    let json = run.json();
    assert_eq!(with_atd(&json), [(0, false), (1, true), (3, false), (4, true)]);
    is_steady(&json["sequence"]["atd"]);
    // The same of depth, which the first frame has to have too.
    let folder = moved(3);
    for frame in 1..3 {
        let gt = part(moving(1, frame)).with(&motion(MOTION)).with(&[("Z", half(|_, _| 1.0))]);
        write(&folder, &format!("gt/{frame:04}.exr"), gt);
    }
    let run = folder.score(&["gt", "test", "--metrics", "atd", "--format", "json"]);
    assert_eq!(run.code, 3);
    run.says(&["frame 1: gt/0001.exr has depth, but earlier frames have none"]);
}

#[test]
fn channels_that_are_not_there_are_said_with_those_that_are() {
    let folder = moved(2);
    let fails = |arguments: &[&str], words: &[&str]| {
        let run = folder.score(&[&["gt", "test", "--metrics", "atd"], arguments].concat());
        assert_eq!(run.code, 3, "{}", run.stderr);
        run.says(words).says(&["--motion or --depth"]);
    };
    fails(
        &["--motion", "speed.X,speed.Y"],
        &[
            "frame 1: gt/0001.exr: it has no motion",
            "speed.X + speed.Y",
            "B, G, R, motion.X, motion.Y",
        ],
    );
    fails(
        &["--depth", "distance"],
        &["gt/0000.exr: it has no depth", "for distance", "B, G, R, motion.X, motion.Y"],
    );
    folder.write("e.toml", experiment("motion = { channels = [\"u\", \"v\"] }\n"));
    let run = folder.run(&["run", "e.toml"]);
    assert_eq!(run.code, 3);
    run.says(&["s, A, frame 1: gt/0001.exr: it has no motion", "u + v", "motion = { channels"]);
    // Only looked for: there need not be any.
    let folder = Folder::with_pair();
    folder.png_pair("gt/0.png", "test/0.png", 48, 40);
    folder.png_pair("gt/1.png", "test/1.png", 48, 40);
    folder.score(&["gt", "test", "--motion", "auto", "--depth", "auto"]).ok();
    let run = folder.score(&["gt", "test", "--motion", "blender"]);
    assert_eq!(run.code, 3);
    run.says(&["gt/1.png: it has no motion"]);
    // What is not asked for is not missed.
    folder.score(&["gt", "test", "--motion", "blender", "--metrics", "psnr"]).ok();
}

#[test]
fn motion_files_that_do_not_fit_are_errors_of_their_frame() {
    let folder = moved(3);
    for frame in 0..3 {
        let [x, y] = motion(MOTION);
        write(&folder, &format!("motion/{frame:04}.exr"), Part::new(SIZE, &[x, y]));
    }
    let score = || {
        folder.score(&[
            "gt",
            "test",
            "--motion-files",
            "motion",
            "--metrics",
            "atd",
            "--format",
            "json",
        ])
    };
    is_steady(&score().ok().json()["sequence"]["atd"]);
    let small = || Values::Half(vec![0.0; 10 * 8]);
    let small = Part::new((10, 8), &[("motion.X", small()), ("motion.Y", small())]);
    write(&folder, "motion/0002.exr", small);
    let run = score();
    assert_eq!(run.code, 3);
    let run = run.says(&["frame 2: gt/0002.exr has 64x32 pixels, but motion/0002.exr has 10x8"]);
    assert_eq!(with_atd(&run.json()), [(0, false), (1, true)]);
    std::fs::remove_file(folder.path("motion/0002.exr")).unwrap();
    let run = score();
    assert_eq!(run.code, 3);
    run.says(&["frame 2: gt/0002.exr: no motion file matches this frame"]);
    folder.png("motion/0002.png", W, H, &codes(W, H, 3, 1));
    let run = score();
    assert_eq!(run.code, 3);
    run.says(&["motion/0002.png: this is not an OpenEXR file; motion and depth are only read"]);
    folder
        .score(&["gt", "test", "--motion-files", "nowhere"])
        .fails(3, &["nowhere: there is no such file or folder"]);
}

/// The reference stands still, and the test moves.
#[test]
fn a_test_with_motion_and_depth_of_its_own_is_compared_along_them() {
    let folder = Folder::new();
    let z = |z: f32| [("Z", half(move |_, _| z))];
    for frame in 0..3 {
        let gt = part(moving(1, 0)).with(&motion([0.0; 2])).with(&z(1.0));
        write(&folder, &format!("gt/{frame}.exr"), gt);
        let test = part(moving(2, frame)).with(&motion(MOTION));
        write(&folder, &format!("test/{frame}.exr"), test);
    }
    let all = &atd(&folder, &[])["sequence"]["atd"];
    assert_eq!((&all["motion"], &all["depth"]), (&json!("test"), &json!("reference")));
    assert_eq!((&all["reference"], &all["test"]), (&json!(0.0), &json!(0.0)));
    assert_eq!(all["left_out"], 0.0);
    near(&all["left_out_test"], beyond_borders());
    // Also where the reference's motion stands in files of its own, but not by names that a user has
    // given these, which may be those of colours in a test.
    for frame in 0..3 {
        let [x, y] = motion([0.0; 2]).map(|(_, values)| values);
        write(&folder, &format!("mv/{frame}.exr"), Part::new(SIZE, &[("R", x), ("G", y)]));
    }
    let named = ["--motion-files", "mv", "--motion", "R,G"];
    for (arguments, source) in [(&named[..2], "test"), (&named[..], "reference")] {
        let all = &atd(&folder, arguments)["sequence"]["atd"];
        assert_eq!((&all["motion"], &all["reference"]), (&json!(source), &json!(0.0)));
        assert_eq!(all["test"] == 0.0, source == "test", "{all}");
    }
    // With a depth of its own that jumps, nothing of it can be compared.
    for frame in 0..3 {
        let test = part(moving(2, frame)).with(&motion(MOTION)).with(&z(1.0 + frame as f32));
        write(&folder, &format!("test/{frame}.exr"), test);
    }
    let json = atd(&folder, &[]);
    let all = &json["sequence"]["atd"];
    assert_eq!((&all["motion"], &all["depth"]), (&json!("test"), &json!("test")));
    assert_eq!((&all["left_out"], &all["left_out_test"]), (&json!(0.0), &json!(1.0)));
    assert_eq!((&all["test"], &all["ratio"]), (&json!(null), &json!(null)));
    assert_eq!(all["reason"], "no pixel can be compared");
    let frame = &json["frames"][1]["atd"];
    assert_eq!((&frame["test"], &frame["left_out_test"]), (&json!(null), &json!(1.0)));
}
