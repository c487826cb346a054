//! The files that the tests write, and the checks of the channels that are read back.

use std::fs;
use std::path::PathBuf;

use fovqa_frame::{Motion, Plane};
use fovqa_io::{
    Decoded, DecodedGuides, DepthChannels, GuideOptions, GuidePreset, MotionChannels, MotionUnit,
    NamedMotion, ReadErrorKind, ReadOptions, read_frame, read_guides,
};
use fovqa_testkit::exr_files::{File, Part, Values};
use tempfile::TempDir;

pub(crate) const W: usize = 40;
pub(crate) const H: usize = 36;
pub(crate) const SIZE: (usize, usize) = (W, H);

/// The value of a pixel: exact as a half float, and different for each channel.
pub(crate) fn value(seed: usize, x: usize, y: usize) -> f32 {
    ((x * 7 + y * 13 + seed * 101) % 1000) as f32 / 4.0
}

pub(crate) fn values(seed: usize, (w, h): (usize, usize)) -> Vec<f32> {
    (0..w * h).map(|i| value(seed, i % w, i / w)).collect()
}

pub(crate) fn half(seed: usize) -> Values {
    Values::Half(values(seed, SIZE))
}

pub(crate) fn float(seed: usize) -> Values {
    Values::Float(values(seed, SIZE))
}

/// A part with half-float channels of these names, with the seeds 0, 1, 2 and so on.
pub(crate) fn part(names: &[&str]) -> Part {
    let channels: Vec<_> = names.iter().enumerate().map(|(i, name)| (*name, half(i))).collect();
    Part::new(SIZE, &channels)
}

/// A temporary folder with one file.
pub(crate) struct Folder(TempDir);

impl Folder {
    pub(crate) fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    pub(crate) fn path(&self) -> PathBuf {
        self.0.path().join("file.exr")
    }

    pub(crate) fn file(&self, parts: Vec<Part>) -> PathBuf {
        self.written(&File::new(parts))
    }

    pub(crate) fn written(&self, file: &File) -> PathBuf {
        file.write(&self.path());
        self.path()
    }

    pub(crate) fn bytes(&self, bytes: impl AsRef<[u8]>) -> PathBuf {
        fs::write(self.path(), bytes).unwrap();
        self.path()
    }
}

pub(crate) fn options(motion: MotionChannels, depth: DepthChannels) -> ReadOptions {
    ReadOptions { guides: GuideOptions { motion, depth }, ..ReadOptions::default() }
}

pub(crate) fn auto() -> ReadOptions {
    options(MotionChannels::Auto, DepthChannels::Auto)
}

pub(crate) fn preset(preset: GuidePreset) -> ReadOptions {
    options(MotionChannels::Preset(preset), DepthChannels::Preset(preset))
}

pub(crate) fn named(channels: [&str; 2]) -> MotionChannels {
    MotionChannels::Named(NamedMotion {
        channels: channels.map(str::to_owned),
        sign: [1.0; 2],
        scale: [1.0; 2],
        unit: MotionUnit::Pixels,
    })
}

pub(crate) fn depth_named(channel: &str) -> DepthChannels {
    DepthChannels::Named(channel.to_owned())
}

pub(crate) fn frame_of(parts: Vec<Part>, options: &ReadOptions) -> Result<Decoded, ReadErrorKind> {
    let folder = Folder::new();
    read_frame(&folder.file(parts), options).map_err(|error| error.kind)
}

pub(crate) fn guides_of(
    parts: Vec<Part>,
    options: &ReadOptions,
) -> Result<DecodedGuides, ReadErrorKind> {
    let folder = Folder::new();
    read_guides(&folder.file(parts), options).map_err(|error| error.kind)
}

#[track_caller]
pub(crate) fn is_seed(plane: &Plane, seed: usize) {
    let wrong = (0..W * H).find(|i| plane.at(i % W, i / W) != value(seed, i % W, i / W));
    assert_eq!((plane.file_size(), wrong), (SIZE, None), "channel {seed}");
}

/// Checks that motion is these channels multiplied by a scale.
#[track_caller]
pub(crate) fn is_motion(motion: &Motion, seeds: [usize; 2], scale: [f64; 2]) {
    assert_eq!((motion.file_size(), motion.scale()), (SIZE, scale));
    let (mut across, mut down) = (vec![0.0; W], vec![0.0; W]);
    for y in 0..H {
        motion.fill_row(y, 0..W, &mut across, &mut down);
        for x in 0..W {
            assert_eq!([across[x], down[x]], seeds.map(|seed| value(seed, x, y)), "({x}, {y})");
        }
    }
}

#[track_caller]
pub(crate) fn is_said(error: &ReadErrorKind, words: &[&str]) {
    let said = format!("{error}; {}", error.help());
    for word in words {
        assert!(said.contains(word), "{word:?} is not in: {said}");
    }
}

pub(crate) fn found(sought: Option<&fovqa_io::ChannelSearch>) -> Option<&str> {
    sought.and_then(|sought| sought.found.as_deref())
}

/// Checks that the colour is that of the channels 0, 1 and 2 of its part.
#[track_caller]
pub(crate) fn is_seed_frame(decoded: &Decoded) {
    for c in 0..3 {
        assert_eq!(decoded.frame.sample(c, 9, 8), value(c, 9, 8));
    }
}

pub(crate) fn two_layers() -> Part {
    part(&[
        "near.Combined.R",
        "near.Combined.G",
        "near.Combined.B",
        "near.Vector.X",
        "near.Vector.Y",
        "near.Depth.Z",
        "far.Combined.R",
        "far.Combined.G",
        "far.Combined.B",
        "far.Vector.X",
        "far.Vector.Y",
        "far.Depth.Z",
    ])
}
