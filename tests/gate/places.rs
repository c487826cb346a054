//! A gate that fails says in which frame and where in it the loss is, and shows it.

use std::fs;

use fovqa_testkit::synthetic::{Xorshift, codes};
use serde_json::Value;

use crate::fovqa::Folder;

const WIDTH: usize = 320;
const HEIGHT: usize = 240;
const FRAMES: usize = 16;
/// Pixels in a degree at the centre of a picture 240 pixels and 60° high.
const PIXELS_PER_DEG: f64 = 3.6;

const RULES: &str = "[[gate]]\nmetric = \"psnr\"\nper_frame = true\nmax_drop = 0.005\n\
                     [[gate]]\nmetric = \"ssim\"\nper_frame = true\nmax_drop = 0.0001\n\
                     [[gate]]\nmetric = \"fvvdp\"\nper_frame = true\nmax_drop = 0.0001\n";

fn experiment(rules: &str) -> String {
    format!(
        "name = \"e\"\n[view]\nfov_vertical_deg = 60\nbands_deg = [0, 5, 10, 20, 30, 50]\n\
         luminance = \"htc-vive-pro\"\n[[scene]]\nname = \"s\"\nreference = \"gt\"\nfps = 60\n\
         [[method]]\nname = \"A\"\ntest = \"test\"\n\
         [metrics]\npsnr = {{}}\nssim = {{}}\nfvvdp = {{}}\n{rules}"
    )
}

/// A texture that moves to the left, and the same as a method shows it: blurred away from the centre.
fn pictures() -> Vec<[Vec<u8>; 2]> {
    let wide = codes(WIDTH + 4 * FRAMES, HEIGHT, 3, 5);
    let frame = |n: usize| {
        let row = |y: usize| {
            let from = (y * (WIDTH + 4 * FRAMES) + 4 * n) * 3;
            wide[from..from + WIDTH * 3].to_vec()
        };
        let reference: Vec<u8> = (0..HEIGHT).flat_map(row).collect();
        let mut random = Xorshift::new(n as u64 + 1);
        let blurred = blurred(&reference, 0.8);
        let test = (0..reference.len()).map(|i| {
            let far = [i / 3 % WIDTH, i / 3 / WIDTH];
            let far = (far[0] as f64 - 160.0).hypot(far[1] as f64 - 120.0) > 60.0;
            let noise = random.next_unit() * 4.0 - 2.0;
            (f64::from(if far { blurred[i] } else { reference[i] }) + noise).round() as u8
        });
        [reference.clone(), test.collect()]
    };
    (0..FRAMES).map(frame).collect()
}

/// Gaussian blur, straight from its definition.
fn blurred(codes: &[u8], sigma: f64) -> Vec<u8> {
    let radius = (3.0 * sigma).ceil() as i64;
    let weights: Vec<f64> =
        (-radius..=radius).map(|d| (-0.5 * (d as f64 / sigma).powi(2)).exp()).collect();
    let along = |values: &[f64], step: [i64; 2]| -> Vec<f64> {
        let value = |i: usize| {
            let [x, y, c] = [i / 3 % WIDTH, i / 3 / WIDTH, i % 3];
            let (mut sum, mut whole) = (0.0, 0.0);
            for (weight, d) in weights.iter().zip(-radius..) {
                let x = x as i64 + d * step[0];
                let y = y as i64 + d * step[1];
                if (0..WIDTH as i64).contains(&x) && (0..HEIGHT as i64).contains(&y) {
                    sum += weight * values[(y as usize * WIDTH + x as usize) * 3 + c];
                    whole += weight;
                }
            }
            sum / whole
        };
        (0..values.len()).map(value).collect()
    };
    let values: Vec<f64> = codes.iter().map(|code| f64::from(*code)).collect();
    along(&along(&values, [1, 0]), [0, 1]).iter().map(|value| value.round() as u8).collect()
}

/// Blurs a frame within so many degrees of a place.
fn blur_patch(codes: &mut [u8], [x, y]: [f64; 2], radius_deg: f64) {
    let soft = blurred(codes, 1.5);
    for (i, code) in codes.iter_mut().enumerate() {
        let [dx, dy] = [(i / 3 % WIDTH) as f64 - x, (i / 3 / WIDTH) as f64 - y];
        if dx.hypot(dy) <= radius_deg * PIXELS_PER_DEG {
            *code = soft[i];
        }
    }
}

fn write(folder: &Folder, pictures: &[[Vec<u8>; 2]]) {
    for (n, [reference, test]) in pictures.iter().enumerate() {
        folder.png(&format!("gt/{n:04}.png"), WIDTH, HEIGHT, reference);
        folder.png(&format!("test/{n:04}.png"), WIDTH, HEIGHT, test);
    }
}

/// A run of the good build, with a baseline that keeps frames and one that does not.
fn good(rules: &str) -> (Folder, Vec<[Vec<u8>; 2]>) {
    let folder = Folder::new();
    let pictures = pictures();
    write(&folder, &pictures);
    folder.write("e.toml", experiment(rules));
    folder.run(&["run", "e.toml", "--output", "good"]).ok();
    folder.run(&["baseline", "save", "good", "plain.json"]).ok();
    let saved = folder.run(&["baseline", "save", "good", "kept.json", "--frames"]).ok();
    saved.says(&["16 frames are kept beside it"]);
    (folder, pictures)
}

fn verdict(folder: &Folder, baseline: &str) -> Value {
    let run = folder.run(&[
        "gate",
        "e.toml",
        "--output",
        "bad",
        "--baseline",
        baseline,
        "--format",
        "json",
    ]);
    assert_eq!(run.code, 1, "{}{}", run.stdout, run.stderr);
    run.json()
}

/// Degrees between the place of a loss and one in pixels.
fn degrees_from(loss: &Value, [x, y]: [f64; 2]) -> f64 {
    let focal = HEIGHT as f64 / 2.0 / 30.0_f64.to_radians().tan();
    let ray = |x: f64, y: f64| [x - WIDTH as f64 / 2.0, y - HEIGHT as f64 / 2.0, focal];
    let (a, b) = (ray(x, y), ray(number(&loss["place"]["x_px"]), number(&loss["place"]["y_px"])));
    let dot = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    (dot(a, b) / (dot(a, a) * dot(b, b)).sqrt()).acos().to_degrees()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value}"))
}

#[track_caller]
fn names(verdict: &Value, frames: &[i64], place: Option<[f64; 2]>, compared: &str) {
    for rule in verdict["rules"].as_array().unwrap() {
        let check = &rule["checks"][0];
        assert_eq!(check["state"], "failed", "{rule:#}");
        let loss = &check["losses"][0];
        let frame = loss["frame"].as_i64().unwrap();
        assert!(frames.contains(&frame), "{frame}: {rule:#}");
        let Some(place) = place else { continue };
        assert_eq!(loss["place"]["compared"], compared, "{rule:#}");
        let degrees = degrees_from(loss, place);
        assert!(degrees <= 5.0, "{degrees}: {rule:#}");
    }
}

/// The page begins with the verdict, and has the pictures of the frame.
#[track_caller]
fn page_shows(folder: &Folder, frame: i64) {
    let page = fs::read_to_string(folder.path("bad/report.html")).unwrap();
    let sections: Vec<usize> = page.match_indices("<h2 id=").map(|(at, _)| at).collect();
    assert!(page[sections[0]..].starts_with("<h2 id=\"verdict\" class=\"bad\">The gate fails"));
    let verdict = &page[sections[0]..sections[1]];
    assert!(verdict.contains(&format!("<p>frame {frame}: ")), "{frame}");
    let pictures = verdict.matches("<img src=\"data:image/png;base64,").count();
    assert!((4..=24).contains(&pictures), "{pictures}");
    for name in ["this-build", "difference", "crop"] {
        assert!(verdict.contains(&format!("gate/s/A/{frame:04}/{name}.png")), "{name}");
        assert!(folder.path(&format!("bad/gate/s/A/{frame:04}/{name}.png")).is_file());
    }
}

#[test]
fn a_blurred_patch_of_one_frame_is_found() {
    let (folder, pictures) = good(RULES);
    for (place, radius) in [([172.0, 110.0], 2.5), ([50.0, 40.0], 2.5)] {
        let mut bad = pictures.clone();
        blur_patch(&mut bad[7][1], place, radius);
        write(&folder, &bad);
        for (baseline, compared) in [("kept.json", "baseline"), ("plain.json", "neighbours")] {
            let verdict = verdict(&folder, baseline);
            names(&verdict, &[7], Some(place), compared);
            page_shows(&folder, 7);
            let [psnr, fvvdp] = [0, 2].map(|rule| &verdict["rules"][rule]["checks"][0]);
            let failing: Vec<i64> = psnr["frames"]
                .as_array()
                .unwrap()
                .iter()
                .map(|frame| frame["frame"].as_i64().unwrap())
                .collect();
            assert_eq!(failing, [7]);
            assert_eq!(fvvdp["losses"][0]["metric"], "psnr", "the frame's own difference decides");
        }
    }
}

#[test]
fn a_whole_frame_and_a_swapped_one_are_found() {
    let (folder, pictures) = good(RULES);
    let mut bad = pictures.clone();
    bad[9][1] = blurred(&bad[9][1], 1.5);
    write(&folder, &bad);
    names(&verdict(&folder, "kept.json"), &[9], None, "baseline");
    page_shows(&folder, 9);
    let mut bad = pictures;
    bad.swap(4, 5);
    let references = [bad[5][0].clone(), bad[4][0].clone()];
    [bad[4][0], bad[5][0]] = references;
    write(&folder, &bad);
    names(&verdict(&folder, "kept.json"), &[4, 5], None, "baseline");
}

/// A loss in the mean of a sequence that no frame's rule looks at is still in one frame.
#[test]
fn a_rule_of_the_mean_names_the_frame_that_lost_most() {
    let rules =
        "[[gate]]\nmetric = \"psnr\"\nmax_drop = 0\n[[gate]]\nmetric = \"fvvdp\"\nmax_drop = 0\n";
    let (folder, pictures) = good(rules);
    let mut bad = pictures.clone();
    blur_patch(&mut bad[11][1], [172.0, 110.0], 4.0);
    write(&folder, &bad);
    names(&verdict(&folder, "kept.json"), &[11], Some([172.0, 110.0]), "baseline");
    // Nothing is left of an earlier verdict where the gate holds.
    write(&folder, &pictures);
    let run = folder.run(&["gate", "e.toml", "--output", "bad", "--baseline", "kept.json"]).ok();
    assert!(run.stdout.contains("the gate holds"), "{}", run.stdout);
    assert!(!folder.path("bad/gate/s").exists());
    let page = fs::read_to_string(folder.path("bad/report.html")).unwrap();
    assert!(page.contains("<h2 id=\"verdict\">The gate holds: 2 rules"));
}

/// A run that was scored before is shown as well, if its files are still there.
#[test]
fn a_finished_run_is_looked_at_again() {
    let (folder, pictures) = good(RULES);
    let mut bad = pictures;
    blur_patch(&mut bad[3][1], [172.0, 110.0], 2.5);
    write(&folder, &bad);
    folder.run(&["run", "e.toml", "--output", "bad"]).ok();
    let gate =
        ["gate", "bad", "--baseline", "kept.json", "--markdown", "gate.md", "--junit", "gate.xml"];
    let run = folder.run(&gate);
    assert_eq!(run.code, 1, "{}", run.stderr);
    assert!(run.stdout.contains("frames that fail: 3 ("), "{}", run.stdout);
    page_shows(&folder, 3);
    let markdown = fs::read_to_string(folder.path("gate.md")).unwrap();
    assert!(markdown.contains("(bad/gate/s/A/0003/crop.png)"), "{markdown}");
    let junit = fs::read_to_string(folder.path("gate.xml")).unwrap();
    assert!(
        junit.contains("most is lost in ") && junit.contains("bad/gate/s/A/0003/crop.png"),
        "{junit}"
    );
    fs::rename(folder.path("gt"), folder.path("gone")).unwrap();
    let run = folder.run(&gate);
    assert_eq!(run.code, 1, "{}", run.stderr);
    assert!(run.stdout.contains("frame 3: psnr "), "{}", run.stdout);
    run.says(&["frames with a loss are not looked at again"]);
    // What an earlier gate has found out about the same values stays.
    page_shows(&folder, 3);
    fs::rename(folder.path("gone"), folder.path("gt")).unwrap();
    folder.png("test/0003.png", WIDTH, HEIGHT, &blurred(&bad[3][1], 1.5));
    folder.run(&gate).says(&["test/0003.png: the file has changed since it was scored"]);
}

#[test]
fn frames_of_another_baseline_are_not_shown() {
    let (folder, pictures) = good(RULES);
    let good_test = pictures[3][1].clone();
    let mut bad = pictures;
    blur_patch(&mut bad[7][1], [172.0, 110.0], 2.5);
    write(&folder, &bad);
    let text = fs::read_to_string(folder.path("plain.json")).unwrap();
    let other = text.replacen("\"psnr mean\": ", "\"psnr mean\": 1", 1);
    assert_ne!(text, other);
    folder.write("kept.json", other);
    let run = folder.run(&["gate", "e.toml", "--output", "bad", "--baseline", "kept.json"]);
    assert_eq!(run.code, 1);
    run.says(&["kept.frames: these frames belong to another baseline"]);
    assert!(!folder.path("bad/gate/s/A/0007/last-good.png").exists());
    // Accepted values have no frames of others beside them.
    let run = folder.run(&["baseline", "accept", "bad", "kept.json"]).ok();
    run.says(&["the frames of the earlier values were removed"]);
    assert!(!folder.path("kept.frames").exists());
    folder.run(&["baseline", "accept", "bad", "kept.json", "--frames"]).ok().says(&["16 frames"]);
    // Frames are prepared in a folder of our own: one of the user's beside the baseline stays.
    folder.write("kept.frames-new/notes.txt", "mine");
    folder.run(&["baseline", "accept", "bad", "kept.json", "--frames"]).ok().says(&["16 frames"]);
    assert!(folder.path("kept.frames-new/notes.txt").exists());
    assert!(!folder.path(".fovqa-kept.frames").exists());
    // A file that has changed since is not what was scored.
    let before = fs::read(folder.path("kept.json")).unwrap();
    folder.png("test/0002.png", WIDTH, HEIGHT, &good_test);
    folder.run(&["baseline", "accept", "bad", "kept.json", "--frames"]).fails(
        3,
        &["test/0002.png: the file has changed since it was scored", "nothing was changed"],
    );
    assert_eq!(fs::read(folder.path("kept.json")).unwrap(), before);
    assert!(folder.path("kept.frames/frames.json").is_file());
    assert!(!folder.path(".fovqa-kept.frames").exists());
}

/// A fixed limit can be broken although nothing was lost: the worst frame and place are told, and are not
/// called a loss against the baseline.
#[test]
fn without_a_loss_the_worst_frame_is_told() {
    let (folder, _) = good("[[gate]]\nmetric = \"psnr\"\nat_least = 90\n");
    let verdict = verdict(&folder, "kept.json");
    let check = &verdict["rules"][0]["checks"][0];
    let loss = &check["losses"][0];
    assert_eq!(loss["frame"], check["worst_frame"]);
    assert_ne!(loss["compared"], "baseline");
    assert_ne!(loss["band"]["compared"], "baseline");
    assert_eq!(loss["place"]["compared"], "nothing");
}

/// What is kept of the last good build may be damaged: then the frames beside it are compared.
#[test]
fn damaged_frames_of_a_baseline_cost_their_pictures_alone() {
    let (folder, pictures) = good(RULES);
    let mut bad = pictures;
    blur_patch(&mut bad[7][1], [172.0, 110.0], 2.5);
    write(&folder, &bad);
    let kept = |name: &str| format!("kept.frames/images/s/0007/methods/A/{name}");
    let maps = fs::read_to_string(folder.path(&kept("test.json"))).unwrap();
    fs::remove_file(folder.path(&kept("page.webp"))).unwrap();
    for damaged in [
        maps.replace("\"block\":", "\"block\":1"),
        maps.replace("\"rows\":", "\"rows\":9999999999"),
        maps[..maps.len() / 2].to_owned(),
    ] {
        folder.write(&kept("test.json"), damaged);
        names(&verdict(&folder, "kept.json"), &[7], Some([172.0, 110.0]), "neighbours");
        assert!(!folder.path("bad/gate/s/A/0007/last-good.png").exists());
    }
}

/// Each rule shows the place of its own map and band.
#[test]
fn rules_that_point_elsewhere_in_a_frame_have_pictures_of_their_own() {
    let rule = |band: &str| {
        format!("[[gate]]\nmetric = \"ssim\"\nper_frame = true\n{band}max_drop = 0.0001\n")
    };
    let rules = format!("{}{}", rule("band_deg = [0, 5]\n"), rule("band_deg = [20, 50]\n"));
    let (folder, pictures) = good(&rules);
    let mut bad = pictures;
    let places = [[166.0, 114.0], [40.0, 40.0]];
    for place in places {
        blur_patch(&mut bad[7][1], place, 3.0);
    }
    write(&folder, &bad);
    let verdict = verdict(&folder, "kept.json");
    for (rule, (place, name)) in places.into_iter().zip(["crop.png", "crop-2.png"]).enumerate() {
        let loss = &verdict["rules"][rule]["checks"][0]["losses"][0];
        assert!(degrees_from(loss, place) <= 5.0, "{loss:#}");
        let pictures = loss["pictures"].as_array().unwrap();
        assert_eq!(pictures.last().unwrap()["path"], format!("gate/s/A/0007/{name}"));
    }
}

/// A gate that is not possible leaves no file that says that it holds.
#[test]
fn files_of_an_earlier_gate_do_not_stay() {
    let (folder, _) = good(RULES);
    let gate = |baseline: &str| {
        folder.run(&[
            "gate",
            "e.toml",
            "--output",
            "out",
            "--baseline",
            baseline,
            "--junit",
            "g.xml",
            "--markdown",
            "g.md",
        ])
    };
    gate("kept.json").ok();
    assert!(fs::read_to_string(folder.path("g.md")).unwrap().contains("the gate holds"));
    gate("gone.json").fails(3, &["gone.json"]);
    let junit = fs::read_to_string(folder.path("g.xml")).unwrap();
    assert!(junit.contains("errors=\"1\"") && !junit.contains("the gate holds"), "{junit}");
    let markdown = fs::read_to_string(folder.path("g.md")).unwrap();
    assert!(!markdown.contains("holds") && markdown.contains("the gate was not possible"));
}

#[test]
fn pictures_of_a_baseline_are_small() {
    let (folder, _) = good(RULES);
    let page = folder.path("kept.frames/images/s/0007/methods/A/page.webp");
    let bytes = fs::metadata(&page).unwrap().len();
    assert!((1000..=200_000).contains(&bytes), "{bytes}");
}
