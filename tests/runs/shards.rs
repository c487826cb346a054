//! Runs in shards, and shards put together.

use std::fs;
use std::path::Path;

use fovqa_testkit::exr_files::{File, Part};

use crate::fovqa::{Folder, Run};
use crate::frames::moving_frames::{SIZE, moving};
use crate::runs::experiment_folder::{bytes, rows};
use crate::runs::interrupted_runs::{
    FRAMES, assert_same, journal, results, sealed, sequence, two_scenes,
};

/// Runs one shard, into `NAME-I-of-N`.
pub(crate) fn shard(folder: &Folder, name: &str, index: usize, of: usize) -> Run {
    let shard = format!("{index}/{of}");
    let output = format!("{name}-{index}-of-{of}");
    folder.run(&["run", "e.toml", "--shard", &shard, "--output", &output])
}

fn merge(folder: &Folder, shards: &[String], output: &str) -> Run {
    let shards: Vec<&str> = shards.iter().map(String::as_str).collect();
    folder.run(&[&["merge"][..], &shards, &["--output", output]].concat())
}

pub(crate) fn names(name: &str, of: usize) -> Vec<String> {
    (1..=of).map(|index| format!("{name}-{index}-of-{of}")).collect()
}

/// The run as a whole, and from so many shards; the exits of the shards.
#[track_caller]
pub(crate) fn divided(folder: &Folder, of: usize, code: i32) -> Vec<i32> {
    let (codes, merged, _) = put_together(folder, of, code);
    assert_same(&results(&folder.path(&merged)), &results(&folder.path("whole")), &merged);
    codes
}

/// Scores an experiment as a whole and in shards, and merges them: the exit codes of the shards, the
/// merged folder and what was said of it.
pub(crate) fn put_together(folder: &Folder, of: usize, code: i32) -> (Vec<i32>, String, String) {
    if !folder.path("whole/run.json").exists() {
        assert_eq!(folder.run(&["run", "e.toml", "--output", "whole"]).code, code);
    }
    let codes = (1..=of).map(|index| shard(folder, "s", index, of).code).collect();
    let merged = format!("merged-{of}");
    // Whichever way round they are given.
    let mut shards = names("s", of);
    shards.reverse();
    let run = merge(folder, &shards, &merged);
    assert_eq!(run.code, code, "{}", run.stderr);
    (codes, merged, run.stderr)
}

#[test]
fn shards_put_together_are_the_run() {
    let folder = two_scenes();
    for of in [1, 3, 7, 36, 50] {
        assert_eq!(divided(&folder, of, 0), vec![0; of]);
    }
    // Without the inputs, and without the experiment.
    for name in ["moving", "eyes", "gaze.csv", "e.toml"] {
        fs::rename(folder.path(name), folder.path(&format!("gone-{name}"))).unwrap();
    }
    merge(&folder, &names("s", 7), "again").ok().says(&["again/report.html"]);
    assert_same(&results(&folder.path("again")), &results(&folder.path("whole")), "again");
    for name in ["moving", "eyes", "gaze.csv", "e.toml"] {
        fs::rename(folder.path(&format!("gone-{name}")), folder.path(name)).unwrap();
    }
    // What has come together is a run like any other, which can be gone on with.
    let run = folder.run(&["run", "e.toml", "--resume", "--output", "again"]).ok();
    run.says(&["36 frames are finished"]);
    assert_same(&results(&folder.path("again")), &results(&folder.path("whole")), "resumed");
}

#[test]
fn sequences_are_cut_anywhere() {
    for padding in ["replicate", "circular", "pingpong"] {
        let folder = sequence(padding);
        // Each pair by itself, each frame by itself, and within frames.
        for of in [2 * FRAMES, FRAMES, 5, 2] {
            assert_eq!(divided(&folder, of, 0), vec![0; of]);
        }
    }
}

/// Frames that cannot be scored: in the middle, first of all, and where the first one looks ahead.
#[test]
fn what_cannot_be_scored_is_the_same_in_shards() {
    for (padding, broken, of) in [
        ("replicate", vec!["a/0005.exr"], vec![2, 3, 7, 24]),
        ("replicate", vec!["gt/0000.exr", "b/0001.exr"], vec![2, 3, 7, 24]),
        ("replicate", vec!["gt/0004.exr", "b/0007.exr"], vec![5, 24]),
        ("circular", vec!["b/0008.exr"], vec![3, 24]),
        ("pingpong", vec!["a/0003.exr", "a/0010.exr"], vec![3, 24]),
    ] {
        let folder = sequence(padding);
        for file in &broken {
            folder.write(&format!("moving/{file}"), "no picture");
        }
        for of in of {
            let codes = divided(&folder, of, 3);
            let failed = codes.iter().filter(|code| **code == 3).count();
            assert!(failed >= 1 && failed <= 2 * broken.len(), "{codes:?}");
            assert!(of < 24 || codes.contains(&0), "only those that have such a frame: {codes:?}");
        }
    }
}

/// What a sequence carries is settled by its first frames, wherever a shard begins.
#[test]
fn motion_that_stops_is_seen_by_shards() {
    let folder = sequence("replicate");
    for frame in 6..FRAMES {
        let to = folder.path(&format!("moving/gt/{frame:04}.exr"));
        fs::copy(folder.path(&format!("moving/a/{frame:04}.exr")), to).unwrap();
    }
    let run = folder.run(&["run", "e.toml", "--output", "whole"]);
    assert_eq!(run.code, 3);
    run.says(&["has no motion vectors, but earlier frames have some"]);
    for of in [2, 5, 24] {
        divided(&folder, of, 3);
    }
}

/// Bad pixels that are left out: some, which the next frame has to know of, and all of a frame.
#[test]
fn pixels_that_are_left_out_are_the_same_in_shards() {
    let folder = sequence("replicate");
    let bad = |frame: usize, bad: fn(usize, usize) -> bool| {
        let value = move |x, y| if bad(x, y) { f32::NAN } else { moving(2, frame * frame)(x, y) };
        File::new(vec![Part::rgb(SIZE, value)])
            .write(&folder.path(&format!("moving/a/{frame:04}.exr")));
    };
    bad(3, |x, y| x < 20 && y < 9);
    bad(7, |_, _| true);
    let text = fs::read_to_string(folder.path("e.toml")).unwrap();
    let text = text.replace("[signal]\n", "[signal]\nnonfinite = \"mask\"\n");
    let without = text.replace("fvvdp = { temp_padding = \"replicate\" }", "");
    for (text, errors) in
        [(text, "is not defined where pixels are left out"), (without, "no pixel")]
    {
        folder.write("e.toml", text);
        let run = folder.run(&["run", "e.toml", "--output", "whole"]);
        assert_eq!(run.code, 3);
        run.says(&[errors]);
        for of in [2, 3, 24] {
            divided(&folder, of, 3);
        }
        let lines = journal(&folder, "whole");
        for end in 1..=lines.len() {
            folder.write("cut/journal.jsonl", lines[..end].concat());
            let run = folder.run(&["run", "e.toml", "--resume", "--output", "cut"]);
            assert_eq!(run.code, 3, "{}", run.stderr);
            assert_same(&results(&folder.path("cut")), &results(&folder.path("whole")), "cut");
        }
        fs::remove_dir_all(folder.path("whole")).unwrap();
    }
}

/// Frames of another size than the first, bad pixels that are left out, gaps, and a scene without a view.
#[test]
fn other_frames_are_the_same_in_shards() {
    let folder = crate::runs::experiment_folder::two_scenes();
    for side in ["gt", "a", "b"] {
        folder.png(&format!("hall/{side}/0001.png"), 60, 40, &vec![9; 60 * 40 * 3]);
        fs::remove_file(folder.path(&format!("room/{side}/0001.png"))).unwrap();
    }
    fs::remove_file(folder.path("room/b/0002.png")).unwrap();
    folder.write("hall/gt/0000.png", "no picture");
    for of in [1, 2, 4, 9] {
        divided(&folder, of, 3);
    }
    // With the default metrics, which depend on the first frame.
    let text = fs::read_to_string(folder.path("e.toml")).unwrap();
    let (text, _) = text.split_once("[metrics]").unwrap();
    let scene = "\"{scene}/gt\"\nallow_missing = true";
    folder.write("e.toml", text.replace("\"{scene}/gt\"", scene));
    fs::remove_dir_all(folder.path("whole")).unwrap();
    for of in [1, 2, 4, 9] {
        divided(&folder, of, 3);
    }
}

#[test]
fn a_missing_gaze_or_mask_is_the_same_in_shards() {
    let folder = crate::runs::experiment_folder::two_scenes();
    let text = fs::read_to_string(folder.path("e.toml")).unwrap();
    for key in ["gaze = { trace = \"nowhere.csv\" }", "mask = \"nowhere.png\""] {
        folder.write("e.toml", text.replace("\"room/gt\"", &format!("\"room/gt\"\n{key}")));
        for of in [1, 3, 7] {
            divided(&folder, of, 3);
        }
        fs::remove_dir_all(folder.path("whole")).unwrap();
    }
    // A whole method, and everything.
    fs::remove_dir_all(folder.path("hall/b")).unwrap();
    folder.write("e.toml", &text);
    let codes = divided(&folder, 3, 3);
    assert_eq!(codes, [0, 0, 0], "all frames that are there are scored");
    fs::remove_dir_all(folder.path("whole")).unwrap();
    fs::remove_dir_all(folder.path("hall")).unwrap();
    fs::remove_dir_all(folder.path("room")).unwrap();
    divided(&folder, 2, 3);
}

#[test]
fn a_shard_leaves_its_journal_and_its_values() {
    let folder = two_scenes();
    folder.run(&["run", "e.toml", "--output", "s"]).ok();
    let run = folder.run(&["run", "e.toml", "--shard", "2/3", "--output", "s"]).ok();
    assert_eq!(run.stdout, "", "nothing that looks like a result");
    run.says(&["s: shard 2/3 of e, 12 frames; `fovqa merge` joins shards"]);
    let mut files = bytes(&folder.path("s"));
    assert!(
        !files.contains_key("images/images.json"),
        "which frames are shown is known at the end"
    );
    files.retain(|file, _| !file.starts_with("images/"));
    assert_eq!(files.into_keys().collect::<Vec<_>>(), ["journal.jsonl", "values.parquet"]);
    let lines = journal(&folder, "s");
    assert!(lines[0].contains("\"shard\":\"2/3\""));
    assert_eq!(*lines.last().unwrap(), sealed("{\"done\":true,\"sum\":\"\"}\n"));
    for command in ["report", "gate"] {
        folder
            .run(&[command, "s"])
            .fails(3, &["s: the folder contains shard 2/3 of a run", "`fovqa merge`"]);
    }
    // Where no folder is named, each has one of its own.
    let run = folder.run(&["run", "e.toml", "--shard", "36/40"]).ok();
    run.says(&["reports/e-shard-36-of-40", "1 frame;"]);
    folder.run(&["run", "e.toml", "--shard", "1/40"]).ok().says(&["0 frames"]);
    for bad in ["0/3", "4/3", "1/0", "1/10001", "x", "1", "-1/3", "1/3/3"] {
        folder
            .run(&["run", "e.toml", &format!("--shard={bad}")])
            .fails(2, &["is not a shard: write I/N"]);
    }
    folder.run(&["run", "e.toml", "--shard", "10000/10000", "--output", "last"]).ok();
}

/// A shard goes on where it was broken off, like a whole run.
#[test]
fn a_shard_is_gone_on_with() {
    for broken in [None, Some("moving/a/0005.exr")] {
        let folder = sequence("replicate");
        if let Some(file) = broken {
            folder.write(file, "no picture");
        }
        let code = if broken.is_some() { 3 } else { 0 };
        divided(&folder, 3, code);
        // The shard whose first frame is behind the one that is broken.
        let lines = journal(&folder, "s-2-of-3");
        for end in 0..=lines.len() {
            folder.write("s-2-of-3/journal.jsonl", lines[..end].concat());
            if end < lines.len() {
                merge(&folder, &names("s", 3), "none").fails(3, &["s-2-of-3"]);
                assert!(!folder.path("none").exists(), "nothing is written");
            }
            let run = folder
                .run(&["run", "e.toml", "--shard", "2/3", "--resume", "--output", "s-2-of-3"]);
            assert!(run.code == 0 || (run.code == 3 && broken.is_some()), "{}", run.stderr);
            assert_eq!(merge(&folder, &names("s", 3), "merged").code, code);
            assert_same(&results(&folder.path("merged")), &results(&folder.path("whole")), "cut");
        }
        // Another share of the same run is no beginning of this one.
        let run =
            folder.run(&["run", "e.toml", "--shard", "2/4", "--resume", "--output", "s-2-of-3"]);
        run.says(&["it contains shard 2/3, but this is shard 2/4", "everything is scored again"]);
    }
}

/// A frame in front of a shard that could not be compared, and is mended.
#[test]
fn what_lies_before_a_shard_may_be_mended() {
    let folder = sequence("replicate");
    let text = fs::read_to_string(folder.path("e.toml")).unwrap();
    let without = text.replace("fvvdp = { temp_padding = \"replicate\" }", "");
    let whole = fs::read(folder.path("moving/a/0005.exr")).unwrap();
    for text in [text, without] {
        folder.write("e.toml", text);
        folder.write("moving/a/0005.exr", "no picture");
        assert_eq!(shard(&folder, "s", 1, 2).code, 3);
        let run = shard(&folder, "s", 2, 2).ok();
        assert!(!run.stderr.contains("0005"), "it is not of this shard: {}", run.stderr);
        folder.write("moving/a/0005.exr", &whole);
        for index in ["1/2", "2/2"] {
            let output = format!("s-{}", index.replace('/', "-of-"));
            folder.run(&["run", "e.toml", "--shard", index, "--resume", "--output", &output]).ok();
        }
        folder.run(&["run", "e.toml", "--output", "whole"]).ok();
        merge(&folder, &names("s", 2), "merged").ok();
        assert_same(&results(&folder.path("merged")), &results(&folder.path("whole")), "mended");
    }
}

#[test]
fn shards_that_do_not_belong_together_are_told() {
    let folder = crate::runs::experiment_folder::two_scenes();
    for index in 1..=3 {
        shard(&folder, "s", index, 3).ok();
    }
    let s = names("s", 3);
    let fails = |shards: &[&str], words: &[&str]| {
        let shards: Vec<String> = shards.iter().map(|name| (*name).to_owned()).collect();
        merge(&folder, &shards, "none").fails(3, words);
        assert!(!folder.path("none").exists(), "nothing is written");
    };
    let [one, two, three] = [&s[0], &s[1], &s[2]].map(String::as_str);
    fails(&[one, three], &["a shard is missing: 2/3"]);
    fails(&[two], &["shards are missing: 1/3, 3/3"]);
    fs::create_dir(folder.path("empty")).unwrap();
    fails(&[one, two, three, two], &["shard 2/3 was given twice: s-2-of-3 and s-2-of-3"]);
    fails(&[one, two, "empty"], &["empty: the folder contains no shard of a run"]);
    fails(&[one, two, "nowhere"], &["nowhere: the folder contains no shard of a run"]);
    fails(&[one, two, "e.toml"], &["e.toml: the folder contains no shard of a run"]);
    folder.run(&["run", "e.toml", "--output", "all"]).ok();
    fails(&["all"], &["all: the folder contains a complete run, not a shard"]);
    folder.run(&["merge", one, two, three, "--output", one]).fails(2, &["one of the shards"]);
    folder.run(&["merge", "--output", "none"]).fails(2, &[]);
    // Of the version before values had one form.
    let lines = journal(&folder, three);
    let old = lines.concat().replace("fovqa.journal/2", "fovqa.journal/1");
    folder.write("s-3-of-3/journal.jsonl", old);
    fails(
        &[one, two, three],
        &["another version of fovqa wrote this shard, in format fovqa.journal/1"],
    );
    // Not finished, in several ways.
    let write = |lines: &[String]| folder.write("s-3-of-3/journal.jsonl", lines.concat());
    let unfinished = ["s-3-of-3: shard 3/3 is not finished", "--resume"];
    let mut without = lines.clone();
    without.remove(lines.iter().position(|line| line.contains("\"values\"")).unwrap());
    let mut behind = lines.clone();
    behind.push(lines[2].clone());
    for other in [&lines[..lines.len() - 1], &lines[..4], &without, &behind] {
        write(other);
        fails(&[one, two, three], &unfinished);
    }
    write(&[lines.concat().trim_end().to_owned()]);
    fails(&[one, two, three], &unfinished);
    // Of other runs.
    let other = |from: &str, to: &str, words: &[&str]| {
        let text = lines.concat();
        assert!(text.contains(from), "{from}");
        let text: String = text.replacen(from, to, 1).split_inclusive('\n').map(sealed).collect();
        folder.write("s-3-of-3/journal.jsonl", text);
        fails(&[one, two, three], words);
    };
    other(
        "\"version\":\"0.1.0\"",
        "\"version\":\"0.0.9\"",
        &["fovqa 0.0.9 wrote", "this is fovqa 0.1.0"],
    );
    other(
        "\"frames\":null",
        "\"frames\":\"0..2:1\"",
        &["frames all and 0..2:1", "belong to different runs"],
    );
    other(
        "\"experiment_file\":\"e.toml\"",
        "\"experiment_file\":\"f.toml\"",
        &["e.toml and f.toml"],
    );
    other("\"shard\":\"3/3\"", "\"shard\":\"3/4\"", &["shard counts 3 and 4"]);
    let sha = lines.iter().find(|line| line.contains("\"input\"")).unwrap();
    let sha = sha.split("\"sha256\":\"").nth(1).unwrap()[..64].to_owned();
    other(&sha, &"0".repeat(64), &["differs from the file that another shard used", "s-3-of-3"]);
    // Bands and sizes that other shards have seen otherwise: `journal-bands` of public reports.
    let said = "s-2-of-3 and s-3-of-3 have different";
    let bands = lines.iter().rfind(|line| line.contains("\"bands_deg\":[[")).unwrap();
    let bands = bands.split("\"bands_deg\":").nth(1).unwrap().split("]]").next().unwrap();
    let fewer = format!("{}]", bands.rsplit_once(",[").unwrap().0);
    other(
        &format!("{bands}]]"),
        &fewer,
        &[said, "different eccentricity bands in scene", "score both"],
    );
    other("\"size\":[48,40]", "\"size\":[48,41]", &[said, "different frame sizes in scene"]);
    // A line that is not as it was written.
    let text = lines.concat().replacen("\"frame\":", "\"frame\":1", 1);
    folder.write("s-3-of-3/journal.jsonl", text);
    let at = lines.iter().position(|line| line.contains("\"frame\":")).unwrap() + 1;
    fails(&[one, two, three], &[&format!("s-3-of-3/journal.jsonl:{at}: this line"), "changed"]);
    write(&lines);
    fs::copy(folder.path("hall/gt/0000.png"), folder.path("hall/gt/0003.png")).unwrap();
    for side in ["a", "b"] {
        fs::copy(folder.path("hall/a/0000.png"), folder.path(&format!("hall/{side}/0003.png")))
            .unwrap();
    }
    shard(&folder, "s", 3, 3).ok();
    fails(&[one, two, three], &["they found different files or different bands"]);
    folder.write("e.toml", fs::read_to_string(folder.path("e.toml")).unwrap() + "# other\n");
    shard(&folder, "s", 3, 3).ok();
    fails(&[one, two, three], &["their experiments differ"]);
}

/// The rules of the folder are those of a run.
#[test]
fn a_merge_keeps_what_is_not_its_own() {
    let folder = crate::runs::experiment_folder::two_scenes();
    for index in 1..=2 {
        shard(&folder, "s", index, 2).ok();
    }
    folder.write("mine/results.csv", "a,b\n");
    merge(&folder, &names("s", 2), "mine")
        .fails(3, &["the folder contains a results.csv that no run of fovqa has written"]);
    folder.run(&["run", "e.toml", "--output", "out", "--frames", "0..1"]).ok();
    folder.write("out/mine.txt", "mine");
    merge(&folder, &names("s", 2), "out").ok();
    assert!(folder.path("out/mine.txt").exists());
    assert_eq!(rows(&folder, "out").iter().filter(|row| row["metric"] == "mse").count() % 12, 0);
    // As with --frames: only of them, and said to be.
    for (index, name) in [("1/2", "f-1-of-2"), ("2/2", "f-2-of-2")] {
        let run = ["run", "e.toml", "--frames", "1..", "--shard", index, "--output", name];
        folder.run(&run).ok();
    }
    folder.run(&["run", "e.toml", "--output", "whole", "--frames", "1.."]).ok();
    merge(&folder, &names("f", 2), "merged").ok();
    assert_same(&results(&folder.path("merged")), &results(&folder.path("whole")), "frames");
    assert!(!Path::new("reports/e").exists());
}
