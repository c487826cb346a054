//! Running the command, and folders to run it in.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use fovqa_testkit::png_files;
use fovqa_testkit::synthetic::{codes, disturbed};
use serde_json::Value;
use tempfile::TempDir;

/// The command, not yet started.
pub(crate) fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_fovqa-under-test"));
    command.args(arguments).stdin(Stdio::null()).env_remove("RAYON_NUM_THREADS");
    command
}

/// How a run ended.
pub(crate) struct Run {
    pub(crate) code: i32,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl From<Output> for Run {
    fn from(output: Output) -> Self {
        let run = Run {
            code: output.status.code().unwrap_or(-1),
            stdout: String::from_utf8(output.stdout).unwrap(),
            stderr: String::from_utf8(output.stderr).unwrap(),
        };
        assert!(!run.stderr.contains("panicked"), "{}", run.stderr);
        assert!(!run.stderr.contains("has a bug"), "{}", run.stderr);
        run
    }
}

impl Run {
    /// A run that has to succeed.
    #[track_caller]
    pub(crate) fn ok(self) -> Self {
        assert_eq!(self.code, 0, "{}", self.stderr);
        self
    }

    /// A run that has to fail with a code, say all of these words, and print no result.
    #[track_caller]
    pub(crate) fn fails(self, code: i32, words: &[&str]) -> Self {
        assert_eq!(self.code, code, "{}", self.stderr);
        assert_eq!(self.stdout, "", "nothing that looks like a result");
        self.says(words)
    }

    /// Every message says what, and errors how to mend it.
    #[track_caller]
    pub(crate) fn says(self, words: &[&str]) -> Self {
        for word in words {
            assert!(self.stderr.contains(word), "{word:?} is not in:\n{}", self.stderr);
        }
        self
    }

    #[track_caller]
    pub(crate) fn json(&self) -> Value {
        serde_json::from_str(&self.stdout).unwrap()
    }
}

/// A folder with pictures in it, where the command runs.
pub(crate) struct Folder(TempDir);

impl Folder {
    pub(crate) fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    /// `a.png` and, with noise on it, `b.png`, 48x40.
    pub(crate) fn with_pair() -> Self {
        let folder = Self::new();
        folder.png_pair("a.png", "b.png", 48, 40);
        folder
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        let path = self.0.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        path
    }

    pub(crate) fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        fs::write(self.path(name), bytes).unwrap();
    }

    pub(crate) fn png(&self, name: &str, width: usize, height: usize, codes: &[u8]) {
        png_files::write8(&self.path(name), width, height, codes);
    }

    pub(crate) fn png_pair(&self, a: &str, b: &str, width: usize, height: usize) {
        let reference = codes(width, height, 3, 1);
        self.png(a, width, height, &reference);
        self.png(b, width, height, &disturbed(&reference, 40.0, 2));
    }

    /// Runs the command here.
    pub(crate) fn run(&self, arguments: &[&str]) -> Run {
        command(arguments).current_dir(self.0.path()).output().unwrap().into()
    }

    /// `fovqa score …`.
    pub(crate) fn score(&self, arguments: &[&str]) -> Run {
        self.run(&[&["score"], arguments].concat())
    }

    /// `fovqa score … --format json`, which has to succeed.
    #[track_caller]
    pub(crate) fn json(&self, arguments: &[&str]) -> Value {
        self.score(&[arguments, &["--format", "json"]].concat()).ok().json()
    }

    /// One metric of the first frame.
    #[track_caller]
    pub(crate) fn metric(&self, name: &str, arguments: &[&str]) -> f64 {
        let json = self.json(&[arguments, &["--metrics", name]].concat());
        let value = &json["frames"][0]["metrics"][name];
        if value == "inf" { f64::INFINITY } else { value.as_f64().unwrap() }
    }
}

/// The largest resident set of a run, in kB.
#[cfg(target_os = "linux")]
pub(crate) fn peak_kb(folder: &Folder, arguments: &[&str]) -> u64 {
    use std::time::Duration;
    let mut child = command(arguments)
        .current_dir(folder.path(""))
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let status = format!("/proc/{}/status", child.id());
    let mut peak = 0;
    while child.try_wait().unwrap().is_none() {
        let text = std::fs::read_to_string(&status).unwrap_or_default();
        let line = text.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        if let Some(kb) = line.and_then(|l| l.trim().trim_end_matches(" kB").parse::<u64>().ok()) {
            peak = peak.max(kb);
        }
        std::thread::sleep(Duration::from_millis(2));
    }
    peak
}

/// The workspace.
pub(crate) fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

/// Set to 1, no test passes for want of data.
const REQUIRE_SHARED: &str = "FOVQA_REQUIRE_SHARED";

/// A folder of the reference data that does not belong to the repository, where it is there;
/// elsewhere `None`, and a line that says so, or, with `FOVQA_REQUIRE_SHARED=1`, an error.
pub(crate) fn shared(folder: &str) -> Option<PathBuf> {
    let is_required = std::env::var_os(REQUIRE_SHARED).is_some_and(|value| value == "1");
    shared_beside(root(), folder, is_required)
}

fn shared_beside(root: &Path, folder: &str, is_required: bool) -> Option<PathBuf> {
    use std::io::Write;
    let path = root.parent().unwrap().join("shared").join(folder);
    if path.is_dir() {
        return Some(path);
    }
    assert!(!is_required, "{REQUIRE_SHARED}=1, and ../shared/{folder} is not there");
    // Not `eprintln!`, which the test runner keeps to itself.
    let _ = writeln!(std::io::stderr(), "skipped: ../shared/{folder} is not there");
    None
}

#[test]
fn what_is_not_there_is_passed_over_unless_it_is_required() {
    let folder = Folder::new();
    let root = folder.path("repository");
    assert_eq!(shared_beside(&root, "data", false), None);
    fs::create_dir_all(folder.path("shared/data")).unwrap();
    assert_eq!(shared_beside(&root, "data", true), Some(folder.path("shared/data")));
}

#[test]
#[should_panic(expected = "FOVQA_REQUIRE_SHARED=1, and ../shared/data is not there")]
fn what_is_required_has_to_be_there() {
    shared_beside(&Folder::new().path("repository"), "data", true);
}
