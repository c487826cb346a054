//! Figures of metrics: mean opinion scores against the scores of each metric, and correlations.

use fovqa_metrics::Metric as KnownMetric;
use fovqa_plot::{Axis, BarChart, Figure, LineChart, LineSeries, Look};
use fovqa_study::json::{Document, Group};
use fovqa_study::metrics::{Metric, Metrics};

use super::context::{
    Context, MOST_FIGURES, caption, ends, group_in_words, group_name, left_out, parts,
};
use super::dots::{Dot, MOST_GROUPS, Row, chart, distinct};
use super::psychometric::{MOST_PANELS, panel_figure};
use crate::sheet::NamedFigure;

/// The most methods with looks of their own.
const MOST_METHODS: usize = 8;
/// Space beside the scores, as a share of their range.
const BESIDE: f64 = 0.05;
/// The points of a fitted curve.
const POINTS: usize = 101;
/// The most figures of a group.
const MOST_OF_GROUP: usize = 4;

pub(super) fn figures(document: &Document<Metrics>, context: &Context) -> Vec<NamedFigure> {
    let all = document.groups.iter().flat_map(|group| &group.result.conditions);
    let methods = distinct(all.map(|condition| condition.method.as_str()));
    let (parts, left) = parts(&document.groups, 1, MOST_FIGURES, "groups");
    let of = |group: &Group<Metrics>| {
        let mut figures = scatter(group, &methods, context, &left);
        figures.extend(correlations(group, context, &left));
        figures
    };
    parts.into_iter().flatten().flat_map(of).collect()
}

/// What a metric is called.
fn label(metric: &str) -> String {
    KnownMetric::find(metric)
        .map_or_else(|| metric.to_owned(), |known| known.info().label.to_owned())
}

/// The unit of a metric, behind its name.
fn unit(metric: &str) -> String {
    match KnownMetric::find(metric).map_or("", |known| known.info().unit) {
        "" => String::new(),
        unit => format!(" in {unit}"),
    }
}

fn scatter(
    group: &Group<Metrics>,
    methods: &[&str],
    context: &Context,
    groups_left: &str,
) -> Vec<NamedFigure> {
    let metrics: Vec<&Metric> =
        group.result.metrics.iter().filter(|m| !m.scores.is_empty()).collect();
    let (parts, left) = parts(&metrics, MOST_PANELS, MOST_OF_GROUP, "metrics");
    let has_errors = group.result.conditions.iter().any(|condition| condition.error.is_some());
    let has_fit = metrics.iter().any(|metric| metric.fit.is_some());
    let text = caption(&[
        "Mean opinion scores against the scores of each metric, one marker for each scene and method",
        &group_in_words(&group.by),
        if has_errors { "error bars: standard error of the mean opinion score" } else { "" },
        if has_fit { "dashed: fitted logistic function" } else { "" },
        "r: Pearson's correlation; ρ: Spearman's",
        &left,
        groups_left,
    ]);
    let figure = |part: &[&Metric]| {
        let panels = part.iter().map(|metric| panel(metric, &group.result, methods)).collect();
        context.figure("scores", &group_name(&group.by), (text.clone(), panel_figure(panels, 3)))
    };
    parts.into_iter().map(figure).collect()
}

fn panel(metric: &Metric, result: &Metrics, methods: &[&str]) -> LineChart {
    // Scores of which lower ones are better were negated.
    let sign = if metric.lower_is_better { -1.0 } else { 1.0 };
    let finite = || metric.scores.iter().copied().filter(|score| score.is_finite());
    let low = finite().fold(f64::INFINITY, f64::min);
    let high = finite().fold(f64::NEG_INFINITY, f64::max);
    let mut series = Vec::new();
    if let Some(fit) = metric.fit.as_ref().filter(|_| low < high) {
        let at = |i: usize| low + (high - low) * i as f64 / (POINTS - 1) as f64;
        let mut points: Vec<(f64, Option<f64>)> =
            (0..POINTS).map(|i| (sign * at(i), Some(fit.at(at(i))))).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        let name = "logistic fit".to_owned();
        series.push(LineSeries {
            name,
            reference: true,
            smooth: true,
            points,
            ..LineSeries::default()
        });
    }
    let has_looks = methods.len() <= MOST_METHODS;
    let looks = if has_looks { methods } else { &[""] };
    for (look, method) in looks.iter().enumerate() {
        let conditions = result.conditions.iter().zip(&metric.scores);
        let of = conditions.filter(|(of, _)| !has_looks || of.method == *method);
        let of: Vec<_> = of.collect();
        series.push(LineSeries {
            name: (*method).to_owned(),
            look: Look::new(look),
            scatter: true,
            points: of.iter().map(|(of, score)| (sign * **score, Some(of.value))).collect(),
            errors: of.iter().map(|(of, _)| of.error).collect(),
            ..LineSeries::default()
        });
    }
    series.retain(|series| !series.points.is_empty());
    let number = |name: &str, value: Option<f64>| {
        value.map_or_else(|| format!("{name} undefined"), |value| format!("{name} = {value:.2}"))
    };
    let (r, rho) = (number("r", metric.pearson), number("ρ", metric.spearman));
    let better = if metric.lower_is_better { " (lower is better)" } else { "" };
    // Markers do not stand on the axis.
    let beside = BESIDE * (high - low);
    let ends = [sign * (low - beside), sign * (high + beside)];
    let (min, max) = (Some(ends[0].min(ends[1])), Some(ends[0].max(ends[1])));
    LineChart {
        title: Some(format!("{r}, {rho}")),
        x: Axis {
            min,
            max,
            ..Axis::new(format!("{}{}{better}", label(&metric.metric), unit(&metric.metric)))
        },
        y: Axis::new("Mean opinion score"),
        series,
        ..LineChart::default()
    }
}

fn correlations(
    group: &Group<Metrics>,
    context: &Context,
    groups_left: &str,
) -> Option<NamedFigure> {
    let all = &group.result.metrics;
    let metrics = &all[..all.len().min(MOST_GROUPS)];
    let has_bootstrap = metrics.iter().any(|metric| metric.pearson_bootstrap.is_some());
    let dot = |value: Option<f64>, interval: Option<[f64; 2]>| Dot { value, interval };
    let pearson = metrics.iter().map(|metric| {
        let interval =
            if has_bootstrap { ends(metric.pearson_bootstrap) } else { metric.pearson_fisher };
        dot(metric.pearson, interval)
    });
    let spearman = metrics.iter().map(|m| dot(m.spearman, ends(m.spearman_bootstrap)));
    let rows = [("Pearson", pearson.collect()), ("Spearman", spearman.collect::<Vec<Dot>>())];
    let row = |(look, (name, dots)): (usize, (&str, Vec<Dot>))| Row {
        name: name.to_owned(),
        look,
        dots,
        notes: Vec::new(),
    };
    let rows: Vec<Row> = rows.into_iter().enumerate().map(row).collect();
    let lowest = rows.iter().flat_map(|row| &row.dots).filter_map(|dot| dot.interval);
    let is_above_0 = lowest.clone().all(|[low, _]| low >= 0.0)
        && rows.iter().flat_map(|row| &row.dots).all(|dot| dot.value.is_none_or(|r| r >= 0.0));
    let has_interval = lowest.clone().next().is_some();
    let interval = match (has_interval, has_bootstrap) {
        (false, _) => String::new(),
        (true, true) => {
            format!("intervals: {} bootstrap (conditions resampled)", context.coverage())
        }
        (true, false) => format!("intervals: {}, Fisher's transformation", context.coverage()),
    };
    let text = caption(&[
        "Correlation of each metric with the mean opinion scores; scores of which lower ones are better are negated",
        &group_in_words(&group.by),
        &interval,
        &left_out(all.len(), metrics.len(), "metrics"),
        groups_left,
    ]);
    let min = is_above_0.then_some(0.0);
    let y = Axis { min, max: Some(1.0), ..Axis::new("Correlation") };
    let names = metrics.iter().map(|metric| label(&metric.metric)).collect();
    let chart: BarChart = chart(y, names, rows)?;
    Some(context.figure("correlations", &group_name(&group.by), (text, Figure::Bar(chart))))
}
