//! Infinite values, such as the PSNR of identical images. They are drawn at the border of the plot
//! area, with an "∞" beyond it in a strip that is kept free.

use crate::canvas::drawing::{Drawing, Rect};
use crate::canvas::text::{VALUE_PX, width_px};
use crate::marks::value_label::{Orientation, Side};
use crate::scales::scale::AxisPlace;

/// Height of the strip: half a marker and the label.
pub(crate) const STRIP_PX: f64 = 18.0;
/// Distance from the border to the edge of a marker on it.
const MARKER_PX: f64 = 2.0;
/// How far a label may extend beyond the sides of the plot area without reaching the labels of an
/// axis.
const BESIDE_PX: f64 = 6.0;

/// Heights of the strips that these places need above and below the plot area.
pub(crate) fn strips_px(places: impl Iterator<Item = AxisPlace>) -> (f64, f64) {
    places.fold((0.0, 0.0), |(above, below), place| match place {
        AxisPlace::At(_) => (above, below),
        AxisPlace::Above => (STRIP_PX, below),
        AxisPlace::Below => (above, STRIP_PX),
    })
}

/// Writes "∞" above or "−∞" below the plot area at each of these positions, except those that are
/// too close to the one before.
pub(crate) fn draw_labels(drawing: &mut Drawing, plot: Rect, mut xs: Vec<f64>, side: Side) {
    let (label, y) = match side {
        Side::Above => ("∞", plot.top - MARKER_PX),
        Side::Below => ("−∞", plot.bottom + MARKER_PX),
    };
    let label_px = width_px(label, VALUE_PX);
    let apart_px = label_px + 1.0;
    let inset_px = (label_px / 2.0 - BESIDE_PX).max(0.0);
    xs.sort_by(f64::total_cmp);
    let mut last = f64::NEG_INFINITY;
    for x in xs {
        let middle = x.clamp(plot.left + inset_px, plot.right - inset_px);
        if middle - last >= apart_px {
            Orientation::Level.draw(drawing, label, (middle, y), side);
            last = middle;
        }
    }
}
