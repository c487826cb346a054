//! What can go wrong between a figure and its picture.

use std::error::Error;

use thiserror::Error;

/// Why a figure could not be drawn.
#[derive(Debug, Error)]
pub enum PlotError {
    /// A series of bars or boxes does not fit the groups of its chart.
    #[error("the series \"{series}\" has {found} values for {expected} groups")]
    Groups {
        /// The series.
        series: String,
        /// Its values.
        found: usize,
        /// The groups.
        expected: usize,
    },
    /// The values of a picture are not one for each cell.
    #[error("the picture \"{panel}\" has {found} values for {columns} x {rows} cells")]
    Cells {
        /// The title of the picture.
        panel: String,
        /// Its values.
        found: usize,
        /// Cells of a row.
        columns: usize,
        /// Rows.
        rows: usize,
    },
    /// A picture has no part of the plane to lie over.
    #[error("the picture \"{panel}\" needs ranges of finite numbers, from left to right")]
    Extent {
        /// The title of the picture.
        panel: String,
    },
    /// The drawing library refused.
    #[error("the SVG could not be written")]
    Draw(#[source] Box<dyn Error + Send + Sync>),
    /// The text to make a PNG of is no SVG.
    #[error("the SVG could not be read")]
    Svg(#[source] Box<dyn Error + Send + Sync>),
    /// A scale that makes no picture.
    #[error(
        "the scale {scale} makes a PNG of {width} x {height} pixels, not of 1 to {} a side",
        crate::limits::MAX_SIDE_PX
    )]
    Size {
        /// Pixels of the PNG for each of the SVG.
        scale: f32,
        /// Width in pixels, rounded up.
        width: f32,
        /// Height in pixels, rounded up.
        height: f32,
    },
    /// The PNG could not be encoded.
    #[error("the PNG could not be encoded")]
    Encode(#[source] Box<dyn Error + Send + Sync>),
}

impl PlotError {
    /// Holds the number of a series' values to the number of groups.
    pub(crate) fn check_groups(
        series: &str,
        found: usize,
        expected: usize,
    ) -> Result<(), PlotError> {
        if found == expected {
            return Ok(());
        }
        Err(Self::Groups { series: series.to_owned(), found, expected })
    }
}
