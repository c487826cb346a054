//! Writes the regions of frames that figures show side by side.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

use fovqa_engine::{CropPair, EngineError, Entry, Finished, FoundRegion, Named};
use fovqa_frame::Frame;
use fovqa_io::{FrameFormat, encode_frame};
use fovqa_plan::Eye;
use fovqa_results::{
    CROPS, CropRecord, FileError, FrameResult, crop_folder, make_folder, write_json_file,
    write_whole,
};

use crate::kept_frames::copy;

/// Writes regions into a results folder.
#[derive(Debug)]
pub(crate) struct Crops {
    folder: PathBuf,
}

impl Crops {
    pub(crate) fn new(results: &Path) -> Self {
        Self { folder: results.to_owned() }
    }

    /// Whether the pictures of all regions exist that are in these frames.
    pub(crate) fn has<'a>(
        &self,
        regions: &[FoundRegion<'_>],
        scored: impl Iterator<Item = (Named<'a>, &'a FrameResult)>,
    ) -> bool {
        let mut of_frames: BTreeMap<_, Vec<&str>> = BTreeMap::new();
        for FoundRegion { region, scene, eye, frame } in regions {
            let place = (*scene, eye.map(Eye::name), *frame);
            of_frames.entry(place).or_default().push(&region.name);
        }
        let is_there =
            |path: PathBuf| path.metadata().is_ok_and(|file| file.is_file() && file.len() > 0);
        let mut scored = scored;
        scored.all(|(named, frame)| {
            let place = (named.scene, named.eye.map(Eye::name), frame.frame);
            of_frames.get(&place).into_iter().flatten().all(|region| {
                let folder = self.region(named, region);
                let test = CropRecord::test_file(&folder, named.method);
                let files = [CropRecord::file(&folder), CropRecord::reference_file(&folder), test];
                files.into_iter().all(is_there)
            })
        })
    }

    fn region(&self, named: Named<'_>, region: &str) -> PathBuf {
        crop_folder(&self.folder, named.scene, named.eye.map(fovqa_plan::Eye::name), region)
    }

    /// Writes the regions of a pair.
    pub(crate) fn write(&self, entry: &Entry<'_>) -> Result<(), EngineError> {
        let Entry::Pair(Finished { named, crops, .. }) = *entry else { return Ok(()) };
        for crop in crops {
            let folder = self.region(named, &crop.region);
            write(&folder, named.method, crop)
                .map_err(|error| EngineError::Region { path: folder, error })?;
        }
        Ok(())
    }
}

fn write(folder: &Path, method: &str, crop: &CropPair) -> io::Result<()> {
    let test = CropRecord::test_file(folder, method);
    make_folder(test.parent().unwrap_or(folder))?;
    let picture = |path: &Path, frame: &Frame| {
        let bytes = encode_frame(frame, FrameFormat::Png).map_err(io::Error::other)?;
        write_whole(path, &bytes).map_err(reason)
    };
    picture(&CropRecord::reference_file(folder), &crop.reference)?;
    picture(&test, &crop.test)?;
    let record = CropRecord {
        frame: crop.frame,
        frame_px: crop.frame_px,
        corner_px: crop.corner_px,
        gaze_px: crop.gaze_px,
        eccentricity_deg: crop.eccentricity_deg,
    };
    write_json_file(&CropRecord::file(folder), &record).map_err(reason)
}

fn reason(error: FileError) -> io::Error {
    match error {
        FileError::Write { error, .. } | FileError::Read { error, .. } => error,
        FileError::Format { detail, .. } => io::Error::other(detail),
    }
}

/// Copies the regions that a shard has cut out.
///
/// # Errors
/// If a file cannot be read or written.
pub(crate) fn copy_crops(shard: &Path, results: &Path) -> io::Result<()> {
    copy(&shard.join(CROPS), &results.join(CROPS))
}
