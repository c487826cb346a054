//! Remarks that are shown together with a comparison table.

use fovqa_metrics::{Metric, MetricKind};
use fovqa_plan::{AveragePlace, Plot, SpreadOver};
use fovqa_results::GuideSource;

use super::column::Column;
use crate::overview::Overview;

pub(super) const EYES_NOTE: &str = "Both eyes: the values of the left and the right eye pooled as each metric requires, which is not always their mean.";

pub(super) const EYES_AVERAGED_NOTE: &str = "Averages over scenes are of both eyes.";

const FOVEAL_NOTE: &str = "FPSNR and FSSIM: the papers print no constants for the foveal weight; \
                           values can be compared between methods, not with papers.";

const FVVDP_NOTE: &str = "FovVideoVDP: JOD of the sequence; 10 means no visible difference, 1 less means that 75 % of \
                          observers prefer the reference. There is no lower limit.";

const SAMPLES_NOTE: &str = "Samples: what an emulated method shades, in percent of the frame's pixels. Emulation from a finished frame \
     understates aliasing and flicker.";

const QUADS_NOTE: &str = "Quads: blocks of 2x2 samples of the buffers that a rasteriser shades, in percent of the frame's. Polar buffers and \
     continuous rates have none.";

/// The remarks of a table with these columns.
pub(super) fn notes(
    overview: &Overview,
    plot: &Plot,
    columns: &[Column],
    scenes: &[&str],
    methods: &[String],
) -> Vec<String> {
    let shows = |metric: Metric| columns.contains(&Column::Metric(metric));
    let mut notes: Vec<String> = spread(plot, columns).into_iter().collect();
    if shows(Metric::Fpsnr) || shows(Metric::Fssim) {
        notes.push(FOVEAL_NOTE.to_owned());
    }
    if shows(Metric::Fvvdp) {
        notes.push(FVVDP_NOTE.to_owned());
    }
    for metric in Metric::ALL.into_iter().filter(|m| m.is(MetricKind::Temporal) && shows(*m)) {
        notes.push(temporal(metric));
        notes.extend(without_motion(metric, overview, scenes, methods));
    }
    if columns.contains(&Column::Samples) {
        notes.push(SAMPLES_NOTE.to_owned());
    }
    if columns.contains(&Column::Quads) {
        notes.push(QUADS_NOTE.to_owned());
    }
    notes.extend(unequal_frames(overview, scenes, methods));
    notes.extend(identical_frames(overview, scenes, methods));
    notes
}

/// What the values are.
pub(super) fn means(plot: &Plot) -> String {
    let only = plot.average == AveragePlace::Only;
    let means = match (plot.spread, only) {
        (None, false) => "Means over frames.",
        (None, true) => "Means over frames, averaged over scenes.",
        (Some(SpreadOver::Scenes), false) => {
            "Means over frames; averages ± standard deviation over scenes."
        }
        (Some(SpreadOver::Scenes), true) => {
            "Means over frames, averaged over scenes ± standard deviation over scenes."
        }
        (Some(SpreadOver::Frames), _) => "Means ± standard deviation over frames.",
    };
    means.to_owned()
}

/// A note on the metrics that have no spread.
fn spread(plot: &Plot, columns: &[Column]) -> Option<String> {
    let whole = columns.iter().filter_map(|column| match column {
        Column::Metric(metric) if !column.has_frames() => Some(metric.info().label),
        _ => None,
    });
    let whole: Vec<&str> = whole.collect();
    (plot.spread == Some(SpreadOver::Frames) && !whole.is_empty()).then(|| {
        format!("Values of whole sequences have no spread over frames: {}.", whole.join(", "))
    })
}

/// Lists items for a note. If there are very many, only the first ones are listed.
fn first(listed: &[String], separator: &str) -> String {
    const MOST: usize = 20;
    let text = listed[..listed.len().min(MOST)].join(separator);
    match listed.len().saturating_sub(MOST) {
        0 => text,
        more => format!("{text}{separator}and {more} more"),
    }
}

/// What the percentage of a temporal metric is.
fn temporal(metric: Metric) -> String {
    let info = metric.info();
    format!("{}: {} of the test in percent of the reference's.", info.label, info.long_name)
}

/// A note on the scenes in which a temporal metric was measured without motion vectors.
fn without_motion(
    metric: Metric,
    overview: &Overview,
    scenes: &[&str],
    methods: &[String],
) -> Option<String> {
    let still = |scene: &&&str| {
        let of = |method: &String| overview.of(scene, method)?.temporal.of(metric);
        let taken = methods.iter().filter_map(of).filter(|of| of.ratio.is_some());
        taken.clone().count() > 0 && taken.clone().all(|of| of.motion == GuideSource::None)
    };
    let still: Vec<&str> = scenes.iter().filter(still).copied().collect();
    let which = still.join(", ");
    (!still.is_empty()).then(|| {
        let label = metric.info().label;
        format!(
            "{label} without motion vectors, where all movement counts as a difference: {which}."
        )
    })
}

/// A note on the scenes in which the methods were not scored on the same number of frames.
fn unequal_frames(overview: &Overview, scenes: &[&str], methods: &[String]) -> Option<String> {
    let unequal: Vec<String> = scenes
        .iter()
        .filter_map(|scene| {
            let scored: Vec<(&String, usize)> = methods
                .iter()
                .filter_map(|method| Some((method, overview.of(scene, method)?.frames)))
                .collect();
            let most = scored.iter().map(|(_, frames)| *frames).max()?;
            let fewer = scored.iter().filter(|(_, frames)| *frames < most);
            let fewer: Vec<String> =
                fewer.map(|(method, frames)| format!("{method} {frames} of {most}")).collect();
            (!fewer.is_empty()).then(|| format!("{scene}: {}", first(&fewer, ", ")))
        })
        .collect();
    (!unequal.is_empty()).then(|| {
        format!("Not all methods were scored on the same frames ({}).", first(&unequal, "; "))
    })
}

/// A note on the frames with infinite decibels, which are not part of any mean.
fn identical_frames(overview: &Overview, scenes: &[&str], methods: &[String]) -> Option<String> {
    let pairs = scenes.iter().flat_map(|scene| methods.iter().map(move |method| (scene, method)));
    let identical: Vec<String> = pairs
        .filter_map(|(scene, method)| {
            let comparison = overview.of(scene, method)?;
            let count = comparison.scores().find_map(|score| score.identical_frames)?;
            (0 < count && count < comparison.frames)
                .then(|| format!("{scene}, {method}: {count} of {}", comparison.frames))
        })
        .collect();
    (!identical.is_empty()).then(|| {
        let which = first(&identical, "; ");
        format!("Means of decibels leave out frames that are identical to the reference ({which}).")
    })
}
