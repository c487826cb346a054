//! The values of all methods in all scenes.

use fovqa_metrics::Image;
use fovqa_plan::{AveragePlace, Plot, SpreadOver};
use fovqa_results::RunRecord;

use super::average::average;
use super::column::Column;
use super::measure::Measure;
use super::notes::{EYES_AVERAGED_NOTE, EYES_NOTE, means, notes};
use super::values::{Item, ItemEye, Items, Scored, Values, deviation, marked};
use super::{ComparisonTable, named};
use crate::frame_values::FrameValues;
use crate::overview::{Measured, Overview};

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
        let scored = |scene: &str, eye: Option<ItemEye>, method: &str, column: Column| -> Scored {
            let measured = match eye {
                Some(ItemEye::Left | ItemEye::Right) => {
                    let is_it = |of: &&Measured| Some(of.eye.as_str()) == eye.map(ItemEye::name);
                    overview.eyes_of(scene, method).into_iter().find(is_it)
                }
                Some(ItemEye::Both) | None => overview.of(scene, method),
            };
            let of = (scene, method, eye.map_or("", ItemEye::name));
            let over_frames = plot.spread == Some(SpreadOver::Frames);
            let spread = over_frames.then(|| spread(frames, of, column)).flatten();
            (measured.and_then(|of| column.value(of)), spread)
        };
        let item = |scene: &str, eye: Option<ItemEye>| {
            let cells = columns.iter().zip(&measures).enumerate().map(|(index, (&c, measure))| {
                let scored: Vec<Scored> =
                    methods.iter().map(|method| scored(scene, eye, method, c)).collect();
                marked(index, measure, &scored)
            });
            let cells = cells.collect();
            let Some(eye) = eye else { return Item::new(scene.to_owned(), cells) };
            let item = Item::new(format!("{scene}, {}", eye.in_words()), cells);
            let name = if eye == ItemEye::Both { scene.to_owned() } else { item.name };
            Item { name, eye: Some(eye), ..item }
        };
        let has_eyes = |scene: &str| {
            let mut measured = methods.iter().filter_map(|method| overview.of(scene, method));
            measured.any(|of| of.is_of_both_eyes)
        };
        let items_of = |scene: &&str| -> Vec<Item> {
            if has_eyes(scene) {
                ItemEye::ALL.iter().map(|eye| item(scene, Some(*eye))).collect()
            } else {
                vec![item(scene, None)]
            }
        };
        let items = scenes.iter().flat_map(items_of).collect();
        let mut values = Values { items_are: Items::Scenes, items, measures, methods };
        let average = average(&values, plot.spread == Some(SpreadOver::Scenes));
        match (plot.average, average) {
            (AveragePlace::Last, Some(average)) => values.items.push(average),
            (AveragePlace::First, Some(average)) => values.items.insert(0, average),
            (AveragePlace::Only, Some(average)) => values.items = vec![average],
            // If nothing can be averaged, the scenes are still worth showing.
            (AveragePlace::None, _) | (_, None) => {}
        }
        let mut remarks = notes(overview, plot, &columns, &scenes, &values.methods);
        if values.items.iter().any(|item| item.eye.is_some()) {
            let averaged = values.items.iter().any(|item| item.is_average);
            let eyes = [EYES_NOTE].into_iter().chain(averaged.then_some(EYES_AVERAGED_NOTE));
            remarks.splice(0..0, eyes.map(str::to_owned));
        }
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

/// The standard deviation over the frames that the mean includes, of a scene, a method and an eye.
fn spread(frames: &FrameValues, of: (&str, &str, &str), column: Column) -> Option<f64> {
    let Column::Metric(metric) = column else { return None };
    let frames = frames.of_eye(of, (metric, Image::Pair)).iter();
    // Means of decibels leave out identical frames.
    let values: Vec<f64> = frames.map(|(_, value)| *value).filter(|v| v.is_finite()).collect();
    deviation(&values).filter(|_| column.has_frames())
}
