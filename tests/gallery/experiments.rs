//! Built-in scenes as references of experiments.

use crate::fovqa::Folder;
use crate::runs::experiment_folder::{bytes, json, rows};
use crate::runs::shards::divided;

fn experiment(scene: &str, methods: &str) -> String {
    format!(
        "name = \"e\"\n[view]\nfov_vertical_deg = 90\nbands_deg = [0, 15, 30]\n[[scene]]\nname = \"s\"\n{scene}\n\
         {methods}\n[metrics]\npsnr = {{}}\natd = {{}}\n[[plot]]\nkind = \"table\"\n"
    )
}

const SCENE: &str =
    "builtin = \"gallery\"\nresolution = \"96x80\"\nframes = 4\nsamples = 2\nseed = 3";

const METHODS: &str = "[[method]]\nname = \"R\"\nemulate = { model = \"rmfr\", temporal = true }\n\
                       [[method]]\nname = \"K\"\nemulate = { model = \"kfr\", keep_frames = true }\n";

/// Gate, shards, resuming and maps work without any file.
#[test]
fn a_built_in_scene_is_a_reference_like_any_other() {
    let folder = Folder::new();
    let gate = "[[gate]]\nmetric = \"psnr\"\nat_least = 10\n";
    folder.write("e.toml", experiment(SCENE, METHODS) + gate);
    let maps = ["run", "e.toml", "--output", "maps-run", "--maps", "maps", "--threads", "1"];
    folder.run(&maps).ok();
    assert!(folder.path("maps/s/R/mse-0003.exr").exists());
    assert_eq!(divided(&folder, 3, 0), vec![0; 3]);
    let run = folder.run(&["run", "e.toml", "--output", "whole", "--resume"]).ok();
    run.says(&["8 frames are finished"]);
    folder.run(&["gate", "whole"]).ok();
    let kept = |results: &str| {
        let files = bytes(&folder.path(results)).into_iter();
        files.filter(|(name, _)| name.starts_with("emulated/")).collect::<Vec<_>>()
    };
    assert_eq!(kept("whole").len(), 4);
    assert_eq!(kept("whole"), kept("maps-run"), "the same for any number of threads");
    // The gaze is that of the viewer, motion and depth those of the scene.
    let rows = rows(&folder, "whole");
    assert!(rows.iter().any(|row| row["metric"] == "gaze_x_px"));
    let summary = json(&folder, "whole/summary.json");
    assert_eq!(summary["comparisons"][0]["atd"]["motion"], "reference");
    assert_eq!(summary["comparisons"][0]["atd"]["depth"], "reference");
    let resolved = &json(&folder, "whole/run.json")["resolved"]["scenes"][0]["eyes"][0];
    assert_eq!(resolved["reference"], "builtin:gallery");
    assert_eq!(resolved["builtin"]["spec"]["seed"], 3);
    // Another seed is another scene.
    folder.write("e.toml", experiment(&SCENE.replace("seed = 3", "seed = 4"), METHODS) + gate);
    let run = folder.run(&["run", "e.toml", "--output", "whole", "--resume"]).ok();
    run.says(&["everything is scored again"]);
}

#[test]
fn two_eyes_see_the_scene_from_their_own_places() {
    let folder = Folder::new();
    let method = "[[method]]\nname = \"R\"\nemulate = { model = \"rmfr\", keep_frames = true, other_eye = { sigma = 4 } }\n";
    folder.write("e.toml", experiment(&format!("{SCENE}\nipd_mm = 64"), method));
    folder.run(&["run", "e.toml", "--output", "out"]).ok();
    let [left, right] = ["left", "right"].map(|eye| {
        std::fs::read(folder.path(&format!("out/emulated/s/R/{eye}/0002.exr"))).unwrap()
    });
    assert_ne!(left, right);
    let eyes = &json(&folder, "out/run.json")["resolved"]["scenes"][0]["eyes"];
    assert_eq!(
        (&eyes[0]["builtin"]["eye_m"], &eyes[1]["builtin"]["eye_m"]),
        (&(-0.032).into(), &0.032.into())
    );
}

#[test]
fn patterns_need_no_view() {
    let folder = Folder::new();
    for scene in ["pattern-a", "pattern_b", "pattern-c", "stripes", "csf-chart"] {
        folder.write(
            "e.toml",
            format!(
                "name = \"e\"\n[[scene]]\nname = \"s\"\nbuiltin = \"{scene}\"\nresolution = \"96x80\"\n\
                 samples = 4\n[[method]]\nname = \"R\"\nemulate = {{ model = \"rmfr\" }}\n[metrics]\nmse = {{}}\n"
            ),
        );
        folder.run(&["run", "e.toml", "--output", "out"]).ok();
    }
}

#[test]
fn mistakes_are_shown_in_their_place() {
    let folder = Folder::new();
    for (scene, said) in [
        ("", "scene \"s\" has neither reference nor builtin"),
        ("builtin = \"gallery\"\nreference = \"gt\"", "has both reference and builtin"),
        ("builtin = \"galery\"", "did you mean \"gallery\"?"),
        ("builtin = \"gallery\"", "the size of the frames of scene \"s\" is not known"),
        (
            "builtin = \"gallery\"\nresolution = \"96x80\"\nframes = 0",
            "scene \"s\".frames cannot be 0",
        ),
        (
            "builtin = \"gallery\"\nresolution = \"96x80\"\nsamples = 1000000",
            "samples cannot be 1000000",
        ),
        ("builtin = \"gallery\"\nresolution = \"96x80\"\nframes = \"0..3\"", "write their number"),
        ("builtin = \"gallery\"\nresolution = \"96x80\"\ncrop = [0, 0, 9, 9]", "crop is for files"),
        ("reference = \"gt\"\nsamples = 4", "samples is for built-in scenes"),
        ("reference = \"gt\"\nframes = 4", "a number of frames is for built-in scenes"),
        ("builtin = \"gallery\"\nresolution = \"40000x80\"", "each side 1 to 32768"),
        ("builtin = \"gallery\"\nresolution = \"96x80\"\nipd_mm = -3", "ipd_mm cannot be -3"),
    ] {
        folder.write("e.toml", experiment(scene, METHODS));
        folder.run(&["run", "e.toml", "--output", "out"]).fails(2, &[said]);
    }
    let no_view =
        experiment(SCENE, METHODS).replace("fov_vertical_deg = 90\nbands_deg = [0, 15, 30]\n", "");
    folder.write("e.toml", no_view);
    folder.run(&["run", "e.toml", "--output", "out"]).fails(2, &["scene \"s\" has no view"]);
}
