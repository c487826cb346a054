//! Where the tests of a method come from.

use std::sync::Arc;

use fovqa_frame::source::{Listing, Source};
use fovqa_plan::Emulation;

/// Where the tests of a method come from.
#[derive(Debug, Clone)]
pub enum TestSource {
    /// They are read.
    Read(Arc<dyn Source>),
    /// They are emulated from the reference. A test has the index of its reference.
    Emulated(Arc<Emulation>),
}

impl TestSource {
    /// The source that is read, if there is one.
    pub fn read(&self) -> Option<&dyn Source> {
        match self {
            Self::Read(source) => Some(&**source),
            Self::Emulated(_) => None,
        }
    }

    /// The emulation, if the tests are emulated.
    pub fn emulation(&self) -> Option<&Emulation> {
        match self {
            Self::Read(_) => None,
            Self::Emulated(emulation) => Some(emulation),
        }
    }

    /// The name of a test in results; an emulated one is named after its reference.
    pub(crate) fn name(&self, reference: &Listing, test: usize) -> String {
        match self {
            Self::Read(source) => source.listing().name(test).to_owned(),
            Self::Emulated(emulation) => emulated(emulation, reference.name(test)),
        }
    }

    /// The name of a test in messages, which is unique.
    pub(crate) fn label(&self, reference: &Listing, test: usize) -> String {
        match self {
            Self::Read(source) => source.listing().label(test),
            Self::Emulated(emulation) => emulated(emulation, &reference.label(test)),
        }
    }

    /// What the user gave, as results show it.
    pub(crate) fn argument(&self, reference: &Listing) -> String {
        match self {
            Self::Read(source) => source.listing().argument.clone(),
            Self::Emulated(emulation) => emulated(emulation, &reference.argument),
        }
    }
}

fn emulated(emulation: &Emulation, reference: &str) -> String {
    format!("{}({reference})", emulation.spec.key())
}
