//! Selects the figures of a run and their contents: values against eccentricity, per scene and
//! method, and over frames. A method has the same colour and marker in all of them.

mod compared;
mod crops;
mod parts;
mod profile;
mod sequence;
mod spectrum;

use std::collections::BTreeMap;
use std::path::Path;

use fovqa_metrics::{Better, Image, Metric, MetricKind};
use fovqa_plan::{ErrorBars, Plot, PlotKind, SpreadShape};
use fovqa_plot::{Axis, BarChart, BarSeries, Figure, Look, SpreadChart, SpreadSeries};
use fovqa_results::RunRecord;

use parts::Part;
pub use profile::Band;
pub(crate) use profile::chart;

use crate::band_spread::BandSpread;
use crate::comparison::{ComparisonTable, Ratios, average_label, common_scenes, mean, named};
use crate::frame_values::FrameValues;
use crate::moments::half_length;
use crate::overview::Overview;
use crate::sheet::NamedFigure;

/// Maximum number of band edges that fit on the axis as ticks.
const MOST_EDGE_TICKS: usize = 13;

/// The data that figures are made from.
pub(crate) struct Source<'a> {
    pub(crate) run: &'a RunRecord,
    pub(crate) overview: &'a Overview,
    pub(crate) values: &'a FrameValues,
    /// The folder of the results; `None` before anything was scored: pictures are blank then.
    pub(crate) folder: Option<&'a Path>,
    /// How values of bands vary over the frames; empty if no plot shows it.
    pub(crate) spread: &'a BandSpread,
}

impl Source<'_> {
    /// Whether a frame of a method was scored, as far as values of single frames are known.
    fn has_frame(&self, scene: &str, method: &str, frame: i64) -> bool {
        let is_measured = || self.overview.of(scene, method).is_some_and(|of| of.frames > 0);
        self.values.has_frame(scene, method, frame).unwrap_or_else(is_measured)
    }
}

/// The scenes and methods of a plot, or of one of its figures.
#[derive(Clone)]
struct Selection<'a> {
    source: &'a Source<'a>,
    scenes: Vec<&'a str>,
    /// Names of the methods with their looks.
    methods: Vec<(&'a str, Look)>,
    /// All methods of the plot.
    all: Vec<&'a str>,
    /// The methods that are shown; `None` for all.
    part: Option<Part>,
}

impl Source<'_> {
    /// The parameter that a method's budget solves.
    pub(crate) fn parameter_of_budget(&self, scene: &str, method: &str) -> String {
        let scenes = &self.run.resolved.scenes;
        let eyes = scenes.iter().find(|known| known.name == scene).map(|scene| &scene.eyes);
        let keys = eyes.into_iter().flatten().find_map(|eye| eye.emulations.get(method));
        let parameter = keys.and_then(|keys| keys.get("budget_parameter")?.as_str());
        parameter.unwrap_or_default().to_owned()
    }
}

/// The plots of a run that requests none: all plots that have something to show.
pub(crate) fn default_plots(source: &Source<'_>) -> Vec<Plot> {
    let all = source.overview.all();
    let budgets = all.iter().any(|measured| measured.budget.is_some());
    if !source.run.resolved.sweeps.is_empty() {
        let kinds = [PlotKind::Optima, PlotKind::Sweep, PlotKind::Table];
        let budgets = budgets.then_some(PlotKind::Budgets);
        return kinds.into_iter().chain(budgets).map(Plot::of).collect();
    }
    let mut kinds = vec![PlotKind::Table, PlotKind::Ratios, PlotKind::Profile];
    kinds.push(PlotKind::RatioProfile);
    if all.iter().filter(|measured| !measured.is_of_one_eye).count() > 1 {
        kinds.push(PlotKind::Bars);
    }
    if all.iter().any(|measured| measured.frames > 1) {
        kinds.push(PlotKind::Frames);
    }
    if budgets {
        kinds.push(PlotKind::Budgets);
    }
    let mut plots: Vec<Plot> = kinds.into_iter().map(Plot::of).collect();
    let temporal = Metric::ALL.into_iter().filter(|metric| metric.is(MetricKind::Temporal));
    for metric in temporal {
        if all.iter().any(|of| of.temporal.of(metric).is_some_and(|of| of.frames > 1)) {
            let metric = Some(metric.key().to_owned());
            plots.push(Plot { metric, ..Plot::of(PlotKind::Sequence) });
        }
    }
    plots
}

/// The figures of a plot; empty for a table.
pub(crate) fn figures(source: &Source<'_>, plot: &Plot) -> Vec<NamedFigure> {
    let whole = Selection::new(source, plot);
    if plot.kind == PlotKind::Crops {
        return whole.crops(plot);
    }
    let of_part = |metric: Metric, part: &Selection<'_>| -> Vec<NamedFigure> {
        match plot.kind {
            PlotKind::Table
            | PlotKind::Ratios
            | PlotKind::Crops
            | PlotKind::Sweep
            | PlotKind::Optima
            | PlotKind::Budgets => Vec::new(),
            PlotKind::Profile => part.profiles(metric, plot),
            PlotKind::RatioProfile => part.ratio_profiles(metric, plot),
            PlotKind::Sequence => part.sequences(metric),
            PlotKind::Bars => vec![part.bars(metric, plot)],
            PlotKind::Frames => vec![part.frames(metric, plot)],
        }
    };
    let of_metric = |metric: Metric| {
        let parts = whole.parts(metric).into_iter();
        parts.flat_map(move |part| {
            let figures = of_part(metric, &part).into_iter();
            figures.map(|figure| part.labelled(figure)).collect::<Vec<_>>()
        })
    };
    metrics(source, plot).into_iter().flat_map(of_metric).collect()
}

/// The tables of ratios of a plot: one per metric and scene.
pub(crate) fn ratio_tables(source: &Source<'_>, plot: &Plot) -> Vec<(String, ComparisonTable)> {
    let resolved = &source.run.resolved;
    let scenes = resolved.scenes.iter().map(|scene| scene.name.as_str());
    let scenes = named(plot.scenes.as_deref(), scenes);
    let methods = named(plot.methods.as_deref(), resolved.methods.iter().map(String::as_str));
    let metrics = metrics(source, plot);
    let table = |(metric, scene): (Metric, &str)| {
        let own = plot.name.as_deref().map(slug).filter(|name| !name.is_empty());
        let key = slug(metric.key());
        let part = match own {
            None => key,
            Some(own) if metrics.len() == 1 => own,
            Some(own) => format!("{own}-{key}"),
        };
        let alone = scenes.len() == 1;
        let name = format!("ratios-{part}");
        let name = if alone { name } else { format!("{name}-{}", slug(scene)) };
        let ratios = Ratios { metric, scene, methods: &methods, plot };
        Some((name, ComparisonTable::ratios(source.run, source.overview, &ratios)?))
    };
    let each = metrics.iter().flat_map(|metric| scenes.iter().map(move |scene| (*metric, *scene)));
    each.filter_map(table).collect()
}

/// The metrics of a plot: its own metric, or all that were scored and fit the plot. MSE is left out
/// if PSNR is shown, because both express the same.
pub(crate) fn metrics(source: &Source<'_>, plot: &Plot) -> Vec<Metric> {
    let all = source.overview.all();
    let scored = |metric: Metric| all.iter().any(|measured| measured.is_scored(metric));
    let fits = |metric: Metric| match plot.kind {
        PlotKind::Profile => metric.info().per_band,
        // The differences over time of test and reference are far apart, and both are in the profile.
        PlotKind::RatioProfile if plot.named().is_none() => metric.is(MetricKind::Profile),
        PlotKind::Ratios | PlotKind::RatioProfile => !metric.is(MetricKind::Fidelity),
        // The ratio of the test to the reference is in a column of the table.
        PlotKind::Bars | PlotKind::Frames if plot.named().is_none() => {
            metric.is(MetricKind::Fidelity)
        }
        _ => !metric.is(MetricKind::Profile),
    };
    let in_order = source.run.resolved.metrics_in_order();
    let wanted: Vec<Metric> = if let Some(keys) = plot.named() {
        let metric = |key: &str| in_order.iter().find(|metric| metric.key() == key).copied();
        keys.into_iter().filter_map(metric).collect()
    } else {
        let is_shown = |metric: &Metric| *metric != Metric::Mse || !scored(Metric::Psnr);
        in_order.into_iter().filter(is_shown).collect()
    };
    wanted.into_iter().filter(|&metric| scored(metric) && fits(metric)).collect()
}

impl<'a> Selection<'a> {
    fn new(source: &'a Source<'a>, plot: &Plot) -> Self {
        let wanted = |names: &Option<Vec<String>>, name: &str| {
            names.as_ref().is_none_or(|names| names.iter().any(|n| n == name))
        };
        let resolved = &source.run.resolved;
        let scenes = resolved.scenes.iter().map(|scene| scene.name.as_str());
        let methods = resolved.methods.iter().enumerate();
        let methods: Vec<(&str, Look)> = methods
            .filter(|(_, method)| wanted(&plot.methods, method))
            .map(|(index, method)| (method.as_str(), Look::new(index)))
            .collect();
        Self {
            source,
            scenes: scenes.filter(|scene| wanted(&plot.scenes, scene)).collect(),
            all: methods.iter().map(|(method, _)| *method).collect(),
            methods,
            part: None,
        }
    }

    /// The title of a figure that shows one of several scenes.
    fn title(&self, scene: &str) -> Option<String> {
        (self.scenes.len() > 1).then(|| scene.to_owned())
    }

    fn common_scenes(&self, metric: Metric) -> Vec<&'a str> {
        common_scenes(self.source.overview, &self.scenes, &self.all, metric)
    }

    fn bars(&self, metric: Metric, plot: &Plot) -> NamedFigure {
        // FovVideoVDP is a value of the whole sequence, and ATD the ratio of two means.
        let is_mean = metric.is(MetricKind::Fidelity) && metric != Metric::Fvvdp;
        let error_bars = plot.error_bars.filter(|_| is_mean);
        let series = self.methods.iter().map(|&(method, look)| {
            let value = |scene: &&str| self.source.overview.of(scene, method)?.value(metric);
            let values = self.scenes.iter().map(value).collect();
            let error = |scene: &&str, kind| half_length(&self.values(scene, method, metric), kind);
            let errors = error_bars.map_or_else(Vec::new, |kind| {
                self.scenes.iter().map(|scene| error(scene, kind)).collect()
            });
            BarSeries { name: method.to_owned(), look, errors, values, ..BarSeries::default() }
        });
        let mut series: Vec<BarSeries> = series.collect();
        let mut groups: Vec<String> = self.scenes.iter().map(|&scene| scene.to_owned()).collect();
        let common = self.common_scenes(metric);
        if common.len() > 1 {
            groups.push(average_label(common.len(), self.scenes.len()));
            for BarSeries { values, errors, .. } in &mut series {
                let of_common = self.scenes.iter().zip(&*values);
                let of_common = of_common.filter(|(scene, _)| common.contains(scene));
                let of_common: Vec<f64> = of_common.filter_map(|(_, value)| *value).collect();
                values.push(mean(&of_common));
                if let Some(kind) = error_bars {
                    errors.push(half_length(&of_common, kind));
                }
            }
        }
        let y = Axis::new(metric_axis(metric));
        let figure = Figure::Bar(BarChart { y, groups, series, ..BarChart::default() });
        let over = if metric == Metric::Fvvdp { "of whole sequences" } else { "mean over frames" };
        let bars = error_bars.map_or_else(String::new, |kind| {
            format!("; error bars over frames (of the average: over scenes): {}", in_words(kind))
        });
        let caption = format!("{} per scene and method, {over}{bars}", metric.info().label);
        NamedFigure::new(format!("bars-{}", slug(metric.key())), caption, figure)
    }

    /// The values of single frames. If the metric is computed for each image, these are the values
    /// of the test.
    fn values(&self, scene: &str, method: &str, metric: Metric) -> Vec<f64> {
        let image = if metric.is(MetricKind::Fidelity) { Image::Pair } else { Image::Test };
        let values = self.source.values.of(scene, method, (metric, image));
        values.iter().map(|(_, value)| *value).collect()
    }

    /// Test / reference in percent, of each frame.
    fn percent(&self, scene: &str, method: &str, metric: Metric) -> Vec<f64> {
        let of = |image| self.source.values.of(scene, method, (metric, image));
        let reference: BTreeMap<i64, f64> = of(Image::Reference).iter().copied().collect();
        let percent = |(frame, test): &(i64, f64)| {
            let reference = reference.get(frame).filter(|reference| **reference > 0.0)?;
            Some(test / reference * 100.0)
        };
        of(Image::Test).iter().filter_map(percent).collect()
    }

    fn frames(&self, metric: Metric, plot: &Plot) -> NamedFigure {
        let is_percent = metric.is(MetricKind::Temporal);
        let values = |scene: &str, method: &str| {
            if is_percent {
                self.percent(scene, method, metric)
            } else {
                self.values(scene, method, metric)
            }
        };
        let series = self.methods.iter().map(|&(method, look)| SpreadSeries {
            name: method.to_owned(),
            look,
            values: self.scenes.iter().map(|scene| values(scene, method)).collect(),
        });
        let series = series.collect();
        let groups = self.scenes.iter().map(|&scene| scene.to_owned()).collect();
        let y = Axis::new(if is_percent { metric_axis(metric) } else { frame_axis(metric) });
        let figure = Figure::Spread(SpreadChart {
            title: None,
            y,
            groups,
            series,
            violins: plot.shape == SpreadShape::Violin,
        });
        let of = if is_percent { " in percent of the reference's" } else { "" };
        let caption = format!("{}{of} over the frames of each scene", metric.info().label);
        NamedFigure::new(format!("frames-{}", slug(metric.key())), caption, figure)
    }
}

/// What error bars show, in words.
fn in_words(kind: ErrorBars) -> &'static str {
    match kind {
        ErrorBars::StandardError => "standard error",
        ErrorBars::Confidence => "95 % confidence interval",
        ErrorBars::Deviation => "standard deviation",
    }
}

/// The part of a caption about error bars; empty without any.
fn error_bars_in_words(plot: &Plot, over: &str) -> String {
    let words = |kind| format!("; error bars: {} over {over}", in_words(kind));
    plot.error_bars.map_or_else(String::new, words)
}

/// The title of the axis for the value of a metric in tables and bars.
pub(crate) fn metric_axis(metric: Metric) -> String {
    if metric.is(MetricKind::Temporal) {
        return titled(metric, "% of the reference");
    }
    axis(metric)
}

/// The title of a metric's axis, with its unit and the better direction.
fn axis(metric: Metric) -> String {
    titled(metric, metric.info().unit)
}

fn titled(metric: Metric, unit: &str) -> String {
    let info = metric.info();
    let better = match info.better {
        Better::Higher => " (higher is better)",
        Better::Lower => " (lower is better)",
        Better::Neither => "",
    };
    if unit.is_empty() {
        format!("{}{better}", info.label)
    } else {
        format!("{} in {unit}{better}", info.label)
    }
}

/// The title of the axis for values of single frames.
fn frame_axis(metric: Metric) -> String {
    match metric {
        Metric::Fvvdp => "FovVideoVDP of each frame in JOD (higher is better)".to_owned(),
        metric => axis(metric),
    }
}

/// Maximum number of bytes that a name adds to a file name.
const LONGEST_BYTES: usize = 120;

/// Converts a name to a part of a file name.
pub(crate) fn slug(name: &str) -> String {
    let plain = |c: char| if c.is_alphanumeric() { c } else { '-' };
    let slug: String = name.to_lowercase().chars().map(plain).collect();
    let slug = slug.split('-').filter(|word| !word.is_empty()).collect::<Vec<_>>().join("-");
    // Some characters take four bytes, and a file name has at most 255.
    let end = slug.floor_char_boundary(LONGEST_BYTES);
    slug[..end].to_owned()
}
