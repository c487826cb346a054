//! Values that a file gives, as bars in groups.

use fovqa_plan::{CurvePlot, GivenSeries, GivenValues};
use fovqa_plot::{Axis, BarChart, BarSeries, Figure, Look};

use super::models::named;
use crate::sheet::NamedFigure;

/// The bars. `None` for a plot of another kind.
pub(super) fn figure(plot: &CurvePlot) -> Option<NamedFigure> {
    let values = plot.values.as_ref()?;
    let series = values.series.iter().enumerate().map(|(i, series)| bars(i, series));
    let sum = values.sum.as_ref().map(|name| BarSeries {
        name: name.clone(),
        look: Look::new(values.series.len()),
        values: sums(values),
        // How the errors of the parts depend on each other is not known.
        errors: Vec::new(),
        ..BarSeries::default()
    });
    let has_errors = values.series.iter().any(|series| !series.errors.is_empty());
    let series = series.chain(sum).collect();
    let figure = Figure::Bar(BarChart {
        title: plot.title.clone(),
        y: Axis::new(&values.quantity),
        groups: values.groups.clone(),
        series,
        ..BarChart::default()
    });
    let named = named(plot, "values", &values.quantity, figure);
    let note = if has_errors { "; error bars as given in the file" } else { "" };
    Some(NamedFigure { caption: format!("{}{note}", named.caption), ..named })
}

fn bars(index: usize, series: &GivenSeries) -> BarSeries {
    BarSeries {
        name: series.name.clone(),
        look: Look::new(index),
        errors: series.errors.iter().copied().map(Some).collect(),
        values: series.values.iter().copied().map(Some).collect(),
        ..BarSeries::default()
    }
}

/// The sum of the series in each group.
fn sums(values: &GivenValues) -> Vec<Option<f64>> {
    let of_group = |i: usize| values.series.iter().filter_map(|series| series.values.get(i)).sum();
    (0..values.groups.len()).map(|i| Some(of_group(i))).collect()
}
