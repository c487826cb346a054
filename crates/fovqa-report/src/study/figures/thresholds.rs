//! Figures of thresholds of psychometric functions: dots with intervals.

use fovqa_plot::{Axis, Figure};
use fovqa_study::json::{Document, Group};
use fovqa_study::psychometric::Psychometric;

use super::context::{Context, caption, ends, group_name, left_out, percent, short};
use super::dots::{Dot, MOST_GROUPS, Row, chart, distinct};
use crate::sheet::NamedFigure;

/// The most series.
const MOST_SERIES: usize = 8;

/// The threshold of a group at a performance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Threshold {
    /// The performance, from 0 to 1.
    pub(super) performance: f64,
    pub(super) dot: Dot,
    /// Whether it is the median of the posterior, and not the maximum-likelihood fit.
    pub(super) is_median: bool,
}

/// The threshold at one of the performances: of the maximum-likelihood fit with its bootstrap interval,
/// or the median of the posterior if the fit has no threshold or no interval.
pub(super) fn threshold(result: &Psychometric, index: usize) -> Option<Threshold> {
    let fitted = result.ml.as_ref().and_then(|ml| ml.thresholds.get(index)).map(|at| Threshold {
        performance: at.performance,
        dot: Dot { value: at.level, interval: ends(at.ci) },
        is_median: false,
    });
    let median = result.posterior.as_ref().and_then(|posterior| posterior.thresholds.get(index));
    let median = median.map(|at| Threshold {
        performance: at.performance,
        dot: Dot { value: at.median, interval: ends(at.ci) },
        is_median: true,
    });
    let is_whole = |of: &Threshold| of.dot.value.is_some() && of.dot.interval.is_some();
    fitted
        .filter(is_whole)
        .or(median.filter(is_whole))
        .or(fitted)
        .filter(|of| of.dot.value.is_some())
}

pub(super) fn figures(document: &Document<Psychometric>, context: &Context) -> Vec<NamedFigure> {
    thresholds(document, context).into_iter().collect()
}

/// A group at a place along the axis, and in a series.
struct Placed<'a> {
    place: String,
    series: String,
    threshold: Option<Threshold>,
    group: &'a Group<Psychometric>,
}

fn thresholds(document: &Document<Psychometric>, context: &Context) -> Option<NamedFigure> {
    let performances = performances(document);
    let has_two_columns = document.groups.iter().any(|group| group.by.0.len() == 2);
    let mut placed: Vec<Placed<'_>> = Vec::new();
    for group in &document.groups {
        match group.by.0.as_slice() {
            [(_, first), (_, second)] => placed.push(Placed {
                place: first.clone(),
                series: second.clone(),
                threshold: threshold(&group.result, 0),
                group,
            }),
            _ => {
                placed.extend(performances.iter().enumerate().map(|(index, performance)| Placed {
                    place: group_name(&group.by),
                    series: format!("{} correct", percent(*performance)),
                    threshold: threshold(&group.result, index),
                    group,
                }));
            }
        }
    }
    let shown = || placed.iter().filter_map(|placed| placed.threshold);
    let has_interval = shown().any(|threshold| threshold.dot.interval.is_some());
    let ends = || shown().filter_map(|threshold| threshold.dot.interval).flatten();
    let has_open = ends().any(f64::is_infinite);
    let groups = distinct(placed.iter().map(|placed| placed.place.as_str()));
    if shown().next().is_none() || (document.groups.len() < 2 && !has_interval) {
        return None;
    }
    let series = distinct(placed.iter().map(|placed| placed.series.as_str()));
    let groups_shown = &groups[..groups.len().min(MOST_GROUPS)];
    let series_shown = &series[..series.len().min(MOST_SERIES)];
    let row = |(look, name): (usize, &&str)| {
        let of = |group: &&str| {
            let found = placed.iter().find(|at| at.place == **group && at.series == **name);
            found
                .and_then(|placed| placed.threshold)
                .map(|threshold| threshold.dot)
                .unwrap_or_default()
        };
        let dots = groups_shown.iter().map(of).collect();
        Row { name: (*name).to_owned(), look, dots, notes: Vec::new() }
    };
    let rows = series_shown.iter().enumerate().map(row).collect();
    let is_log = document
        .groups
        .iter()
        .any(|group| group.result.drawn.as_ref().is_some_and(|drawn| drawn.is_logarithmic));
    let axis = Axis { log: is_log, ..Axis::new("Threshold (level)") };
    let names = groups_shown.iter().map(|&group| group.to_owned()).collect();
    let chart = chart(axis, names, rows)?;
    let performance = performances.first().copied().map(percent);
    let at = match performance {
        Some(performance) if has_two_columns || performances.len() == 1 => {
            format!("Levels with {performance} correct answers")
        }
        _ => "Levels with these shares of correct answers".to_owned(),
    };
    let text = caption(&[
        &at,
        &if has_interval { methods_in_words(&placed, context) } else { String::new() },
        if has_open { "an interval that ends at the border has no limit there" } else { "" },
        &left_out(groups.len(), groups_shown.len(), "groups"),
        &left_out(series.len(), series_shown.len(), "series"),
    ]);
    Some(context.figure("thresholds", "", (text, Figure::Bar(chart))))
}

/// The performances of the groups, which are the same in all.
fn performances(document: &Document<Psychometric>) -> Vec<f64> {
    let of = |group: &Group<Psychometric>| {
        let ml = group.result.ml.as_ref()?;
        Some(ml.thresholds.iter().map(|at| at.performance).collect())
    };
    document.groups.iter().find_map(of).unwrap_or_default()
}

/// How thresholds and intervals were estimated.
fn methods_in_words(placed: &[Placed<'_>], context: &Context) -> String {
    let of = |is_median: bool| {
        let with =
            |placed: &&Placed<'_>| placed.threshold.is_some_and(|t| t.is_median == is_median);
        let names = placed.iter().filter(with).map(|placed| group_name(&placed.group.by));
        let names: Vec<String> = names.collect();
        distinct(names.iter().map(String::as_str)).into_iter().map(short).collect::<Vec<_>>()
    };
    let coverage = context.coverage();
    let (fitted, medians) = (of(false), of(true));
    let posterior = format!("medians of the posterior with {coverage} equal-tailed intervals");
    if fitted.is_empty() {
        return posterior;
    }
    let fits = format!("maximum likelihood with {coverage} bootstrap intervals");
    match medians.as_slice() {
        [] => fits,
        names => {
            let shown = names.iter().take(4).cloned().collect::<Vec<_>>().join(" / ");
            let more = if names.len() > 4 { " and others" } else { "" };
            format!("{fits}; {shown}{more}: {posterior}")
        }
    }
}
