//! Dots with intervals: estimates of several groups, one series beside the other.

use fovqa_plot::{Axis, BarChart, BarSeries, Look};

/// A figure shows at most this many groups side by side.
pub(super) const MOST_GROUPS: usize = 48;

/// An estimate with its interval.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Dot {
    pub(super) value: Option<f64>,
    /// The lower and the upper end, which may be infinite.
    pub(super) interval: Option<[f64; 2]>,
}

/// A named row of estimates, one for each group.
pub(super) struct Row {
    pub(super) name: String,
    /// The index of its look.
    pub(super) look: usize,
    pub(super) dots: Vec<Dot>,
    /// A text above each dot; empty for none.
    pub(super) notes: Vec<String>,
}

/// A chart of dots with intervals. A single row is not named in a legend. `None` without estimates.
pub(super) fn chart(y: Axis, groups: Vec<String>, rows: Vec<Row>) -> Option<BarChart> {
    let finite = |dot: &Dot| dot.value.is_some_and(f64::is_finite);
    if !rows.iter().flat_map(|row| &row.dots).any(finite) {
        return None;
    }
    let is_one = rows.len() == 1;
    let series = rows.into_iter().map(|row| BarSeries {
        name: if is_one { String::new() } else { row.name },
        look: Look::new(row.look),
        values: row.dots.iter().map(|dot| dot.value.filter(|value| value.is_finite())).collect(),
        intervals: row.dots.iter().map(|dot| dot.interval).collect(),
        notes: row.notes,
        ..BarSeries::default()
    });
    let series = series.collect();
    Some(BarChart { y, groups, series, from_zero: false, labels: false, ..BarChart::default() })
}

/// The different names, by first appearance.
pub(super) fn distinct<'a>(names: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    let mut seen = std::collections::HashSet::new();
    names.into_iter().filter(|name| seen.insert(*name)).collect()
}
