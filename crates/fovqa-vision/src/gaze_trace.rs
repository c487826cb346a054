//! A recorded gaze: one position a frame, or positions over time.

use std::io::Read;

use thiserror::Error;

/// A gaze trace as its file holds it: rising frames or times, a position each.
#[derive(Debug, Clone, PartialEq)]
pub struct GazeTrace {
    clock: Clock,
    samples: Vec<Sample>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Clock {
    Frame,
    TimeS,
}

/// Beyond this no frame number, time or position of a real recording lies.
const LARGEST: f64 = 1e9;

#[derive(Debug, Clone, Copy, PartialEq)]
struct Sample {
    at: f64,
    /// `None`: a blink.
    position_px: Option<[f64; 2]>,
    /// The position, or the last one before it that is no blink: not looked for frame by frame,
    /// which would not end where an eye stays closed.
    held_px: Option<[f64; 2]>,
}

/// The gaze of one frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GazeAt {
    /// Position in pixels.
    pub px: [f64; 2],
    /// Whether it was held over from an earlier frame (a blink, or beyond the trace).
    pub held: bool,
}

/// A gaze trace that cannot be read, or does not fit the sequence.
#[derive(Debug, Error)]
pub enum GazeTraceError {
    /// Not CSV.
    #[error("it is not a CSV table: {0}")]
    Csv(#[from] csv::Error),
    /// A column that has to be there.
    #[error("it has no column {wanted}; its columns are: {found}")]
    Column {
        /// What was looked for.
        wanted: &'static str,
        /// What is there.
        found: String,
    },
    /// A cell that is not a number.
    #[error("line {line}: {column} is {found:?}, not a number")]
    Number {
        /// Line of the file, from 1.
        line: u64,
        /// The column.
        column: &'static str,
        /// The cell.
        found: String,
    },
    /// Rows out of order, or two for one moment.
    #[error("line {line}: {clock} {at} does not come after the {before} before it")]
    Order {
        /// Line of the file, from 1.
        line: u64,
        /// `frame` or `time_s`.
        clock: &'static str,
        /// Its value.
        at: f64,
        /// The value before.
        before: f64,
    },
    /// A table without rows.
    #[error("it has no rows")]
    Empty,
    /// Times without a frame rate.
    #[error("it gives times, and a time names a frame only with a frame rate")]
    NoFps,
    /// No gaze for a frame.
    #[error("it has no gaze for frame {frame}; it covers {clock} {from} to {to}")]
    Missing {
        /// The frame's number.
        frame: u64,
        /// `frame` or `time_s`.
        clock: &'static str,
        /// Start of the trace.
        from: f64,
        /// End of the trace.
        to: f64,
    },
    /// A blink, or a frame the trace does not cover, with nothing before it to hold.
    #[error("frame {frame} has no gaze of its own, and there is none before it to hold")]
    NothingToHold {
        /// The frame's number.
        frame: u64,
    },
}

impl Clock {
    fn column(self) -> &'static str {
        match self {
            Clock::Frame => "frame",
            Clock::TimeS => "time_s",
        }
    }
}

impl GazeTrace {
    /// Reads a CSV table with columns `frame` (or `time_s`), `x_px`, `y_px`; others are ignored.
    /// A NaN or an empty cell as a position is a blink.
    ///
    /// # Errors
    /// When it is not such a table, or its rows do not rise.
    pub fn read(source: impl Read) -> Result<Self, GazeTraceError> {
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(source);
        let headers = reader.headers()?.clone();
        let find = |name: &str| {
            headers.iter().position(|h| h.trim_start_matches('\u{feff}').eq_ignore_ascii_case(name))
        };
        let column = |wanted: &'static str, name: &str| {
            find(name).ok_or_else(|| GazeTraceError::Column {
                wanted,
                found: headers.iter().take(24).collect::<Vec<_>>().join(", "),
            })
        };
        let clock = if find("frame").is_some() { Clock::Frame } else { Clock::TimeS };
        let at = column("frame (or time_s)", clock.column())?;
        let (x, y) = (column("x_px", "x_px")?, column("y_px", "y_px")?);
        let mut samples: Vec<Sample> = Vec::new();
        for record in reader.records() {
            let record = record?;
            let line = record.position().map_or(0, csv::Position::line);
            let number = |index: usize, column: &'static str| {
                let cell = &record[index];
                let value = if cell.is_empty() { Ok(f64::NAN) } else { cell.parse::<f64>() };
                value.ok().filter(|v| v.is_nan() || v.abs() <= LARGEST).ok_or_else(|| {
                    GazeTraceError::Number { line, column, found: cell.chars().take(40).collect() }
                })
            };
            let clock_at = number(at, clock.column())?;
            if clock_at.is_nan() || (clock == Clock::Frame && clock_at.fract() != 0.0) {
                let found = record[at].chars().take(40).collect();
                return Err(GazeTraceError::Number { line, column: clock.column(), found });
            }
            if let Some(before) = samples.last().map(|s| s.at).filter(|b| *b >= clock_at) {
                let clock = clock.column();
                return Err(GazeTraceError::Order { line, clock, at: clock_at, before });
            }
            let position = [number(x, "x_px")?, number(y, "y_px")?];
            let open = !position.iter().any(|v| v.is_nan());
            let position_px = open.then_some(position);
            let held_px = position_px.or_else(|| samples.last()?.held_px);
            samples.push(Sample { at: clock_at, position_px, held_px });
        }
        if samples.is_empty() {
            return Err(GazeTraceError::Empty);
        }
        Ok(Self { clock, samples })
    }

    /// The gaze of each of `frames`. A blink holds the gaze before it. Times start
    /// with frame `first_frame`, and the sample nearest in time counts, if it is no farther than
    /// one frame away. With `hold`, a frame the trace does not cover keeps the gaze before it.
    ///
    /// # Errors
    /// When a frame has no gaze, when the trace begins with a blink, or when it gives times and
    /// there is no frame rate.
    pub fn at_frames(
        &self,
        frames: &[u64],
        first_frame: u64,
        fps: Option<f64>,
        hold: bool,
    ) -> Result<Vec<GazeAt>, GazeTraceError> {
        let mut gaze: Vec<GazeAt> = Vec::with_capacity(frames.len());
        for &frame in frames {
            let sample = match self.clock {
                Clock::Frame => {
                    let found = self.samples.binary_search_by(|s| s.at.total_cmp(&(frame as f64)));
                    found.ok().map(|index| &self.samples[index])
                }
                Clock::TimeS => {
                    let fps = fps.ok_or(GazeTraceError::NoFps)?;
                    self.nearest(frame.saturating_sub(first_frame) as f64 / fps, 1.0 / fps)
                }
            };
            // The last open eye before this frame, in the trace itself: frames may be a subset.
            let held = || self.last_open_before(frame, first_frame, fps);
            let missing = || GazeTraceError::Missing {
                frame,
                clock: self.clock.column(),
                from: self.samples[0].at,
                to: self.samples[self.samples.len() - 1].at,
            };
            let at = match sample.map(|s| s.position_px) {
                Some(Some(px)) => GazeAt { px, held: false },
                Some(None) => {
                    let px = held().ok_or(GazeTraceError::NothingToHold { frame })?;
                    GazeAt { px, held: true }
                }
                None if hold => {
                    let px = held().ok_or(GazeTraceError::NothingToHold { frame })?;
                    GazeAt { px, held: true }
                }
                None => return Err(missing()),
            };
            gaze.push(at);
        }
        Ok(gaze)
    }

    fn nearest(&self, time_s: f64, within_s: f64) -> Option<&Sample> {
        let distance = |s: &&Sample| (s.at - time_s).abs();
        // Samples rise: the nearest is one of the two around the moment.
        let after = self.samples.partition_point(|s| s.at < time_s);
        self.samples[after.saturating_sub(1)..(after + 1).min(self.samples.len())]
            .iter()
            .min_by(|a, b| distance(a).total_cmp(&distance(b)))
            .filter(|s| distance(s) <= within_s)
    }

    fn last_open_before(&self, frame: u64, first_frame: u64, fps: Option<f64>) -> Option<[f64; 2]> {
        let now = match self.clock {
            Clock::Frame => frame as f64,
            Clock::TimeS => frame.saturating_sub(first_frame) as f64 / fps?,
        };
        let past = self.samples.partition_point(|s| s.at <= now);
        self.samples[..past].last()?.held_px
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "what is only passed on comes back exactly")]
mod tests {
    use super::*;

    fn trace(text: &str) -> Result<GazeTrace, GazeTraceError> {
        GazeTrace::read(text.as_bytes())
    }

    #[test]
    fn frames_times_and_other_columns() {
        let t = trace("note,frame,time_s,x_px,y_px\na,0,0,1,2\nb,1,9,3,4\n").unwrap();
        let at = t.at_frames(&[0, 1], 0, None, false).unwrap();
        assert_eq!(at[1], GazeAt { px: [3.0, 4.0], held: false });
        // 1/72 s, as a file with six digits rounds it, is that of frame 1.
        let t = trace("time_s,x_px,y_px\n0,1,1\n0.013889,2,2\n0.027778,3,3\n").unwrap();
        let at = t.at_frames(&[5, 6, 7], 5, Some(72.0), false).unwrap();
        assert_eq!(at.iter().map(|g| g.px[0]).collect::<Vec<_>>(), [1.0, 2.0, 3.0]);
        assert!(matches!(t.at_frames(&[0], 0, None, false), Err(GazeTraceError::NoFps)));
    }

    #[test]
    fn a_blink_holds_the_gaze_before_it() {
        let t = trace("frame,x_px,y_px\n0,1,1\n1,nan,NaN\n2,,\n3,4,4\n").unwrap();
        let at = t.at_frames(&[0, 1, 2, 3], 0, None, false).unwrap();
        assert_eq!(
            at.iter().map(|g| (g.px[0], g.held)).collect::<Vec<_>>(),
            [(1.0, false), (1.0, true), (1.0, true), (4.0, false)]
        );
        assert_eq!(t.at_frames(&[2], 0, None, false).unwrap()[0].px, [1.0, 1.0]);
        let blind = trace("frame,x_px,y_px\n0,nan,1\n").unwrap();
        assert!(matches!(
            blind.at_frames(&[0], 0, None, true),
            Err(GazeTraceError::NothingToHold { frame: 0 })
        ));
    }

    #[test]
    fn a_long_blink_is_not_looked_through_frame_by_frame() {
        const ROWS: u64 = 200_000;
        let rows = (1..ROWS).map(|frame| format!("{frame},,"));
        let rows: Vec<String> = std::iter::once("0,1,2".to_owned()).chain(rows).collect();
        let t = trace(&format!("frame,x_px,y_px\n{}\n", rows.join("\n"))).unwrap();
        let frames: Vec<u64> = (0..ROWS).collect();
        let from = std::time::Instant::now();
        let at = t.at_frames(&frames, 0, None, false).unwrap();
        assert!(at[1..].iter().all(|at| at.held && at.px == [1.0, 2.0]));
        // Twenty thousand million steps otherwise.
        assert!(from.elapsed() < std::time::Duration::from_secs(5), "{:?}", from.elapsed());
    }

    #[test]
    fn too_short_is_an_error_unless_held() {
        let t = trace("frame,x_px,y_px\n0,1,1\n1,2,2\n").unwrap();
        assert!(matches!(
            t.at_frames(&[0, 1, 2], 0, None, false),
            Err(GazeTraceError::Missing { frame: 2, .. })
        ));
        let at = t.at_frames(&[0, 1, 2], 0, None, true).unwrap();
        assert_eq!(at[2], GazeAt { px: [2.0, 2.0], held: true });
    }

    #[test]
    fn a_gap_in_time_is_one_when_no_sample_is_within_a_frame() {
        let t = trace("time_s,x_px,y_px\n0,1,1\n0.05,2,2\n").unwrap();
        let at = t.at_frames(&[0, 1, 4], 0, Some(72.0), false).unwrap();
        assert_eq!(at.iter().map(|g| g.px[0]).collect::<Vec<_>>(), [1.0, 1.0, 2.0]);
        let far = t.at_frames(&[8], 0, Some(72.0), false);
        assert!(matches!(far, Err(GazeTraceError::Missing { frame: 8, .. })));
        assert!(t.at_frames(&[8], 0, Some(72.0), true).unwrap()[0].held);
    }

    #[test]
    fn says_what_is_wrong_and_where() {
        assert!(matches!(trace("x,y\n1,2\n"), Err(GazeTraceError::Column { .. })));
        assert!(matches!(trace("frame,x_px,y_px\n"), Err(GazeTraceError::Empty)));
        assert!(matches!(
            trace("frame,x_px,y_px\n0,a,2\n"),
            Err(GazeTraceError::Number { line: 2, column: "x_px", .. })
        ));
        assert!(matches!(trace("frame,x_px,y_px\n0,inf,2\n"), Err(GazeTraceError::Number { .. })));
        assert!(matches!(
            trace("frame,x_px,y_px\n0.5,1,2\n"),
            Err(GazeTraceError::Number { column: "frame", .. })
        ));
        assert!(matches!(
            trace("frame,x_px,y_px\n1,1,2\n1,1,2\n"),
            Err(GazeTraceError::Order { line: 3, .. })
        ));
        assert!(trace("frame,x_px,y_px\n0,1\n").is_err());
    }
}
