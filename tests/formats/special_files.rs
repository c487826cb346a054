//! Pipes, devices, byte order marks and missing locks where small files are meant.

use std::fs;

use crate::fovqa::{Folder, root};
#[cfg(target_os = "linux")]
use crate::fovqa::{Run, command};

/// An experiment with a gate, scored into `r`, and a baseline of it.
fn scored() -> Folder {
    let folder = Folder::with_pair();
    folder.write(
        "x.toml",
        "name = \"x\"\n[view]\nfov_vertical_deg = 60\n[[scene]]\nname = \"s\"\nreference = \"a.png\"\n\
         [[method]]\nname = \"m\"\ntest = \"b.png\"\n[metrics]\npsnr = {}\n\
         [[gate]]\nmetric = \"psnr\"\nmax_drop = 1\n",
    );
    folder.run(&["run", "x.toml", "--output", "r"]).ok();
    folder.run(&["baseline", "save", "r", "base.json"]).ok();
    folder
}

/// Runs the command, which has to end by itself.
#[cfg(target_os = "linux")]
#[track_caller]
fn ends(folder: &Folder, arguments: &[&str]) -> Run {
    use std::process::Stdio;
    use std::time::{Duration, Instant};
    let mut child = command(arguments)
        .current_dir(folder.path(""))
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // It ends at once; the limit is there for a test that fails.
    let begun = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if begun.elapsed() > Duration::from_mins(1) {
            child.kill().unwrap();
            child.wait().unwrap();
            panic!("{arguments:?} waits");
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    child.wait_with_output().unwrap().into()
}

/// Puts a pipe that nobody writes to in the place of a file.
#[cfg(target_os = "linux")]
fn pipe(folder: &Folder, name: &str) {
    let path = folder.path(name);
    let _ = fs::remove_file(&path);
    assert!(std::process::Command::new("mkfifo").arg(path).status().unwrap().success());
}

#[cfg(target_os = "linux")]
#[test]
fn pipes_and_devices_are_not_waited_for() {
    let folder = scored();
    pipe(&folder, "pipe");
    let gate = |baseline: &str| ends(&folder, &["gate", "r", "--baseline", baseline]);
    gate("pipe").fails(3, &["pipe: it cannot be read: it is a pipe"]);
    gate("/dev/zero").fails(3, &["it is not a regular file"]);
    for toml in ["pipe", "/dev/zero"] {
        for subcommand in ["run", "check", "curves"] {
            assert_eq!(ends(&folder, &[subcommand, toml]).code, 2, "{subcommand} {toml}");
        }
    }
    let view = ["a.png", "b.png", "--fov-vertical", "60", "--gaze", "pipe"];
    ends(&folder, &[&["score"], &view[..]].concat())
        .fails(3, &["it is a pipe", "write it to a file"]);
    ends(&folder, &["score", "pipe", "b.png"]).fails(3, &["neither a file nor a folder"]);
    let mask = ["score", "a.png", "b.png", "--mask", "pipe"];
    assert_eq!(ends(&folder, &mask).code, 3);
}

#[cfg(target_os = "linux")]
#[test]
fn pipes_in_a_folder_of_results_are_not_waited_for() {
    let files = [
        "run.json",
        "summary.json",
        "results.csv",
        "journal.jsonl",
        "report.json",
        "index.html",
        "report.html",
    ];
    for file in files {
        let folder = scored();
        pipe(&folder, &format!("r/{file}"));
        for arguments in [
            &["gate", "r", "--baseline", "base.json"][..],
            &["report", "r"],
            &["run", "x.toml", "--output", "r", "--resume"],
            &["merge", "r", "--output", "m"],
            &["baseline", "accept", "r", "base.json"],
            &["report", "."],
        ] {
            let run = ends(&folder, arguments);
            assert!([0, 3].contains(&run.code), "{file} {arguments:?}: {}", run.stderr);
        }
    }
    let folder = scored();
    pipe(&folder, "r/.fovqa.lock");
    ends(&folder, &["run", "x.toml", "--output", "r"]).fails(3, &[".fovqa.lock", "regular file"]);
}

#[cfg(target_os = "linux")]
#[test]
fn what_the_shell_hands_over_as_a_pipe_is_refused_and_said() {
    let folder = scored();
    let exe = command(&[]);
    let script = format!("\"{}\" check <(cat x.toml)", exe.get_program().to_str().unwrap());
    let Ok(output) = std::process::Command::new("bash")
        .args(["-c", &script])
        .current_dir(folder.path(""))
        .output()
    else {
        return;
    };
    let run: Run = output.into();
    run.fails(2, &["it is a pipe", "write it to a file first"]);
}

#[test]
fn byte_order_marks_are_passed_over() {
    let case = root().join("tests/cases/baseline-bom");
    let folder = Folder::new();
    for name in ["a.png", "b.png", "base.json", "base_bom.json", "x.toml", "x_bom.toml"] {
        fs::copy(case.join(name), folder.path(name)).unwrap();
    }
    let plain = folder.run(&["gate", "x.toml", "--baseline", "base.json"]).ok();
    let marked = folder.run(&["gate", "x.toml", "--baseline", "base_bom.json"]).ok();
    assert_eq!(plain.stdout, marked.stdout);
    folder.run(&["gate", "x_bom.toml", "--baseline", "base_bom.json"]).ok();
    folder.run(&["run", "x.toml", "--output", "r"]).ok();
    for file in ["run.json", "summary.json", "results.csv", "journal.jsonl", "report.json"] {
        let text = fs::read_to_string(folder.path(&format!("r/{file}"))).unwrap();
        folder.write(&format!("r/{file}"), format!("\u{feff}{text}"));
    }
    folder.run(&["gate", "r", "--baseline", "base.json"]).ok();
    folder.run(&["report", "r"]).ok();
    folder.run(&["baseline", "accept", "r", "base_bom.json"]).ok();
    let resumed = folder.run(&["run", "x.toml", "--output", "r", "--resume"]).ok();
    resumed.says(&["1 frame is finished"]);
}

#[test]
fn a_folder_can_do_without_a_lock() {
    let folder = scored();
    // What keeps a lock from being taken here.
    fs::remove_file(folder.path("r/.fovqa.lock")).unwrap();
    fs::create_dir(folder.path("r/.fovqa.lock")).unwrap();
    folder.run(&["report", "r"]).fails(3, &[".fovqa.lock"]);
    folder.run(&["report", "r", "--no-lock"]).ok();
    folder.run(&["run", "x.toml", "--output", "r", "--no-lock"]).ok();
    let gate = ["gate", "x.toml", "--output", "r", "--baseline", "base.json", "--no-lock"];
    folder.run(&gate).ok();
    folder.run(&["run", "x.toml", "--output", "s", "--shard", "1/1", "--no-lock"]).ok();
    folder.run(&["merge", "s", "--output", "r", "--no-lock"]).ok();
}
