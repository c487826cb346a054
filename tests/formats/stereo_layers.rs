//! Motion and depth of the view and layer that is scored, among those of others.

use fovqa_testkit::exr_files::{File, Part, Values};
use serde_json::{Value, json};

use crate::fovqa::{Folder, Run, root};
use crate::frames::moving_frames::{
    ENCODED, MOTION, SIZE, beyond_borders, float, is_steady, moving, near, part, write,
};
use crate::runs::experiment_folder;

const RIGHT: &str = "ViewLayer.Combined-right.ViewLayer.Combined";

/// `score gt gt --metrics atd` of the case, and more.
fn case(arguments: &[&str]) -> Run {
    let gt = root().join("tests/cases/blender-stereo/gt");
    let gt = gt.to_str().unwrap();
    let score = ["score", gt, gt, "--metrics", "atd", "--fov-vertical", "60", "--format", "json"];
    crate::fovqa::command(&[&score, arguments].concat()).output().unwrap().into()
}

#[track_caller]
fn is_of_the_right_eye(run: Run) {
    let atd = run.ok().json()["sequence"]["atd"].clone();
    let value = atd["reference"].as_f64().unwrap();
    assert!((value - 0.001_928_2).abs() < 5e-8, "{atd}");
    assert_eq!((&atd["motion"], &atd["depth"]), (&json!("test"), &json!("test")));
}

#[test]
fn an_eye_of_blender_has_its_own_motion_and_depth() {
    let motion =
        ["ViewLayer.Vector-right.ViewLayer.Vector.X", "ViewLayer.Vector-right.ViewLayer.Vector.Y"];
    let [x, y] = motion;
    for arguments in [
        &["--layer", RIGHT][..],
        &["--layer", "right"],
        &["--layer", "ViewLayer.Combined-right", "--motion", "blender", "--depth", "blender"],
        &["--layer", RIGHT, "--motion", &format!("blender:{x},{y}")],
        &["--layer", RIGHT, "--motion", &format!("{x},-{y}")],
    ] {
        is_of_the_right_eye(case(arguments));
    }
    let left = case(&["--layer", "left"]).ok().json()["sequence"]["atd"]["reference"].clone();
    assert!((left.as_f64().unwrap() - 0.001_928_2).abs() > 1e-6, "{left}");
    // Without its sign, a pass of Blender is another motion.
    case(&["--layer", RIGHT, "--motion", &format!("{x},{y}")]).fails(
        2,
        &[
            "blender writes these channels",
            "--motion blender,",
            &format!("--motion blender:{x},{y}"),
            &format!("+{x},+{y}"),
        ],
    );
    let run = case(&["--layer", RIGHT, "--motion", "Speed.X,Speed.Y"]);
    assert_eq!(run.code, 3);
    run.says(&[
        "no motion channel (searched for Speed.X + Speed.Y)",
        "--motion RENDERER:X,Y",
        "X,-Y for y up",
    ]);
    case(&[]).says(&["several colour layers", RIGHT, "--layer"]);
}

#[test]
fn experiments_say_how_named_channels_are_encoded() {
    let folder = Folder::new();
    let gt = root().join("tests/cases/blender-stereo/gt");
    let experiment = |motion: &str| {
        format!(
            "name = \"e\"\n[view]\nfov_vertical_deg = 60\n[signal]\nlayer = \"right\"\nmotion = {{ {motion} }}\n\
             [[scene]]\nname = \"s\"\nreference = '{gt}'\n[[method]]\nname = \"m\"\ntest = '{gt}'\n\
             [metrics]\natd = {{}}\n",
            gt = gt.display()
        )
    };
    let channels = "channels = [\"ViewLayer.Vector-right.ViewLayer.Vector.X\", \"ViewLayer.Vector-right.ViewLayer.Vector.Y\"]";
    for (more, motion) in
        [(", sign = [1, -1]", None), (", encoding = \"blender\"", Some(json!("blender")))]
    {
        folder.write("e.toml", experiment(&format!("{channels}{more}")));
        folder.run(&["run", "e.toml"]).ok();
        let summary = experiment_folder::json(&folder, "reports/e/summary.json");
        let value = summary["comparisons"][0]["atd"]["reference"].as_f64().unwrap();
        assert!((value - 0.001_928_2).abs() < 5e-8, "{value}");
        let record = experiment_folder::json(&folder, "reports/e/run.json");
        let resolved = &record["resolved"]["scenes"][0]["eyes"][0]["signal"]["motion"];
        assert_eq!(resolved.get("encoding"), motion.as_ref());
    }
    folder.write("e.toml", experiment(channels));
    folder.run(&["run", "e.toml"]).fails(
        2,
        &["blender writes these channels", "add encoding = \"blender\", or sign = [1, 1]"],
    );
    folder
        .write("e.toml", experiment(&format!("{channels}, encoding = \"blender\", sign = [1, 1]")));
    folder.run(&["run", "e.toml"]).fails(2, &["both sign and an encoding with its own"]);
}

/// Blender's passes of a layer, moving as `motion` says.
fn passes(layer: &str, [x, y]: [f32; 2]) -> Vec<(String, Values)> {
    let vector = [("X", x), ("Y", -y), ("Z", 0.0), ("W", 0.0)];
    let vector = vector.map(|(name, value)| (format!("{layer}{name}"), float(|_, _| value)));
    vector.to_vec()
}

fn atd(folder: &Folder, arguments: &[&str]) -> Run {
    let score = ["gt", "test", "--metrics", "atd", "--format", "json", "--test-layer", "root"];
    folder.score(&[&score, &ENCODED[..], arguments].concat())
}

/// Two views that move differently, in one of the ways that files tell views apart; the test has none.
fn two_views(
    parts: impl Fn(Part, Part, [Vec<(String, Values)>; 2]) -> Vec<Part>,
    passes_at: [&str; 2],
) -> Folder {
    let folder = Folder::new();
    for frame in 0..2 {
        let [left, right] = [moving(7, 0), moving(1, frame)].map(part);
        let passes = [passes(passes_at[0], [5.0, 1.0]), passes(passes_at[1], MOTION)];
        let name = format!("gt/{frame}.exr");
        File::new(parts(left, right, passes)).write(&folder.path(&name));
        write(&folder, &format!("test/{frame}.exr"), part(moving(2, frame)));
    }
    folder
}

fn of(channels: Vec<(String, Values)>) -> Part {
    Part { channels, ..Part::new(SIZE, &[]) }
}

#[test]
fn views_are_told_by_attributes_or_names() {
    // The parts of Blender, with and without the attribute, and parts whose names tell nothing.
    let in_parts = |names: [&'static str; 4], views: [&'static str; 2]| {
        move |left: Part, right: Part, [a, b]: [Vec<(String, Values)>; 2]| {
            vec![
                left.in_layer("VL.Combined").named(names[0]).of_view(views[0]),
                right.in_layer("VL.Combined").named(names[1]).of_view(views[1]),
                of(a).named(names[2]).of_view(views[0]),
                of(b).named(names[3]).of_view(views[1]),
            ]
        }
    };
    let blender = ["VL.Combined-left", "VL.Combined-right", "VL.Vector-left", "VL.Vector-right"];
    let vector = ["VL.Vector."; 2];
    let files = [
        two_views(in_parts(blender, ["left", "right"]), vector),
        two_views(in_parts(blender, ["", ""]), vector),
        two_views(in_parts(["a", "b", "c", "d"], ["left", "right"]), vector),
        // The parts have the names, and the channels are X and Y.
        two_views(in_parts(blender, ["", ""]), [""; 2]),
    ];
    for folder in files {
        for layer in [&["--layer", "right"][..], &["--layer", "right", "--motion", "blender"]] {
            let run = atd(&folder, layer).ok();
            is_steady(&run.json()["sequence"]["atd"]);
        }
    }
    // One part, where the channels of the first view need no name of it.
    let one = |left: Part, right: Part, [a, b]: [Vec<(String, Values)>; 2]| {
        let mut part = left.in_layer("VL.Combined.left");
        part.channels.extend(right.in_layer("VL.Combined.right").channels);
        part.channels.extend(a.into_iter().chain(b));
        vec![part.of_views(&["left", "right"])]
    };
    let folder = two_views(one, ["VL.Vector.left.", "VL.Vector.right."]);
    let run = atd(&folder, &["--layer", "VL.Combined.right"]).ok();
    is_steady(&run.json()["sequence"]["atd"]);
    let plain = |left: Part, right: Part, [a, b]: [Vec<(String, Values)>; 2]| {
        let mut part = left;
        part.channels.extend(right.in_layer("right").channels);
        part.channels.extend(a.into_iter().chain(b));
        vec![part.of_views(&["left", "right"])]
    };
    let folder = two_views(plain, ["Vector.", "Vector.right."]);
    is_steady(&atd(&folder, &["--layer", "right"]).ok().json()["sequence"]["atd"]);
}

/// Nothing says that the motion of one eye is that of the other one.
#[test]
fn motion_of_the_other_view_alone_is_not_taken() {
    let folder = two_views(
        |left, right, [_, b]| {
            vec![
                left.in_layer("VL.Combined").named("VL.Combined-left"),
                right.in_layer("VL.Combined").named("VL.Combined-right"),
                of(b).named("VL.Vector-right"),
            ]
        },
        ["VL.Vector."; 2],
    );
    let names = "VL.Vector-right.VL.Vector.X + VL.Vector-right.VL.Vector.Y";
    let run = atd(&folder, &["--layer", "left"]).ok();
    assert_eq!(run.json()["sequence"]["atd"]["motion"], "none");
    run.says(&[names, "belongs to another view or layer", "without motion vectors"]);
    let run = atd(&folder, &["--layer", "left", "--motion", "blender"]);
    assert_eq!(run.code, 3);
    run.says(&["no motion for the view and layer of the colour", names, "--motion RENDERER:X,Y"]);
    // Unless it is named in full.
    let [x, y] = ["X", "Y"].map(|axis| format!("VL.Vector-right.VL.Vector.{axis}"));
    let run = atd(&folder, &["--layer", "left", "--motion", &format!("blender:{x},{y}")]).ok();
    assert_eq!(run.json()["sequence"]["atd"]["motion"], "reference");
}

#[test]
fn view_layers_have_their_own_motion_and_depth() {
    let folder = Folder::new();
    let file = |own: bool, frame: usize| {
        let mut all = part(moving(1, frame)).in_layer("Front.Combined");
        all.channels.extend(part(moving(3, 0)).in_layer("Back.Combined").channels);
        all.channels.extend(passes("Back.Vector.", [4.0, 4.0]));
        all.channels.push(("Back.Depth.Z".to_owned(), float(|x, _| (x + 9 * frame) as f32)));
        if own {
            all.channels.extend(passes("Front.Vector.", MOTION));
            all.channels.push(("Front.Depth.Z".to_owned(), float(|_, _| 2.0)));
        }
        all
    };
    for frame in 0..2 {
        write(&folder, &format!("test/{frame}.exr"), part(moving(2, frame)));
    }
    let score = |own: bool| {
        for frame in 0..2 {
            write(&folder, &format!("gt/{frame}.exr"), file(own, frame));
        }
        atd(&folder, &["--layer", "Front.Combined"]).ok()
    };
    let all = &score(true).json()["sequence"]["atd"];
    assert_eq!((&all["motion"], &all["depth"]), (&json!("reference"), &json!("reference")));
    assert_eq!((&all["reference"], &all["test"]), (&json!(0.0), &json!(0.0)));
    near(&all["left_out"], beyond_borders());
    let run = score(false);
    let all: &Value = &run.json()["sequence"]["atd"];
    assert_eq!((&all["motion"], &all["depth"]), (&json!("none"), &json!("none")));
    run.says(&[
        "Back.Vector.X + Back.Vector.Y is not used as the motion",
        "Back.Depth.Z is not used",
    ]);
}

/// Unreal does not say how its motion is scaled.
#[test]
fn the_motion_of_unreal_comes_with_a_warning() {
    let folder = Folder::new();
    let [x, y] = MOTION;
    let (w, h) = (SIZE.0 as f32, SIZE.1 as f32);
    for frame in 0..2 {
        let unreal = "FinalImageMovieRenderQueue_MotionVectors";
        let names = ["R", "G", "B"].map(|name| format!("{unreal}.{name}"));
        let values = [0.5 - x / w / 2.0, 0.5 + y / h / 2.0, 0.0];
        let mut gt = part(moving(1, frame));
        let motion = names.into_iter().zip(values.map(|value| float(move |_, _| value)));
        gt.channels.extend(motion);
        write(&folder, &format!("gt/{frame}.exr"), gt);
        write(&folder, &format!("test/{frame}.exr"), part(moving(2, frame)));
    }
    for which in ["auto", "unreal"] {
        let run = atd(&folder, &["--motion", which]).ok();
        is_steady(&run.json()["sequence"]["atd"]);
        run.says(&["2 (v - 0.5) of the frame", "check it with a known motion"]);
    }
}
