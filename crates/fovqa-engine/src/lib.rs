//! From a request to results: frames are found, read ahead, checked and scored in order.
//!
//! Knows nothing of TOML, drawing or the terminal; what it has to say on the way goes through
//! [`Events`].

mod error;
mod events;
mod load;
mod plan;
mod read_ahead;
mod request;
mod retina;
mod score;
mod setup;

pub use error::EngineError;
pub use events::Events;
pub use read_ahead::read_ahead;
pub use request::{Gaze, MetricChoice, Nonfinite, ScoreRequest};
pub use score::score;
