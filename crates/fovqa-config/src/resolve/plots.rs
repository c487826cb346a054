//! `[[plot]]`.

use std::ops::Range;

use fovqa_metrics::{Metric, MetricKind, Params};
use fovqa_params::Words;

use super::figures::{figure, has_effect};
use super::methods::Methods;
use super::regions;
use super::scenes::SceneEntry;
use super::tables::with_table_keys;
use super::view::VIEW_HELP;
use crate::fault::{Fault, Faults};
use crate::grammar::{first_quoted, quoted};
use crate::nearest::nearest;
use crate::node::Node;
use fovqa_plan::{FigureForm, FigureSettings, MetricChoice, Plot, PlotKind};

/// The names that plots may refer to.
pub(super) struct Known<'a> {
    pub(super) scenes: &'a [SceneEntry],
    pub(super) methods: &'a Methods,
    pub(super) metrics: &'a MetricChoice,
    pub(super) params: &'a Params,
}

pub(super) fn plots(
    root: Node<'_>,
    known: &Known<'_>,
    figures: &FigureSettings,
    faults: &mut Faults,
) -> Vec<Plot> {
    let tables = root.tables("plot").into_iter();
    let plots = tables.map(|(table, _)| {
        let kind = table.word("kind").unwrap_or(PlotKind::Table);
        let metric = table.text("metric");
        if let Some(metric) = metric {
            scored((metric, table.span("metric")), kind, known, faults);
        }
        let metrics = metrics(table, kind, known, faults);
        let of_haar = metric == Some(Metric::Haar.key())
            || metrics.iter().flatten().any(|metric| metric == Metric::Haar.key());
        wavelet(table, of_haar, kind, known, faults);
        let scenes: Vec<&str> = known.scenes.iter().map(|s| s.scene.name.as_str()).collect();
        let methods = known.methods.referable();
        let shown_scenes = subset(table, "scenes", &scenes, faults);
        let of_plot = shown_scenes.as_deref();
        let plot = Plot {
            regions: regions::of_plot(table, &scenes, of_plot, faults),
            metric: metric.map(str::to_owned),
            metrics,
            scenes: shown_scenes,
            methods: subset(table, "methods", &methods, faults).map(|names| {
                names.iter().flat_map(|name| known.methods.called(name)).cloned().collect()
            }),
            levels: levels(table),
            statistic: table.text("statistic").map(str::to_owned),
            error_bars: table.word("error_bars"),
            shape: table.word("shape").unwrap_or_default(),
            figure: figure(table.table("figure"), figures, faults),
            caption: table.text("caption").map(str::to_owned),
            ..Plot::of(kind)
        };
        let shown = plot.scenes.as_ref().map_or(scenes.len(), Vec::len);
        marks(table, kind, faults);
        let own =
            || figure(table.table("figure"), &FigureSettings::default(), &mut Faults::default());
        has_effect(table, FigureForm::of(kind), kind.word(), own, faults);
        if kind == PlotKind::Crops {
            regions::has_some(table, faults);
        }
        let plot = with_table_keys(table, plot, shown, faults);
        if faults.is_empty() {
            shows_something(table, &plot, known, faults);
        }
        plot
    });
    plots.collect()
}

/// Checks that error bars and shapes are given only for plots that have them.
fn marks(table: Node<'_>, kind: PlotKind, faults: &mut Faults) {
    let of_spectrum = table.text("metric") == Some(Metric::Spectrum.key());
    if kind == PlotKind::Profile && of_spectrum && table.has("error_bars") {
        let message = "the power spectrum has no error bars";
        faults.push(Fault::new(table.span("error_bars"), message).help("leave out error_bars"));
    }
    let has_bars = matches!(kind, PlotKind::Bars | PlotKind::Profile);
    for (key, fits, kinds) in [
        ("error_bars", has_bars, "\"bars\" or \"profile\""),
        ("regions", kind == PlotKind::Crops, "\"crops\""),
        ("shape", kind == PlotKind::Frames, "\"frames\""),
    ] {
        if table.has(key) && !fits {
            let message = format!("{key} does not apply to kind = \"{}\"", kind.word());
            let fault = Fault::new(table.span(key), message);
            faults.push(fault.help(format!("use it with kind = {kinds}")));
        }
    }
}

/// Checks that at least one of a plot's methods is in one of its scenes and, for a profile, has
/// bands there.
fn shows_something(table: Node<'_>, plot: &Plot, known: &Known<'_>, faults: &mut Faults) {
    let wanted = |names: &Option<Vec<String>>, name: &str| {
        names.as_ref().is_none_or(|names| names.iter().any(|n| n == name))
    };
    let scenes = known.scenes.iter().filter(|scene| wanted(&plot.scenes, &scene.scene.name));
    let eyes: Vec<_> = scenes.flat_map(|scene| &scene.scene.eyes).collect();
    let scored = |(method, _): &(usize, _)| wanted(&plot.methods, &known.methods.names[*method]);
    let (message, help) = if !eyes.iter().any(|eye| eye.tests.iter().any(scored)) {
        ("the plot has nothing to show: none of its methods is in any of its scenes", "")
    } else if matches!(plot.kind, PlotKind::Profile | PlotKind::Ratios | PlotKind::RatioProfile)
        && eyes.iter().all(|e| e.settings.view.is_none())
    {
        ("the plot shows values by eccentricity, but none of its scenes has a view", VIEW_HELP)
    } else if matches!(plot.kind, PlotKind::Sweep | PlotKind::Optima)
        && !known.methods.sweeps.iter().any(|sweep| {
            known.methods.names[sweep.methods()].iter().any(|name| wanted(&plot.methods, name))
        })
    {
        (
            "the plot shows a sweep, but none of its methods is swept",
            "add [sweep], such as \"RMFR.fx\" = [0.1, 0.2]",
        )
    } else if !matches!(plot.kind, PlotKind::Crops | PlotKind::Budgets)
        && plot.named().is_none()
        && !known.metrics.metrics().iter().any(|m| fits(*m, plot.kind))
    {
        ("the plot has nothing to show: no metric that is scored fits its kind", "")
    } else {
        return;
    };
    faults.push(Fault::new(table.span("kind"), message).help(help));
}

/// The metrics in a list, each once.
fn metrics(
    table: Node<'_>,
    kind: PlotKind,
    known: &Known<'_>,
    faults: &mut Faults,
) -> Option<Vec<String>> {
    let named = table.names("metrics")?;
    if table.has("metric") {
        let message = "a plot has either metric or metrics";
        faults.push(Fault::new(table.span("metrics"), message).help("leave out one of them"));
    }
    let mut metrics: Vec<String> = Vec::new();
    for (key, span) in named {
        match (key, kind) {
            (Plot::SAMPLES | Plot::QUADS, PlotKind::Table) => {}
            (Plot::SAMPLES | Plot::QUADS, _) => {
                let message = format!("only a comparison table shows {key}");
                faults.push(Fault::new(span, message).help("use it with kind = \"table\""));
            }
            _ => scored((key, span), kind, known, faults),
        }
        if !metrics.iter().any(|known| known == key) {
            metrics.push(key.to_owned());
        }
    }
    Some(metrics)
}

/// Checks that a plot's metric is scored and fits the kind of plot.
fn scored(
    (key, span): (&str, Range<usize>),
    kind: PlotKind,
    known: &Known<'_>,
    faults: &mut Faults,
) {
    let scored = known.metrics.metrics();
    let keys = || scored.iter().map(|metric| metric.key());
    let Some(metric) = scored.iter().find(|metric| metric.key() == key) else {
        let fault = Fault::new(span, format!("the plot's metric {key} is not scored"));
        faults.push(
            fault.help(format!("add it to [metrics]; the scored metrics are {}", quoted(keys()))),
        );
        return;
    };
    if !fits(*metric, kind) {
        let why = match (kind, metric.info().kind) {
            (PlotKind::Profile, _) => "has no values per band, and so no profile",
            (PlotKind::Ratios | PlotKind::RatioProfile, _) => {
                "already compares test with reference, and so has no ratio"
            }
            (PlotKind::Crops, _) => "cannot be shown as pictures",
            (PlotKind::Budgets, _) => "is no budget",
            _ => "describes each image by eccentricity: draw it as profile or ratios",
        };
        let others = scored.iter().filter(|metric| fits(**metric, kind)).map(|m| m.key());
        let help = match kind {
            PlotKind::Crops => {
                "remove it: crops show regions of the frames, whatever is scored".to_owned()
            }
            _ if others.clone().next().is_none() => {
                "none of the scored metrics fits: add one to [metrics]".to_owned()
            }
            _ => format!("these fit: {}", quoted(others)),
        };
        faults.push(Fault::new(span, format!("{key} {why}")).help(help));
    }
}

/// Whether a metric can be shown in a kind of plot.
fn fits(metric: Metric, kind: PlotKind) -> bool {
    match kind {
        PlotKind::Profile => metric.info().per_band,
        PlotKind::Ratios | PlotKind::RatioProfile => !metric.is(MetricKind::Fidelity),
        PlotKind::Crops | PlotKind::Budgets => false,
        PlotKind::Table
        | PlotKind::Bars
        | PlotKind::Frames
        | PlotKind::Sequence
        | PlotKind::Sweep
        | PlotKind::Optima => !metric.is(MetricKind::Profile),
    }
}

/// The wavelet levels in a list.
fn levels(table: Node<'_>) -> Option<Vec<usize>> {
    let levels = table.numbers("levels")?;
    Some(levels.into_iter().map(|level| level as usize).collect())
}

/// Checks that levels and statistic are given only for a plot that has them.
fn wavelet(table: Node<'_>, of_haar: bool, kind: PlotKind, known: &Known<'_>, faults: &mut Faults) {
    let fits = matches!(kind, PlotKind::Profile | PlotKind::Ratios | PlotKind::RatioProfile);
    if !fits || !of_haar {
        for key in ["levels", "statistic"].into_iter().filter(|key| table.has(key)) {
            let message = format!("{key} only applies to the wavelet");
            let fault = Fault::new(table.span(key), message);
            faults.push(
                fault.help("use it with kind = \"profile\" or \"ratios\" and metric = \"haar\""),
            );
        }
        return;
    }
    let most = known.params.haar.levels as usize;
    if let Some(level) = levels(table).iter().flatten().find(|level| **level > most) {
        let message = format!("level {level} is not scored: the number of levels is {most}");
        let fault = Fault::new(table.span("levels"), message);
        faults.push(fault.help(format!("write haar = {{ levels = {level} }} in [metrics]")));
    }
}

/// The names in a list, all of which have to be known.
pub(super) fn subset(
    table: Node<'_>,
    key: &str,
    known: &[&str],
    faults: &mut Faults,
) -> Option<Vec<String>> {
    let wanted = table.names(key)?;
    for (name, span) in &wanted {
        if faults.are_many() {
            break;
        }
        if !known.contains(name) {
            let what = key.trim_end_matches('s');
            let names = || known.iter().copied();
            let near = nearest(name, names()).map(|near| format!("did you mean \"{near}\"?"));
            let fault = Fault::new(span.clone(), format!("there is no {what} \"{name}\""));
            let help = format!("the {key} are {}", first_quoted(names()));
            faults.push(fault.label(near.unwrap_or_default()).help(help));
        }
    }
    Some(wanted.into_iter().map(|(name, _)| name.to_owned()).collect())
}
