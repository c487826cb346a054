//! Runs that are killed at any moment, while they score, write or draw, and continued.

#![cfg(unix)]

use std::collections::BTreeMap;
use std::fs;
use std::process::Stdio;
use std::time::Instant;

use super::experiment_folder::bytes;
use super::interrupted_runs::{assert_same, two_scenes};
use crate::fovqa::{Folder, command};

/// What a run with its maps writes.
const WRITTEN: [&str; 2] = ["out", "maps"];

/// How many times a run is brought to its end after kills; `FOVQA_KILLS` asks for more.
fn rounds() -> usize {
    std::env::var("FOVQA_KILLS").ok().and_then(|rounds| rounds.parse().ok()).unwrap_or(4)
}

fn written(folder: &Folder) -> [BTreeMap<String, Vec<u8>>; 2] {
    WRITTEN.map(|of| bytes(&folder.path(of)))
}

/// Every file is that of a run that was left alone, and there is no other.
#[test]
fn a_run_killed_at_any_moment_ends_in_the_same_bytes() {
    let folder = two_scenes();
    let run = ["run", "e.toml", "--resume", "--output", "out", "--maps", "maps", "--threads", "2"];
    let begun = Instant::now();
    folder.run(&run).ok();
    let length = begun.elapsed();
    let wanted = written(&folder);
    let mut random = 0x9e37_79b9_7f4a_7c15_u64;
    let mut draw = |below: u64| {
        random ^= random << 13;
        random ^= random >> 7;
        random ^= random << 17;
        random % below
    };
    let mut killed = 0;
    for round in 0..rounds() {
        for of in WRITTEN {
            fs::remove_dir_all(folder.path(of)).unwrap();
        }
        // Those that continue are killed too.
        for _ in 0..=draw(3) {
            let mut child = command(&run)
                .current_dir(folder.path(""))
                .stdout(Stdio::null())
                .stderr(Stdio::null())
                .spawn()
                .unwrap();
            std::thread::sleep(length.mul_f64(draw(1000) as f64 / 1000.0));
            killed += u32::from(child.try_wait().unwrap().is_none());
            let _ = child.kill();
            child.wait().unwrap();
        }
        folder.run(&run).ok();
        for (found, wanted) in written(&folder).iter().zip(&wanted) {
            assert_same(found, wanted, &format!("round {round}"));
        }
    }
    assert!(killed > 0, "each run was faster than the first one");
}
