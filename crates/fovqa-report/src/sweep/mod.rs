//! What a sweep found: maps and curves over its parameters, and the best point of each grid.

mod figures;
mod grid;
mod optima;

pub(crate) use figures::figures;
pub(crate) use optima::optima;
