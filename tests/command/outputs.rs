//! Files that somebody names for an output: links, devices, pipes, a full disk, and what a killed run leaves.

use std::fs;

use crate::fovqa::Folder;
use crate::runs::experiment_folder::bytes;

/// An experiment with a gate that holds, scored into `r`.
fn scored() -> Folder {
    let folder = Folder::with_pair();
    folder.write(
        "x.toml",
        "name = \"x\"\n[view]\nfov_vertical_deg = 60\n[[scene]]\nname = \"s\"\nreference = \"a.png\"\n\
         [[method]]\nname = \"m\"\ntest = \"b.png\"\n[metrics]\npsnr = {}\n\
         [[gate]]\nmetric = \"psnr\"\nat_least = 1\n",
    );
    folder.run(&["run", "x.toml", "--output", "r"]).ok();
    folder
}

/// Every option that names a file, with what it would write.
#[cfg(unix)]
const NAMED: [(&[&str], &str); 3] = [
    (&["gate", "r", "--junit"], "<?xml"),
    (&["gate", "r", "--markdown"], "| rule |"),
    (&["baseline", "save", "r"], "\"fovqa.baseline/1\""),
];

#[cfg(unix)]
#[test]
fn links_are_followed_and_devices_written_to() {
    use std::os::unix::fs::symlink;
    let folder = scored();
    fs::create_dir(folder.path("real")).unwrap();
    for (number, (arguments, begin)) in NAMED.into_iter().enumerate() {
        let (link, file) = (format!("link-{number}"), format!("real/{number}"));
        symlink(&file, folder.path(&link)).unwrap();
        folder.run(&[arguments, &[&link]].concat()).ok();
        assert!(fs::symlink_metadata(folder.path(&link)).unwrap().is_symlink(), "{arguments:?}");
        let written = fs::read_to_string(folder.path(&file)).unwrap();
        assert!(written.contains(begin), "{arguments:?}: {written}");
        let run = folder.run(&[arguments, &["/dev/stdout"]].concat()).ok();
        assert!(run.stdout.contains(&written), "{arguments:?}: {}", run.stdout);
        folder.run(&[arguments, &["/dev/null"]].concat()).ok();
    }
    assert!(!fs::metadata("/dev/null").unwrap().is_file());
    // A folder too may be a link, and one to a folder that is yet to be made.
    symlink("real/folder", folder.path("results")).unwrap();
    folder.run(&["run", "x.toml", "--output", "results"]).ok();
    assert!(folder.path("real/folder/results.csv").is_file());
    // Files of a run that were moved elsewhere are renewed there.
    fs::rename(folder.path("r/results.csv"), folder.path("real/results.csv")).unwrap();
    symlink("../real/results.csv", folder.path("r/results.csv")).unwrap();
    // A run has no verdict yet.
    fs::remove_dir_all(folder.path("r/gate")).unwrap();
    folder.run(&["report", "r"]).ok();
    let before = bytes(&folder.path("r"));
    folder.run(&["run", "x.toml", "--output", "r"]).ok();
    assert!(fs::symlink_metadata(folder.path("r/results.csv")).unwrap().is_symlink());
    assert_eq!(bytes(&folder.path("r")), before);
}

/// Behind what is there: the verdict of the same process, and what others have written.
#[cfg(target_os = "linux")]
#[test]
fn what_goes_to_stdout_stands_behind_the_verdict() {
    let folder = scored();
    let file = fs::File::create(folder.path("log")).unwrap();
    let status = crate::fovqa::command(&["gate", "r", "--junit", "/dev/stdout"])
        .current_dir(folder.path(""))
        .stdout(file)
        .status()
        .unwrap();
    assert!(status.success());
    let log = fs::read_to_string(folder.path("log")).unwrap();
    let verdict = folder.run(&["gate", "r", "--junit", "junit"]).ok().stdout;
    assert_eq!(log, verdict + &fs::read_to_string(folder.path("junit")).unwrap());
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_device_is_said_and_costs_nothing_else() {
    let folder = scored();
    for (arguments, _) in NAMED {
        let run = folder.run(&[arguments, &["/dev/full"]].concat());
        assert_eq!(run.code, 3);
        run.says(&["/dev/full: it cannot be written: No space left", "give another file"]);
    }
    let gate = ["gate", "r", "--junit", "/dev/full", "--markdown", "gate.md"];
    assert_eq!(folder.run(&gate).code, 3);
    assert!(folder.path("gate.md").is_file(), "the other file is written");
}

#[test]
fn what_a_killed_run_left_goes_with_the_next() {
    let folder = scored();
    let left = ".fovqa-0123456789abcdef.tmp";
    for place in ["r", "r/plots", "ci"] {
        folder.write(&format!("{place}/{left}"), "half");
        folder.write(&format!("{place}/.fovqa-mine.tmp"), "not ours");
    }
    folder.run(&["run", "x.toml", "--output", "r"]).ok();
    folder.run(&["gate", "r", "--junit", "ci/junit.xml"]).ok();
    for place in ["r", "r/plots", "ci"] {
        assert!(!folder.path(&format!("{place}/{left}")).exists(), "{place}");
        assert!(folder.path(&format!("{place}/.fovqa-mine.tmp")).exists(), "{place}");
    }
}
