//! Measures of each image against eccentricity: one line per method, with a dashed line for the
//! reference. The wavelet has one panel per level (Patney et al. 2016, Figs. 4 and 10).

use fovqa_metrics::Metric;
use fovqa_plan::Plot;
use fovqa_plot::{Axis, Figure, LineChart, LineSeries, Look, PanelChart};

use super::{MOST_EDGE_TICKS, NamedFigure, Selection, axis, slug};
use crate::comparison::{statistic, statistic_in_words};
use crate::overview::Measured;

/// Number of panels side by side.
const COLUMNS: usize = 3;

/// Values of the reference and the test in a band.
#[derive(Debug, Clone, Copy)]
struct Values {
    from_deg: f64,
    to_deg: f64,
    reference: Option<f64>,
    test: Option<f64>,
}

impl Selection<'_> {
    /// The profile of a scene; `None` if it was not scored.
    pub(super) fn compared(&self, metric: Metric, scene: &str, plot: &Plot) -> Option<NamedFigure> {
        let name = format!("profile-{}", slug(metric.key()));
        let name = if self.scenes.len() == 1 { name } else { format!("{name}-{}", slug(scene)) };
        let (figure, what) = match metric {
            Metric::Haar => {
                let words = statistic_in_words(statistic(plot));
                (self.wavelet(scene, plot)?, format!("Haar wavelet {words} by level"))
            }
            metric => {
                let values = |c: &Measured| banded(c, metric);
                let chart = self.chart(scene, Axis::new(axis(metric)), values)?;
                // Contrasts differ only slightly, so their distance matters, not their height above
                // zero.
                let y_from_zero = metric != Metric::RmsContrast;
                let chart = LineChart { title: self.title(scene), y_from_zero, ..chart };
                (Figure::Line(chart), metric.info().label.to_owned())
            }
        };
        let caption = format!("{what} against eccentricity, {scene}; the reference is dashed");
        Some(NamedFigure::new(name, caption, figure))
    }

    fn wavelet(&self, scene: &str, plot: &Plot) -> Option<Figure> {
        let of = |(method, _): &(&str, Look)| self.source.overview.of(scene, method);
        let bands = self.methods.iter().filter_map(of).flat_map(|measured| &measured.wavelet);
        let mut levels: Vec<usize> = bands.map(|band| band.level.into()).collect();
        levels.sort_unstable();
        levels.dedup();
        levels.retain(|level| plot.levels.as_ref().is_none_or(|wanted| wanted.contains(level)));
        let statistic = statistic(plot);
        let panel = |level: &usize| {
            let y = Axis::new(format!("Wavelet {}", statistic_in_words(statistic)));
            let values = |c: &Measured| levelled(c, *level, statistic);
            let chart = self.chart(scene, y, values)?;
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
            Some(LineChart { title, x_ticks, ..chart })
        };
        let panels: Vec<LineChart> = levels.iter().filter_map(panel).collect();
        (!panels.is_empty()).then_some(Figure::Panels(PanelChart {
            title: self.title(scene),
            panels,
            columns: COLUMNS,
        }))
    }

    fn chart(
        &self,
        scene: &str,
        y: Axis,
        values: impl Fn(&Measured) -> Vec<Values>,
    ) -> Option<LineChart> {
        let mut edges: Vec<f64> = Vec::new();
        let mut reference: Option<LineSeries> = None;
        let mut series = Vec::new();
        for &(method, look) in &self.methods {
            let Some(comparison) = self.source.overview.of(scene, method) else { continue };
            let bands = values(comparison);
            if bands.is_empty() {
                continue;
            }
            edges.extend(bands.iter().flat_map(|band| [band.from_deg, band.to_deg]));
            let points = |of: fn(&Values) -> Option<f64>| {
                let centre = |band: &Values| f64::midpoint(band.from_deg, band.to_deg);
                bands.iter().map(|band| (centre(band), of(band))).collect()
            };
            let name = method.to_owned();
            let test =
                LineSeries { name, look, points: points(|b| b.test), ..LineSeries::default() };
            series.push(test);
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
}

fn banded(measured: &Measured, metric: Metric) -> Vec<Values> {
    let bands = measured.bands.iter().filter_map(|band| {
        let compared = band.compared(metric)?;
        Some(Values {
            from_deg: band.from_deg,
            to_deg: band.to_deg,
            reference: compared.reference(),
            test: compared.test(),
        })
    });
    bands.collect()
}

fn levelled(measured: &Measured, level: usize, statistic: &str) -> Vec<Values> {
    let bands = measured.wavelet.iter().filter(|band| usize::from(band.level) == level);
    let values = bands.map(|band| {
        let compared = band.statistic(statistic);
        Values {
            from_deg: band.from_deg,
            to_deg: band.to_deg,
            reference: compared.reference(),
            test: compared.test(),
        }
    });
    values.collect()
}
