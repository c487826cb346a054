//! The ratio test / reference in each eccentricity band, in percent.

use fovqa_metrics::{Better, Key, Metric, MetricKind};
use fovqa_plan::Plot;
use fovqa_results::RunRecord;

use super::ComparisonTable;
use super::measure::Measure;
use super::values::{Item, Items, Values, marked};
use crate::overview::{Band, Measured, Overview, WaveletBand};

/// The contents of a table of ratios.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Ratios<'a> {
    pub(crate) metric: Metric,
    pub(crate) scene: &'a str,
    pub(crate) methods: &'a [&'a str],
    /// The plot, with levels and statistic of the wavelet, and with the layout.
    pub(crate) plot: &'a Plot,
}

/// The statistic of the wavelet that is shown if none is named.
pub(crate) const DEFAULT_STATISTIC: &str = "energy";

/// The wavelet statistic of a plot.
pub(crate) fn statistic(plot: &Plot) -> &str {
    plot.statistic.as_deref().unwrap_or(DEFAULT_STATISTIC)
}

/// A wavelet statistic in words.
pub(crate) fn statistic_in_words(statistic: &str) -> &'static str {
    match statistic {
        "mean_abs" => "mean |c|",
        "max_abs" => "max |c|",
        _ => "energy",
    }
}

impl ComparisonTable {
    /// The table of one metric in one scene; `None` if it was not scored.
    pub(crate) fn ratios(
        run: &RunRecord,
        overview: &Overview,
        ratios: &Ratios<'_>,
    ) -> Option<Self> {
        let of = |method: &&str| overview.of(ratios.scene, method);
        let found: Vec<&Measured> = ratios.methods.iter().filter_map(of).collect();
        let bands = found.iter().map(|c| &c.bands).find(|bands| !bands.is_empty())?;
        let levels = ratios.levels_of(&found);
        let measures = ratios.measures(&levels);
        let item = |label: String, value: &dyn Fn(&Measured, usize) -> Option<f64>| {
            let cells = measures.iter().enumerate().map(|(index, measure)| {
                let value = |method: &&str| Some(value(of(method)?, index)? * ratios.scale());
                let scored: Vec<_> = ratios.methods.iter().map(|m| (value(m), None)).collect();
                marked(index, measure, &scored)
            });
            Item::new(label, cells.collect())
        };
        let band = |band: &Band| {
            let edges = (band.from_deg, band.to_deg);
            let label = format!("{}° to {}°", band.from_deg, band.to_deg);
            item(label, &|comparison, index| ratios.in_band(comparison, edges, levels.get(index)))
        };
        let mut items: Vec<Item> = bands.iter().map(band).collect();
        if ratios.metric.is(MetricKind::Temporal) {
            let whole = |c: &Measured, _| c.temporal.of(ratios.metric)?.ratio;
            items.push(Item { is_average: true, ..item("whole frame".to_owned(), &whole) });
        }
        let mut cells = items.iter().flat_map(|item| item.cells.iter().flatten());
        if measures.is_empty() || cells.all(|cell| cell.value.is_none()) {
            return None;
        }
        let scene = if run.resolved.scenes.len() > 1 {
            format!(", {}", ratios.scene)
        } else {
            String::new()
        };
        let methods = ratios.methods.iter().map(|&method| method.to_owned()).collect();
        Some(Self {
            title: format!("{}{}{scene}", ratios.label(), ratios.of_what()),
            caption: ratios.plot.caption.clone(),
            label: String::new(),
            layout: ratios.plot.layout,
            means: ratios.means().to_owned(),
            notes: vec![ratios.note().to_owned()],
            values: Box::new(Values { items_are: Items::Bands, items, measures, methods }),
        })
    }
}

const CUTOFF_NOTE: &str = "The cut-off is the highest frequency up to which the test has at least half of the reference's power. Power that the test adds, such as noise or aliasing, counts as well: look at the figure of the spectrum. – means that the test lacks the lowest half octave, or that the reference has no power.";

const NOTE: &str = "100 % means the same value as in the reference; – means that the reference is 0, or that nothing was measured.";

impl Ratios<'_> {
    fn label(&self) -> String {
        let label = self.metric.info().label;
        match self.metric {
            Metric::Haar => format!("{label} {}", statistic_in_words(statistic(self.plot))),
            Metric::Spectrum => "Cut-off of the spectrum".to_owned(),
            _ => label.to_owned(),
        }
    }

    /// Whether the table has cut-off frequencies in place of ratios.
    fn are_cutoffs(&self) -> bool {
        self.metric == Metric::Spectrum
    }

    fn of_what(&self) -> &'static str {
        if self.are_cutoffs() { "" } else { ", test / reference" }
    }

    fn note(&self) -> &'static str {
        if self.are_cutoffs() { CUTOFF_NOTE } else { NOTE }
    }

    /// The factor from values to what the table shows: ratios in percent.
    fn scale(&self) -> f64 {
        if self.are_cutoffs() { 1.0 } else { 100.0 }
    }

    /// What the values are ratios of.
    fn means(&self) -> &'static str {
        match (self.metric, statistic(self.plot)) {
            (Metric::Haar, "max_abs") => "Ratios of the largest values over frames.",
            (Metric::Spectrum, _) => "Of the mean power over frames.",
            (metric, _) if Key::of(metric).statistic().pools_values() => {
                "Ratios of root mean squares over frames."
            }
            _ => "Ratios of means over frames.",
        }
    }

    /// The levels to show. Only the wavelet has levels.
    fn levels_of(&self, found: &[&Measured]) -> Vec<usize> {
        if self.metric != Metric::Haar {
            return Vec::new();
        }
        let mut levels: Vec<usize> =
            found.iter().flat_map(|c| c.wavelet.iter().map(|band| band.level.into())).collect();
        levels.sort_unstable();
        levels.dedup();
        let wanted = self.plot.levels.as_ref();
        levels.retain(|level| wanted.is_none_or(|wanted| wanted.contains(level)));
        levels
    }

    fn measures(&self, levels: &[usize]) -> Vec<Measure> {
        let key = self.metric.key();
        if self.are_cutoffs() {
            return vec![Measure::cutoff(self.metric)];
        }
        if self.metric != Metric::Haar {
            let key = format!("{key}_percent");
            return vec![Measure::ratio(self.metric, self.label(), key, Better::Neither)];
        }
        let level = |level: &usize| {
            let key = format!("{key}_{}_{level}_percent", statistic(self.plot));
            Measure::ratio(self.metric, format!("level {level}"), key, Better::Neither)
        };
        levels.iter().map(level).collect()
    }

    fn in_band(
        &self,
        comparison: &Measured,
        edges: (f64, f64),
        level: Option<&usize>,
    ) -> Option<f64> {
        let is_it = |from: f64, to: f64| (from, to) == edges;
        if self.are_cutoffs() {
            let band = comparison.spectrum.iter().find(|b| is_it(b.from_deg, b.to_deg))?;
            return band.cutoff_cpd;
        }
        let Some(&level) = level else {
            let band = comparison.bands.iter().find(|b| is_it(b.from_deg, b.to_deg))?;
            return band.compared(self.metric)?.ratio();
        };
        let of = |band: &&WaveletBand| {
            usize::from(band.level) == level && is_it(band.from_deg, band.to_deg)
        };
        comparison.wavelet.iter().find(of)?.statistic(statistic(self.plot)).ratio()
    }
}
