//! A built-in sequence as a source of frames like any other.

use std::sync::Arc;

use fovqa_frame::source::{
    InputId, Length, Listing, Origin, Picture, PictureGuides, Source, SourceError,
};
use fovqa_params::Words;

use crate::builtin::Builtin;

/// A built-in sequence as a source of frames: linear light in floats, with motion and depth.
#[derive(Debug)]
pub struct BuiltinSource {
    builtin: Arc<Builtin>,
    listing: Listing,
    id: InputId,
}

impl BuiltinSource {
    /// The source of a sequence. `id` stands for everything that it is made of.
    pub fn new(builtin: Arc<Builtin>, id: InputId) -> Self {
        let name = format!("builtin:{}", builtin.spec().scene.word());
        let listing = Listing::counted(name, Length::Whole(builtin.spec().frames));
        Self { builtin, listing, id }
    }

    /// The sequence as an input of a run. Sequences of one scene differ in their names, as files do: two
    /// eyes, or two sizes, are two inputs.
    fn input(&self) -> (String, InputId) {
        let short: String = self.id.sha256.chars().take(8).collect();
        (format!("{}#{short}", self.listing.argument), self.id.clone())
    }

    fn check(&self, frame: usize) -> Result<(), SourceError> {
        if frame < self.builtin.spec().frames {
            return Ok(());
        }
        let message = format!("{} has no frame {frame}", self.listing.argument);
        let mut error = SourceError::new(message, "ask for more frames of the built-in scene");
        error.has_ended = true;
        Err(error)
    }
}

impl Source for BuiltinSource {
    fn listing(&self) -> &Listing {
        &self.listing
    }

    fn size(&self, _frame: usize) -> Result<(usize, usize), SourceError> {
        let view = self.builtin.view();
        Ok((view.width, view.height))
    }

    fn bytes_per_pixel(&self) -> u64 {
        12
    }

    fn read(&self, frame: usize, guides: bool) -> Result<Picture, SourceError> {
        self.check(frame)?;
        let mut picture = Picture::new(self.builtin.ground_truth(frame));
        if guides {
            picture.guides = self.builtin.guides(frame);
        }
        picture.inputs = vec![self.input()];
        Ok(picture)
    }

    fn read_guides(&self, frame: usize) -> Result<PictureGuides, SourceError> {
        self.check(frame)?;
        let guides = self.builtin.guides(frame);
        Ok(PictureGuides { guides, notes: Vec::new(), inputs: vec![self.input()] })
    }

    fn origins(&self, _frame: usize) -> Vec<(String, Origin)> {
        let (name, id) = self.input();
        vec![(name, Origin::Made(id))]
    }

    fn fps(&self) -> Option<f64> {
        Some(self.builtin.spec().fps)
    }
}
