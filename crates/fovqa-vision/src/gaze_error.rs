//! Errors of gaze traces: the file cannot be read, or it does not fit the sequence.

use thiserror::Error;

/// A gaze trace that cannot be read, or does not fit the sequence.
#[derive(Debug, Error)]
pub enum GazeTraceError {
    /// The file is not CSV.
    #[error("it is not a CSV table: {0}")]
    Csv(#[from] csv::Error),
    /// A required column is missing.
    #[error("it has no column {wanted}; its columns are: {found}")]
    Column {
        /// The column that was looked for.
        wanted: &'static str,
        /// The columns that exist.
        found: String,
        /// The eye tracker whose export the columns look like.
        export: Option<Export>,
    },
    /// A column exists twice.
    #[error("it has the column {0} twice")]
    TwoColumns(&'static str),
    /// A cell is not a number.
    #[error("line {line}: {column} has {found:?} instead of {wanted}")]
    Number {
        /// Line of the file, from 1.
        line: u64,
        /// The column.
        column: &'static str,
        /// The text of the cell.
        found: String,
        /// What it should be.
        wanted: &'static str,
    },
    /// Two rows belong to one frame.
    #[error("line {line}: there is already a row for frame {frame}")]
    Twice {
        /// Line of the file, from 1.
        line: u64,
        /// The frame's number.
        frame: i64,
    },
    /// Rows are out of order, or two rows have the same time.
    #[error("line {line}: {clock} {at} is not greater than {before} in the row before")]
    Order {
        /// Line of the file, from 1.
        line: u64,
        /// `frame` or `time_s`.
        clock: &'static str,
        /// The value of this row.
        at: f64,
        /// The value of the row before it.
        before: f64,
    },
    /// The table has no rows.
    #[error("it has no rows")]
    Empty,
    /// The positions are shares of the frame, not pixels.
    #[error(
        "all its positions are between {from} and {to}: they look like fractions of the frame, but x_px and \
         y_px must be pixels"
    )]
    Shares {
        /// The smallest coordinate.
        from: f64,
        /// The largest coordinate.
        to: f64,
    },
    /// The trace gives times, but there is no frame rate.
    #[error("it gives times in seconds, but the frame rate is not known")]
    NoFps,
    /// The trace has no gaze for a frame.
    #[error("it has no gaze for frame {frame}; it covers the frames {from} to {to}")]
    Missing {
        /// The frame's number.
        frame: i64,
        /// First frame of the trace.
        from: i64,
        /// Last frame of the trace.
        to: i64,
    },
    /// The trace has no gaze near the time of a frame.
    #[error(
        "it has no gaze for frame {frame}, which is shown at {at_s} s; it covers time_s {from_s} to {to_s}, and times start at 0 with the first frame of the sequence"
    )]
    MissingTime {
        /// The frame's number.
        frame: i64,
        /// Time of the frame, in seconds from the first frame.
        at_s: f64,
        /// Start of the trace, in seconds.
        from_s: f64,
        /// End of the trace, in seconds.
        to_s: f64,
    },
    /// A frame is a blink, or not covered by the trace, and there is no earlier gaze to hold.
    #[error("frame {frame} has no gaze, and there is no earlier gaze that could be kept")]
    NothingToHold {
        /// The frame's number.
        frame: i64,
    },
}

/// The eye tracker whose export format a table looks like.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Export {
    /// Tobii Pro Lab.
    Tobii,
    /// Pupil Labs.
    Pupil,
    /// Varjo.
    Varjo,
}

impl Export {
    /// Recognises the format by the headings of the table.
    pub(crate) fn of(headings: &[String]) -> Option<Self> {
        let has = |part: &str| headings.iter().any(|heading| heading.to_lowercase().contains(part));
        if has("norm_pos_x") || has("gaze x [px]") {
            Some(Self::Pupil)
        } else if has("gaze point x") || has("gazepointx") || has("recording timestamp") {
            Some(Self::Tobii)
        } else if has("gaze_forward") || has("gaze forward") {
            Some(Self::Varjo)
        } else {
            None
        }
    }

    /// How to convert the export to a gaze trace.
    fn help(self) -> &'static str {
        match self {
            Self::Tobii => {
                "this looks like an export of Tobii: gaze points are pixels of the screen, so subtract the frame's position there, \
                 keep one row per frame, and name the columns frame,x_px,y_px (or time_s, in seconds from the first frame)"
            }
            Self::Pupil => {
                "this looks like an export of Pupil Labs: x_px = norm_pos_x * width, y_px = (1 - norm_pos_y) * height where norm_pos is \
                 given, in pixels of the rendered frame; keep one row per frame, and name the columns frame,x_px,y_px (or time_s, in \
                 seconds from the first frame)"
            }
            Self::Varjo => {
                "this looks like an export of Varjo, whose gaze is a direction: project it into the frame, \
                 keep one row per frame, and name the columns frame,x_px,y_px (or time_s, in seconds from the first frame)"
            }
        }
    }
}

impl GazeTraceError {
    /// How to correct the error. Settings are in braces.
    pub fn help(&self) -> &'static str {
        match self {
            Self::NoFps => "give {fps}",
            Self::Missing { .. } => {
                "record it for every frame, or keep the last gaze with {gaze_hold}"
            }
            Self::MissingTime { at_s, from_s, .. } if from_s > at_s => {
                "subtract the time of the first frame from time_s"
            }
            Self::MissingTime { .. } => {
                "record it for every frame, in seconds from the first one, or keep the last gaze with {gaze_hold}"
            }
            Self::NothingToHold { .. } => {
                "start the trace with a row that has a gaze, at or before the first frame (time_s is 0 there)"
            }
            Self::Twice { .. } => "keep one row per frame: the gaze with which it was rendered",
            Self::Shares { .. } => {
                "multiply x_px by the frame's width and y_px by its height (pixels from the top-left corner)"
            }
            Self::Number { found, .. } if found.contains(',') => {
                "write numbers with a decimal point and without thousands separators"
            }
            Self::Column { export: Some(export), .. } => export.help(),
            Self::Csv(error) if matches!(error.kind(), csv::ErrorKind::UnequalLengths { .. }) => {
                "every row needs as many cells as the header; numbers need a decimal point, not a comma"
            }
            _ => {
                "a gaze trace is CSV with the columns frame,x_px,y_px (or time_s,x_px,y_px), with rows in \
                 increasing order"
            }
        }
    }
}
