//! Writes pictures of frames, their maps, and what the page holds of them.

use std::fs;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use fovqa_engine::{EngineError, Entry, Finished, Named, PicturePair};
use fovqa_frame::Frame;
use fovqa_io::{FrameFormat, encode_frame};
use fovqa_metrics::Map;
use fovqa_results::{
    FrameImages, FrameRecord, FrameView, TestRecord, make_folder, open_result_file, read_record,
    take_away,
};
use fovqa_vision::Seen;
use rayon::prelude::*;
use serde::Serialize;

use super::blocks::blocks;
use super::reduced::reduced;
use crate::map_sheets::MapSheets;

/// Writes pictures into a results folder.
#[derive(Debug)]
pub(crate) struct Pictures {
    results: PathBuf,
    /// Longer side of the pictures on the page, in pixels.
    size: usize,
    /// The frame whose reference was written last.
    written: Option<FrameImages>,
    sheets: MapSheets,
}

/// A file and what makes its content.
type Job<'a> = (PathBuf, Box<dyn Fn() -> io::Result<Vec<u8>> + Sync + Send + 'a>);

impl Pictures {
    pub(crate) fn new(results: &Path, size: usize) -> Self {
        Self { results: results.to_owned(), size, written: None, sheets: MapSheets::default() }
    }

    fn images(&self, named: Named<'_>, frame: i64) -> FrameImages {
        FrameImages::new(&self.results, named.scene, named.eye, frame)
    }

    /// Whether the pictures of a method's frame exist, in the size of the page.
    pub(crate) fn has(&self, named: Named<'_>, frame: i64) -> bool {
        let images = self.images(named, frame);
        let record: Option<FrameRecord> = read_record(&images.record());
        let test: Option<TestRecord> = read_record(&images.test_record(named.method));
        let (Some(record), Some(test)) = (record, test) else { return false };
        let maps = test.maps.iter().map(|map| images.map(named.method, &map.map));
        let files = [
            images.reference(),
            images.reference_on_page(),
            images.test(named.method),
            images.test_on_page(named.method),
        ];
        record.size == self.size
            && files.into_iter().chain(maps).all(|path| is_whole(&path).unwrap_or(false))
    }

    /// Removes the maps of a method's frame except those for which `is_kept` holds.
    pub(super) fn keep_maps(
        &self,
        named: Named<'_>,
        frame: i64,
        is_kept: impl Fn(&str) -> bool,
    ) -> io::Result<()> {
        let images = self.images(named, frame);
        let path = images.test_record(named.method);
        let Some(TestRecord { borders, maps }) = read_record(&path) else { return Ok(()) };
        let (kept, dropped): (Vec<_>, Vec<_>) = maps.into_iter().partition(|map| is_kept(&map.map));
        if dropped.is_empty() {
            return Ok(());
        }
        for map in dropped {
            take_away(&images.map(named.method, &map.map))?;
        }
        fs::write(path, record_text(&TestRecord { borders, maps: kept })?)
    }

    /// Writes the pictures of a pair, if the report shows it.
    pub(crate) fn write(&mut self, entry: &Entry<'_>) -> Result<(), EngineError> {
        let Entry::Pair(Finished {
            named,
            maps,
            seen,
            pictures: Some(pictures),
            result: Ok(frame),
            ..
        }) = *entry
        else {
            return Ok(());
        };
        let images = self.images(named, frame.frame);
        let failed = |error| EngineError::Picture { path: images.folder().to_owned(), error };
        self.pair(&images, named.method, (pictures, maps, seen)).map_err(failed)?;
        self.written = Some(images);
        Ok(())
    }

    fn pair(
        &self,
        images: &FrameImages,
        method: &str,
        (pictures, maps, seen): (&PicturePair, &[Map], Option<&Seen>),
    ) -> io::Result<()> {
        make_folder(&images.method(method))?;
        // Without their record, pictures that are only partly replaced are taken again.
        take_away(&images.test_record(method))?;
        let (reference, test) = (&*pictures.reference, &pictures.test);
        let mut jobs: Vec<Job<'_>> = Vec::new();
        if self.written.as_ref() != Some(images) {
            jobs.push((images.reference(), Box::new(|| full(reference))));
            let small = || reduced(reference, self.size);
            jobs.push((images.reference_on_page(), Box::new(small)));
        }
        jobs.push((images.test(method), Box::new(|| full(test))));
        jobs.push((images.test_on_page(method), Box::new(|| reduced(test, self.size))));
        for map in maps {
            let picture = move || self.sheets.sheet(map, seen)?.png(map).map_err(io::Error::other);
            jobs.push((images.map(method, map.info.name), Box::new(picture)));
        }
        // There are many, and they can be taken again: nothing waits until they are on the disk.
        jobs.par_iter().try_for_each(|(path, make)| fs::write(path, make()?))?;
        let maps: Vec<_> = maps.par_iter().map(|map| blocks(map, self.size)).collect();
        let frame = FrameRecord {
            size: self.size,
            frame_px: [test.width(), test.height()],
            view: seen.map(view_of),
        };
        fs::write(images.record(), record_text(&frame)?)?;
        // The record is written last: if it exists, all pictures do.
        let test = TestRecord { borders: pictures.borders.clone(), maps };
        fs::write(images.test_record(method), record_text(&test)?)
    }
}

/// Whether a picture, PNG or WebP, was written to its end.
fn is_whole(path: &Path) -> io::Result<bool> {
    const IEND_BYTES: i64 = 8;
    let mut file = open_result_file(path).map_err(io::Error::other)?;
    let bytes = file.metadata()?.len();
    let mut word = [0; 4];
    file.read_exact(&mut word)?;
    if &word == b"RIFF" {
        file.read_exact(&mut word)?;
        return Ok(u64::from(u32::from_le_bytes(word)) + 8 == bytes);
    }
    file.seek(SeekFrom::End(-IEND_BYTES))?;
    file.read_exact(&mut word)?;
    Ok(&word == b"IEND")
}

/// A record as one line of JSON: long lists of positions are for programs alone.
pub(super) fn record_text(record: &impl Serialize) -> io::Result<String> {
    Ok(serde_json::to_string(record)? + "\n")
}

fn full(frame: &Frame) -> io::Result<Vec<u8>> {
    encode_frame(frame, FrameFormat::Png).map_err(io::Error::other)
}

fn view_of(seen: &Seen) -> FrameView {
    let view = seen.eccentricity.view();
    let last = seen.bands.iter().last().map(|(_, to)| to);
    FrameView {
        focal_px: view.focal_px,
        principal_px: view.principal_px,
        gaze_px: seen.eccentricity.gaze_px(),
        eccentricity: seen.eccentricity.kind(),
        bands_deg: seen.bands.iter().map(|(from, _)| from).chain(last).collect(),
    }
}
