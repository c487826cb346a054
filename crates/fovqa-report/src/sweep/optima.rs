//! The best point of each grid, as a table.

use fovqa_plan::Plot;

use super::grid::{Grid, Place, best_and_worst};
use crate::comparison::{Measure, named};
use crate::figures::{Source, metrics};
use crate::plain_table::{Cell, Column, PlainTable};

/// The best value of each metric for each swept method, and where it is; `None` if nothing was swept or
/// scored.
pub(crate) fn optima(source: &Source<'_>, plot: &Plot) -> Option<PlainTable> {
    let scenes = source.run.resolved.scenes.iter().map(|scene| scene.name.as_str());
    let scenes = named(plot.scenes.as_deref(), scenes);
    let metrics = metrics(source, plot);
    let mut rows = Vec::new();
    for place in Place::all(&scenes) {
        for grid in Grid::all(source, plot) {
            for metric in &metrics {
                let values = grid.values(source.overview, place, *metric);
                let Some((best, worst)) = best_and_worst(*metric, &values) else { continue };
                let measure = Measure::of_value(*metric);
                let number = |point: usize| {
                    let value = values[point].unwrap_or(f64::NAN);
                    Cell::number(measure.shown(Some(value)), value)
                };
                let label = grid.label(best);
                let share = place.value(source.overview, label, |of| of.samples_percent);
                let samples = share.map_or_else(Cell::default, |percent| {
                    Cell::number(format!("{percent:.2} %"), percent / 100.0)
                });
                rows.push(vec![
                    Cell::text(place.name()),
                    Cell::text(grid.sweep.method.clone()),
                    Cell::named(measure.heading(), measure.key.clone()),
                    number(best),
                    Cell::named(grid.at_in_words(best), grid.sweep.parameters(best)),
                    samples,
                    number(worst),
                ]);
            }
        }
    }
    if rows.is_empty() {
        return None;
    }
    Some(PlainTable {
        caption: "Best point of each sweep".to_owned(),
        columns: vec![
            Column::new("Scene", "scene").repeated(),
            Column::new("Method", "method").repeated(),
            Column::new("Metric", "metric").repeated(),
            Column::new("Best", "best").about("The best value of the metric over the points of the sweep."),
            Column::new("At", "parameters").about("The parameters of the best point."),
            Column::new("Samples", "samples_share").about("The samples that the method shades at the best point, as a share of the frame's pixels."),
            Column::new("Worst", "worst").about("The worst value of the metric over the points of the sweep."),
        ],
        rows,
        notes: vec!["Of equally good points, the table shows the first.".to_owned()],
    })
}
