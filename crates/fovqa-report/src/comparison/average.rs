//! Averages over scenes.

use fovqa_metrics::Metric;

use super::values::{Item, Scored, Values, deviation, marked, mean};
use crate::overview::Overview;

/// The scenes in which every method has a value of a metric. Means over scenes use only these, in
/// tables and figures alike, because means over different scenes could not be compared.
pub(crate) fn common_scenes<'a>(
    overview: &Overview,
    scenes: &[&'a str],
    methods: &[&str],
    metric: Metric,
) -> Vec<&'a str> {
    let has = |scene: &str, method: &&str| {
        overview.of(scene, method).is_some_and(|measured| measured.value(metric).is_some())
    };
    let all = |scene: &&str| methods.iter().all(|method| has(scene, method));
    scenes.iter().copied().filter(all).collect()
}

/// The label of a mean over `of` of `all` scenes.
pub(crate) fn average_label(of: usize, all: usize) -> String {
    if of == all {
        "Average".to_owned()
    } else {
        format!("Average of the {of} scenes all methods have")
    }
}

/// The scenes, each once: one with two eyes counts with the values of both together.
fn scenes_of(values: &Values) -> impl Iterator<Item = &Item> + Clone {
    values.items.iter().filter(|item| item.is_of_whole_scene())
}

/// The means over the scenes that all methods have, for each measure. Only measures with at least
/// two such scenes are included; `None` if there is no such measure.
pub(super) fn average(values: &Values, with_spread: bool) -> Option<Item> {
    let mut scenes = Vec::new();
    let cells = values.measures.iter().enumerate().map(|(index, measure)| {
        let common = scenes_of(values).map(|item| &item.cells[index]);
        let common: Vec<_> =
            common.filter(|cells| cells.iter().all(|cell| cell.value.is_some())).collect();
        if common.len() > 1 {
            scenes.push(common.len());
        }
        let of = |method: usize| -> Scored {
            let of_scenes: Vec<f64> = common.iter().filter_map(|c| c[method].value).collect();
            let spread = deviation(&of_scenes).filter(|_| with_spread);
            if of_scenes.len() > 1 { (mean(&of_scenes), spread) } else { (None, None) }
        };
        let scored: Vec<Scored> = (0..values.methods.len()).map(of).collect();
        marked(index, measure, &scored)
    });
    let cells = cells.collect();
    let (fewest, most) = (scenes.iter().min().copied()?, scenes.iter().max().copied()?);
    let all = scenes_of(values).count();
    let label = if fewest == most {
        average_label(fewest, all)
    } else {
        "Average of the scenes all methods have".to_owned()
    };
    let title = if fewest == all { format!("Average over {all} scenes") } else { label.clone() };
    Some(Item { title, is_average: true, ..Item::new(label, cells) })
}
