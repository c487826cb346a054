//! Writes pictures of frames, their maps, and what the page holds of them.

use std::io;
use std::path::{Path, PathBuf};

use fovqa_engine::{EngineError, Entry, Finished, Named, PicturePair};
use fovqa_frame::Frame;
use fovqa_io::{FrameFormat, encode_frame};
use fovqa_metrics::Map;
use fovqa_results::{
    Batch, FileError, FrameImages, FrameRecord, FrameView, TestRecord, make_folder, read_record,
};
use fovqa_vision::Seen;
use rayon::prelude::*;
use serde::Serialize;

use super::blocks::blocks;
use super::reduced::reduced;
use crate::crops::reason;
use crate::map_sheets::MapSheets;

/// Writes pictures into a results folder.
#[derive(Debug)]
pub(crate) struct Pictures {
    results: PathBuf,
    /// Longer side of the pictures on the page, in pixels.
    size: usize,
    /// The frame whose reference was written last.
    written: Option<FrameImages>,
    batch: Batch,
    sheets: MapSheets,
}

/// A file and what makes its content.
type Job<'a> = (PathBuf, Box<dyn Fn() -> io::Result<Vec<u8>> + Sync + Send + 'a>);

impl Pictures {
    pub(crate) fn new(results: &Path, size: usize) -> Self {
        Self {
            results: results.to_owned(),
            size,
            written: None,
            batch: Batch::default(),
            sheets: MapSheets::default(),
        }
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
            && files
                .into_iter()
                .chain(maps)
                .all(|path| path.metadata().is_ok_and(|file| file.is_file() && file.len() > 0))
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
        jobs.par_iter()
            .try_for_each(|(path, make)| self.batch.write(path, &make()?).map_err(reason))?;
        let maps: Vec<_> = maps.par_iter().map(|map| blocks(map, self.size)).collect();
        let frame = FrameRecord {
            size: self.size,
            frame_px: [test.width(), test.height()],
            view: seen.map(view_of),
        };
        write_record(&self.batch, &images.record(), &frame).map_err(reason)?;
        // The record is written last: if it exists, all pictures do.
        let test = TestRecord { borders: pictures.borders.clone(), maps };
        write_record(&self.batch, &images.test_record(method), &test).map_err(reason)
    }

    /// Makes sure that what was written is on the disk.
    pub(crate) fn flush(&self) {
        self.batch.flush();
    }
}

/// Writes a record as one line of JSON: long lists of positions are for programs alone.
pub(super) fn write_record(
    batch: &Batch,
    path: &Path,
    record: &impl Serialize,
) -> Result<(), FileError> {
    batch.write_with(path, |mut out| {
        serde_json::to_writer(&mut out, record)?;
        out.write_all(b"\n")
    })
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
