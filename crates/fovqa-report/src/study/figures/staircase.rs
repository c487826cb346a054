//! Figures of staircases: their tracks, and the thresholds of methods.

use fovqa_plot::{Axis, Figure, LineChart, LineSeries, Look};
use fovqa_study::json::{Document, Group};
use fovqa_study::options::LevelMean;
use fovqa_study::staircase::{Staircase, Staircases};

use super::context::{Context, caption, group_name, left_out, parts};
use super::dots::{Dot, MOST_GROUPS, Row, chart, distinct};
use super::psychometric::{MOST_FIGURES, MOST_PANELS, panel_figure};
use crate::sheet::NamedFigure;

/// The most trials of a track in one of three columns.
const MOST_IN_3_COLUMNS: usize = 60;
/// The most panels with longer tracks.
const MOST_LONG: usize = 8;
/// The most series of the thresholds.
const MOST_SERIES: usize = 8;

/// A trial in a track.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Step {
    pub(super) trial: f64,
    pub(super) level: f64,
    pub(super) is_correct: bool,
    /// Whether it is a reversal that enters the threshold.
    pub(super) is_used: bool,
}

/// The level of each trial with the answers, reversals as rings, and a named level as a dashed line.
pub(super) fn track(steps: &[Step], level: Option<(&str, f64)>, is_log: bool) -> LineChart {
    let look = Look::new(0);
    let points = |keep: &dyn Fn(&Step) -> bool| -> Vec<(f64, Option<f64>)> {
        steps.iter().filter(|step| keep(step)).map(|step| (step.trial, Some(step.level))).collect()
    };
    let named = |name: &str| LineSeries { name: name.to_owned(), look, ..LineSeries::default() };
    let mut series = vec![LineSeries {
        rings: true,
        dots: true,
        points: points(&|step| step.is_used),
        ..named("reversal that counts")
    }];
    let ends = steps.first().zip(steps.last());
    if let (Some((name, level)), Some((first, last))) = (level, ends)
        && level.is_finite()
    {
        let points = vec![(first.trial, Some(level)), (last.trial, Some(level))];
        series.push(LineSeries { reference: true, points, ..named(name) });
    }
    let line = named("level");
    series.push(LineSeries { unmarked: true, unlisted: true, points: points(&|_| true), ..line });
    let right = points(&|step| step.is_correct);
    series.push(LineSeries { dots: true, points: right, ..named("right answer") });
    series.push(LineSeries {
        scatter: true,
        look: Look::new(1),
        points: points(&|step| !step.is_correct),
        ..named("wrong answer")
    });
    series.retain(|series| !series.points.is_empty());
    let y = Axis { log: is_log, ..Axis::new("Level") };
    LineChart { x: Axis::new("Trial"), y, series, ..LineChart::default() }
}

pub(super) fn figures(document: &Document<Staircases>, context: &Context) -> Vec<NamedFigure> {
    let mut figures = tracks(document, context);
    figures.extend(methods(document, context));
    figures
}

fn tracks(document: &Document<Staircases>, context: &Context) -> Vec<NamedFigure> {
    let of = |group: &'_ Group<Staircases>| group.result.mean;
    let all: Vec<(LevelMean, &Staircase)> = document
        .groups
        .iter()
        .flat_map(|group| {
            group.result.staircases.iter().map(move |staircase| (of(group), staircase))
        })
        .filter(|(_, staircase)| !staircase.track.is_empty())
        .collect();
    // Long tracks need room.
    let is_long = all.iter().any(|(_, staircase)| staircase.track.len() > MOST_IN_3_COLUMNS);
    let (columns, panels) = if is_long { (2, MOST_LONG) } else { (3, MOST_PANELS) };
    let (parts, left) = parts(&all, panels, MOST_FIGURES, "staircases");
    let figure = |part: &[(LevelMean, &Staircase)]| {
        let panels: Vec<LineChart> = part.iter().map(|(mean, of)| panel(of, *mean)).collect();
        let is_geometric = part.iter().any(|(mean, _)| *mean == LevelMean::Geometric);
        let mean = if is_geometric { "geometric mean" } else { "mean" };
        let mut trials = part.iter().flat_map(|(_, of)| &of.track);
        let has_rings = trials.any(|trial| trial.is_used);
        let has_threshold = part.iter().any(|(_, of)| of.threshold.threshold.is_some());
        let text = caption(&[
            "Levels of the staircases by trial",
            if has_rings { "rings: reversals that enter the threshold" } else { "" },
            &if has_threshold {
                format!("dashed: threshold, the {mean} of their levels")
            } else {
                String::new()
            },
            &left,
        ]);
        context.figure("tracks", "", (text, panel_figure(panels, columns)))
    };
    parts.into_iter().map(figure).collect()
}

fn panel(staircase: &Staircase, mean: LevelMean) -> LineChart {
    let steps = staircase.track.iter().map(|trial| Step {
        trial: trial.trial,
        level: trial.level,
        is_correct: trial.is_correct,
        is_used: trial.is_used,
    });
    let steps: Vec<Step> = steps.collect();
    let threshold = staircase.threshold.threshold.map(|threshold| ("threshold", threshold));
    let names = [
        Some(staircase.participant.as_str()),
        staircase.scene.as_deref(),
        staircase.method.as_deref(),
        staircase.staircase.as_deref(),
    ];
    let title = distinct(names.into_iter().flatten().filter(|name| !name.is_empty())).join(", ");
    let chart = track(&steps, threshold, mean == LevelMean::Geometric);
    LineChart { title: (!title.is_empty()).then_some(title), ..chart }
}

/// The thresholds of the methods; groups are series, or along the axis if there are no methods.
fn methods(document: &Document<Staircases>, context: &Context) -> Option<NamedFigure> {
    let thresholds = || document.groups.iter().flat_map(|group| &group.result.methods);
    let has_methods = thresholds().any(|threshold| threshold.method.is_some());
    let dot = |group: usize, name: &str| {
        let mut methods = document.groups.get(group)?.result.methods.iter();
        let found = methods.find(|of| !has_methods || of.method.as_deref() == Some(name))?;
        Some(Dot { value: found.threshold, interval: found.ci })
    };
    let names: Vec<String> = document.groups.iter().map(|group| group_name(&group.by)).collect();
    let all: Vec<String> = if has_methods {
        let methods = thresholds().filter_map(|threshold| threshold.method.as_deref());
        distinct(methods).into_iter().map(str::to_owned).collect()
    } else {
        names.clone()
    };
    let places = &all[..all.len().min(MOST_GROUPS)];
    let series = if has_methods { names.len() } else { 1 };
    let row = |of: usize| {
        let group = |place: usize| if has_methods { of } else { place };
        let dots =
            places.iter().enumerate().map(|(i, name)| dot(group(i), name).unwrap_or_default());
        let dots = dots.collect();
        Row { name: names.get(of).cloned().unwrap_or_default(), look: of, dots, notes: Vec::new() }
    };
    let rows: Vec<Row> = (0..series.min(MOST_SERIES)).map(row).collect();
    let dots = || rows.iter().flat_map(|row| &row.dots).filter(|dot| dot.value.is_some());
    let has_interval = dots().any(|dot| dot.interval.is_some());
    if dots().count() < 2 && !has_interval {
        return None;
    }
    let is_log = document.groups.iter().any(|group| group.result.mean == LevelMean::Geometric);
    let mean = if is_log { "Geometric means" } else { "Means" };
    let text = caption(&[
        &format!("{mean} of the participants' thresholds"),
        &if has_interval {
            format!("intervals: {} t intervals over participants", context.coverage())
        } else {
            String::new()
        },
        &left_out(all.len(), places.len(), if has_methods { "methods" } else { "groups" }),
        &left_out(series, rows.len(), "groups"),
    ]);
    let y = Axis { log: is_log, ..Axis::new("Threshold (level)") };
    let chart = chart(y, places.to_vec(), rows)?;
    Some(context.figure("methods", "", (text, Figure::Bar(chart))))
}
