//! Pictures that are constant, or of which a part was never drawn.

use std::collections::BTreeMap;

use fovqa_frame::{Frame, Mask, Samples};

use crate::pair::Looked;
use crate::sample::{Sample, Window};
use crate::suspicion::{Check, Suspicion};

/// The share of the windows in which one picture has a single colour and the other has detail, from
/// which a part of the picture counts as missing.
const MISSING: f64 = 0.45;

/// The share of the windows along the edges of the frame from which such a part no longer counts.
const LEFT_OUT: f64 = 0.4;

/// A picture of fewer pixels may well have one colour.
const FEWEST_PIXELS: usize = 64;

/// Distance of the pixels that are compared first.
const LATTICE: usize = 37;

const HELP: &str = "check that the render has finished and that the right files are named; {crop} or \
                    {mask} leaves out parts that are not to be scored";

/// Whether all pixels that count have the same values.
fn is_constant(frame: &Frame, counts: Option<&Mask>) -> bool {
    let channels = frame.channels().count();
    let pixel = |x: usize, y: usize| -> [u32; 3] {
        std::array::from_fn(|c| if c < channels { frame.sample(c, x, y).to_bits() } else { 0 })
    };
    let mut first = None;
    // A few pixels tell nearly every picture.
    [LATTICE, 1].into_iter().all(|step| {
        let rows = (0..frame.height()).step_by(step);
        let mut places = rows.flat_map(|y| (0..frame.width()).step_by(step).map(move |x| (x, y)));
        places.all(|(x, y)| {
            if counts.is_some_and(|mask| !mask.row(y)[x]) {
                return true;
            }
            let pixel = pixel(x, y);
            *first.get_or_insert(pixel) == pixel
        })
    }) && first.is_some()
}

/// A picture whose every pixel is the same.
pub(crate) fn check(pair: &Looked<'_>) -> Option<Suspicion> {
    if pair.reference.width() * pair.reference.height() < FEWEST_PIXELS {
        return None;
    }
    let message = match [pair.reference, pair.test].map(|side| is_constant(side, pair.counts)) {
        [false, false] => return None,
        [true, true] => "the test and the reference are constant".to_owned(),
        [true, false] => format!("the reference is constant{}", value(pair.reference, pair)),
        [false, true] => format!("the test is constant{}", value(pair.test, pair)),
    };
    Some(Suspicion::new(Check::Constant, message, HELP))
}

/// The value of the first pixel, as the file has it; nothing if that pixel may not count.
fn value(frame: &Frame, pair: &Looked<'_>) -> String {
    if pair.counts.is_some() {
        return String::new();
    }
    let values: Vec<String> =
        (0..frame.channels().count()).map(|c| frame.sample(c, 0, 0).to_string()).collect();
    let what = match frame.samples() {
        Samples::U8(_) => "8-bit code ",
        Samples::U16(_) => "16-bit code ",
        Samples::F16(_) | Samples::F32(_) => "value ",
    };
    format!(", {what}{}", values.join(" "))
}

/// A picture of which a large part has one single value where the other has detail, or that is nearly
/// constant although the other is not. Smaller parts without a picture, such as the corners that a
/// method or a lens leaves black, no longer count in the sample.
pub(crate) fn of_windows(sample: &mut Sample) -> Option<Suspicion> {
    for (side, name, other) in [(1, "the test", "the reference"), (0, "the reference", "the test")]
    {
        let share = missing(sample, side);
        if share >= MISSING {
            let message = format!(
                "{name} has one single value in at least {:.0} % of the frame, where {other} has detail",
                100.0 * share
            );
            return Some(Suspicion::new(Check::Constant, message, HELP));
        }
    }
    for side in 0..2 {
        if let Some(value) = border(sample, side) {
            // Windows at the edge of such a part are partly covered.
            for window in &mut sample.windows {
                let ends = [window.low[side], window.high[side]].map(f32::to_bits);
                window.counts &= !ends.contains(&value);
            }
        }
    }
    let [of_reference, of_test] = [0, 1].map(|side| spread(sample, side));
    let (name, low, high) = if of_test < of_reference {
        ("the test", of_test, of_reference)
    } else {
        ("the reference", of_reference, of_test)
    };
    (high > 0.05 && low < 0.1 * high).then(|| {
        let message = format!(
            "{name} is nearly constant: its brightness varies by {:.1} % of white, that of the other by \
             {:.1} %",
            100.0 * low,
            100.0 * high
        );
        Suspicion::new(Check::Constant, message, HELP)
    })
}

/// The share of the windows that have one and the same value where the other picture has detail or
/// clearly another value.
fn missing(sample: &Sample, side: usize) -> f64 {
    let mut values = Values::default();
    let differs = |window: &&Window| {
        window.detail[1 - side] > 0.01 || (window.mean[0] - window.mean[1]).abs() > 0.1
    };
    for window in sample.counted().filter(differs) {
        values.add(window, side);
    }
    // What both leave empty, such as the corners of a lens, is missing in neither.
    let is_seen = |window: &&Window| (0..2).any(|side| window.low[side] < window.high[side]);
    let seen = sample.counted().filter(is_seen).count().max(1);
    values.most().map_or(0.0, |(_, windows)| f64::from(windows) / seen as f64)
}

/// The value of most windows along the edges of the frame, if they are flat.
fn border(sample: &Sample, side: usize) -> Option<u32> {
    let (columns, last) = (sample.columns, sample.windows.len() - sample.columns);
    let is_border = |at: usize| {
        at < columns || at >= last || at.is_multiple_of(columns) || at % columns == columns - 1
    };
    let (mut values, mut all) = (Values::default(), 0u32);
    for (at, window) in sample.windows.iter().enumerate() {
        if window.counts && is_border(at) {
            values.add(window, side);
            all += 1;
        }
    }
    let (value, windows) = values.most()?;
    (f64::from(windows) >= LEFT_OUT * f64::from(all)).then_some(value)
}

/// How many windows have only one value, by the bits of the value.
#[derive(Default)]
struct Values(BTreeMap<u32, u32>);

impl Values {
    fn add(&mut self, window: &Window, side: usize) {
        let [low, high] = [window.low[side], window.high[side]];
        if low >= high {
            *self.0.entry(high.to_bits()).or_default() += 1;
        }
    }

    /// The most frequent value and its number of windows.
    fn most(&self) -> Option<(u32, u32)> {
        let (value, windows) = self.0.iter().max_by_key(|(_, windows)| **windows)?;
        Some((*value, *windows))
    }
}

/// Standard deviation of the windows' means.
fn spread(sample: &Sample, side: usize) -> f32 {
    let n = sample.counted().count() as f32;
    let mean = sample.counted().map(|w| w.mean[side]).sum::<f32>() / n;
    (sample.counted().map(|w| (w.mean[side] - mean).powi(2)).sum::<f32>() / n).sqrt()
}
