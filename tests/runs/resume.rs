//! Runs that are broken off and gone on with.

use std::fs;

use serde_json::Value;

use crate::fovqa::{Folder, command};
use crate::runs::experiment_folder::{bytes, json, rows};
use crate::runs::interrupted_runs::{assert_same, journal, results, sealed, sequence, two_scenes};

/// Goes on with what is left of journals, a folder each, and ends as `whole` has.
#[track_caller]
pub(crate) fn goes_on(folder: &Folder, code: i32, journals: &[(String, String)], threads: &str) {
    let wanted = &results(&folder.path("whole"));
    std::thread::scope(|scope| {
        for part in journals.chunks(journals.len().div_ceil(4).max(1)) {
            scope.spawn(move || {
                for (name, text) in part {
                    let output = format!("cut/{name}");
                    folder.write(&format!("{output}/journal.jsonl"), text);
                    let run = ["run", "e.toml", "--resume", "--threads", threads, "--output"];
                    let run = folder.run(&[&run[..], &[&output]].concat());
                    assert_eq!(run.code, code, "{}", run.stderr);
                    assert_same(&results(&folder.path(&output)), wanted, name);
                    fs::remove_dir_all(folder.path(&output)).unwrap();
                }
            });
        }
    });
}

/// A journal up to each of its lines, and up to the middle of the next.
pub(crate) fn cuts(lines: &[String], of: &str) -> Vec<(String, String)> {
    let mut cuts = Vec::new();
    for end in 0..=lines.len() {
        let whole = lines[..end].concat();
        if let Some(next) = lines.get(end) {
            let torn = format!("{whole}{}", &next[..next.len() / 2]);
            cuts.push((format!("{of}-within-{end}"), torn));
        }
        cuts.push((format!("{of}-after-{end}"), whole));
    }
    cuts
}

/// The lines of a journal, with another value for what a frame has been scored.
fn marked(lines: &[String]) -> Vec<String> {
    let mark = |line: &String| {
        let value: Value = serde_json::from_str(line).unwrap();
        if value.get("values").is_none() {
            return line.clone();
        }
        // MSE comes first.
        let (before, behind) = line.split_once("\"values\":[").unwrap();
        let (_, behind) = behind.split_once(',').unwrap();
        sealed(&format!("{before}\"values\":[123.5,{behind}"))
    };
    lines.iter().map(mark).collect()
}

/// Scene, method and frame of all frames, and whether their score has the mark.
fn marks(folder: &Folder, output: &str) -> Vec<(String, bool)> {
    let of = rows(folder, output).into_iter();
    let of = of.filter(|row| row["metric"] == "mse" && row["from_deg"].is_empty());
    let of = of.filter(|row| row["eye"] != "both");
    let name = |row: &std::collections::BTreeMap<String, String>| {
        format!("{} {} {} {}", row["scene"], row["method"], row["eye"], row["frame"])
    };
    of.map(|row| (name(&row), row["value"] == "123.5")).collect()
}

/// A run may be killed anywhere: after each line of its journal, and within one.
#[test]
fn a_journal_cut_anywhere_is_gone_on_with() {
    for (padding, threads) in [("replicate", "1"), ("circular", "8"), ("pingpong", "2")] {
        let folder = sequence(padding);
        folder.run(&["run", "e.toml", "--output", "whole"]).ok();
        let summary = json(&folder, "whole/summary.json");
        for comparison in summary["comparisons"].as_array().unwrap() {
            assert!(comparison["fvvdp"]["jod"].as_f64().unwrap() < 9.9, "{comparison}");
            let atd = &comparison["atd"];
            assert_eq!((&atd["motion"], &atd["depth"]), (&"reference".into(), &"reference".into()));
        }
        let lines = journal(&folder, "whole");
        assert!(lines.len() > 24 + 36, "{}", lines.len());
        goes_on(&folder, 0, &cuts(&lines, padding), threads);
    }
}

/// The same where frames of the sequence cannot be scored: in its middle, at its beginning, and where the
/// first one already looks ahead to it.
#[test]
fn what_could_not_be_scored_is_tried_again() {
    for (padding, broken) in
        [("replicate", "a/0007.exr"), ("replicate", "gt/0000.exr"), ("circular", "b/0009.exr")]
    {
        let folder = sequence(padding);
        let whole = fs::read(folder.path(&format!("moving/{broken}"))).unwrap();
        folder.write(&format!("moving/{broken}"), "no picture");
        assert_eq!(folder.run(&["run", "e.toml", "--output", "whole"]).code, 3);
        let lines = journal(&folder, "whole");
        let all = cuts(&lines, padding);
        goes_on(&folder, 3, &all, "2");
        // Mended, it is as if it had never been broken.
        folder.write(&format!("moving/{broken}"), whole);
        folder.run(&["run", "e.toml", "--output", "whole"]).ok();
        let some: Vec<_> = all.into_iter().skip(3).step_by(4).collect();
        goes_on(&folder, 0, &some, "2");
        folder.write("end/journal.jsonl", lines.concat());
        folder.run(&["run", "e.toml", "--resume", "--output", "end"]).ok();
        assert_same(&results(&folder.path("end")), &results(&folder.path("whole")), broken);
    }
}

/// Killed by a signal that nothing can answer, whenever the journal has come as far as chance will have it.
#[cfg(unix)]
#[test]
fn a_run_killed_twenty_times_ends_in_the_same_bytes() {
    use std::process::Stdio;
    use std::time::Duration;
    let folder = two_scenes();
    folder.run(&["run", "e.toml", "--output", "whole"]).ok();
    let wanted = results(&folder.path("whole"));
    let length = |of: &str| {
        let journal = folder.path("").join(of).join("journal.jsonl");
        fs::metadata(journal).map_or(0, |file| file.len())
    };
    let whole = length("whole");
    let mut random = 0x2545_f491_4f6c_dd1d_u64;
    for threads in ["1", "8"] {
        let run = ["run", "e.toml", "--resume", "--output", "killed", "--threads", threads];
        let mut killed = 0;
        while killed < 20 {
            random ^= random << 13;
            random ^= random >> 7;
            random ^= random << 17;
            let until = random % whole;
            let mut child = command(&run)
                .current_dir(folder.path(""))
                .stdout(Stdio::null())
                .stderr(Stdio::null())
                .spawn()
                .unwrap();
            while child.try_wait().unwrap().is_none() && length("killed") < until {
                std::thread::sleep(Duration::from_micros(100));
            }
            if child.try_wait().unwrap().is_none() {
                child.kill().unwrap();
                killed += 1;
            }
            child.wait().unwrap();
            // From the beginning again, where it has come to its end.
            if folder.path("killed/summary.json").exists() && killed < 15 {
                fs::remove_dir_all(folder.path("killed")).unwrap();
            }
        }
        folder.run(&run).ok();
        assert_same(&results(&folder.path("killed")), &wanted, threads);
        fs::remove_dir_all(folder.path("killed")).unwrap();
    }
}

/// A score that stands in the journal is not computed again, whatever it is.
#[test]
fn finished_frames_are_not_scored_again() {
    let folder = two_scenes();
    folder.run(&["run", "e.toml", "--output", "whole"]).ok();
    let lines = marked(&journal(&folder, "whole"));
    let frames = |lines: &[String]| lines.iter().filter(|l| l.contains("\"values\"")).count();
    assert_eq!(frames(&lines), 36);
    let first = lines.iter().position(|line| line.contains("\"values\"")).unwrap();
    let behind = lines.len() - first;
    for end in [first + behind / 5, first + behind / 2, lines.len() - 2, lines.len()] {
        folder.write("out/journal.jsonl", lines[..end].concat());
        let finished = frames(&lines[..end]);
        let said = format!("{finished} frames are finished");
        folder.run(&["run", "e.toml", "--resume", "--output", "out"]).ok().says(&[&said]);
        let marks = marks(&folder, "out");
        assert_eq!(marks.iter().filter(|(_, marked)| *marked).count(), finished, "{marks:?}");
        assert_eq!(marks.len(), 36);
        // Another run takes the place of what is there.
        folder.run(&["run", "e.toml", "--output", "out"]).ok();
        assert_same(&results(&folder.path("out")), &results(&folder.path("whole")), "afresh");
    }
}

/// Where nothing is measured over time, a frame that could not be scored costs itself alone.
#[test]
fn a_mended_frame_is_scored_alone_where_frames_stand_alone() {
    let folder = crate::runs::experiment_folder::two_scenes();
    let whole = fs::read(folder.path("room/a/0001.png")).unwrap();
    folder.write("room/a/0001.png", "no picture");
    assert_eq!(folder.run(&["run", "e.toml", "--output", "out"]).code, 3);
    let lines = marked(&journal(&folder, "out"));
    folder.write("out/journal.jsonl", lines.concat());
    folder.write("room/a/0001.png", &whole);
    folder.run(&["run", "e.toml", "--resume", "--output", "out"]).ok().says(&["11 frames are"]);
    let afresh: Vec<String> =
        marks(&folder, "out").into_iter().filter(|(_, m)| !m).map(|(name, _)| name).collect();
    assert_eq!(afresh, ["room A  1"]);
    // Its line stands last in the journal, and its row in its place.
    let frames: Vec<String> = marks(&folder, "out").into_iter().map(|(name, _)| name).collect();
    assert_eq!(frames[..3], ["room A  0", "room A  1", "room A  2"]);
    // But where the first frame is mended, it decides what holds for the others.
    folder.write("room/gt/0000.png", "no picture");
    assert_eq!(folder.run(&["run", "e.toml", "--output", "out"]).code, 3);
    let lines = marked(&journal(&folder, "out"));
    folder.write("out/journal.jsonl", lines.concat());
    let codes = fovqa_testkit::synthetic::codes(48, 40, 3, 10);
    folder.png("room/gt/0000.png", 48, 40, &codes);
    folder.run(&["run", "e.toml", "--resume", "--output", "out"]).ok();
    let kept = marks(&folder, "out").into_iter().filter(|(_, marked)| *marked);
    assert!(kept.clone().all(|(name, _)| name.starts_with("hall")) && kept.count() == 6);
}

/// What a run without results has left, and what becomes of it after a change.
#[test]
fn what_has_changed_is_said_and_all_is_scored() {
    let folder = crate::runs::experiment_folder::two_scenes();
    folder.write("gaze.csv", "frame,x_px,y_px\n0,4,4\n1,30,30\n2,9,9\n");
    let text = fs::read_to_string(folder.path("e.toml")).unwrap();
    let text = text.replace("\"room/gt\"", "\"room/gt\"\ngaze = { trace = \"gaze.csv\" }");
    folder.write("e.toml", &text);
    folder.run(&["run", "e.toml", "--output", "whole"]).ok();
    let lines = marked(&journal(&folder, "whole"));
    let cut = lines[..lines.len() - 5].concat();
    let resumed = |journal: &str, more: &[&str], words: &[&str]| {
        folder.write("out/journal.jsonl", journal);
        let run = ["run", "e.toml", "--resume", "--output", "out"];
        let run = folder.run(&[&run[..], more].concat()).ok().says(words);
        assert!(
            run.stderr.contains("everything is scored again") != words.is_empty(),
            "{}",
            run.stderr
        );
        if !more.contains(&"--shard") {
            let kept = marks(&folder, "out").iter().filter(|(_, marked)| *marked).count();
            assert_eq!(kept > 0, words.is_empty(), "{kept}");
        }
    };
    resumed(&cut, &[], &[]);
    resumed(
        &cut,
        &["--frames", "0..2"],
        &["its run used all frames, but this run uses --frames 0..2:1"],
    );
    resumed(&cut, &["--shard", "1/2"], &["it contains a complete run, but this is shard 1/2"]);
    let older = cut.replacen("\"version\":\"0.1.0\"", "\"version\":\"0.0.9\"", 1);
    let older: String = older.split_inclusive('\n').map(sealed).collect();
    resumed(&older, &[], &["fovqa 0.0.9 wrote it, but this is fovqa 0.1.0"]);
    resumed(
        "{\"schema\":\"fovqa.journal/9\"}\n",
        &[],
        &[
            "another version of fovqa wrote journal.jsonl, in format fovqa.journal/9; it is kept as journal.jsonl.old",
        ],
    );
    for (file, bytes) in [
        ("room/a/0001.png", fs::read(folder.path("room/a/0000.png")).unwrap()),
        ("hall/gt/0000.png", fs::read(folder.path("room/gt/0000.png")).unwrap()),
        ("gaze.csv", b"frame,x_px,y_px\n0,4,4\n1,30,30\n2,9,8\n".to_vec()),
    ] {
        let whole = fs::read(folder.path(file)).unwrap();
        folder.write(file, bytes);
        resumed(&cut, &[], &[&format!("{file} has changed")]);
        folder.write(file, whole);
    }
    folder.write("e.toml", text.replace("ssim = {}\n", "ssim = { sigma = 2.0 }\n"));
    resumed(&cut, &[], &["the experiment file has changed"]);
    folder.write("e.toml", text.replace("psnr = {}\n", "psnr = {}\n# a remark\n"));
    resumed(&cut, &[], &[]);
    folder.write("e.toml", &text);
    resumed(&cut, &[], &[]);
    // A frame that was not there before, and one that is not there any more.
    for side in ["gt", "a", "b"] {
        let last = folder.path(&format!("hall/{side}/0002.png"));
        fs::copy(last, folder.path(&format!("hall/{side}/0003.png"))).unwrap();
    }
    resumed(&cut, &[], &["hall: its files, or the bands that follow from them, have changed"]);
    for side in ["gt", "a", "b"] {
        fs::remove_file(folder.path(&format!("hall/{side}/0003.png"))).unwrap();
        fs::remove_file(folder.path(&format!("room/{side}/0002.png"))).unwrap();
    }
    resumed(&cut, &[], &["room: its files, or the bands that follow from them, have changed"]);
}

/// A scene that was missing altogether costs the others nothing when it comes.
#[test]
fn a_scene_that_has_come_is_scored_alone() {
    let folder = crate::runs::experiment_folder::two_scenes();
    fs::rename(folder.path("hall"), folder.path("elsewhere")).unwrap();
    assert_eq!(folder.run(&["run", "e.toml", "--output", "out"]).code, 3);
    let lines = marked(&journal(&folder, "out"));
    folder.write("out/journal.jsonl", lines.concat());
    fs::rename(folder.path("elsewhere"), folder.path("hall")).unwrap();
    folder.run(&["run", "e.toml", "--resume", "--output", "out"]).ok();
    for (name, marked) in marks(&folder, "out") {
        assert_eq!(name.starts_with("room"), marked, "{name}");
    }
    // So it is for a mask that could not be read.
    let text = fs::read_to_string(folder.path("e.toml")).unwrap();
    folder.write("e.toml", text.replace("\"room/gt\"", "\"room/gt\"\nmask = \"mask.png\""));
    let run = folder.run(&["run", "e.toml", "--output", "out"]);
    assert_eq!(run.code, 3);
    folder.write("out/journal.jsonl", marked(&journal(&folder, "out")).concat());
    folder.png("mask.png", 48, 40, &[255; 48 * 40]);
    folder.run(&["run", "e.toml", "--resume", "--output", "out"]).ok();
    for (name, marked) in marks(&folder, "out") {
        assert_eq!(name.starts_with("hall"), marked, "{name}");
    }
}

/// The bands of a scene go as far as either eye sees: what cannot be read of one counts for both.
#[test]
fn an_eye_that_is_mended_widens_the_bands_of_both() {
    let folder = Folder::new();
    for eye in ["left", "right"] {
        folder.png_pair(&format!("gt_{eye}.png"), &format!("a_{eye}.png"), 48, 40);
    }
    folder.write(
        "e.toml",
        "name = \"e\"\n[view]\nfov_vertical_deg = 60\ngaze = { left = [24, 20], right = [47, 40] }\n\
         [[scene]]\nname = \"s\"\nreference = { left = \"gt_left.png\", right = \"gt_right.png\" }\n\
         [[method]]\nname = \"A\"\ntest = \"a_{eye}.png\"\n[metrics]\nmse = {}\n",
    );
    let whole = fs::read(folder.path("gt_right.png")).unwrap();
    folder.write("gt_right.png", "no picture");
    assert_eq!(folder.run(&["run", "e.toml", "--output", "out"]).code, 3);
    folder.write("gt_right.png", whole);
    folder.run(&["run", "e.toml", "--resume", "--output", "out"]).ok();
    folder.run(&["run", "e.toml", "--output", "whole"]).ok();
    assert_same(&results(&folder.path("out")), &results(&folder.path("whole")), "mended");
}

#[test]
fn where_nothing_is_there_a_run_begins() {
    let folder = crate::runs::experiment_folder::two_scenes();
    folder.run(&["run", "e.toml", "--output", "whole"]).ok();
    let wanted = results(&folder.path("whole"));
    folder.run(&["run", "e.toml", "--resume", "--output", "new"]).ok();
    assert_same(&results(&folder.path("new")), &wanted, "new");
    // Results without a journal, and a journal without a line.
    fs::remove_file(folder.path("new/journal.jsonl")).unwrap();
    folder.run(&["run", "e.toml", "--resume", "--output", "new"]).ok();
    assert_same(&results(&folder.path("new")), &wanted, "without a journal");
    folder.write("new/journal.jsonl", "");
    folder.run(&["run", "e.toml", "--resume", "--output", "new"]).ok();
    assert_same(&results(&folder.path("new")), &wanted, "an empty journal");
    // What is behind something that is none of its lines is not trusted.
    let mut lines = marked(&journal(&folder, "new"));
    let half = lines.len() / 2;
    lines.insert(half, "\0\0\0\n".to_owned());
    folder.write("new/journal.jsonl", lines.concat());
    folder.run(&["run", "e.toml", "--resume", "--output", "new"]).ok();
    let before = lines[..half].iter().filter(|line| line.contains("\"values\"")).count();
    let kept = marks(&folder, "new").iter().filter(|(_, marked)| *marked).count();
    assert_eq!(kept, before);
}

/// Maps are written before their frame is finished; elsewhere they have to be made again.
#[test]
fn maps_are_all_there() {
    let folder = sequence("replicate");
    folder.run(&["run", "e.toml", "--output", "whole", "--maps", "maps"]).ok();
    let wanted = bytes(&folder.path("maps"));
    // Four of FovVideoVDP, two each of the squared error and SSIM.
    assert_eq!(wanted.len(), 24 * 8);
    let lines = journal(&folder, "whole");
    // All inputs stand in front.
    let cut = lines[..lines.len() * 4 / 5].concat();
    let run = ["run", "e.toml", "--resume", "--output", "out", "--maps"];
    folder.write("out/journal.jsonl", &cut);
    folder.run(&[&run[..], &["maps"]].concat()).ok().says(&["frames are finished"]);
    assert_eq!(bytes(&folder.path("maps")), wanted);
    folder.write("out/journal.jsonl", &cut);
    let run = folder.run(&[&run[..], &["others"]].concat()).ok();
    run.says(&[
        "the --maps folder does not contain the maps of finished frames",
        "everything is scored again",
    ]);
    assert_eq!(bytes(&folder.path("others")), wanted);
}

/// Maps of other pictures are never taken for those of finished frames.
#[test]
fn maps_of_an_earlier_run_are_made_again() {
    let folder = Folder::new();
    folder.png_pair("a.png", "b.png", 48, 40);
    folder.write(
        "e.toml",
        "name = \"e\"\n[[scene]]\nname = \"s\"\nreference = \"a.png\"\n\
         [[method]]\nname = \"m\"\ntest = \"b.png\"\n[metrics]\nssim = {}\n",
    );
    folder.run(&["run", "e.toml", "--maps", "maps"]).ok();
    folder.png_pair("other.png", "b.png", 48, 41);
    folder.png_pair("a.png", "c.png", 48, 41);
    folder.run(&["run", "e.toml"]).ok();
    let run = folder.run(&["run", "e.toml", "--resume", "--maps", "maps"]).ok();
    run.says(&["the --maps folder does not contain the maps of finished frames"]);
    let kept = bytes(&folder.path("maps"));
    folder.run(&["run", "e.toml", "--maps", "fresh"]).ok();
    assert_eq!(kept, bytes(&folder.path("fresh")));
}

/// A disk that is full, or cannot be written to any more, costs nothing that was finished.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_loses_nothing() {
    use std::io::Write;
    use std::process::Command;
    struct Disk(std::path::PathBuf);
    impl Disk {
        fn mount(&self, options: &str) -> bool {
            let mut mount = Command::new("mount");
            mount.args(["-t", "tmpfs", "-o", options, "tmpfs"]).arg(&self.0);
            mount.output().is_ok_and(|output| output.status.success())
        }
    }
    impl Drop for Disk {
        fn drop(&mut self) {
            let _ = Command::new("umount").arg(&self.0).output();
        }
    }
    let folder = sequence("replicate");
    // Pictures would fill the disk before the journal does.
    let text = fs::read_to_string(folder.path("e.toml")).unwrap();
    folder.write("e.toml", text + "\n[report]\nframes = []\n");
    folder.run(&["run", "e.toml", "--output", "whole"]).ok();
    let wanted = results(&folder.path("whole"));
    fs::create_dir(folder.path("disk")).unwrap();
    let disk = Disk(folder.path("disk"));
    if !disk.mount("size=32k") {
        let _ = writeln!(std::io::stderr(), "skipped: no file system can be mounted here");
        return;
    }
    let run = ["run", "e.toml", "--resume", "--output", "disk/out"];
    let frames = || {
        let journal = fs::read_to_string(folder.path("disk/out/journal.jsonl"));
        journal.unwrap_or_default().matches("\"values\"").count()
    };
    folder.run(&run).fails(3, &["the journal cannot be written", "--resume continues"]);
    let finished = frames();
    assert!(finished > 0 && finished < 24, "{finished}");
    assert!(!folder.path("disk/out/results.csv").exists());
    // Still full, and then not to be written to at all: what is there stays.
    folder.run(&run).fails(3, &[]);
    assert!(disk.mount("remount,ro"));
    folder.run(&run).fails(3, &["cannot write results to this folder"]);
    assert_eq!(frames(), finished);
    let lines = journal(&folder, "disk/out");
    let whole: Vec<String> = lines.into_iter().filter(|line| line.ends_with('\n')).collect();
    assert!(disk.mount("remount,rw,size=64m"));
    folder.write("disk/out/journal.jsonl", marked(&whole).concat());
    folder.run(&run).ok().says(&["finished; continuing from there"]);
    let kept = marks(&folder, "disk/out").iter().filter(|(_, marked)| *marked).count();
    assert!(kept >= finished - 1, "{kept} of {finished}");
    folder.write("disk/out/journal.jsonl", whole.concat());
    folder.run(&run).ok();
    assert_same(&results(&folder.path("disk/out")), &wanted, "with space again");
    // Full when everything is scored again: the results are still to be written.
    let journal = fs::read_to_string(folder.path("disk/out/journal.jsonl")).unwrap();
    fs::remove_dir_all(folder.path("disk/out")).unwrap();
    folder.write("disk/out/journal.jsonl", &journal);
    let pages = 2 * journal.len().div_ceil(4096) + 8;
    assert!(disk.mount(&format!("remount,size={}k", pages * 4)));
    let run_full = folder.run(&run);
    assert_eq!(run_full.code, 3, "{}", run_full.stderr);
    run_full.says(&["cannot be written", "--resume continues"]);
    assert!(disk.mount("remount,size=64m"));
    folder.run(&run).ok().says(&["24 frames are finished"]);
    assert_same(&results(&folder.path("disk/out")), &wanted, "all was scored");
}

/// A line that is not as it was written is neither taken nor passed over.
#[test]
fn a_line_that_was_changed_is_refused() {
    let folder = crate::runs::experiment_folder::two_scenes();
    folder.run(&["run", "e.toml", "--output", "whole"]).ok();
    let lines = journal(&folder, "whole");
    for (at, line) in lines.iter().enumerate() {
        let digit = line.rfind(|c: char| c.is_ascii_digit() && c != '9').unwrap();
        let digit = line[..digit].rfind(|c: char| c.is_ascii_digit() && c != '9').unwrap_or(digit);
        let mut changed = lines.clone();
        changed[at].replace_range(digit..=digit, "9");
        folder.write("out/journal.jsonl", changed.concat());
        let said = format!("journal.jsonl:{}: this line of the journal was changed", at + 1);
        let run = folder.run(&["run", "e.toml", "--resume", "--output", "out"]);
        run.fails(3, &[&said, "delete this line and all lines after it"]);
        let kept = fs::read_to_string(folder.path("out/journal.jsonl")).unwrap();
        assert!(kept == changed.concat(), "it is left as it is");
    }
}
