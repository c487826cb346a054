//! Scores for people.

mod terminal;

pub use terminal::score_table;
