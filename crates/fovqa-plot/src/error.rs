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
    /// The resolution does not make a picture.
    #[error(
        "{dpi} pixels per inch make a PNG of {width} x {height} pixels; each side must have 1 to {}",
        crate::limits::MAX_SIDE_PX
    )]
    Size {
        /// Pixels per inch.
        dpi: f32,
        /// Width in pixels, rounded up.
        width: f32,
        /// Height in pixels, rounded up.
        height: f32,
    },
    /// A frame has no pixels, or too many for a drawing.
    #[error(
        "a frame of {width} x {height} pixels cannot be drawn; each side must have 1 to {most}"
    )]
    Frame {
        /// Width in pixels.
        width: usize,
        /// Height in pixels.
        height: usize,
        /// The longest side in pixels.
        most: usize,
    },
    /// The figure does not fit into the width that was asked for.
    #[error(
        "a width of {width_in} in is too narrow: the smallest text would be under {} pt; it needs {least_in} in",
        crate::limits::LEAST_PT
    )]
    Narrow {
        /// The width asked for, in inches.
        width_in: f64,
        /// The smallest possible width, in inches.
        least_in: f64,
    },
    /// The figure does not fit into the height that was asked for.
    #[error(
        "a height of {height_in} in is too low: title, legend and axes leave no room; it needs {least_in} in"
    )]
    Low {
        /// The height asked for, in inches.
        height_in: f64,
        /// The smallest possible height, in inches.
        least_in: f64,
    },
    /// A picture keeps its sides' ratio, so that a height cannot be asked for.
    #[error(
        "a height of {height_in:.2} in is not possible: the height of pictures follows from their width; set only the width"
    )]
    FollowsFromWidth {
        /// The height asked for, in inches.
        height_in: f64,
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
