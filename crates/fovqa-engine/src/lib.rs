//! Turns a plan into results: frames are found, read ahead, checked and scored in order.
//!
//! This crate does not depend on TOML, drawing or the terminal. It reports messages and progress
//! through [`Events`].

mod assemble;
mod available_memory;
mod emulated_methods;
mod error;
mod events;
mod find;
mod find_gaze;
mod findings;
mod folder;
mod foresee;
mod found;
mod found_frame;
mod foveate;
mod foveator;
mod inputs;
mod join;
mod journal;
mod load;
mod memory;
mod merge;
mod meters;
mod needed_memory;
mod open_ended;
mod output_error;
mod read_ahead;
mod remarks;
mod resume;
mod retina;
mod run;
mod scoring;
mod settle;
mod setup;
mod share;
mod sources;
mod task;
mod test_source;
mod timing;
mod unit;
mod view;
mod view_sources;
mod work;

pub use assemble::results;
pub use error::EngineError;
pub use events::Events;
pub use find::find;
pub use findings::{Entry, Findings, Finished, Named, Record, Settled};
pub use folder::{FolderError, Locking, ResultsFolder};
pub use foresee::foresee;
pub use found::{FoundInputs, FoundView, Problem};
pub use found_frame::FoundFrame;
pub use foveate::{FoveatedFrame, TakeFrame, foveate};
pub use journal::{Header, JOURNAL, Journal, shard_in};
pub use merge::{MergeError, Shards};
pub use needed_memory::Needed;
pub use output_error::OutputError;
pub use resume::{NO_MAPS, Resumed, resume};
pub use run::{check, run, score};
pub use share::{Shard, ShardError};
pub use sources::Given;
pub use task::{Task, TaskError, TaskFindings};
pub use test_source::TestSource;
pub use unit::{Unit, units};
pub use view_sources::ViewSources;
