//! Selects the figures of a run and their contents: values against eccentricity, per scene and
//! method, and over frames. A method has the same colour and marker in all of them.

mod compared;
mod parts;
mod sequence;

use fovqa_metrics::{Better, Image, Metric, MetricKind};
use fovqa_plan::{Plot, PlotKind};
use fovqa_plot::{
    Axis, BarChart, BarSeries, Figure, LineChart, LineSeries, Look, SpreadChart, SpreadSeries,
};
use fovqa_results::{EccentricityShare, RunRecord};

use parts::Part;

use crate::comparison::{ComparisonTable, Ratios, average_label, common_scenes, mean, named};
use crate::frame_values::FrameValues;
use crate::overview::Overview;
use crate::sheet::NamedFigure;

/// Maximum number of band edges that fit on the axis as ticks.
const MOST_EDGE_TICKS: usize = 13;

/// The data that figures are made from.
pub(crate) struct Source<'a> {
    pub(crate) run: &'a RunRecord,
    pub(crate) overview: &'a Overview,
    pub(crate) values: &'a FrameValues,
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

/// The plots of a run that requests none: all plots that have something to show.
pub(crate) fn default_plots(source: &Source<'_>) -> Vec<Plot> {
    let all = source.overview.all();
    let mut kinds = vec![PlotKind::Table, PlotKind::Ratios, PlotKind::Profile];
    if all.iter().filter(|measured| !measured.is_of_one_eye).count() > 1 {
        kinds.push(PlotKind::Bars);
    }
    if all.iter().any(|measured| measured.frames > 1) {
        kinds.push(PlotKind::Frames);
    }
    let mut plots: Vec<Plot> = kinds.into_iter().map(Plot::of).collect();
    if all.iter().any(|of| of.atd.as_ref().is_some_and(|atd| atd.frames > 1)) {
        let metric = Some(Metric::Atd.key().to_owned());
        plots.push(Plot { metric, ..Plot::of(PlotKind::Sequence) });
    }
    plots
}

/// The figures of a plot; empty for a table.
pub(crate) fn figures(source: &Source<'_>, plot: &Plot) -> Vec<NamedFigure> {
    let whole = Selection::new(source, plot);
    let of_part = |metric: Metric, part: &Selection<'_>| -> Vec<NamedFigure> {
        match plot.kind {
            PlotKind::Table | PlotKind::Ratios => Vec::new(),
            PlotKind::Profile => part.profiles(metric, plot),
            PlotKind::Sequence => part.sequences(metric),
            PlotKind::Bars => vec![part.bars(metric)],
            PlotKind::Frames => vec![part.frames(metric)],
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
        PlotKind::Ratios => !metric.is(MetricKind::Fidelity),
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

    /// The profile of each scene. For a fidelity metric in several scenes, the profile of their
    /// mean follows.
    fn profiles(&self, metric: Metric, plot: &Plot) -> Vec<NamedFigure> {
        if !metric.is(MetricKind::Fidelity) {
            let scenes = self.scenes.iter();
            return scenes.filter_map(|scene| self.compared(metric, scene, plot)).collect();
        }
        let name = format!("profile-{}", slug(metric.key()));
        let label = match metric {
            Metric::Fvvdp => "Share of FovVideoVDP's visible difference",
            metric => metric.info().label,
        };
        let mut figures: Vec<NamedFigure> = Vec::new();
        let mut common = self.common_scenes(metric);
        // A scene without a view has values, but no bands.
        common.retain(|scene| {
            self.methods.iter().any(|(method, _)| !self.bands(metric, scene, method).is_empty())
        });
        if common.len() > 1 {
            let bands = |method: &str| self.mean_bands(metric, &common, method);
            let which =
                if common.len() == self.scenes.len() { "" } else { " that all methods have" };
            let count = common.len();
            let caption = format!("{label} against eccentricity, mean over {count} scenes{which}");
            figures.extend(self.profile(metric, name.clone(), None, caption, bands));
        }
        for scene in &self.scenes {
            let bands = |method: &str| self.bands(metric, scene, method);
            let alone = self.scenes.len() == 1;
            let name = if alone { name.clone() } else { format!("{name}-{}", slug(scene)) };
            let caption = format!("{label} against eccentricity, {scene}");
            figures.extend(self.profile(metric, name, Some(scene), caption, bands));
        }
        figures
    }

    fn profile(
        &self,
        metric: Metric,
        name: String,
        title: Option<&str>,
        caption: String,
        bands: impl Fn(&str) -> Vec<Band>,
    ) -> Option<NamedFigure> {
        let mut edges: Vec<f64> = Vec::new();
        let mut series = Vec::new();
        for &(method, look) in &self.methods {
            let bands = bands(method);
            if bands.is_empty() {
                continue;
            }
            edges.extend(bands.iter().flat_map(|band| [band.from_deg, band.to_deg]));
            let points =
                bands.iter().map(|band| (f64::midpoint(band.from_deg, band.to_deg), band.value));
            let points = points.collect();
            series.push(LineSeries {
                name: method.to_owned(),
                look,
                points,
                ..LineSeries::default()
            });
        }
        if series.is_empty() {
            return None;
        }
        edges.sort_by(f64::total_cmp);
        edges.dedup_by(|a, b| a.to_bits() == b.to_bits());
        let figure = Figure::Line(LineChart {
            title: title.map(str::to_owned),
            x: Axis::new("Eccentricity (°)"),
            y: Axis::new(match metric {
                Metric::Fvvdp => "Share of FovVideoVDP's Q".to_owned(),
                metric => axis(metric),
            }),
            y_from_zero: metric == Metric::Fvvdp,
            series,
            x_ticks: Some(edges).filter(|edges| edges.len() <= MOST_EDGE_TICKS),
            ..LineChart::default()
        });
        Some(NamedFigure { name, caption, figure })
    }

    fn bands(&self, metric: Metric, scene: &str, method: &str) -> Vec<Band> {
        let Some(measured) = self.source.overview.of(scene, method) else { return Vec::new() };
        if metric == Metric::Fvvdp {
            let band = |share: &EccentricityShare| Band {
                from_deg: share.from_deg,
                to_deg: share.to_deg,
                value: share.share,
            };
            return measured.shares.iter().map(band).collect();
        }
        let band = |band: &crate::overview::Band| Band {
            from_deg: band.from_deg,
            to_deg: band.to_deg,
            value: band.mean(metric),
        };
        measured.bands.iter().map(band).collect()
    }

    fn common_scenes(&self, metric: Metric) -> Vec<&'a str> {
        common_scenes(self.source.overview, &self.scenes, &self.all, metric)
    }

    /// The mean over scenes of the bands that all scenes have.
    fn mean_bands(&self, metric: Metric, scenes: &[&str], method: &str) -> Vec<Band> {
        let scenes: Vec<Vec<Band>> =
            scenes.iter().map(|scene| self.bands(metric, scene, method)).collect();
        let Some((first, others)) = scenes.split_first() else { return Vec::new() };
        let bands = first.iter().filter_map(|band| {
            let mut values = vec![band.value?];
            for other in others {
                values.push(other.iter().find(|other| other.is_like(band))?.value?);
            }
            Some(Band { value: mean(&values), ..*band })
        });
        bands.collect()
    }

    fn bars(&self, metric: Metric) -> NamedFigure {
        let series = self.methods.iter().map(|&(method, look)| {
            let value = |scene: &&str| self.source.overview.of(scene, method)?.value(metric);
            let values = self.scenes.iter().map(value).collect();
            BarSeries { name: method.to_owned(), look, values }
        });
        let mut series: Vec<BarSeries> = series.collect();
        let mut groups: Vec<String> = self.scenes.iter().map(|&scene| scene.to_owned()).collect();
        let common = self.common_scenes(metric);
        if common.len() > 1 {
            groups.push(average_label(common.len(), self.scenes.len()));
            for BarSeries { values, .. } in &mut series {
                let of_common = self.scenes.iter().zip(&*values);
                let of_common = of_common.filter(|(scene, _)| common.contains(scene));
                let of_common: Vec<f64> = of_common.filter_map(|(_, value)| *value).collect();
                values.push(mean(&of_common));
            }
        }
        let y = match metric {
            Metric::Atd => Axis::new("ATD in % of the reference (lower is better)"),
            metric => Axis::new(axis(metric)),
        };
        let figure = Figure::Bar(BarChart { y, groups, series, ..BarChart::default() });
        let over = if metric == Metric::Fvvdp { "of whole sequences" } else { "mean over frames" };
        let caption = format!("{} per scene and method, {over}", metric.info().label);
        NamedFigure { name: format!("bars-{}", slug(metric.key())), caption, figure }
    }

    /// The values of single frames. If the metric is computed for each image, these are the values
    /// of the test.
    fn values(&self, scene: &str, method: &str, metric: Metric) -> Vec<f64> {
        let image = if metric.is(MetricKind::Fidelity) { Image::Pair } else { Image::Test };
        let values = self.source.values.of(scene, method, (metric, image));
        values.iter().map(|(_, value)| *value).collect()
    }

    fn frames(&self, metric: Metric) -> NamedFigure {
        let series = self.methods.iter().map(|&(method, look)| SpreadSeries {
            name: method.to_owned(),
            look,
            values: self.scenes.iter().map(|scene| self.values(scene, method, metric)).collect(),
        });
        let series = series.collect();
        let groups = self.scenes.iter().map(|&scene| scene.to_owned()).collect();
        let y = Axis::new(frame_axis(metric));
        let figure = Figure::Spread(SpreadChart { title: None, y, groups, series });
        let caption = format!("{} over the frames of each scene", metric.info().label);
        NamedFigure { name: format!("frames-{}", slug(metric.key())), caption, figure }
    }
}

/// The value of a metric in a band.
#[derive(Debug, Clone, Copy)]
struct Band {
    from_deg: f64,
    to_deg: f64,
    value: Option<f64>,
}

impl Band {
    fn is_like(&self, other: &Self) -> bool {
        let edges = |band: &Self| [band.from_deg, band.to_deg].map(f64::to_bits);
        edges(self) == edges(other)
    }
}

/// The title of a metric's axis, with its unit and the better direction.
fn axis(metric: Metric) -> String {
    let info = metric.info();
    let better = match info.better {
        Better::Higher => " (higher is better)",
        Better::Lower => " (lower is better)",
        Better::Neither => "",
    };
    if info.unit.is_empty() {
        format!("{}{better}", info.label)
    } else {
        format!("{} in {}{better}", info.label, info.unit)
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
