//! What the tests of `fovqa foveate` share: frames that are read back, and runs.

use std::path::Path;

use fovqa_frame::Frame;
use fovqa_io::{ReadOptions, read_frame};
use fovqa_testkit::synthetic::codes;
use serde_json::Value;

use crate::fovqa::{Folder, Run};

pub(super) const WIDTH: usize = 48;
pub(super) const HEIGHT: usize = 40;

/// A frame as a file holds it.
#[track_caller]
pub(super) fn read(path: &Path) -> Frame {
    read_frame(path, &ReadOptions::default()).unwrap().frame
}

/// The folder with `a.png`.
pub(super) fn with_frame() -> Folder {
    let folder = Folder::new();
    folder.png("a.png", WIDTH, HEIGHT, &codes(WIDTH, HEIGHT, 3, 1));
    folder
}

/// The folder with `gt/0000.png` and so on, all different.
pub(super) fn with_sequence(frames: usize) -> Folder {
    let folder = Folder::new();
    for frame in 0..frames {
        let codes = codes(WIDTH, HEIGHT, 3, frame as u64);
        folder.png(&format!("gt/{frame:04}.png"), WIDTH, HEIGHT, &codes);
    }
    folder
}

impl Folder {
    /// `fovqa foveate …`, with the arguments separated by spaces.
    pub(super) fn foveate(&self, arguments: &str) -> Run {
        let arguments: Vec<&str> = arguments.split_whitespace().collect();
        self.run(&[&["foveate"], &arguments[..]].concat())
    }

    /// The record of a run that has to succeed.
    #[track_caller]
    pub(super) fn record(&self, arguments: &str) -> Value {
        self.foveate(&format!("{arguments} --format json")).ok().json()
    }

    /// A frame of this folder.
    #[track_caller]
    pub(super) fn frame(&self, name: &str) -> Frame {
        read(&self.path(name))
    }
}
