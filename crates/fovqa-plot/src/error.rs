//! Errors of drawing a figure.

use std::error::Error;

use thiserror::Error;

/// The reason why a figure could not be drawn.
#[derive(Debug, Error)]
pub enum PlotError {
    /// A series of bars or boxes does not fit the groups of its chart.
    #[error("the series \"{series}\" has {found} values for {expected} groups")]
    Groups {
        /// The series.
        series: String,
        /// Its number of values.
        found: usize,
        /// The number of groups.
        expected: usize,
    },
    /// The number of a picture's values differs from its number of cells.
    #[error("the picture \"{panel}\" has {found} values for {columns} x {rows} cells")]
    Cells {
        /// The title of the picture.
        panel: String,
        /// Its number of values.
        found: usize,
        /// The number of cells in a row.
        columns: usize,
        /// The number of rows.
        rows: usize,
    },
    /// A picture does not cover a part of the plane.
    #[error("the picture \"{panel}\" needs ranges of finite numbers, from left to right")]
    Extent {
        /// The title of the picture.
        panel: String,
    },
    /// The drawing library reports an error.
    #[error("the SVG could not be written")]
    Draw(#[source] Box<dyn Error + Send + Sync>),
    /// The text for a PNG is not SVG.
    #[error("the SVG could not be read")]
    Svg(#[source] Box<dyn Error + Send + Sync>),
    /// The scale does not make a picture.
    #[error(
        "the scale {scale} makes a PNG of {width} x {height} pixels; each side must have 1 to {}",
        crate::limits::MAX_SIDE_PX
    )]
    Size {
        /// PNG pixels per SVG pixel.
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
    /// Checks that a series has one value per group.
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
