//! The number of infinite values that each distribution leaves out, written outside the plot area:
//! "3 × ∞".

use crate::canvas::drawing::{Anchor, Drawing, Rect, Text};
use crate::canvas::text::VALUE_PX;
use crate::charts::spread_series::SpreadSeries;
use crate::marks::value_label::{GAP_PX, Orientation, Side, widest_px};
use crate::scales::scale::AxisPlace;

/// One count per distribution, or one for all if the slots are too narrow.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct LeftOut {
    above: Counts,
    below: Counts,
}

/// The counts of one sign.
#[derive(Debug, Clone, PartialEq)]
struct Counts {
    side: Side,
    /// Group, series and label of each count.
    labels: Vec<(usize, usize, String)>,
    orientation: Orientation,
    /// The label with the sum of all counts.
    total: String,
}

impl LeftOut {
    /// Counts the values that the series leave out; `pitch_px` is the width of a slot.
    pub(crate) fn of(series: &[SpreadSeries], pitch_px: f64) -> Self {
        let row = |beyond, side, sign| Counts::of(series, pitch_px, (beyond, side, sign));
        Self {
            above: row(AxisPlace::Above, Side::Above, "∞"),
            below: row(AxisPlace::Below, Side::Below, "−∞"),
        }
    }

    /// Space above the plot area.
    pub(crate) fn above_px(&self) -> f64 {
        self.above.height_px()
    }

    /// Space below the plot area.
    pub(crate) fn below_px(&self) -> f64 {
        self.below.height_px()
    }

    /// Writes the counts; `x` gives the position of a group and series.
    pub(crate) fn draw(&self, drawing: &mut Drawing, plot: Rect, x: impl Fn(usize, usize) -> f64) {
        for row in [&self.above, &self.below] {
            row.draw(drawing, plot, &x);
        }
    }
}

impl Counts {
    fn of(
        series: &[SpreadSeries],
        pitch_px: f64,
        (beyond, side, sign): (AxisPlace, Side, &str),
    ) -> Self {
        let mut labels = Vec::new();
        let mut total = 0;
        for (s, series) in series.iter().enumerate() {
            for (g, values) in series.values.iter().enumerate() {
                let count = values.iter().filter(|v| AxisPlace::of(**v) == Some(beyond)).count();
                if count > 0 {
                    labels.push((g, s, format!("{count} × {sign}")));
                    total += count;
                }
            }
        }
        let orientation = Orientation::of(widest_px(labels.iter().map(|l| l.2.as_str())), pitch_px);
        Self { side, labels, orientation, total: format!("{total} × {sign} left out") }
    }

    fn height_px(&self) -> f64 {
        if self.labels.is_empty() {
            return 0.0;
        }
        let widest = widest_px(self.labels.iter().map(|label| label.2.as_str()));
        GAP_PX + self.orientation.reach_px(widest).max(VALUE_PX)
    }

    fn draw(&self, drawing: &mut Drawing, plot: Rect, x: &impl Fn(usize, usize) -> f64) {
        let border = if self.side == Side::Above { plot.top } else { plot.bottom };
        if self.orientation == Orientation::Nowhere && !self.labels.is_empty() {
            let baseline = match self.side {
                Side::Above => border - GAP_PX,
                Side::Below => border + GAP_PX + VALUE_PX,
            };
            let at = (plot.left + GAP_PX, baseline);
            drawing.text(Text::new(&self.total, at, VALUE_PX, Anchor::Start));
        }
        for (group, series, label) in &self.labels {
            self.orientation.draw(drawing, label, (x(*group, *series), border), self.side);
        }
    }
}
