//! The frames of the last accepted build that a baseline keeps: reduced pictures and maps in a folder
//! beside its file. With them, a gate shows what has changed, and where.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use fovqa_engine::{EngineError, Entry, Finished, Named};
use fovqa_frame::Frame;
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
        Small::read(&fs::read(path).ok()?, SIDES[0]).ok()
    }

    /// The map of a method's frame; `None` if it is not kept, or damaged.
    pub(crate) fn map(&self, named: Named<'_>, frame: i64, map: &str) -> Option<MapBlocks> {
        let record: TestRecord = read_record(&self.images(named, frame).test_record(named.method))?;
        record.maps.into_iter().find(|blocks| blocks.map == map)
    }

    /// Keeps the frames of a run, and returns their number. Earlier frames are replaced.
    ///
    /// # Errors
    /// If an input has changed since it was scored, or a file cannot be read or written.
    pub(crate) fn save(
        path: &Path,
        baseline: &Baseline,
        run: &Reopened,
        known: &KnownInputs,
    ) -> Result<usize, Error> {
        let frames = Self { folder: Self::folder_of(path) };
        let failed = |error: &dyn std::fmt::Display| {
            Error::input(
                error.to_string(),
                "the baseline is written; correct this, and use `fovqa baseline accept --frames`",
            )
        };
        // Without its record, a folder that is only partly written is not used.
        frames.clear().map_err(|error| failed(&format!("{}: {error}", frames.folder.display())))?;
        let plan = &run.experiment.plan;
        let mapped = Self::mapped(plan.metrics.metrics());
        let again = Again { plan, found: &run.found, mapped: &mapped, hash_inputs: true };
        let (mut count, mut changed, mut lost) = (0, None, None);
        let scored = again.score(&|_, _| true, &mut |entry| {
            match &entry {
                Entry::Input(input) if !known.is_same(input) => {
                    changed.get_or_insert_with(|| input.path.clone());
                }
                Entry::Pair(Finished { named, result: Err(failure), .. }) => {
                    lost.get_or_insert_with(|| {
                        format!("{}, {}: {}", named.scene, named.method, failure.message)
                    });
                }
                _ => count += usize::from(frames.write(&entry)?),
            }
            Ok(())
        });
        scored.map_err(|error| failed(&error))?;
        if let Some(path) = changed {
            return Err(failed(&format!("{path}: the file has changed since it was scored")));
        }
        if let Some(lost) = lost {
            return Err(failed(&lost));
        }
        let record = Record { schema: SCHEMA.to_owned(), baseline: id(baseline) };
        write_json_file(&frames.folder.join(RECORD), &record).map_err(|error| failed(&error))?;
        Ok(count)
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
