//! Reading a study's table: CSV, the roles of columns, selected rows, groups, and order.
//!
//! A [`Table`] holds all cells. A [`Data`] is a selection of its rows in which columns are found by
//! their role. [`Levels`] numbers the values of a column.

mod data;
mod levels;
mod selection;
mod table;
mod validation;

pub use data::Data;
pub use levels::Levels;
pub use selection::Selection;
pub use table::{Column, Table};
pub use validation::{Validation, without_validation};
