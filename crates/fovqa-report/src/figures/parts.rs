//! Plots with more methods than one figure can show. Some dozens of methods are split over several
//! figures. If there are very many, each figure shows a selection. The title and the caption state
//! what is shown.

use fovqa_metrics::{Better, Metric};
use fovqa_plot::{Figure, Look};

use super::{NamedFigure, Selection};
use crate::comparison::mean;

/// Maximum number of methods in one figure. With more, neither the curves nor the legend can be
/// read.
const MOST_METHODS: usize = 20;
/// Maximum number of figures that one plot is split into.
const MOST_PARTS: usize = 5;
/// Number of best methods that a selection from very many methods contains.
const BEST: usize = MOST_METHODS / 2;

/// The methods that a figure shows, if it does not show all.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Part {
    /// Suffix of the file name.
    suffix: String,
    /// Description of the methods that are shown.
    shown: String,
    /// Number of methods in all.
    of: usize,
}

impl<'a> Selection<'a> {
    /// Splits the selection into parts that one figure each can show, for figures of a metric.
    pub(super) fn parts(&self, metric: Metric) -> Vec<Self> {
        if self.methods.len() <= MOST_METHODS {
            return vec![self.clone()];
        }
        let methods: Vec<&str> = self.all.iter().copied().filter(|m| self.has(m)).collect();
        let of = methods.len();
        if of > MOST_METHODS * MOST_PARTS {
            return vec![self.choice(&methods, metric)];
        }
        self.split(&methods, MOST_METHODS)
    }

    /// Splits the selection into parts of about the same size with at most `most` methods each, for
    /// figures of no metric. Of very many methods, some are chosen.
    pub(super) fn parts_of(&self, most: usize) -> Vec<Self> {
        let methods: Vec<&str> = self.all.iter().copied().filter(|m| self.has(m)).collect();
        if self.methods.len() <= most || methods.is_empty() {
            return vec![self.clone()];
        }
        if methods.len() <= MOST_METHODS * MOST_PARTS {
            let parts = methods.len().div_ceil(most);
            return self.split(&methods, methods.len().div_ceil(parts));
        }
        let choice = self.choice(&methods, Metric::Psnr);
        let chosen: Vec<&str> = choice.methods.iter().map(|(method, _)| *method).collect();
        let parts = chosen.len().div_ceil(most);
        let part = |(index, methods): (usize, &[&'a str])| {
            let part = choice.part.as_ref().map(|part| Part {
                suffix: format!("-part-{}", index + 1),
                shown: format!("{}; part {} of {parts}", part.shown, index + 1),
                of: part.of,
            });
            self.of_methods(methods, part)
        };
        chosen.chunks(chosen.len().div_ceil(parts)).enumerate().map(part).collect()
    }

    /// Parts of `size` methods each; some methods of the plot may have no values in its scenes.
    fn split(&self, methods: &[&'a str], size: usize) -> Vec<Self> {
        let of = methods.len();
        let parts = methods.chunks(size).enumerate().map(|(index, methods)| {
            let first = index * size + 1;
            let last = first + methods.len() - 1;
            let suffix = format!("-methods-{first}-{last}");
            let shown = format!("methods {first} to {last} of {of}");
            let part = (of > size).then_some(Part { suffix, shown, of });
            self.of_methods(methods, part)
        });
        parts.collect()
    }

    /// The best methods, and some of the others down to the worst.
    fn choice(&self, methods: &[&'a str], metric: Metric) -> Self {
        let of = methods.len();
        let part = |shown| Some(Part { suffix: String::new(), shown, of });
        let Some((by, ranked)) = self.ranked(methods, metric) else {
            let first = &methods[..MOST_METHODS];
            return self
                .of_methods(first, part(format!("the first {MOST_METHODS} of {of} methods")));
        };
        let others = MOST_METHODS - BEST;
        let steps = (0..others).map(|nth| BEST + nth * (of - 1 - BEST) / (others - 1));
        let chosen: Vec<&str> = (0..BEST).chain(steps).map(|rank| ranked[rank]).collect();
        let shown = format!(
            "{MOST_METHODS} of {of} methods: the {BEST} best by {}, and {others} spread evenly over the others down to the worst",
            by.info().label
        );
        self.of_methods(&chosen, part(shown))
    }

    /// The methods from the best to the worst according to a metric. If the metric has no better
    /// direction, another metric is used. Methods without a value come last.
    fn ranked(&self, methods: &[&'a str], metric: Metric) -> Option<(Metric, Vec<&'a str>)> {
        let values = |metric: Metric| -> Vec<Option<f64>> {
            let value = |method: &str| {
                let measured = self.scenes.iter();
                let measured = measured.filter_map(|s| self.source.overview.of(s, method));
                mean(&measured.filter_map(|of| of.value(metric)).collect::<Vec<_>>())
            };
            methods.iter().map(|method| value(method)).collect()
        };
        let fits = |metric: &Metric| metric.info().better != Better::Neither;
        let mut candidates = [metric].into_iter().chain(Metric::ALL).filter(fits);
        let (by, values) = candidates.find_map(|metric| {
            let values = values(metric);
            values.iter().any(Option::is_some).then_some((metric, values))
        })?;
        let sign = if by.info().better == Better::Higher { -1.0 } else { 1.0 };
        let mut ranked: Vec<(f64, &str)> = values
            .into_iter()
            .map(|value| value.map_or(f64::INFINITY, |value| sign * value))
            .zip(methods.iter().copied())
            .collect();
        // The sort is stable: equally good methods stay in the order of the experiment.
        ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
        Some((by, ranked.into_iter().map(|(_, method)| method).collect()))
    }

    fn has(&self, method: &str) -> bool {
        self.scenes.iter().any(|scene| self.source.overview.of(scene, method).is_some())
    }

    /// The selection with some of its methods. Looks are assigned again, because only a limited
    /// number can be told apart.
    fn of_methods(&self, methods: &[&'a str], part: Option<Part>) -> Self {
        let methods = methods.iter().enumerate();
        let methods = methods.map(|(index, method)| (*method, Look::new(index))).collect();
        Self { methods, part, ..self.clone() }
    }

    /// Adds to the title and caption of a figure which methods it shows, if it does not show all.
    pub(super) fn labelled(&self, figure: NamedFigure) -> NamedFigure {
        let Some(Part { suffix, shown, of }) = &self.part else { return figure };
        let NamedFigure { name, caption, figure: mut drawn, settings, warnings } = figure;
        let title = match &mut drawn {
            Figure::Line(chart) => &mut chart.title,
            Figure::Bar(chart) => &mut chart.title,
            Figure::Spread(chart) => &mut chart.title,
            Figure::Panels(chart) => &mut chart.title,
            Figure::Raster(chart) => &mut chart.title,
            Figure::Montage(chart) => &mut chart.title,
        };
        *title = Some(match title.take() {
            Some(title) => format!("{title}; {shown}"),
            None => shown.clone(),
        });
        let caption = format!("{caption}; {shown} (all {of} are in summary.json)");
        NamedFigure { name: format!("{name}{suffix}"), caption, figure: drawn, settings, warnings }
    }
}
