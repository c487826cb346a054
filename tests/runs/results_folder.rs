//! The folder of results: the same bytes always, one run at a time, nothing lost.

use std::fs;
use std::path::Path;

use serde_json::Value;

#[cfg(target_os = "linux")]
use crate::fovqa::peak_kb;
use crate::fovqa::{Folder, Run, command, root};
use crate::runs::experiment_folder::{HEAD, bytes, experiment, json, rows, two_scenes};

#[test]
fn the_same_bytes_for_any_threads_and_again_by_report() {
    let folder = two_scenes();
    folder.run(&["run", "e.toml", "--threads", "1", "--output", "one"]).ok();
    folder.run(&["run", "e.toml", "--threads", "8", "--output", "eight"]).ok();
    let one = bytes(&folder.path("one"));
    for file in ["results.csv", "summary.json", "run.json", "table.md", "plots/profile-psnr.png"] {
        assert!(one.contains_key(file), "{file} is not among {:?}", one.keys());
    }
    assert_eq!(one, bytes(&folder.path("eight")));
    // Again over the old results, and drawn again without scoring.
    folder.run(&["run", "e.toml", "--output", "one"]).ok();
    assert_eq!(one, bytes(&folder.path("one")));
    fs::remove_dir_all(folder.path("room")).unwrap();
    fs::remove_dir_all(folder.path("eight/plots")).unwrap();
    for file in ["table.md", "table.csv", "index.html", "report.html"] {
        fs::remove_file(folder.path(&format!("eight/{file}"))).unwrap();
    }
    folder.run(&["report", "eight"]).ok();
    assert_eq!(one, bytes(&folder.path("eight")));
}

/// Whatever went wrong on the way: results name files as the experiment does.
#[test]
fn results_do_not_tell_where_they_were_made() {
    let folder = two_scenes();
    fs::remove_file(folder.path("room/a/0001.png")).unwrap();
    folder.write("room/b/0001.png", "no picture");
    fs::remove_dir_all(folder.path("hall/b")).unwrap();
    folder.write("gaze.csv", "frame,x_px,y_px\n0,1,1\n");
    folder.png("mask.png", 48, 40, &[255; 48 * 40]);
    let scene = "[[scene]]\nname = \"short\"\nreference = \"room/gt\"\nfolder = \"room\"\n";
    let text = experiment("").replace("\"{scene}/a\"", "\"{folder}/a\"").replace(
        "[[method]]\nname = \"A\"",
        &format!("{scene}gaze = {{ trace = \"gaze.csv\" }}\n{scene2}mask = \"mask.png\"\ngaze = {{ trace = \"gaze.csv\", hold = true }}\n[[method]]\nname = \"A\"", scene2 = scene.replace("short", "masked")),
    );
    folder.write("e.toml", text);
    assert_eq!(folder.run(&["run", "e.toml", "--output", "here"]).code, 3);
    let here = bytes(&folder.path("here"));
    let elsewhere = Folder::new();
    let file = folder.path("e.toml").canonicalize().unwrap();
    let run = elsewhere.run(&["run", file.to_str().unwrap(), "--output", "there"]);
    assert_eq!(run.code, 3);
    run.says(&[
        "hall, B: hall/b: there is no such file or folder",
        "starts in the folder of the experiment file",
        "short, A: gaze.csv: it has no gaze for frame",
        "room, B, frame 1: room/b/0001.png: this is not a PNG",
        "room, A: reference without a test frame: room/gt/0001.png",
    ]);
    assert_eq!(here, bytes(&elsewhere.path("there")));
    let record = json(&folder, "here/run.json");
    let inputs = record["inputs"].as_array().unwrap();
    let paths: Vec<&str> = inputs.iter().map(|input| input["path"].as_str().unwrap()).collect();
    assert!(paths.is_sorted());
    for name in ["hall/a/0000.png", "hall/gt/0002.png", "gaze.csv", "mask.png"] {
        let input = &inputs[paths.iter().position(|path| *path == name).unwrap()];
        let file = fs::read(folder.path(name)).unwrap();
        let id = fovqa_io::id_of(file.as_slice()).unwrap();
        assert_eq!(
            (input["bytes"].as_u64(), input["sha256"].as_str()),
            (Some(id.bytes), Some(id.sha256.as_str()))
        );
    }
}

#[test]
fn a_folder_that_cannot_be_written_is_found_before_scoring() {
    let folder = two_scenes();
    folder.write("file", "");
    folder.write("room/gt/0000.png", "no picture: scoring would say so");
    let run = folder.run(&["run", "e.toml", "--output", "file/results"]);
    let run = run.fails(3, &["file/results: cannot write results to this folder", "--output"]);
    assert!(!run.stderr.contains("0000.png"), "{}", run.stderr);
    folder
        .run(&["run", "e.toml", "--output", "file"])
        .fails(3, &["file: cannot write results to this folder"]);
    // What is not ours is not replaced: neither results nor drawings, nor by way of a list of files.
    for file in
        ["index.html", "report.html", "table.csv", "journal.jsonl", "run.json", "report.json"]
    {
        let folder_of = format!("own/{file}");
        folder.write(&format!("{folder_of}/{file}"), "{\"files\": [\"thesis.tex\"]}");
        folder.write(&format!("{folder_of}/thesis.tex"), "mine");
        folder
            .run(&["run", "e.toml", "--output", &folder_of])
            .fails(3, &["that no run of fovqa has written", file]);
        assert!(folder.path(&format!("{folder_of}/thesis.tex")).exists());
    }
    folder.run(&["report", "own/run.json"]).fails(3, &["run.json"]);
    assert!(!folder.path("own/run.json/.fovqa.lock").exists(), "not even a lock");
    folder.write("mine/results.csv", "a,b\n");
    folder
        .run(&["run", "e.toml", "--output", "mine"])
        .fails(3, &["mine: the folder contains a results.csv that no run of fovqa has written"]);
    assert_eq!(fs::read(folder.path("mine/results.csv")).unwrap(), b"a,b\n");
}

/// An experiment that takes a while.
#[cfg(unix)]
fn long() -> Folder {
    let folder = Folder::new();
    folder.png_pair("gt/0000.png", "a/0000.png", 1000, 1000);
    for frame in 1..1000 {
        for side in ["gt", "a"] {
            let first = folder.path(&format!("{side}/0000.png"));
            fs::hard_link(first, folder.path(&format!("{side}/{frame:04}.png"))).unwrap();
        }
    }
    let scene =
        "[[scene]]\nname = \"s\"\nreference = \"gt\"\n[[method]]\nname = \"A\"\ntest = \"a\"\n";
    folder.write("e.toml", format!("{HEAD}{scene}"));
    folder
}

/// The journal, as soon as it has some frames.
#[cfg(unix)]
fn wait_for_frames(journal: &Path) -> String {
    for _ in 0..3000 {
        let text = fs::read_to_string(journal).unwrap_or_default();
        if text.matches("\"values\"").count() > 3 {
            return text;
        }
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    panic!("no frame was journaled in half a minute")
}

#[cfg(unix)]
#[test]
fn one_run_at_a_time_and_a_killed_one_leaves_its_journal() {
    let folder = long();
    folder.write("reports/e/old.txt", "not ours");
    let mut first = command(&["run", "e.toml"])
        .current_dir(folder.path(""))
        .stdout(std::process::Stdio::null())
        .stderr(std::process::Stdio::null())
        .spawn()
        .unwrap();
    let journal = folder.path("reports/e/journal.jsonl");
    wait_for_frames(&journal);
    folder
        .run(&["run", "e.toml"])
        .fails(3, &["reports/e: another run is writing to this folder", "--output"]);
    folder.run(&["run", "e.toml", "--frames", "0..1", "--output", "other"]).ok();
    first.kill().unwrap();
    first.wait().unwrap();
    // Every line but a last piece is whole, and has what a frame was found to have.
    let text = fs::read_to_string(&journal).unwrap();
    let whole = text.rsplit_once('\n').unwrap().0;
    let lines: Vec<Value> = whole.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(lines[0]["schema"], "fovqa.journal/2");
    let inputs = lines.iter().filter(|line| line["input"] == "gt/0000.png");
    assert_eq!(inputs.count(), 1, "an input is recorded once");
    let frame = lines.iter().find(|line| line["frame"] == 0).unwrap();
    let row = rows(&folder, "other").into_iter().find(|row| row["metric"] == "psnr").unwrap();
    // As many numbers stand before PSNR as the keys before it have: each its value and its parts.
    let keys = lines.iter().find(|line| !line["keys"]["layout"].is_null()).unwrap();
    let keys = keys["keys"]["layout"].as_array().unwrap();
    let before = keys.iter().take_while(|key| key[0] != "psnr");
    let before: u64 = before.map(|key| 1 + key[5].as_u64().unwrap()).sum();
    assert_eq!(frame["values"][before as usize].as_f64(), row["value"].parse().ok());
    // The lock went with the process; nothing looks like finished results.
    assert!(!folder.path("reports/e/results.csv").exists());
    folder.run(&["report", "reports/e"]).fails(3, &["no finished run"]);
    folder.run(&["run", "e.toml", "--frames", "0..2"]).ok();
    assert!(folder.path("reports/e/results.csv").exists());
    assert!(folder.path("reports/e/old.txt").exists(), "what is not ours stays");
}

#[test]
fn another_run_takes_the_place_of_the_last() {
    let folder = two_scenes();
    folder.run(&["run", "e.toml", "--output", "out"]).ok();
    assert!(folder.path("out/plots/profile-ssim-hall.svg").exists());
    folder.write("out/plots/mine.svg", "not ours");
    folder.write("e.toml", experiment("[metrics]\npsnr = {}\n[[plot]]\nkind = \"bars\"\n"));
    folder.run(&["run", "e.toml", "--output", "out"]).ok();
    let plots: Vec<String> = bytes(&folder.path("out/plots")).into_keys().collect();
    assert_eq!(
        plots,
        ["bars-psnr.csv", "bars-psnr.pdf", "bars-psnr.png", "bars-psnr.svg", "mine.svg"]
    );
    assert!(!folder.path("out/table.md").exists(), "it was not asked for");
}

#[test]
fn a_report_needs_a_finished_run() {
    let folder = two_scenes();
    folder.run(&["report", "nowhere"]).fails(3, &["nowhere: the folder contains no finished run"]);
    folder.run(&["run", "e.toml", "--output", "out"]).ok();
    let whole = fs::read_to_string(folder.path("out/run.json")).unwrap();
    let newer = whole.replace("fovqa.run/1", "fovqa.run/9");
    let nobody = whole.replace("\"A\",\n      \"B\"", "");
    folder.write("out/run.json", &nobody);
    folder.run(&["report", "out"]).ok();
    folder.write("out/run.json", &whole);
    for (file, text) in [
        ("results.csv", "a,b\n1,2\n"),
        ("summary.json", "{}"),
        ("run.json", "{\"schema\": \"fovqa.run/1\"}"),
        ("run.json", &newer),
    ] {
        let path = format!("out/{file}");
        let whole = fs::read(folder.path(&path)).unwrap();
        folder.write(&path, text);
        folder.run(&["report", "out"]).fails(3, &[&path, "it is not"]);
        folder.write(&path, whole);
    }
    folder.run(&["report", "out"]).ok();
}

/// Decoded, a frame here takes 590 kB: 200 of them with four tests each would take 590 MB.
#[cfg(target_os = "linux")]
#[test]
fn memory_for_pixels_does_not_grow_with_frames() {
    const SIDE: usize = 443;
    let folder = Folder::new();
    folder.png_pair("gt/0000.png", "a/0000.png", SIDE, SIDE);
    for frame in 0..200 {
        for side in ["gt", "a", "b", "c", "d"] {
            let first = folder.path(if side == "gt" { "gt/0000.png" } else { "a/0000.png" });
            let to = folder.path(&format!("{side}/{frame:04}.png"));
            if !to.exists() {
                fs::hard_link(first, to).unwrap();
            }
        }
    }
    let methods: String = ["a", "b", "c", "d"]
        .map(|m| format!("[[method]]\nname = \"{m}\"\ntest = \"{m}\"\n"))
        .concat();
    folder.write(
        "e.toml",
        format!("{HEAD}[[scene]]\nname = \"s\"\nreference = \"gt\"\n{methods}[[plot]]\nkind = \"table\"\n"),
    );
    let ten = peak_kb(&folder, &["run", "e.toml", "--threads", "2", "--frames", "0..10"]);
    let all = peak_kb(&folder, &["run", "e.toml", "--threads", "2"]);
    assert!(ten > 0 && all < ten + 16_000, "{ten} kB for 10 frames, {all} kB for 200");
}

/// All that is found of a frame, with every default metric: what is kept of it until the end is small.
#[cfg(target_os = "linux")]
#[test]
fn memory_for_values_hardly_grows_with_frames() {
    let folder = Folder::new();
    folder.png_pair("gt/0000.png", "a/0000.png", 48, 40);
    for frame in 1..1000 {
        for side in ["gt", "a"] {
            let first = folder.path(&format!("{side}/0000.png"));
            fs::hard_link(first, folder.path(&format!("{side}/{frame:04}.png"))).unwrap();
        }
    }
    folder.write(
        "e.toml",
        format!("{HEAD}[[scene]]\nname = \"s\"\nreference = \"gt\"\n[[method]]\nname = \"A\"\ntest = \"a\"\n[[plot]]\nkind = \"table\"\n"),
    );
    let ten = peak_kb(&folder, &["run", "e.toml", "--threads", "2", "--frames", "0..10"]);
    let all = peak_kb(&folder, &["run", "e.toml", "--threads", "2"]);
    assert!(ten > 0 && all < ten + 3_000, "{ten} kB for 10 frames, {all} kB for 1000");
    let haar = rows(&folder, "reports/e").iter().filter(|row| row["metric"] == "haar").count();
    assert!(haar > 1000 * 5 * 7, "{haar}");
}

/// A drawing that does not need a file any more takes it away, and no other.
#[test]
fn a_new_drawing_takes_away_what_it_does_not_draw() {
    let folder = two_scenes();
    folder.run(&["run", "e.toml", "--output", "out"]).ok();
    let run = fs::read_to_string(folder.path("out/run.json")).unwrap();
    let plots = "\"plots\": [{\"kind\": \"bars\", \"metric\": \"ssim\", \"scenes\": null, \"methods\": null}]";
    assert!(run.contains("\"plots\": []"));
    folder.write("out/run.json", run.replace("\"plots\": []", plots));
    folder.write("out/plots/mine.svg", "not ours");
    // Nor what a list of drawn files names that no drawing could have written.
    folder.write("out/thesis.tex", "not ours");
    let list = fs::read_to_string(folder.path("out/report.json")).unwrap();
    let longer = list.replace("\"index.html\"", "\"index.html\", \"thesis.tex\", \"../e.toml\"");
    folder.write("out/report.json", longer);
    folder.run(&["report", "out"]).ok();
    assert!(folder.path("out/thesis.tex").exists() && folder.path("e.toml").exists());
    let plots: Vec<String> = bytes(&folder.path("out/plots")).into_keys().collect();
    assert_eq!(
        plots,
        ["bars-ssim.csv", "bars-ssim.pdf", "bars-ssim.png", "bars-ssim.svg", "mine.svg"]
    );
    assert!(!folder.path("out/table.md").exists());
}

/// A drawing that is broken off leaves no figures that nobody knows of.
#[test]
fn what_a_broken_drawing_left_is_taken_away() {
    let folder = two_scenes();
    folder.run(&["run", "e.toml", "--output", "out"]).ok();
    fs::remove_file(folder.path("out/index.html")).unwrap();
    fs::create_dir(folder.path("out/index.html")).unwrap();
    let run = folder.run(&["run", "e.toml", "--output", "out"]);
    assert_eq!(run.code, 3);
    run.says(&["index.html: it cannot be written", "`fovqa report` draws them"]);
    fs::remove_dir(folder.path("out/index.html")).unwrap();
    folder.write(
        "e.toml",
        experiment("")
            .replace("\"hall\"", "\"lobby\"\nfolder = \"hall\"")
            .replace("{scene}", "{folder}"),
    );
    folder.run(&["run", "e.toml", "--output", "out"]).ok();
    let left: Vec<String> =
        bytes(&folder.path("out/plots")).into_keys().filter(|f| f.contains("hall")).collect();
    assert!(left.is_empty(), "{left:?}");
}

#[test]
fn a_closed_pipe_is_no_error() {
    use std::process::Stdio;
    let folder = two_scenes();
    let mut child = command(&["run", "e.toml"])
        .current_dir(folder.path(""))
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let run = Run::from(child.wait_with_output().unwrap());
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(folder.path("reports/e/report.html").exists());
}

/// The demo needs nothing but its experiment. The README shows the table that it prints, and
/// `reports/sample` has some of the files that it writes.
#[test]
fn the_demo_is_as_committed() {
    let makefile = fs::read_to_string(root().join("Makefile")).unwrap();
    let demo = makefile.split("demo:").nth(1).unwrap().split("\n\n").next().unwrap();
    let arguments: Vec<&str> = demo.split(" -- ").nth(1).unwrap().split_whitespace().collect();
    assert_eq!(arguments, ["run", "configs/demo.toml"]);
    let folder = Folder::new();
    fs::create_dir(folder.path("configs")).unwrap();
    fs::copy(root().join("configs/demo.toml"), folder.path("configs/demo.toml")).unwrap();
    let table = folder.run(&arguments).ok().stdout;
    let readme = fs::read_to_string(root().join("README.md")).unwrap();
    assert!(readme.contains(&table), "{table}");
    let found = bytes(&folder.path("reports/demo"));
    let sample = root().join("reports/sample");
    let plots = ["psnr", "haar", "atd"].map(|metric| format!("plots/profile-{metric}.png"));
    let tables = ["csv", "md", "tex"].map(|ending| format!("table.{ending}"));
    let pages = ["report.html", "index.html"].map(str::to_owned);
    let mut size = 0;
    for file in plots.into_iter().chain(tables).chain(pages) {
        let committed = fs::read(sample.join(&file)).unwrap();
        assert!(found[&file] == committed, "{file}: make sample, look at it, commit it");
        size += committed.len();
    }
    assert!(size < 2_000_000, "{size} bytes are committed");
}
