//! From a plan to results: frames are found, read ahead, checked and scored in order.
//!
//! Knows nothing of TOML, drawing or the terminal; what it has to say on the way goes through
//! [`Events`].

mod error;
mod events;
mod find;
mod folder;
mod inputs;
mod journal;
mod light;
mod load;
mod read_ahead;
mod retina;
mod run;
mod scoring;
mod settle;
mod setup;
mod temporal;
mod timing;
mod view;

pub use error::EngineError;
pub use events::Events;
pub use find::{Found, FoundFrame, FoundView, Problem, find};
pub use folder::{FolderError, ResultsFolder};
pub use journal::{JOURNAL, Journal};
pub use light::FvvdpMaps;
pub use run::{Finished, Record, check, run};
