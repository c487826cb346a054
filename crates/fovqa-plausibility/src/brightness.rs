//! Another exposure, transfer function or tone map.

use fovqa_frame::transfer::srgb;
use fovqa_frame::{Frame, LumaKind, LumaScratch, LumaSignal, Transfer};

use crate::pair::Looked;
use crate::sample::{SIDE, Sample, WHITE, Window};
use crate::scene::pearson;
use crate::suspicion::{Check, Suspicion};

/// Darker windows are mostly rounding and noise.
const DARK: f32 = 0.04;

/// Windows with a larger variance have structure that a foveated picture may average differently.
const SMOOTH: f32 = 0.006;

/// The number of windows from which more would change nothing.
const ENOUGH: usize = 512;

/// The smallest number of windows without it.
const FEWEST_SMOOTH: usize = 32;

/// Smallest difference of exposure that is reported, in stops.
const STOPS: f32 = 0.2;

/// The share of the windows that have to agree.
const MOST: f32 = 0.6;

/// Smallest share of the windows that are neither dark nor white.
const FEWEST: f32 = 0.2;

/// The natural logarithm of the slope from which transfer functions differ.
const SLOPE: f32 = 0.34;

/// Least correlation of the logarithms of light for a statement about the slope.
const LEAST_CORRELATION: f32 = 0.95;

pub(crate) fn check(pair: &Looked<'_>, sample: &Sample) -> Option<Suspicion> {
    let all = sample.counted().count();
    let mut usable: Vec<&Window> = sample.counted().filter(|w| is_usable(w)).collect();
    // Blur and coarse samples change little in the smoother half.
    let half = usable.len() / 2;
    if half > 0 {
        usable.select_nth_unstable_by(half, |a, b| structure(a).total_cmp(&structure(b)));
    }
    let smooth: Vec<&Window> =
        usable[..half].iter().copied().filter(|w| structure(w) <= SMOOTH).collect();
    let some = smooth.iter().step_by(smooth.len() / ENOUGH + 1);
    let mut light: Vec<[f32; 2]> = some.map(|w| w.mean.map(stops)).collect();
    if (usable.len() as f32) < FEWEST * all as f32 || !is_shown_as_srgb(pair) {
        light = scene_light(pair, sample);
        if (light.len() as f32) < FEWEST * all as f32 {
            return None;
        }
    } else if light.len() < FEWEST_SMOOTH {
        return None;
    } else if let Some(transfer) = transfer(&light) {
        return Some(transfer);
    }
    exposure(pair, &light)
}

/// A picture in linear light that is mostly black or white as it is scored, because its values are in
/// other units.
pub(crate) fn of_clipped(pair: &Looked<'_>, sample: &Sample) -> Option<Suspicion> {
    let params = pair.tables.params();
    let is_clipped = |side: usize, frame: &Frame| {
        let linear = params.transfer_of(frame) == Transfer::Linear && !frame.samples().is_integer();
        let clipped = |w: &&Window| w.mean[side] >= WHITE || w.mean[side] < DARK;
        linear && 2 * sample.counted().filter(clipped).count() > sample.counted().count()
    };
    let is_of_one = is_clipped(0, pair.reference) != is_clipped(1, pair.test);
    let light = is_of_one.then(|| scene_light(pair, sample))?;
    (light.len() as f32 >= FEWEST * sample.counted().count() as f32)
        .then(|| exposure(pair, &light))
        .flatten()
}

/// Whether the signal of both pictures is sRGB-encoded.
fn is_shown_as_srgb(pair: &Looked<'_>) -> bool {
    let params = pair.tables.params();
    [pair.reference, pair.test].iter().all(|frame| match params.transfer_of(frame) {
        Transfer::Srgb | Transfer::Linear => true,
        Transfer::Pq | Transfer::Gamma22 => false,
    })
}

fn is_usable(window: &Window) -> bool {
    window.high.iter().all(|high| *high <= WHITE) && window.mean.iter().all(|mean| *mean >= DARK)
}

/// The larger variance of the two.
fn structure(window: &Window) -> f32 {
    window.variance[0].max(window.variance[1])
}

/// The logarithm to base 2 of the linear light of a signal.
fn stops(signal: f32) -> f32 {
    libm::log2f(srgb::decode(f64::from(signal)) as f32)
}

fn median(values: &mut [f32]) -> f32 {
    let middle = values.len() / 2;
    *values.select_nth_unstable_by(middle, f32::total_cmp).1
}

fn transfer(light: &[[f32; 2]]) -> Option<Suspicion> {
    let (correlation, [of_reference, of_test]) = pearson(light)?;
    let slope = of_test / of_reference;
    // Pictures of one brightness say nothing.
    if of_reference.min(of_test) < 0.3
        || correlation < LEAST_CORRELATION
        || libm::logf(slope).abs() < SLOPE
    {
        return None;
    }
    let message = format!(
        "the test has another transfer function or tone map than the reference: its light is that of \
         the reference to the power of {slope:.2}"
    );
    let help = match slope {
        // About 2.2.
        1.8..2.7 => {
            "its values seem to be linear but are read as encoded (or those of the reference the other \
             way round): name the encoding of the files with {transfer}, or write both alike"
        }
        // About 1 / 2.2.
        0.37..0.56 => {
            "its values seem to be encoded but are read as linear (or those of the reference the other \
             way round): name the encoding of the files with {transfer}, or write both alike"
        }
        _ => {
            "write both with the same tone map and transfer function; {tonemap} and {exposure} apply to \
             linear files, {transfer} names the encoding of the files"
        }
    };
    Some(Suspicion::new(Check::Transfer, message, help))
}

fn exposure(pair: &Looked<'_>, light: &[[f32; 2]]) -> Option<Suspicion> {
    // Nearly all windows can be those of a border that does not count.
    if light.len() < FEWEST_SMOOTH {
        return None;
    }
    let mut ratios: Vec<f32> = light.iter().map(|[r, t]| t - r).collect();
    let stops = median(&mut ratios);
    let near = (0.25 * stops.abs()).max(0.12);
    let share =
        ratios.iter().filter(|r| (*r - stops).abs() <= near).count() as f32 / ratios.len() as f32;
    if stops.abs() < STOPS || share < MOST {
        return None;
    }
    let than = if stops > 0.0 { "brighter" } else { "darker" };
    let message = format!(
        "the test is {:.2} stops {than} than the reference over most of the frame",
        stops.abs()
    );
    let exposure = pair.tables.params().exposure_stops;
    let is_linear = |frame: &Frame| pair.tables.params().transfer_of(frame) == Transfer::Linear;
    let help = match (is_linear(pair.reference), is_linear(pair.test)) {
        (true, false) => format!(
            "the reference is linear and the test is encoded: set {{exposure}} to that with which the test \
             was written, about {:.2} stops; if it was tone mapped, set {{tonemap}} first",
            exposure + f64::from(stops)
        ),
        (false, true) => format!(
            "the test is linear and the reference is encoded: set {{exposure}} to that with which the \
             reference was written, about {:.2} stops; if it was tone mapped, set {{tonemap}} first",
            exposure - f64::from(stops)
        ),
        _ => "write both with the same exposure: the values of one of them have to be changed"
            .to_owned(),
    };
    Some(Suspicion::new(Check::Exposure, message, help))
}

/// The light of the windows before any limit to what the signal can show, for pictures that are mostly
/// black or white as they are scored.
fn scene_light(pair: &Looked<'_>, sample: &Sample) -> Vec<[f32; 2]> {
    let signals = [pair.reference, pair.test].map(|frame| {
        (LumaSignal::new(frame, pair.tables, LumaKind::Luminance), frame.samples().is_integer())
    });
    let mut scratch = LumaScratch::new(SIDE);
    let mut row = [0.0; SIDE];
    let mut light = Vec::new();
    for window in sample.counted() {
        let [x, y] = window.at.map(|at| at as usize);
        let mut both = [0.0f32; 2];
        let mut usable = true;
        for (side, (signal, is_integer)) in signals.iter().enumerate() {
            signal.fill_row(y, x - SIDE / 2..x + SIDE / 2, &mut scratch, &mut row);
            let mean = row.iter().sum::<f64>() / SIDE as f64;
            both[side] = libm::log2(mean) as f32;
            let limited = *is_integer && (window.high[side] > WHITE || window.mean[side] < DARK);
            usable &= mean > 0.0 && mean.is_finite() && !limited;
        }
        if usable {
            light.push(both);
        }
    }
    light
}
