//! The ratio test / reference in each eccentricity band, in percent.

use fovqa_metrics::{Better, Metric};
use fovqa_plan::Plot;
use fovqa_results::RunRecord;

use super::group::Group;
use super::{Cell, ComparedRow, ComparisonTable};
use crate::overview::{Measured, Overview, WaveletBand};

/// The contents of a table of ratios.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Ratios<'a> {
    pub(crate) metric: Metric,
    pub(crate) scene: &'a str,
    pub(crate) methods: &'a [&'a str],
    /// Levels of the wavelet; `None` for all.
    pub(crate) levels: Option<&'a [usize]>,
    /// Statistic of the wavelet.
    pub(crate) statistic: &'a str,
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
        let groups = ratios.groups(&levels);
        let row = |label: String, value: &dyn Fn(&Measured, usize) -> Option<f64>| {
            let cells = (0..groups.len()).map(|group| {
                let value = |method: &&str| Some(value(of(method)?, group)? * 100.0);
                let cell = |value| Cell { value, best: false };
                ratios.methods.iter().map(|method| cell(value(method))).collect()
            });
            ComparedRow { label, average: false, cells: cells.collect() }
        };
        let mut rows: Vec<ComparedRow> = bands
            .iter()
            .map(|band| {
                let edges = (band.from_deg, band.to_deg);
                let label = format!("{}° to {}°", band.from_deg, band.to_deg);
                row(label, &|comparison, group| {
                    ratios.in_band(comparison, edges, levels.get(group))
                })
            })
            .collect();
        if ratios.metric == Metric::Atd {
            let whole = |c: &Measured, _| c.atd.as_ref()?.ratio;
            rows.push(ComparedRow { average: true, ..row("whole frame".to_owned(), &whole) });
        }
        let cells = rows.iter().flat_map(|row| row.cells.iter().flatten());
        if groups.is_empty() || cells.clone().all(|cell| cell.value.is_none()) {
            return None;
        }
        let scene = if run.resolved.scenes.len() > 1 {
            format!(", {}", ratios.scene)
        } else {
            String::new()
        };
        Some(Self {
            caption: format!("{}, test / reference{scene}", ratios.label()),
            corner: "eccentricity",
            methods: ratios.methods.iter().map(|&method| method.to_owned()).collect(),
            groups,
            rows,
            notes: vec![NOTE.to_owned()],
        })
    }
}

const NOTE: &str = "Ratios of means over frames (max |c|: of the largest values). 100 % means the same value as in the \
                    reference; – means that the reference is 0, or that nothing was measured.";

impl Ratios<'_> {
    fn label(&self) -> String {
        let label = self.metric.info().label;
        match self.metric {
            Metric::Haar => format!("{label} {}", statistic_in_words(self.statistic)),
            _ => label.to_owned(),
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
        levels.retain(|level| self.levels.is_none_or(|wanted| wanted.contains(level)));
        levels
    }

    fn groups(&self, levels: &[usize]) -> Vec<Group> {
        let key = self.metric.key();
        match self.metric {
            Metric::Haar => levels
                .iter()
                .map(|level| {
                    let key = format!("{key}_{}_{level}_percent", self.statistic);
                    Group::ratio(format!("level {level}"), key, Better::Neither)
                })
                .collect(),
            _ => vec![Group::ratio(self.label(), format!("{key}_percent"), Better::Neither)],
        }
    }

    fn in_band(
        &self,
        comparison: &Measured,
        edges: (f64, f64),
        level: Option<&usize>,
    ) -> Option<f64> {
        let is_it = |from: f64, to: f64| (from, to) == edges;
        let Some(&level) = level else {
            let band = comparison.bands.iter().find(|b| is_it(b.from_deg, b.to_deg))?;
            return band.compared(self.metric)?.ratio();
        };
        let of = |band: &&WaveletBand| {
            usize::from(band.level) == level && is_it(band.from_deg, band.to_deg)
        };
        comparison.wavelet.iter().find(of)?.statistic(self.statistic).ratio()
    }
}
