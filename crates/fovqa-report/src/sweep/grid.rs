//! The values of a metric over the grid of a sweep.

use fovqa_metrics::{Better, Metric};
use fovqa_params::ParamValue;
use fovqa_plan::{Plot, Sweep, SweptKey, shown_value};

use crate::comparison::{mean, named};
use crate::figures::Source;
use crate::overview::{Measured, Overview};

/// A sweep with the names of its points among the methods of the run.
#[derive(Clone, Copy)]
pub(super) struct Grid<'a> {
    pub(super) sweep: &'a Sweep,
    labels: &'a [String],
}

/// A scene, or the average over several.
#[derive(Clone, Copy)]
pub(super) struct Place<'a> {
    scenes: &'a [&'a str],
    is_average: bool,
}

impl<'a> Place<'a> {
    /// The places of a list of scenes: each scene, and the average of several.
    pub(super) fn all(scenes: &'a [&'a str]) -> Vec<Self> {
        let single = scenes.chunks(1).map(|scenes| Self { scenes, is_average: false });
        let several = scenes.len() > 1;
        single.chain(several.then_some(Self { scenes, is_average: true })).collect()
    }

    /// Its name in tables; empty for the only scene of a run without names.
    pub(super) fn name(&self) -> String {
        if self.is_average { "average".to_owned() } else { self.scenes.concat() }
    }

    /// The name in titles and captions.
    pub(super) fn title(&self) -> String {
        if self.is_average {
            format!("Average over {} scenes", self.scenes.len())
        } else {
            self.scenes.concat()
        }
    }

    /// A value of a method: that of the scene, or the average if all scenes have one.
    pub(super) fn value(
        &self,
        overview: &Overview,
        method: &str,
        of: impl Fn(&Measured) -> Option<f64>,
    ) -> Option<f64> {
        let values = self.scenes.iter().map(|scene| of(overview.of(scene, method)?));
        mean(&values.collect::<Option<Vec<f64>>>()?)
    }
}

impl<'a> Grid<'a> {
    /// The sweeps of a plot's methods.
    pub(super) fn all(source: &Source<'a>, plot: &Plot) -> Vec<Self> {
        let resolved = &source.run.resolved;
        let wanted = |labels: &[String]| {
            let of_plot = |names: &Vec<String>| labels.iter().any(|label| names.contains(label));
            plot.methods.as_ref().is_none_or(of_plot)
        };
        let grids = resolved.sweeps.iter().filter_map(|sweep| {
            let labels = resolved.methods.get(sweep.methods())?;
            Some(Self { sweep, labels })
        });
        grids.filter(|grid| wanted(grid.labels)).collect()
    }

    /// The methods of a plot that are not swept.
    pub(super) fn others(source: &Source<'a>, plot: &Plot) -> Vec<&'a str> {
        let resolved = &source.run.resolved;
        let swept = |index: usize| resolved.sweeps.iter().any(|s| s.methods().contains(&index));
        let names = named(plot.methods.as_deref(), resolved.methods.iter().map(String::as_str));
        let place = |name: &str| resolved.methods.iter().position(|method| method == name);
        names.into_iter().filter(|name| place(name).is_some_and(|index| !swept(index))).collect()
    }

    /// The value of a metric at each point.
    pub(super) fn values(
        &self,
        overview: &Overview,
        place: Place<'_>,
        metric: Metric,
    ) -> Vec<Option<f64>> {
        let value = |label: &String| place.value(overview, label, |of| of.value(metric));
        self.labels.iter().map(value).collect()
    }

    /// The name of a point among the methods.
    pub(super) fn label(&self, point: usize) -> &'a str {
        self.labels.get(point).map_or("", String::as_str)
    }

    /// The values of a point in words: `fx = 0.1, fy = 0.2`.
    pub(super) fn at_in_words(&self, point: usize) -> String {
        let words = |(key, value): (&str, &ParamValue)| format!("{key} = {}", shown_value(value));
        self.sweep.at(point).map(words).collect::<Vec<_>>().join(", ")
    }
}

/// The numbers of a key; `None` if it has other values.
pub(super) fn numbers(key: &SweptKey) -> Option<Vec<f64>> {
    key.values.iter().map(ParamValue::number).collect()
}

/// The index of the best value and the index of the worst; `None` without values or if no direction
/// is better. Of equal values, the first counts.
pub(super) fn best_and_worst(metric: Metric, values: &[Option<f64>]) -> Option<(usize, usize)> {
    let sign = match metric.info().better {
        Better::Higher => 1.0,
        Better::Lower => -1.0,
        Better::Neither => return None,
    };
    let found = || values.iter().enumerate().filter_map(|(i, v)| Some((i, sign * (*v)?)));
    let first = |better: fn(f64, f64) -> bool| {
        found().reduce(|kept, next| if better(next.1, kept.1) { next } else { kept })
    };
    let best = first(|next, kept| next > kept)?;
    let worst = first(|next, kept| next < kept)?;
    Some((best.0, worst.0))
}
