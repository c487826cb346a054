//! The strip below a heat map: what the values are, and a bar with the colour of each value.

use crate::axes::axis::{LABEL_GAP_PX, TICK_LENGTH_PX};
use crate::canvas::colour::{AXIS, INK, WHITE};
use crate::canvas::colour_map::map_palette;
use crate::canvas::drawing::{Anchor, Drawing, Rect, Stroke, Text};
use crate::canvas::printed::{PT_PER_PX, Printed};
use crate::canvas::text::{CAPITAL, DESCENT, LINE_PITCH, TICK_PX, TITLE_PX, width_px};
use crate::canvas::wrap::wrap;
use crate::charts::heat_scale::HeatScale;
use crate::error::PlotError;
use crate::scales::number::{exponent, power_label, power_of_ten};
use crate::scales::ticks::Tick;

/// Sizes for a unit of 1: the distance from the picture to the title, from the title to the bar,
/// and from the labels to the lower edge; the height of the bar, and its least distance from the
/// sides.
const ABOVE_PX: f64 = 6.0;
const TITLE_GAP_PX: f64 = 3.0;
const BELOW_PX: f64 = 5.0;
const BAR_PX: f64 = 10.0;
const SIDE_PX: f64 = 8.0;
/// Width of lines.
const LINE_PX: f64 = 1.0;
/// The largest number of lines of the title.
const TITLE_LINES: usize = 3;
/// The least distance between two labels.
const APART_PX: f64 = 8.0;

/// The pixels of a strip.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct HeatStrip {
    /// Rows of red, green and blue codes.
    pub(crate) rgb: Vec<u8>,
    pub(crate) height: usize,
}

impl HeatStrip {
    /// Draws the strip with a width in pixels. `bright` says what the right end of the bar is, and `unit` is the
    /// factor of all sizes.
    pub(crate) fn new(
        width: usize,
        label: &str,
        bright: &str,
        scale: HeatScale,
        unit: f64,
    ) -> Result<Self, PlotError> {
        let (ticks, side) = ticks(scale, width as f64, unit);
        // The bar covers whole pixels.
        let (left, right) = (side.ceil(), width as f64 - side.ceil());
        let title_px = TITLE_PX * unit;
        let title = wrap(label, title_px, right - left, TITLE_LINES);
        let top = (ABOVE_PX + TITLE_GAP_PX) * unit + title.len() as f64 * title_px * LINE_PITCH;
        let bar = Rect { left, top: top.ceil(), right, bottom: (top + BAR_PX * unit).ceil() };
        let labels_px = bar.bottom + (TICK_LENGTH_PX + LABEL_GAP_PX + CAPITAL * TICK_PX) * unit;
        let height = (labels_px + (DESCENT * TICK_PX + BELOW_PX) * unit).ceil();

        let mut drawing = Drawing { width_px: width as f64, height_px: height, marks: Vec::new() };
        let whole = Rect { left: 0.0, top: 0.0, right: width as f64, bottom: height };
        drawing.area(whole.corners().to_vec(), WHITE);
        let baseline = |line: usize| ABOVE_PX * unit + title_px * (0.9 + line as f64 * LINE_PITCH);
        for (i, line) in title.iter().enumerate() {
            drawing.text(Text::new(line, (left, baseline(i)), title_px, Anchor::Start));
        }
        let hint = format!("{bright} →");
        let hint_px = width_px(&hint, TICK_PX * unit);
        if let [line] = &title[..]
            && width_px(line, title_px) + APART_PX * unit + hint_px <= right - left
        {
            let at = (right, baseline(0));
            drawing.text(Text::new(&hint, at, TICK_PX * unit, Anchor::End));
        }
        let stroke = Stroke { colour: AXIS, width_px: LINE_PX * unit };
        let out = stroke.width_px / 2.0;
        let around = Rect {
            left: bar.left - out,
            top: bar.top - out,
            right: bar.right + out,
            bottom: bar.bottom + out,
        };
        drawing.frame(around, stroke);
        for (share, tick) in &ticks {
            let x = left + share * (right - left);
            let end = bar.bottom + TICK_LENGTH_PX * unit;
            drawing.line(&[(x, bar.bottom), (x, end)], Stroke { colour: INK, ..stroke });
            let text = Text::new(&tick.label, (x, labels_px), TICK_PX * unit, Anchor::Middle);
            drawing.text(text);
        }
        let height = height as usize;
        let size = (width as u32, height as u32);
        let rows = Printed::new(drawing, PT_PER_PX).rows(size, |row| {
            row.iter().flat_map(|p| [p.red(), p.green(), p.blue()]).collect::<Vec<u8>>()
        })?;
        let mut rgb = rows.concat();
        fill_bar(&mut rgb, width, bar);
        Ok(Self { rgb, height })
    }
}

/// Fills the bar with the colours from those of the smallest to those of the largest differences.
fn fill_bar(rgb: &mut [u8], width: usize, bar: Rect) {
    let palette = map_palette();
    let (left, right) = (bar.left as usize, bar.right as usize);
    for row in rgb.chunks_exact_mut(3 * width).take(bar.bottom as usize).skip(bar.top as usize) {
        for (x, pixel) in row[3 * left..3 * right].chunks_exact_mut(3).enumerate() {
            let share = (x as f64 + 0.5) / (right - left) as f64;
            pixel.copy_from_slice(&palette[(share * 255.0).round() as usize]);
        }
    }
}

/// The ticks with their positions along the bar, and the distance of the bar from the sides, at
/// which the labels of its ends fit.
fn ticks(scale: HeatScale, whole_px: f64, unit: f64) -> (Vec<(f64, Tick)>, f64) {
    let range = scale.range();
    let label_px = |tick: &Tick| width_px(&tick.label, TICK_PX * unit);
    // The widest labels have about this width.
    let mut side = SIDE_PX * unit;
    let mut found = Vec::new();
    for _ in 0..2 {
        let bar_px = (whole_px - 2.0 * side).max(1.0);
        let fits = |ticks: &[Tick]| {
            ticks.windows(2).all(|pair| {
                let apart = (range.share(pair[1].value) - range.share(pair[0].value)).abs();
                let halves = f64::midpoint(label_px(&pair[0]), label_px(&pair[1]));
                apart * bar_px >= halves + APART_PX * unit
            })
        };
        found = powers(scale, fits).unwrap_or_else(|| range.ticks(fits));
        let over = found.iter().map(|tick| {
            let share = range.share(tick.value).clamp(0.0, 1.0);
            label_px(tick) / 2.0 + 2.0 * unit - share.min(1.0 - share) * bar_px
        });
        side = over.fold(SIDE_PX * unit, f64::max);
    }
    let places = found.into_iter().map(|tick| (range.share(tick.value).clamp(0.0, 1.0), tick));
    (places.collect(), side)
}

/// The powers of ten of a logarithmic scale, as many as fit; `None` if there are fewer than two.
fn powers(scale: HeatScale, fits: impl Fn(&[Tick]) -> bool) -> Option<Vec<Tick>> {
    const STEPS: [usize; 6] = [1, 2, 3, 6, 10, 20];
    let (low, high) = (scale.none.min(scale.most), scale.none.max(scale.most));
    // An f32 is near a power of ten rather than equal to it.
    let (low, high) = (f64::from(low) * (1.0 - 1e-6), f64::from(high) * (1.0 + 1e-6));
    let power =
        |exponent: i32| Tick { value: power_of_ten(exponent), label: power_label(exponent) };
    let all = (exponent(low)..=exponent(high)).map(power);
    let all: Vec<Tick> = all.filter(|tick| tick.value >= low && tick.value <= high).collect();
    let some = |step: usize| all.iter().step_by(step).cloned().collect::<Vec<Tick>>();
    let found = STEPS.into_iter().map(some).find(|ticks| fits(ticks))?;
    (scale.log && found.len() > 1).then_some(found)
}
