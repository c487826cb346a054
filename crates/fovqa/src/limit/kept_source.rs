//! A source whose frames are read once and kept, as far as memory allows: a search reads the same
//! references again and again.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use fovqa_frame::source::{Listing, Origin, Picture, PictureGuides, Source, SourceError};

/// Maximum size in bytes of the frames that are kept, of all sources together.
const MOST_BYTES: usize = 1 << 30;

/// The frames that are kept, by the number of their source.
#[derive(Debug, Default)]
pub(super) struct KeptFrames {
    frames: Mutex<Kept>,
}

#[derive(Debug, Default)]
struct Kept {
    pictures: BTreeMap<(usize, usize, bool), Picture>,
    bytes: usize,
}

/// A source that keeps its frames.
#[derive(Debug)]
pub(super) struct KeptSource {
    pub(super) source: Arc<dyn Source>,
    pub(super) number: usize,
    pub(super) kept: Arc<KeptFrames>,
}

impl Source for KeptSource {
    fn listing(&self) -> &Listing {
        self.source.listing()
    }

    fn size(&self, frame: usize) -> Result<(usize, usize), SourceError> {
        self.source.size(frame)
    }

    fn bytes_per_pixel(&self) -> u64 {
        self.source.bytes_per_pixel()
    }

    fn read(&self, frame: usize, guides: bool) -> Result<Picture, SourceError> {
        let key = (self.number, frame, guides);
        let lock = || self.kept.frames.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(picture) = lock().pictures.get(&key) {
            return Ok(picture.clone());
        }
        let picture = self.source.read(frame, guides)?;
        let bytes = picture.frame.bytes() + picture.guides.bytes();
        let mut kept = lock();
        if kept.bytes + bytes <= MOST_BYTES && kept.pictures.insert(key, picture.clone()).is_none()
        {
            kept.bytes += bytes;
        }
        Ok(picture)
    }

    fn read_guides(&self, frame: usize) -> Result<PictureGuides, SourceError> {
        self.source.read_guides(frame)
    }

    fn origins(&self, frame: usize) -> Vec<(String, Origin)> {
        self.source.origins(frame)
    }

    fn fps(&self) -> Option<f64> {
        self.source.fps()
    }

    fn code_bits(&self) -> Option<u32> {
        self.source.code_bits()
    }

    fn is_read_once(&self) -> bool {
        self.source.is_read_once()
    }

    fn has_more(&self) -> Result<bool, SourceError> {
        self.source.has_more()
    }
}
