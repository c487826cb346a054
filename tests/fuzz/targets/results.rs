//! The folder of a run, one of whose files is hostile, and journals: read, gated, drawn again and merged.
//!
//! The first byte says which file the other bytes are: `c` results.csv, `p` results.parquet, `s` summary.json,
//! `r` run.json, `j` a journal, `J` a journal whose lines get the checksums that belong to them.

#![no_main]

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use fovqa::{Against, FinishedRun, Locking, MergeOptions, Silent, gate_folder, merge, report};
use fovqa_fuzz::abort_on_escaping_panics;
use libfuzzer_sys::fuzz_target;
use tempfile::TempDir;

/// The files of a small run. Its record has no checksums, so that changed files are read.
const BASE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/base");

static FOLDER: LazyLock<TempDir> = LazyLock::new(|| tempfile::tempdir().expect("a folder"));

fuzz_target!(init: abort_on_escaping_panics(), |bytes: &[u8]| {
    let Some((which, bytes)) = bytes.split_first() else { return };
    let folder = FOLDER.path().join("run");
    fresh(&folder);
    match which {
        b'c' => run(&folder, "results.csv", bytes),
        b'p' => {
            let _ = fs::remove_file(folder.join("results.csv"));
            run(&folder, "results.parquet", bytes);
        }
        b's' => run(&folder, "summary.json", bytes),
        b'r' => run(&folder, "run.json", bytes),
        b'j' => journal(bytes),
        b'J' => journal(&sealed(bytes)),
        _ => {}
    }
});

fn fresh(folder: &Path) {
    let _ = fs::remove_dir_all(folder);
    fs::create_dir_all(folder).expect("a folder");
    for file in ["results.csv", "summary.json", "run.json"] {
        fs::copy(Path::new(BASE).join(file), folder.join(file)).expect("a file of the base");
    }
}

/// A finished run with one file replaced.
fn run(folder: &Path, file: &str, bytes: &[u8]) {
    fs::write(folder.join(file), bytes).expect("a file");
    let read = FinishedRun::read(folder);
    let verdict = gate_folder(folder, &Against::default(), Locking::Unlocked, &Silent);
    if read.is_err() {
        assert!(verdict.is_err(), "a run that cannot be read has no verdict");
        return;
    }
    let _ = report(folder, Locking::Unlocked, &Silent);
}

/// A journal as the only shard of a run.
fn journal(bytes: &[u8]) {
    let shard = FOLDER.path().join("shard");
    let merged = FOLDER.path().join("merged");
    let _ = fs::remove_dir_all(&merged);
    fs::create_dir_all(&shard).expect("a folder");
    fs::write(shard.join("journal.jsonl"), bytes).expect("a journal");
    let shards: [PathBuf; 1] = [shard];
    let options = MergeOptions { locking: Locking::Unlocked, ..MergeOptions::default() };
    if let Ok(finished) = merge(&shards, &merged, options, &Silent) {
        // With the right checksums a forged journal may hold any values, also such as no run gives.
        let _ = FinishedRun::read(&finished.folder);
    }
}

/// The lines of a journal with the checksums that belong to them.
fn sealed(journal: &[u8]) -> Vec<u8> {
    let mut out = Vec::new();
    for line in journal.split(|byte| *byte == b'\n').filter(|line| !line.is_empty()) {
        const SUM: &[u8] = b",\"sum\":\"";
        let end = line.windows(SUM.len()).rposition(|window| window == SUM);
        let object = match end {
            Some(end) => &line[..end],
            None => line.strip_suffix(b"}").unwrap_or(line),
        };
        out.extend(object);
        out.extend(format!(",\"sum\":\"{:08x}\"}}\n", crc32fast::hash(object)).bytes());
    }
    out
}
