//! Which figures a run has, and what is in them: values against eccentricity, per scene and
//! method, and over frames. A method has one colour and marker in all of them.

use fovqa_config::{Plot, PlotKind};
use fovqa_metrics::{Better, Metric};
use fovqa_plot::{
    Axis, BarChart, BarSeries, Figure, LineChart, LineSeries, Look, SpreadChart, SpreadSeries,
};
use fovqa_results::{BandStatistics, ComparisonSummary, RunRecord, SummaryRecord};

use crate::comparison::{mean, overall};
use crate::frame_values::FrameValues;

/// A figure with its name and what it says.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct NamedFigure {
    /// File name without folder and ending.
    pub(crate) name: String,
    pub(crate) caption: String,
    pub(crate) figure: Figure,
}

/// More edges than this do not fit the axis as ticks.
const MOST_EDGE_TICKS: usize = 13;

/// What figures are made from.
pub(crate) struct Source<'a> {
    pub(crate) run: &'a RunRecord,
    pub(crate) summary: &'a SummaryRecord,
    pub(crate) values: &'a FrameValues,
}

/// A plot's own scenes, methods and metric.
struct Selection<'a> {
    source: &'a Source<'a>,
    scenes: Vec<&'a str>,
    /// Name and look.
    methods: Vec<(&'a str, Look)>,
}

/// The plots of a run that asks for none: all that have something to show.
pub(crate) fn default_plots(source: &Source<'_>) -> Vec<Plot> {
    let summary = source.summary;
    let plot = |kind| Plot { kind, metric: None, scenes: None, methods: None };
    let mut kinds = vec![PlotKind::Table, PlotKind::Profile];
    let eyes = |c: &&ComparisonSummary| c.eye.is_empty() || c.eye == "both";
    if summary.comparisons.iter().filter(eyes).count() > 1 {
        kinds.push(PlotKind::Bars);
    }
    if summary.comparisons.iter().any(|comparison| comparison.frames > 1) {
        kinds.push(PlotKind::Frames);
    }
    kinds.into_iter().map(plot).collect()
}

/// The figures of a plot; none for a table.
pub(crate) fn figures(source: &Source<'_>, plot: &Plot) -> Vec<NamedFigure> {
    let wanted = |names: &Option<Vec<String>>, name: &str| {
        names.as_ref().is_none_or(|names| names.iter().any(|n| n == name))
    };
    let resolved = &source.run.resolved;
    let scenes = resolved.scenes.iter().map(|scene| scene.name.as_str());
    let methods = resolved.methods.iter().enumerate();
    let selection = Selection {
        source,
        scenes: scenes.filter(|scene| wanted(&plot.scenes, scene)).collect(),
        methods: methods
            .filter(|(_, method)| wanted(&plot.methods, method))
            .map(|(index, method)| (method.as_str(), Look::new(index)))
            .collect(),
    };
    let metrics = metrics(source, plot);
    match plot.kind {
        PlotKind::Table => Vec::new(),
        PlotKind::Profile => {
            metrics.into_iter().flat_map(|metric| selection.profiles(metric)).collect()
        }
        PlotKind::Bars => metrics.into_iter().map(|metric| selection.bars(metric)).collect(),
        PlotKind::Frames => metrics.into_iter().map(|metric| selection.frames(metric)).collect(),
    }
}

/// The metrics of a plot: its own, or all that were scored and fit, without MSE where PSNR says
/// the same.
fn metrics(source: &Source<'_>, plot: &Plot) -> Vec<Metric> {
    let scored =
        |metric: Metric| source.summary.comparisons.iter().any(|c| c.metrics.contains_key(&metric));
    let fits = |metric: Metric| plot.kind != PlotKind::Profile || metric.info().per_band;
    let wanted = |metric: Metric| match &plot.metric {
        Some(key) => key == metric.key(),
        None => metric != Metric::Mse || !scored(Metric::Psnr),
    };
    let all = Metric::ALL.into_iter();
    all.filter(|&metric| scored(metric) && fits(metric) && wanted(metric)).collect()
}

impl Selection<'_> {
    /// The profile of each scene and, where there are several, of their mean.
    fn profiles(&self, metric: Metric) -> Vec<NamedFigure> {
        let name = format!("profile-{}", slug(metric.key()));
        let label = metric.info().label;
        let mut figures: Vec<NamedFigure> = Vec::new();
        let common = self.common_scenes(metric);
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
            y: Axis::new(axis(metric)),
            series,
            x_ticks: Some(edges).filter(|edges| edges.len() <= MOST_EDGE_TICKS),
            ..LineChart::default()
        });
        Some(NamedFigure { name, caption, figure })
    }

    fn bands(&self, metric: Metric, scene: &str, method: &str) -> Vec<Band> {
        let bands = overall(self.source.summary, scene, method).map(|c| c.bands.as_slice());
        let bands = bands.unwrap_or_default().iter();
        bands
            .map(|band: &BandStatistics| Band {
                from_deg: band.from_deg,
                to_deg: band.to_deg,
                value: band.metrics.get(&metric).copied().flatten().map(|s| s.mean),
            })
            .collect()
    }

    /// The scenes in which every method has bands: means over others could not be compared.
    fn common_scenes(&self, metric: Metric) -> Vec<&str> {
        let has = |scene: &&str| {
            self.methods.iter().all(|(method, _)| !self.bands(metric, scene, method).is_empty())
        };
        self.scenes.iter().copied().filter(has).collect()
    }

    /// The mean over scenes, of the bands that all of them have.
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
            let value = |scene: &&str| {
                Some(overall(self.source.summary, scene, method)?.metrics.get(&metric)?.mean)
            };
            let values = self.scenes.iter().map(value).collect();
            BarSeries { name: method.to_owned(), look, values }
        });
        let mut series: Vec<BarSeries> = series.collect();
        let mut groups: Vec<String> = self.scenes.iter().map(|&scene| scene.to_owned()).collect();
        // Averages are of the same scenes for all methods, or not there.
        let whole = series.iter().all(|series| series.values.iter().all(Option::is_some));
        if groups.len() > 1 && whole {
            groups.push("Average".to_owned());
            for BarSeries { values, .. } in &mut series {
                let all: Vec<f64> = values.iter().copied().flatten().collect();
                values.push(mean(&all));
            }
        }
        let y = Axis::new(axis(metric));
        let figure = Figure::Bar(BarChart { y, groups, series, ..BarChart::default() });
        let caption = format!("{} per scene and method, mean over frames", metric.info().label);
        NamedFigure { name: format!("bars-{}", slug(metric.key())), caption, figure }
    }

    fn frames(&self, metric: Metric) -> NamedFigure {
        let series = self.methods.iter().map(|&(method, look)| SpreadSeries {
            name: method.to_owned(),
            look,
            values: self
                .scenes
                .iter()
                .map(|scene| self.source.values.of(scene, method, metric))
                .collect(),
        });
        let series = series.collect();
        let groups = self.scenes.iter().map(|&scene| scene.to_owned()).collect();
        let y = Axis::new(axis(metric));
        let figure = Figure::Spread(SpreadChart { title: None, y, groups, series });
        let caption = format!("{} over the frames of each scene", metric.info().label);
        NamedFigure { name: format!("frames-{}", slug(metric.key())), caption, figure }
    }
}

/// A value of a band.
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

/// The title of a metric's axis: with its unit, and which way is better.
fn axis(metric: Metric) -> String {
    let info = metric.info();
    let better = match info.better {
        Better::Higher => "higher is better",
        Better::Lower => "lower is better",
        Better::Neither => "",
    };
    if info.unit.is_empty() {
        format!("{} ({better})", info.label)
    } else {
        format!("{} in {} ({better})", info.label, info.unit)
    }
}

/// What a name may add to a file name.
const LONGEST_BYTES: usize = 120;

/// A name as part of a file name.
pub(crate) fn slug(name: &str) -> String {
    let plain = |c: char| if c.is_alphanumeric() { c } else { '-' };
    let slug: String = name.to_lowercase().chars().map(plain).collect();
    let slug = slug.split('-').filter(|word| !word.is_empty()).collect::<Vec<_>>().join("-");
    // Some characters take four bytes, and a file name has 255.
    let end = slug.floor_char_boundary(LONGEST_BYTES);
    slug[..end].to_owned()
}
