//! A recorded gaze: one position per frame, or positions over time.

use std::io::Read;

use crate::gaze_error::GazeTraceError;
use crate::gaze_table::{Clock, GazeRow, Table};

/// A gaze trace as its file holds it: a position for each frame or time, in rising order.
#[derive(Debug, Clone, PartialEq)]
pub struct GazeTrace {
    samples: Samples,
    /// Headings of columns about the quality of samples, which are not applied.
    unused: Vec<String>,
}

/// Positions by frame or by time.
#[derive(Debug, Clone, PartialEq)]
enum Samples {
    Frames(Vec<Sample<i64>>),
    Times(Vec<Sample<f64>>),
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Sample<At> {
    at: At,
    /// `None` for a blink.
    position_px: Option<[f64; 2]>,
    /// The position, or the last position before a blink. It is stored here because searching
    /// backwards for every frame would take too long where an eye stays closed.
    held_px: Option<[f64; 2]>,
}

/// The gaze of one frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GazeAt {
    /// Position in pixels.
    pub px: [f64; 2],
    /// Whether the position was held over from an earlier frame, because of a blink or because the
    /// trace does not cover the frame.
    pub held: bool,
}

/// A frame's number and its index in the sequence, from 0. The frame's time is the index divided by
/// the frame rate.
pub type FrameAt = (i64, usize);

impl GazeTrace {
    /// Reads a CSV table with the columns `frame` (or `time_s`), `x_px`, `y_px`. Commas, semicolons
    /// or tabs separate them; the encoding is UTF-8 or UTF-16. A row is a blink if a position is
    /// NaN or empty, or if its column `valid` says 0 or false. Other columns are ignored.
    ///
    /// # Errors
    /// When it is not such a table, its rows do not rise, or its positions are shares of the frame.
    pub fn read(source: impl Read) -> Result<Self, GazeTraceError> {
        let table = Table::read(source)?;
        if table.rows.is_empty() {
            return Err(GazeTraceError::Empty);
        }
        let positions = table.rows.iter().filter_map(|row| row.position_px);
        shares(positions)?;
        let samples = match table.clock {
            Clock::Frame => {
                let frames = table.rows.iter().map(|row| (row, row.frame)).collect();
                Samples::Frames(rising(frames, |row, at, before| {
                    if at == before {
                        GazeTraceError::Twice { line: row.line, frame: at }
                    } else {
                        order(row, Clock::Frame, at as f64, before as f64)
                    }
                })?)
            }
            Clock::TimeS => {
                let times = table.rows.iter().map(|row| (row, row.time_s)).collect();
                Samples::Times(rising(times, |row, at, before| {
                    order(row, Clock::TimeS, at, before)
                })?)
            }
        };
        Ok(Self { samples, unused: table.unused })
    }

    /// Headings of columns about the quality of samples, which are not applied: a row that must not
    /// count needs an empty position.
    pub fn unused_quality_columns(&self) -> &[String] {
        &self.unused
    }

    /// Whether all positions lie in the first pixel, but not all in its corner. They may then be
    /// shares of the frame that were rounded.
    pub fn is_in_first_pixel(&self) -> bool {
        let held: Vec<[f64; 2]> = match &self.samples {
            Samples::Frames(samples) => samples.iter().filter_map(|s| s.position_px).collect(),
            Samples::Times(samples) => samples.iter().filter_map(|s| s.position_px).collect(),
        };
        let within = |at: &f64| (0.0..=1.0).contains(at);
        held.iter().flatten().all(within) && held.iter().flatten().any(|at| *at > 0.0)
    }

    /// The median interval between two samples in seconds, if the trace gives times.
    pub fn interval_s(&self) -> Option<f64> {
        let Samples::Times(samples) = &self.samples else { return None };
        let mut steps: Vec<f64> = samples.windows(2).map(|pair| pair[1].at - pair[0].at).collect();
        steps.sort_by(f64::total_cmp);
        steps.get(steps.len() / 2).copied()
    }

    /// The gaze of each of `frames`. A blink holds the gaze before it. If the trace gives times,
    /// time 0 is that of index 0 of the sequence, and the nearest sample counts if it is at most
    /// one frame away. With `hold`, a frame that the trace does not cover keeps the gaze before it.
    ///
    /// # Errors
    /// When a frame has no gaze, when the trace begins with a blink, or when it gives times and
    /// there is no frame rate.
    pub fn at_frames(
        &self,
        frames: &[FrameAt],
        fps: Option<f64>,
        hold: bool,
    ) -> Result<Vec<GazeAt>, GazeTraceError> {
        let at = |&(frame, place): &FrameAt| {
            let (own, held, missing) = match &self.samples {
                Samples::Frames(samples) => {
                    let own = samples.binary_search_by(|sample| sample.at.cmp(&frame)).ok();
                    let own = own.map(|index| samples[index].position_px);
                    let held = held_at(samples, |at| *at <= frame);
                    let (from, to) = (samples[0].at, samples[samples.len() - 1].at);
                    (own, held, GazeTraceError::Missing { frame, from, to })
                }
                Samples::Times(samples) => {
                    let fps = fps.ok_or(GazeTraceError::NoFps)?;
                    let at_s = place as f64 / fps;
                    let own = nearest(samples, at_s, 1.0 / fps).map(|sample| sample.position_px);
                    let held = held_at(samples, |at| *at <= at_s);
                    let (from_s, to_s) = (samples[0].at, samples[samples.len() - 1].at);
                    (own, held, GazeTraceError::MissingTime { frame, at_s, from_s, to_s })
                }
            };
            match own {
                Some(Some(px)) => Ok(GazeAt { px, held: false }),
                // The held gaze comes from the trace itself, since `frames` may be a subset.
                None if !hold => Err(missing),
                _ => match held {
                    Some(px) => Ok(GazeAt { px, held: true }),
                    // A trace that begins after the frame is a different mistake from a blink.
                    None if own.is_none() && matches!(self.samples, Samples::Times(_)) => {
                        Err(missing)
                    }
                    None => Err(GazeTraceError::NothingToHold { frame }),
                },
            }
        };
        frames.iter().map(at).collect()
    }
}

fn order(row: &GazeRow, clock: Clock, at: f64, before: f64) -> GazeTraceError {
    GazeTraceError::Order { line: row.line, clock: clock.column(), at, before }
}

/// Makes samples of rows. `wrong` makes the error if frames or times do not rise.
fn rising<At: Copy + PartialOrd>(
    rows: Vec<(&GazeRow, At)>,
    wrong: impl Fn(&GazeRow, At, At) -> GazeTraceError,
) -> Result<Vec<Sample<At>>, GazeTraceError> {
    let mut samples: Vec<Sample<At>> = Vec::with_capacity(rows.len());
    for (row, at) in rows {
        let last = samples.last();
        if let Some(before) = last.map(|last| last.at).filter(|before| *before >= at) {
            return Err(wrong(row, at, before));
        }
        let held_px = row.position_px.or_else(|| last?.held_px);
        samples.push(Sample { at, position_px: row.position_px, held_px });
    }
    Ok(samples)
}

/// Refuses positions that are shares of the frame. Eye trackers write shares from 0 to 1, and
/// slightly beyond where the eye looks past the screen. Nobody looks at the first pixels of a frame
/// all the time.
fn shares(positions: impl Iterator<Item = [f64; 2]>) -> Result<(), GazeTraceError> {
    let (mut from, mut to, mut fractions) = (f64::INFINITY, f64::NEG_INFINITY, false);
    for value in positions.flatten() {
        (from, to) = (from.min(value), to.max(value));
        fractions |= value.fract() != 0.0;
    }
    let about = fractions && from >= -1.0 && to <= 2.0;
    if about {
        return Err(GazeTraceError::Shares { from, to });
    }
    Ok(())
}

fn nearest(samples: &[Sample<f64>], time_s: f64, within_s: f64) -> Option<&Sample<f64>> {
    let distance = |s: &&Sample<f64>| (s.at - time_s).abs();
    // Samples rise in time, so the nearest one is one of the two around `time_s`.
    let after = samples.partition_point(|s| s.at < time_s);
    samples[after.saturating_sub(1)..(after + 1).min(samples.len())]
        .iter()
        .min_by(|a, b| distance(a).total_cmp(&distance(b)))
        .filter(|s| distance(s) <= within_s)
}

/// The last position with an open eye up to a moment.
fn held_at<At>(samples: &[Sample<At>], is_past: impl Fn(&At) -> bool) -> Option<[f64; 2]> {
    let past = samples.partition_point(|sample| is_past(&sample.at));
    samples[..past].last()?.held_px
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "what is only passed on comes back exactly")]
mod tests {
    use super::*;

    /// Frames with their index in a sequence that begins at `first`.
    fn from(first: i64, frames: &[i64]) -> Vec<FrameAt> {
        frames.iter().map(|frame| (*frame, usize::try_from(frame - first).unwrap_or(0))).collect()
    }

    fn trace(text: &str) -> Result<GazeTrace, GazeTraceError> {
        GazeTrace::read(text.as_bytes())
    }

    #[test]
    fn frames_times_and_other_columns() {
        let t = trace("note,frame,time_s,x_px,y_px\na,0,0,1,2\nb,1,9,3,4\n").unwrap();
        let at = t.at_frames(&from(0, &[0, 1]), None, false).unwrap();
        assert_eq!(at[1], GazeAt { px: [3.0, 4.0], held: false });
        // 1/72 s, rounded to six digits in the file, is the time of frame 1.
        let t = trace("time_s,x_px,y_px\n0,1,1\n0.013889,2,2\n0.027778,3,3\n").unwrap();
        let at = t.at_frames(&from(5, &[5, 6, 7]), Some(72.0), false).unwrap();
        assert_eq!(at.iter().map(|g| g.px[0]).collect::<Vec<_>>(), [1.0, 2.0, 3.0]);
        assert!(matches!(t.at_frames(&from(0, &[0]), None, false), Err(GazeTraceError::NoFps)));
    }

    #[test]
    fn a_blink_holds_the_gaze_before_it() {
        let t = trace("frame,x_px,y_px\n0,1,1\n1,nan,NaN\n2,,\n3,4,4\n").unwrap();
        let at = t.at_frames(&from(0, &[0, 1, 2, 3]), None, false).unwrap();
        assert_eq!(
            at.iter().map(|g| (g.px[0], g.held)).collect::<Vec<_>>(),
            [(1.0, false), (1.0, true), (1.0, true), (4.0, false)]
        );
        assert_eq!(t.at_frames(&from(0, &[2]), None, false).unwrap()[0].px, [1.0, 1.0]);
        let blind = trace("frame,x_px,y_px\n0,nan,1\n1,nan,9\n").unwrap();
        assert!(matches!(
            blind.at_frames(&from(0, &[0]), None, true),
            Err(GazeTraceError::NothingToHold { frame: 0 })
        ));
    }

    #[test]
    fn a_long_blink_is_not_looked_through_frame_by_frame() {
        const ROWS: i64 = 200_000;
        let rows = (1..ROWS).map(|frame| format!("{frame},,"));
        let rows: Vec<String> = std::iter::once("0,1,2".to_owned()).chain(rows).collect();
        let t = trace(&format!("frame,x_px,y_px\n{}\n", rows.join("\n"))).unwrap();
        let frames: Vec<i64> = (0..ROWS).collect();
        let begun = std::time::Instant::now();
        let at = t.at_frames(&from(0, &frames), None, false).unwrap();
        assert!(at[1..].iter().all(|at| at.held && at.px == [1.0, 2.0]));
        // Searching backwards for every frame would take 2e10 steps.
        assert!(begun.elapsed() < std::time::Duration::from_secs(5), "{:?}", begun.elapsed());
    }

    #[test]
    fn too_short_is_an_error_unless_held() {
        let t = trace("frame,x_px,y_px\n0,1,1\n1,2,2\n").unwrap();
        assert!(matches!(
            t.at_frames(&from(0, &[0, 1, 2]), None, false),
            Err(GazeTraceError::Missing { frame: 2, .. })
        ));
        let at = t.at_frames(&from(0, &[0, 1, 2]), None, true).unwrap();
        assert_eq!(at[2], GazeAt { px: [2.0, 2.0], held: true });
    }

    #[test]
    fn a_gap_in_time_is_one_when_no_sample_is_within_a_frame() {
        let t = trace("time_s,x_px,y_px\n0,1,1\n0.05,2,2\n").unwrap();
        let at = t.at_frames(&from(0, &[0, 1, 4]), Some(72.0), false).unwrap();
        assert_eq!(at.iter().map(|g| g.px[0]).collect::<Vec<_>>(), [1.0, 1.0, 2.0]);
        let far = t.at_frames(&from(0, &[8]), Some(72.0), false);
        assert!(matches!(far, Err(GazeTraceError::MissingTime { frame: 8, .. })));
        assert!(t.at_frames(&from(0, &[8]), Some(72.0), true).unwrap()[0].held);
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
            Err(GazeTraceError::Twice { line: 3, frame: 1 })
        ));
        assert!(matches!(
            trace("frame,x_px,y_px\n1,1,2\n0,1,2\n"),
            Err(GazeTraceError::Order { line: 3, .. })
        ));
        assert!(matches!(
            trace("time_s,x_px,y_px\n1,1,2\n1,1,2\n"),
            Err(GazeTraceError::Order { line: 3, .. })
        ));
        assert!(trace("frame,x_px,y_px\n0,1\n").is_err());
    }

    #[test]
    fn numbers_are_exact_however_large_and_may_be_negative() {
        let text = "frame,x_px,y_px\n-2,1,9\n-1,2,9\n9007199254740992,3,9\n9007199254740993,4,9\n";
        let t = trace(text).unwrap();
        let frames = [(-2, 0), (-1, 1), (9_007_199_254_740_993, 2)];
        let at = t.at_frames(&frames, None, false).unwrap();
        assert_eq!(at.iter().map(|g| g.px[0]).collect::<Vec<_>>(), [1.0, 2.0, 4.0]);
    }

    #[test]
    fn unix_times_are_not_times_of_the_sequence() {
        let t = trace("time_s,x_px,y_px\n1700000000.0,9,9\n1700000000.011,9,9\n").unwrap();
        for hold in [false, true] {
            let error = t.at_frames(&[(7, 0)], Some(90.0), hold).unwrap_err();
            assert!(error.to_string().contains("times start at 0 with the first frame"), "{error}");
            assert!(error.help().contains("subtract the time of the first frame"));
        }
        let slow = trace("time_s,x_px,y_px\n0,9,9\n11,9,9\n22,9,9\n").unwrap();
        assert_eq!(slow.interval_s(), Some(11.0));
    }

    #[test]
    fn shares_of_the_frame_are_not_pixels() {
        let table = |rows: &str| trace(&format!("frame,x_px,y_px\n{rows}"));
        for rows in ["0,0.5,0.5\n1,0.25,0.75\n", "0,0.5,0.5\n", "0,-0.1,0.5\n1,1.2,0.3\n"] {
            assert!(matches!(table(rows), Err(GazeTraceError::Shares { .. })), "{rows:?}");
        }
        for rows in ["0,0,0\n", "0,0.5,0.5\n1,3,0.5\n", "0,1,2\n1,2,1\n", "0,1,1\n", "0,,\n"] {
            assert!(table(rows).is_ok(), "{rows:?}");
        }
    }
}
