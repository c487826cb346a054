//! Images in memory as a source of frames.

use fovqa_frame::Frame;
use fovqa_frame::source::{
    Entry, Frames, Listing, Numbering, Origin, Picture, PictureGuides, Source, SourceError,
};

/// One image in memory.
#[derive(Debug)]
pub(crate) struct InMemory {
    listing: Listing,
    frame: Frame,
}

impl InMemory {
    pub(crate) fn new(name: &str, frame: Frame) -> Self {
        let entry = Entry { name: name.into(), stem: name.into(), number: None };
        let listing = Listing {
            argument: name.to_owned(),
            is_single: true,
            frames: Frames::Named(vec![entry]),
            numbering: Numbering::ByPosition,
        };
        Self { listing, frame }
    }
}

impl Source for InMemory {
    fn listing(&self) -> &Listing {
        &self.listing
    }

    fn size(&self, _frame: usize) -> Result<(usize, usize), SourceError> {
        Ok((self.frame.width(), self.frame.height()))
    }

    fn bytes_per_pixel(&self) -> u64 {
        self.frame.bytes() as u64 / (self.frame.width() * self.frame.height()).max(1) as u64
    }

    fn read(&self, _frame: usize, _guides: bool) -> Result<Picture, SourceError> {
        Ok(Picture::new(self.frame.clone()))
    }

    fn read_guides(&self, _frame: usize) -> Result<PictureGuides, SourceError> {
        let message = format!("{}: it has neither motion nor depth", self.listing.argument);
        Err(SourceError::new(message, "give motion and depth files"))
    }

    fn origins(&self, _frame: usize) -> Vec<(String, Origin)> {
        Vec::new()
    }
}
