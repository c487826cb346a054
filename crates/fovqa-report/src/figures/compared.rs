//! Measures of each image against eccentricity: one line per method, with a dashed line for the
//! reference. The wavelet has one panel per level (Patney et al. 2016, Figs. 4 and 10). Where the
//! curves lie on each other, their ratio to the reference tells them apart.

use fovqa_metrics::{Image, Metric};
use fovqa_plan::{ErrorBars, Plot};
use fovqa_plot::{Axis, Figure, LineChart, LineSeries, Look, PanelChart};

use super::{MOST_EDGE_TICKS, NamedFigure, Selection, axis, error_bars_in_words, slug};
use crate::band_spread::InBand;
use crate::comparison::{DEFAULT_STATISTIC, statistic, statistic_in_words};
use crate::overview::{Compared, Measured};

/// Number of panels side by side.
pub(super) const COLUMNS: usize = 3;

/// Values of the reference and the test in a band.
#[derive(Debug, Clone, Copy)]
struct Values {
    from_deg: f64,
    to_deg: f64,
    reference: Option<f64>,
    test: Option<f64>,
    /// Half the length of the test's error bar.
    error: Option<f64>,
}

/// Whether a figure shows the values of test and reference, or their ratio.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Shown {
    Values,
    Ratio,
}

/// What a chart shows of a band.
#[derive(Debug, Clone, Copy)]
struct Content<'a> {
    shown: Shown,
    metric: Metric,
    /// Level of the wavelet, from 1.
    level: Option<usize>,
    /// Statistic of the wavelet.
    statistic: Option<&'a str>,
    error_bars: Option<ErrorBars>,
}

impl Selection<'_> {
    /// The profile of a scene; `None` if it was not scored.
    pub(super) fn compared(
        &self,
        metric: Metric,
        scene: &str,
        (plot, shown): (&Plot, Shown),
    ) -> Option<NamedFigure> {
        let kind = match shown {
            Shown::Values => "profile",
            Shown::Ratio => "ratio-profile",
        };
        let name = format!("{kind}-{}", slug(metric.key()));
        let name = if self.scenes.len() == 1 { name } else { format!("{name}-{}", slug(scene)) };
        let (figure, what) = match metric {
            Metric::Haar => {
                let words = statistic_in_words(statistic(plot));
                (self.wavelet(scene, plot, shown)?, format!("Haar wavelet {words} by level"))
            }
            Metric::Spectrum => (self.spectrum(scene, shown)?, "Power spectrum by band".to_owned()),
            metric => {
                let error_bars = error_bars(plot);
                let content = Content { shown, metric, level: None, statistic: None, error_bars };
                let chart =
                    self.chart(scene, titled(axis(metric), metric.info().label, shown), content)?;
                // Contrasts differ only slightly, so their distance matters, not their height above
                // zero.
                let y_from_zero = metric != Metric::RmsContrast && shown == Shown::Values;
                let chart = LineChart { title: self.title(scene), y_from_zero, ..chart };
                (Figure::Line(chart), metric.info().label.to_owned())
            }
        };
        let against = match metric {
            Metric::Spectrum => "spatial frequency",
            _ => "eccentricity",
        };
        let bars =
            error_bars(plot).map_or_else(String::new, |_| error_bars_in_words(plot, "frames"));
        let caption = match shown {
            Shown::Values => {
                format!("{what} against {against}, {scene}; the reference is dashed{bars}")
            }
            Shown::Ratio => {
                format!("{what} of the test over that of the reference against {against}, {scene}")
            }
        };
        Some(NamedFigure::new(name, caption, figure))
    }

    fn wavelet(&self, scene: &str, plot: &Plot, shown: Shown) -> Option<Figure> {
        let of = |(method, _): &(&str, Look)| self.source.overview.of(scene, method);
        let bands = self.methods.iter().filter_map(of).flat_map(|measured| &measured.wavelet);
        let mut levels: Vec<usize> = bands.map(|band| band.level.into()).collect();
        levels.sort_unstable();
        levels.dedup();
        levels.retain(|level| plot.levels.as_ref().is_none_or(|wanted| wanted.contains(level)));
        let statistic = statistic(plot);
        let panel = |level: &usize| {
            let label = format!("Wavelet {}", statistic_in_words(statistic));
            let content = Content {
                shown,
                metric: Metric::Haar,
                level: Some(*level),
                statistic: Some(statistic),
                error_bars: error_bars(plot),
            };
            let chart = self.chart(scene, titled(label.clone(), &label, shown), content)?;
            let side = 1u64 << level;
            let title = Some(format!("Level {level} ({side}×{side} px)"));
            // The panel is half as wide as a single chart, so with many band edges only every other
            // edge is labelled.
            let every =
                |ticks: &Vec<f64>| if ticks.len() > MOST_EDGE_TICKS / 2 + 1 { 2 } else { 1 };
            let x_ticks = chart.x_ticks.map(|ticks| {
                let every = every(&ticks);
                ticks.into_iter().step_by(every).collect()
            });
            Some(LineChart { title, x_ticks, y_from_zero: shown == Shown::Values, ..chart })
        };
        let panels: Vec<LineChart> = levels.iter().filter_map(panel).collect();
        (!panels.is_empty()).then_some(Figure::Panels(PanelChart {
            title: self.title(scene),
            panels,
            columns: COLUMNS,
        }))
    }

    fn chart(&self, scene: &str, y: Axis, content: Content<'_>) -> Option<LineChart> {
        let mut edges: Vec<f64> = Vec::new();
        let mut reference: Option<LineSeries> = None;
        let mut series = Vec::new();
        for &(method, look) in &self.methods {
            let Some(comparison) = self.source.overview.of(scene, method) else { continue };
            let bands = self.values_of((scene, method), comparison, content);
            if bands.is_empty() {
                continue;
            }
            edges.extend(bands.iter().flat_map(|band| [band.from_deg, band.to_deg]));
            let points = |of: fn(&Values) -> Option<f64>| {
                let centre = |band: &Values| f64::midpoint(band.from_deg, band.to_deg);
                bands.iter().map(|band| (centre(band), of(band))).collect()
            };
            let name = method.to_owned();
            let errors: Vec<Option<f64>> = bands.iter().map(|band| band.error).collect();
            let errors = if errors.iter().any(Option::is_some) { errors } else { Vec::new() };
            let points_of_test = points(|band| band.test);
            series.push(LineSeries {
                name,
                look,
                points: points_of_test,
                errors,
                ..LineSeries::default()
            });
            reference.get_or_insert_with(|| LineSeries {
                name: "reference".to_owned(),
                reference: true,
                points: points(|band| band.reference),
                ..LineSeries::default()
            });
        }
        // The reference is drawn last, because the other lines might hide it.
        series.push(reference?);
        edges.sort_by(f64::total_cmp);
        edges.dedup_by(|a, b| a.to_bits() == b.to_bits());
        Some(LineChart {
            title: None,
            x: Axis::new("Eccentricity (°)"),
            y,
            series,
            x_ticks: Some(edges).filter(|edges| edges.len() <= MOST_EDGE_TICKS),
            y_from_zero: true,
            ..LineChart::default()
        })
    }

    fn values_of(
        &self,
        of: (&str, &str),
        measured: &Measured,
        content: Content<'_>,
    ) -> Vec<Values> {
        let Content { shown, metric, level, statistic, error_bars } = content;
        let values = |(from_deg, to_deg): (f64, f64), compared: &Compared| {
            let (reference, test) = match shown {
                Shown::Values => (compared.reference(), compared.test()),
                Shown::Ratio => (Some(1.0), compared.ratio()),
            };
            let image = Image::Test;
            let level = level.map(|level| level as i64);
            let place = InBand { metric, image, level, statistic, from_deg, to_deg };
            let error = error_bars.and_then(|kind| self.source.spread.half_length(of, place, kind));
            Values { from_deg, to_deg, reference, test, error }
        };
        if let Some(level) = level {
            let bands = measured.wavelet.iter().filter(|band| usize::from(band.level) == level);
            let statistic = statistic.unwrap_or(DEFAULT_STATISTIC);
            return bands
                .map(|band| values((band.from_deg, band.to_deg), band.statistic(statistic)))
                .collect();
        }
        let bands = measured.bands.iter();
        bands
            .filter_map(|band| Some(values((band.from_deg, band.to_deg), band.compared(metric)?)))
            .collect()
    }
}

/// The vertical axis of values, or of their ratio.
fn titled(values: String, label: &str, shown: Shown) -> Axis {
    match shown {
        Shown::Values => Axis::new(values),
        Shown::Ratio => Axis::new(format!("{label} (test / reference)")),
    }
}

/// The error bars of a plot. The largest coefficient is not a mean, so it has none.
fn error_bars(plot: &Plot) -> Option<ErrorBars> {
    plot.error_bars.filter(|_| statistic(plot) != "max_abs")
}
