//! The values of all methods in all scenes.

use fovqa_metrics::Image;
use fovqa_plan::{AveragePlace, Plot, SpreadOver};
use fovqa_results::RunRecord;

use super::average::average;
use super::column::Column;
use super::measure::Measure;
use super::notes::{means, notes};
use super::values::{Item, Items, Scored, Values, deviation, marked};
use super::{ComparisonTable, named};
use crate::frame_values::FrameValues;
use crate::overview::Overview;

/// The columns of a plot: those that it names, in its order, or all that have values, in the order
/// of the experiment.
fn columns(run: &RunRecord, overview: &Overview, plot: &Plot) -> Vec<Column> {
    let all = overview.all();
    let metrics = run.resolved.metrics_in_order();
    let columns: Vec<Column> = match plot.named() {
        None => metrics.into_iter().map(Column::Metric).chain([Column::Samples]).collect(),
        Some(keys) => {
            let column = |key: &str| match key {
                Plot::SAMPLES => Some(Column::Samples),
                Plot::QUADS => Some(Column::Quads),
                key => metrics.iter().find(|m| m.key() == key).map(|m| Column::Metric(*m)),
            };
            keys.into_iter().filter_map(column).collect()
        }
    };
    let has_values = |column: &Column| all.iter().any(|measured| column.value(measured).is_some());
    columns.into_iter().filter(has_values).collect()
}

impl ComparisonTable {
    /// The table that a plot describes, with its scenes, methods and metrics, or with all of them.
    /// `None` if nothing was scored.
    pub(crate) fn new(
        run: &RunRecord,
        overview: &Overview,
        frames: &FrameValues,
        plot: &Plot,
    ) -> Option<Self> {
        let resolved = &run.resolved;
        let methods: Vec<String> =
            named(plot.methods.as_deref(), resolved.methods.iter().map(String::as_str))
                .into_iter()
                .map(str::to_owned)
                .collect();
        let scenes =
            named(plot.scenes.as_deref(), resolved.scenes.iter().map(|scene| scene.name.as_str()));
        let columns = columns(run, overview, plot);
        if columns.is_empty() || methods.is_empty() || scenes.is_empty() {
            return None;
        }
        let measures: Vec<Measure> = columns.iter().map(|column| column.measure()).collect();
        let scored = |scene: &str, method: &str, column: Column| -> Scored {
            let value = overview.of(scene, method).and_then(|of| column.value(of));
            let over_frames = plot.spread == Some(SpreadOver::Frames);
            (value, over_frames.then(|| spread(frames, scene, method, column)).flatten())
        };
        let item = |scene: &&str| {
            let cells = columns.iter().zip(&measures).enumerate().map(|(index, (&c, measure))| {
                let scored: Vec<Scored> =
                    methods.iter().map(|method| scored(scene, method, c)).collect();
                marked(index, measure, &scored)
            });
            let (label, title) = ((*scene).to_owned(), (*scene).to_owned());
            Item { label, title, is_average: false, cells: cells.collect() }
        };
        let items = scenes.iter().map(item).collect();
        let mut values = Values { items_are: Items::Scenes, items, measures, methods };
        let average = average(&values, plot.spread == Some(SpreadOver::Scenes));
        match (plot.average, average) {
            (AveragePlace::Last, Some(average)) => values.items.push(average),
            (AveragePlace::First, Some(average)) => values.items.insert(0, average),
            (AveragePlace::Only, Some(average)) => values.items = vec![average],
            // If nothing can be averaged, the scenes are still worth showing.
            (AveragePlace::None, _) | (_, None) => {}
        }
        let remarks = notes(overview, plot, &columns, &scenes, &values.methods);
        Some(Self {
            title: "Comparison".to_owned(),
            caption: plot.caption.clone(),
            label: String::new(),
            layout: plot.layout,
            means: means(plot),
            notes: remarks,
            values: Box::new(values),
        })
    }
}

/// The standard deviation over the frames that the mean includes.
fn spread(frames: &FrameValues, scene: &str, method: &str, column: Column) -> Option<f64> {
    let Column::Metric(metric) = column else { return None };
    let frames = frames.of(scene, method, (metric, Image::Pair)).iter();
    // Means of decibels leave out identical frames.
    let values: Vec<f64> = frames.map(|(_, value)| *value).filter(|v| v.is_finite()).collect();
    deviation(&values).filter(|_| column.has_frames())
}
