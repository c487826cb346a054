//! The frames of the last accepted build that a baseline keeps: reduced pictures and maps in a folder
//! beside its file. With them, a gate shows what has changed, and where.

use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use fovqa_engine::{EngineError, Entry, Finished, Named};
use fovqa_frame::Frame;
use fovqa_io::read_small_file;
use fovqa_metrics::Metric;
use fovqa_results::{
    Baseline, FileError, FrameImages, MapBlocks, TestRecord, make_folder, read_json_file,
    read_record, write_json_file, write_whole,
};
use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::finish::text_hash;
use crate::pictures::{Again, Small, blocks, clear_pictures, small};
use crate::reopened::{KnownInputs, Reopened};

/// Name and version of the format of the folder's record.
const SCHEMA: &str = "fovqa.baseline_frames/1";
const RECORD: &str = "frames.json";
/// Longer sides of the pictures in pixels; the first that is small enough is kept.
const SIDES: [usize; 5] = [512, 448, 384, 320, 256];
/// Bytes that a picture may have.
const MOST_BYTES: usize = 200_000;
/// Bytes of a picture that is read: an uncompressed one is not larger.
const MOST_PICTURE_BYTES: u64 = 4 << 20;

/// The record of the folder.
#[derive(Debug, Serialize, Deserialize)]
struct Record {
    schema: String,
    /// SHA-256 of the values of the baseline that the frames belong to.
    baseline: String,
}

/// The frames that a baseline keeps.
#[derive(Debug)]
pub(crate) struct BaselineFrames {
    folder: PathBuf,
}

impl BaselineFrames {
    /// The folder beside a baseline file: `nightly.baseline.frames` for `nightly.baseline.json`.
    pub(crate) fn folder_of(baseline: &Path) -> PathBuf {
        baseline.with_extension("frames")
    }

    /// The frames of a baseline; `None` if it keeps none.
    ///
    /// # Errors
    /// If the frames belong to other values than those of the baseline.
    pub(crate) fn open(path: &Path, baseline: &Baseline) -> Result<Option<Self>, String> {
        let folder = Self::folder_of(path);
        if !folder.join(RECORD).exists() {
            return Ok(None);
        }
        let record: Result<Record, FileError> =
            read_json_file(&folder.join(RECORD), SCHEMA, "the record of a baseline's frames");
        match record {
            Ok(record) if record.baseline == id(baseline) => Ok(Some(Self { folder })),
            Ok(_) => Err(format!(
                "{}: these frames belong to another baseline and are not shown; \
                 `fovqa baseline accept --frames` renews them",
                folder.display()
            )),
            Err(error) => Err(format!("{error}; its frames are not shown")),
        }
    }

    fn images(&self, named: Named<'_>, frame: i64) -> FrameImages {
        FrameImages::new(&self.folder, named.scene, named.eye, frame)
    }

    /// The picture of a method's frame; `None` if it is not kept, or damaged.
    pub(crate) fn picture(&self, named: Named<'_>, frame: i64) -> Option<Small> {
        let path = self.images(named, frame).test_on_page(named.method);
        // Only regular files, and only as large as such a picture can be.
        Small::read(&read_small_file(&path, MOST_PICTURE_BYTES).ok()?, SIDES[0]).ok()
    }

    /// The map of a method's frame; `None` if it is not kept, or damaged.
    pub(crate) fn map(&self, named: Named<'_>, frame: i64, map: &str) -> Option<MapBlocks> {
        let record: TestRecord = read_record(&self.images(named, frame).test_record(named.method))?;
        record.maps.into_iter().find(|blocks| blocks.map == map)
    }

    /// Reads the frames of a run again into a folder beside the one of a baseline, and returns their number.
    /// [`BaselineFrames::accept`] puts them in its place when the values are written.
    ///
    /// # Errors
    /// If an input has changed since it was scored, a file cannot be read or written, or the folder of the
    /// baseline's frames has other files.
    pub(crate) fn prepare(
        path: &Path,
        baseline: &Baseline,
        run: &Reopened,
        known: &KnownInputs,
    ) -> Result<usize, Error> {
        let folder = Self::folder_of(path);
        let failed = |error: &dyn std::fmt::Display| {
            Error::input(
                error.to_string(),
                "nothing was changed; correct this, or leave out --frames",
            )
        };
        if is_foreign(&folder) {
            let message = "this folder is not one of a baseline's frames";
            return Err(failed(&format!("{}: {message}", folder.display())));
        }
        let frames = Self { folder: Self::prepared(path) };
        let _ = fs::remove_dir_all(&frames.folder);
        let kept = frames.keep(baseline, run, known);
        if kept.is_err() {
            let _ = fs::remove_dir_all(&frames.folder);
        }
        kept.map_err(|error| failed(&error))
    }

    /// The folder in which frames are prepared: `.fovqa-nightly.baseline.frames` for
    /// `nightly.baseline.json`. What is left of an earlier one is removed, so nobody else may use its name.
    fn prepared(path: &Path) -> PathBuf {
        let mut name = OsString::from(".fovqa-");
        name.push(path.file_stem().unwrap_or_default());
        name.push(".frames");
        path.with_file_name(name)
    }

    fn keep(
        &self,
        baseline: &Baseline,
        run: &Reopened,
        known: &KnownInputs,
    ) -> Result<usize, String> {
        let plan = &run.experiment.plan;
        let mapped = Self::mapped(plan.metrics.metrics());
        let again = Again { plan, found: &run.found, mapped: &mapped, hash_inputs: true };
        let (mut count, mut lost) = (0, None);
        let scored = again.score(&|_, _| true, &mut |entry| {
            match &entry {
                Entry::Input(input) if !known.is_same(input) => {
                    lost.get_or_insert_with(|| {
                        format!("{}: the file has changed since it was scored", input.path)
                    });
                }
                Entry::Pair(Finished { named, result: Err(failure), .. }) => {
                    lost.get_or_insert_with(|| {
                        format!("{}, {}: {}", named.scene, named.method, failure.message)
                    });
                }
                _ => count += usize::from(self.write(&entry)?),
            }
            Ok(())
        });
        scored.map_err(|error| error.to_string())?;
        if let Some(lost) = lost {
            return Err(lost);
        }
        let record = Record { schema: SCHEMA.to_owned(), baseline: id(baseline) };
        write_json_file(&self.folder.join(RECORD), &record).map_err(|error| error.to_string())?;
        Ok(count)
    }

    /// Puts prepared frames in the place of earlier ones.
    pub(crate) fn accept(path: &Path) -> io::Result<()> {
        Self::remove(path)?;
        fs::rename(Self::prepared(path), Self::folder_of(path))
    }

    /// Removes prepared frames.
    pub(crate) fn forget(path: &Path) {
        let _ = fs::remove_dir_all(Self::prepared(path));
    }

    /// The metrics whose maps are kept: those in which a place can be looked for.
    fn mapped(scored: &[Metric]) -> Vec<Metric> {
        let mut mapped = vec![Metric::Mse];
        let others = scored.iter().filter_map(|metric| place_metric(*metric));
        for metric in others {
            if !mapped.contains(&metric) {
                mapped.push(metric);
            }
        }
        mapped
    }

    /// Removes the frames of earlier values.
    pub(crate) fn clear(&self) -> io::Result<()> {
        fovqa_results::take_away(&self.folder.join(RECORD))?;
        clear_pictures(&self.folder);
        Ok(())
    }

    /// Removes the frames beside a baseline, if there are any; whether there were.
    pub(crate) fn remove(path: &Path) -> io::Result<bool> {
        let frames = Self { folder: Self::folder_of(path) };
        let existed = frames.folder.join(RECORD).exists();
        if existed {
            frames.clear()?;
            let _ = fs::remove_dir(&frames.folder);
        }
        Ok(existed)
    }

    fn write(&self, entry: &Entry<'_>) -> Result<bool, EngineError> {
        let Entry::Pair(Finished {
            named, maps, pictures: Some(pictures), result: Ok(frame), ..
        }) = *entry
        else {
            return Ok(false);
        };
        let images = self.images(named, frame.frame);
        let write = || -> io::Result<()> {
            make_folder(&images.method(named.method))?;
            let picture = kept_picture(&pictures.test)?;
            write_whole(&images.test_on_page(named.method), &picture).map_err(io::Error::other)?;
            let maps = maps.iter().map(|map| blocks(map, SIDES[0])).collect();
            let record = TestRecord { borders: Vec::new(), maps };
            let text = serde_json::to_string(&record)? + "\n";
            fs::write(images.test_record(named.method), text)?;
            // It marks the folder as one of a frame.
            fs::write(images.record(), "{}\n")
        };
        write()
            .map_err(|error| EngineError::Picture { path: images.folder().to_owned(), error })?;
        Ok(true)
    }
}

/// Whether a folder exists that has something, but no frames of a baseline.
fn is_foreign(folder: &Path) -> bool {
    let has_entries = fs::read_dir(folder).is_ok_and(|mut entries| entries.next().is_some());
    (has_entries || folder.is_file()) && !folder.join(RECORD).is_file()
}

/// The metric in whose map the place of a loss is looked for; `None` if it has to be another metric's.
/// The map of FovVideoVDP also shows what was lost in the frames before.
pub(crate) fn place_metric(metric: Metric) -> Option<Metric> {
    match metric {
        Metric::Fvvdp => None,
        Metric::Psnr | Metric::Mse => Some(Metric::Mse),
        Metric::Fssim | Metric::MsSsim => Some(Metric::Ssim),
        metric => metric.info().map.map(|_| metric),
    }
}

fn kept_picture(frame: &Frame) -> io::Result<Vec<u8>> {
    let mut kept = Vec::new();
    for side in SIDES {
        kept = small(frame, side)?.webp()?;
        if kept.len() <= MOST_BYTES {
            break;
        }
    }
    Ok(kept)
}

fn id(baseline: &Baseline) -> String {
    text_hash(&serde_json::to_string(&baseline.comparisons).unwrap_or_default())
}
