//! Figures whose axes were set so that they show none of their values.

use crate::axes::axis::Axis;
use crate::canvas::clip;
use crate::canvas::drawing::Point;
use crate::charts::bar::BarChart;
use crate::charts::line::{LineChart, LineSeries};
use crate::charts::spread::SpreadChart;
use crate::charts::spread_series::BOX_FROM;
use crate::scales::scale::{AxisPlace, Scale};

/// A chart that shows none of its values, and where they lie.
#[derive(Debug, Clone, PartialEq)]
pub struct Unseen {
    /// The title of the panel; `None` if the figure has only one chart.
    pub panel: Option<String>,
    /// The ends of the horizontal axis that were set.
    pub x_ends: [Option<f64>; 2],
    /// The ends of the vertical axis that were set.
    pub y_ends: [Option<f64>; 2],
    /// The smallest and the largest position; `None` for groups.
    pub x: Option<(f64, f64)>,
    /// The smallest and the largest value.
    pub y: Option<(f64, f64)>,
}

impl Unseen {
    fn of_groups(axis: &Axis, y: Option<(f64, f64)>) -> Self {
        Self { panel: None, x_ends: [None; 2], y_ends: ends_of(axis), x: None, y }
    }
}

fn ends_of(axis: &Axis) -> [Option<f64>; 2] {
    [axis.min, axis.max]
}

/// Finds out whether the ends of the axes of a chart of curves leave nothing of it.
pub(crate) fn of_curves(chart: &LineChart) -> Option<Unseen> {
    let ends = [&chart.x, &chart.y].map(|axis| axis.min.or(axis.max));
    let places = || chart.series.iter().flat_map(|series| chart.places(series));
    let finite = |place: Option<AxisPlace>| place.and_then(AxisPlace::finite);
    if ends.iter().all(Option::is_none) || !places().any(|(_, place)| place.is_some()) {
        return None;
    }
    let scales = chart.x_scale().zip(chart.y_scale());
    if let Some((x, y)) = scales
        && chart.series.iter().any(|series| is_seen(chart, series, x, y))
    {
        return None;
    }
    let values = places().filter(|(_, place)| place.is_some());
    Some(Unseen {
        panel: None,
        x_ends: ends_of(&chart.x),
        y_ends: ends_of(&chart.y),
        x: range(values.map(|(x, _)| x)),
        y: range(places().filter_map(|(_, place)| finite(place))),
    })
}

fn is_seen(chart: &LineChart, series: &LineSeries, x: Scale, y: Scale) -> bool {
    let far = |share: f64| share.clamp(-clip::FAR, clip::FAR);
    let inside = |share: f64| (0.0..=1.0).contains(&share);
    let mut points: Vec<Option<Point>> = Vec::new();
    for (position, place) in chart.places(series) {
        let across = far(x.share(position));
        match place {
            // An infinite value is drawn at the border.
            Some(AxisPlace::Above | AxisPlace::Below) if inside(across) => return true,
            Some(AxisPlace::At(value)) => points.push(Some((across, far(y.share(value))))),
            _ => points.push(None),
        }
    }
    if points.iter().flatten().any(|(x, y)| inside(*x) && inside(*y)) {
        return true;
    }
    let runs = points.split(Option::is_none);
    let runs = runs.map(|run| run.iter().copied().flatten().collect::<Vec<Point>>());
    let mut pieces = runs.flat_map(|run| clip::upright(&run));
    !series.dots
        && !series.scatter
        && !series.rings
        && pieces.any(|run| !clip::level(&run).is_empty())
}

/// The same for bars.
pub(crate) fn of_bars(chart: &BarChart) -> Option<Unseen> {
    let scale = chart.axis_range().filter(|_| chart.y.min.or(chart.y.max).is_some())?;
    let mut values = chart.places().peekable();
    values.peek()?;
    let is_seen = |place: AxisPlace| match place {
        AxisPlace::Above | AxisPlace::Below => true,
        AxisPlace::At(value) if chart.has_bars() => {
            value.min(0.0) < scale.high && value.max(0.0) > scale.low
        }
        AxisPlace::At(value) => (0.0..=1.0).contains(&scale.share(value)),
    };
    if values.any(is_seen) {
        return None;
    }
    let y = range(chart.places().filter_map(AxisPlace::finite));
    Some(Unseen::of_groups(&chart.y, y))
}

/// The same for distributions.
pub(crate) fn of_spread(chart: &SpreadChart) -> Option<Unseen> {
    let scale = chart.axis_range().filter(|_| chart.y.min.or(chart.y.max).is_some())?;
    let finite = |value: &f64| AxisPlace::of(*value).and_then(AxisPlace::finite);
    let on_axis = |values: &[f64]| -> Vec<f64> {
        values.iter().filter_map(finite).filter(|value| chart.y.has(*value)).collect()
    };
    let all: Vec<Vec<f64>> =
        chart.series.iter().flat_map(|s| &s.values).map(|values| on_axis(values)).collect();
    let is_seen = |values: &Vec<f64>| {
        let inside = |value: &f64| (0.0..=1.0).contains(&scale.share(*value));
        let (low, high) = range(values.iter().copied()).unwrap_or((0.0, 0.0));
        // A box may be larger than the axis.
        let spans = values.len() >= BOX_FROM && low < scale.low && high > scale.high;
        spans || values.iter().any(inside)
    };
    let y = range(all.iter().flatten().copied())?;
    (!all.iter().any(is_seen)).then(|| Unseen::of_groups(&chart.y, Some(y)))
}

fn range(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    values.fold(None, |range, value| {
        let (low, high) = range.unwrap_or((value, value));
        Some((value.min(low), value.max(high)))
    })
}
