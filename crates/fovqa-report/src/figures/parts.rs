//! Plots of more methods than one figure can show. Some dozens are split over several figures; of very many,
//! each figure shows a choice. What is shown stands in the title and in the caption.

use fovqa_metrics::{Better, Metric};
use fovqa_plot::{Figure, Look};

use super::{NamedFigure, Selection};
use crate::comparison::mean;

/// The most methods of one figure: with more, neither curves nor legend can be read.
const MOST_METHODS: usize = 20;
/// The most figures that one is split into.
const MOST_PARTS: usize = 5;
/// Of very many methods, how many of those shown are the best.
const BEST: usize = MOST_METHODS / 2;

/// Which methods a figure shows, where it does not show all.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Part {
    /// Behind the name of the file.
    suffix: String,
    /// What it shows, in words.
    shown: String,
    /// How many methods there are.
    of: usize,
}

impl<'a> Selection<'a> {
    /// The selection in pieces that one figure can show, for figures of a metric.
    pub(super) fn parts(&self, metric: Metric) -> Vec<Self> {
        if self.methods.len() <= MOST_METHODS {
            return vec![self.clone()];
        }
        let methods: Vec<&str> = self.all.iter().copied().filter(|m| self.has(m)).collect();
        let of = methods.len();
        if of > MOST_METHODS * MOST_PARTS {
            return vec![self.choice(&methods, metric)];
        }
        let parts = methods.chunks(MOST_METHODS).enumerate().map(|(index, methods)| {
            let first = index * MOST_METHODS + 1;
            let last = first + methods.len() - 1;
            let suffix = format!("-methods-{first}-{last}");
            let shown = format!("methods {first} to {last} of {of}");
            // Not all methods of the plot may have values in its scenes.
            let part = (of > MOST_METHODS).then_some(Part { suffix, shown, of });
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

    /// Methods from the best to the worst by a metric, or by another one where it has no better or worse.
    /// Those without a value come last.
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
        // A stable sort: equally good methods stay in the order of the experiment.
        ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
        Some((by, ranked.into_iter().map(|(_, method)| method).collect()))
    }

    fn has(&self, method: &str) -> bool {
        self.scenes.iter().any(|scene| self.source.overview.of(scene, method).is_some())
    }

    /// The same of some of its methods. Looks are given anew: there are only so many that can be told apart.
    fn of_methods(&self, methods: &[&'a str], part: Option<Part>) -> Self {
        let methods = methods.iter().enumerate();
        let methods = methods.map(|(index, method)| (*method, Look::new(index))).collect();
        Self { methods, part, ..self.clone() }
    }

    /// A figure with what it shows in its title and its caption, where it does not show all.
    pub(super) fn labelled(&self, figure: NamedFigure) -> NamedFigure {
        let Some(Part { suffix, shown, of }) = &self.part else { return figure };
        let NamedFigure { name, caption, mut figure } = figure;
        let title = match &mut figure {
            Figure::Line(chart) => &mut chart.title,
            Figure::Bar(chart) => &mut chart.title,
            Figure::Spread(chart) => &mut chart.title,
            Figure::Panels(chart) => &mut chart.title,
            Figure::Raster(chart) => &mut chart.title,
        };
        *title = Some(match title.take() {
            Some(title) => format!("{title}; {shown}"),
            None => shown.clone(),
        });
        let caption = format!("{caption}; {shown} (all {of} are in summary.json)");
        NamedFigure { name: format!("{name}{suffix}"), caption, figure }
    }
}
