//! Writes the maps of each frame to files: the values, and images of them in colour.

use std::io;
use std::path::{Path, PathBuf};

use fovqa_engine::{EngineError, Entry, Finished, NO_MAPS, Named};
use fovqa_io::{exr_gray, exr_gray_half, png_rgb8};
use fovqa_metrics::{Map, Metric};
use fovqa_report::MapSheet;
use fovqa_results::{FileError, FrameResult, make_folder, padded, write_whole};

use crate::kept_frames::copy;
use crate::map_sheets::MapSheets;

/// The folder that maps are written to.
#[derive(Debug)]
pub(crate) struct MapsFolder {
    folder: PathBuf,
    /// Whether several comparisons write to the folder. Each then has a subfolder.
    several: bool,
    /// Names of the maps that are written; `None` for all.
    only: Option<Vec<&'static str>>,
    sheets: MapSheets,
}

/// The folder of maps in a results folder.
const FOLDER: &str = "maps";

impl MapsFolder {
    pub(crate) fn new(folder: PathBuf, several: bool) -> Self {
        Self { folder, several, only: None, sheets: MapSheets::default() }
    }

    /// The folder in the results of a run, for the maps of some metrics.
    pub(crate) fn kept(results: &Path, metrics: &[Metric]) -> Self {
        let names = metrics.iter().flat_map(|metric| metric.info().maps());
        let only = Some(names.map(|map| map.name).collect());
        Self { folder: results.join(FOLDER), several: true, only, sheets: MapSheets::default() }
    }

    /// The reason why finished frames cannot be used: they have no maps.
    pub(crate) fn lacking(&self) -> String {
        match self.only {
            None => NO_MAPS.to_owned(),
            Some(_) => "the maps of [output] are missing for finished frames".to_owned(),
        }
    }

    fn takes(&self, map: &str) -> bool {
        self.only.as_ref().is_none_or(|only| only.contains(&map))
    }

    /// The folder for a comparison.
    fn folder(&self, named: Named<'_>) -> PathBuf {
        let mut folder = self.folder.clone();
        if self.several {
            folder.extend([named.scene, named.method]);
        }
        folder.extend(named.eye.map(fovqa_plan::Eye::name));
        folder
    }

    /// Whether the maps of a frame exist, for all its metrics that have maps.
    pub(crate) fn has(&self, named: Named<'_>, frame: &FrameResult) -> bool {
        let folder = self.folder(named);
        let scored = Metric::ALL.into_iter().filter(|metric| frame.rows.has(*metric));
        let maps = scored.flat_map(|metric| metric.info().maps());
        let mut maps = maps.filter(|map| self.takes(map.name));
        let there =
            |path: PathBuf| path.metadata().is_ok_and(|file| file.is_file() && file.len() > 0);
        maps.all(|map| there(folder.join(values_file(map.name, frame.frame))))
    }

    /// Writes the maps of a pair, if there are any.
    pub(crate) fn write(&self, entry: &Entry<'_>) -> Result<(), EngineError> {
        let Entry::Pair(Finished { named, maps, seen, result: Ok(frame), .. }) = *entry else {
            return Ok(());
        };
        if maps.is_empty() {
            return Ok(());
        }
        let folder = self.folder(named);
        let at = |path: &Path, error| EngineError::Map { path: path.to_owned(), error };
        make_folder(&folder).map_err(|error| at(&folder, error))?;
        let mut named_files = Vec::new();
        for map in maps.iter().filter(|map| self.takes(map.info.name)) {
            let sheet = self.sheets.sheet(map, seen).map_err(|error| at(&folder, error))?;
            named_files.extend(files(map, &sheet, frame.frame));
        }
        for (name, bytes) in named_files {
            let path = folder.join(name);
            let bytes = bytes.map_err(|error| at(&path, error))?;
            write_whole(&path, &bytes).map_err(|error| match error {
                FileError::Write { path, error } | FileError::Read { path, error } => {
                    EngineError::Map { path, error }
                }
                FileError::Format { path, detail, .. } => {
                    EngineError::Map { path, error: io::Error::other(detail) }
                }
            })?;
        }
        Ok(())
    }
}

/// Why maps cannot be requested: none of the metrics has one.
pub fn maps_lacking(metrics: &[Metric]) -> Option<String> {
    let has = |metric: &Metric| metric.info().map.is_some();
    (!metrics.iter().any(has)).then(|| {
        let all = Metric::ALL.into_iter().filter(has).map(Metric::key);
        format!(
            "{{maps}}: none of the metrics has a map; these have one: {}",
            all.collect::<Vec<_>>().join(", ")
        )
    })
}

/// The files of a map, with their names.
fn files(map: &Map, sheet: &MapSheet, frame: i64) -> Vec<(String, io::Result<Vec<u8>>)> {
    let Map { info, frame_size, values, .. } = map;
    let (name, (width, height)) = (info.name, info.size(*frame_size));
    let coloured = sheet.png(map).map_err(io::Error::other);
    let coloured = (format!("{name}-{}.png", padded(frame)), coloured);
    let pictures = map.pictures.iter().map(|picture| {
        let bytes = png_rgb8(frame_size.0, frame_size.1, &picture.codes);
        (format!("{name}-{}-{}.png", picture.name, padded(frame)), bytes)
    });
    let values = if map.is_half {
        exr_gray_half(width, height, values)
    } else {
        exr_gray(width, height, values)
    };
    // The values are written last: if they exist, all files of the map exist.
    let values = (values_file(name, frame), values);
    [coloured].into_iter().chain(pictures).chain([values]).collect()
}

/// The name of the file with the values of a map.
fn values_file(map: &str, frame: i64) -> String {
    format!("{map}-{}.exr", padded(frame))
}

/// Copies the maps that a shard has written into its folder.
///
/// # Errors
/// If a file cannot be read or written.
pub(crate) fn copy_maps(shard: &Path, results: &Path) -> io::Result<()> {
    copy(&shard.join(FOLDER), &results.join(FOLDER))
}
