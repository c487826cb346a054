//! A metric against eccentricity, in each scene and as the mean over scenes.

use fovqa_metrics::{Image, Metric, MetricKind};
use fovqa_plan::{ErrorBars, Plot};
use fovqa_plot::{Axis, Figure, LineChart, LineSeries, Look};
use fovqa_results::EccentricityShare;

use super::compared::Shown;
use super::{MOST_EDGE_TICKS, NamedFigure, Selection, axis, error_bars_in_words, slug};
use crate::band_spread::InBand;
use crate::comparison::mean;
use crate::moments::half_length;

/// The value of a metric in an eccentricity band.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Band {
    /// Inner edge in degrees.
    pub from_deg: f64,
    /// Outer edge in degrees.
    pub to_deg: f64,
    /// The value, if there is one.
    pub value: Option<f64>,
    /// Half the length of its error bar, if it has one.
    pub error: Option<f64>,
}

/// A metric against eccentricity, of series with their looks and bands. `None` if there are no bands.
pub(crate) fn chart<'a>(
    metric: Metric,
    named: impl Iterator<Item = (&'a str, Look, Vec<Band>)>,
) -> Option<LineChart> {
    let mut edges: Vec<f64> = Vec::new();
    let mut series = Vec::new();
    for (name, look, bands) in named {
        if bands.is_empty() {
            continue;
        }
        edges.extend(bands.iter().flat_map(|band| [band.from_deg, band.to_deg]));
        let points =
            bands.iter().map(|band| (f64::midpoint(band.from_deg, band.to_deg), band.value));
        let points = points.collect();
        let errors = bands.iter().map(|band| band.error);
        let errors = errors.collect::<Vec<_>>();
        let errors = if errors.iter().any(Option::is_some) { errors } else { Vec::new() };
        series.push(LineSeries {
            name: name.to_owned(),
            look,
            points,
            errors,
            ..LineSeries::default()
        });
    }
    if series.is_empty() {
        return None;
    }
    edges.sort_by(f64::total_cmp);
    edges.dedup_by(|a, b| a.to_bits() == b.to_bits());
    Some(LineChart {
        x: Axis::new("Eccentricity (°)"),
        y: Axis::new(match metric {
            Metric::Fvvdp => "Share of FovVideoVDP's Q".to_owned(),
            metric => axis(metric),
        }),
        y_from_zero: metric == Metric::Fvvdp,
        series,
        x_ticks: Some(edges).filter(|edges| edges.len() <= MOST_EDGE_TICKS),
        ..LineChart::default()
    })
}

impl Band {
    fn is_like(&self, other: &Self) -> bool {
        let edges = |band: &Self| [band.from_deg, band.to_deg].map(f64::to_bits);
        edges(self) == edges(other)
    }
}

impl Selection<'_> {
    /// The profile of each scene. For a fidelity metric in several scenes, the profile of their
    /// mean follows.
    pub(super) fn profiles(&self, metric: Metric, plot: &Plot) -> Vec<NamedFigure> {
        if !metric.is(MetricKind::Fidelity) {
            let scenes = self.scenes.iter();
            let plot = (plot, Shown::Values);
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
            let bands = |method: &str| self.mean_bands(metric, &common, method, plot.error_bars);
            let which =
                if common.len() == self.scenes.len() { "" } else { " that all methods have" };
            let count = common.len();
            let bars = error_bars_in_words(plot, "scenes");
            let caption =
                format!("{label} against eccentricity, mean over {count} scenes{which}{bars}");
            figures.extend(self.profile(metric, name.clone(), None, caption, bands));
        }
        for scene in &self.scenes {
            let bands = |method: &str| self.with_errors(metric, scene, method, plot.error_bars);
            let alone = self.scenes.len() == 1;
            let name = if alone { name.clone() } else { format!("{name}-{}", slug(scene)) };
            // The shares of FovVideoVDP are those of the whole sequence.
            let bars = match metric {
                Metric::Fvvdp => String::new(),
                _ => error_bars_in_words(plot, "frames"),
            };
            let caption = format!("{label} against eccentricity, {scene}{bars}");
            figures.extend(self.profile(metric, name, Some(scene), caption, bands));
        }
        figures
    }

    /// Test / reference against eccentricity, of each scene.
    pub(super) fn ratio_profiles(&self, metric: Metric, plot: &Plot) -> Vec<NamedFigure> {
        let plot = (plot, Shown::Ratio);
        self.scenes.iter().filter_map(|scene| self.compared(metric, scene, plot)).collect()
    }

    fn profile(
        &self,
        metric: Metric,
        name: String,
        title: Option<&str>,
        caption: String,
        bands: impl Fn(&str) -> Vec<Band>,
    ) -> Option<NamedFigure> {
        let series = self.methods.iter().map(|&(method, look)| (method, look, bands(method)));
        let chart = chart(metric, series)?;
        let chart = LineChart { title: title.map(str::to_owned), ..chart };
        Some(NamedFigure::new(name, caption, Figure::Line(chart)))
    }

    fn bands(&self, metric: Metric, scene: &str, method: &str) -> Vec<Band> {
        let Some(measured) = self.source.overview.of(scene, method) else { return Vec::new() };
        if metric == Metric::Fvvdp {
            let band = |share: &EccentricityShare| Band {
                from_deg: share.from_deg,
                to_deg: share.to_deg,
                value: share.share,
                error: None,
            };
            return measured.shares.iter().map(band).collect();
        }
        let band = |band: &crate::overview::Band| Band {
            from_deg: band.from_deg,
            to_deg: band.to_deg,
            value: band.mean(metric),
            error: None,
        };
        measured.bands.iter().map(band).collect()
    }

    /// The bands with their error bars over the frames, if they are wanted.
    fn with_errors(
        &self,
        metric: Metric,
        scene: &str,
        method: &str,
        kind: Option<ErrorBars>,
    ) -> Vec<Band> {
        let mut bands = self.bands(metric, scene, method);
        let Some(kind) = kind else { return bands };
        for band in &mut bands {
            let (from_deg, to_deg) = (band.from_deg, band.to_deg);
            let image = Image::Pair;
            let place = InBand { metric, image, level: None, statistic: None, from_deg, to_deg };
            band.error = self.source.spread.half_length((scene, method), place, kind);
        }
        bands
    }

    /// The mean over scenes of the bands that all scenes have, with error bars over the scenes.
    fn mean_bands(
        &self,
        metric: Metric,
        scenes: &[&str],
        method: &str,
        kind: Option<ErrorBars>,
    ) -> Vec<Band> {
        let scenes: Vec<Vec<Band>> =
            scenes.iter().map(|scene| self.bands(metric, scene, method)).collect();
        let Some((first, others)) = scenes.split_first() else { return Vec::new() };
        let bands = first.iter().filter_map(|band| {
            let mut values = vec![band.value?];
            for other in others {
                values.push(other.iter().find(|other| other.is_like(band))?.value?);
            }
            let error = kind.and_then(|kind| half_length(&values, kind));
            Some(Band { value: mean(&values), error, ..*band })
        });
        bands.collect()
    }
}
