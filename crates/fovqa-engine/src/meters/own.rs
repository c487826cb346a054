//! Metrics of fidelity that share a pass with no other.

use fovqa_config::Plan;
use fovqa_metrics::{BlockRegions, Metric, PairInput, PairPass, Params, Scored};

use super::Pair;
use super::fidelity::unscored;
use crate::load::Fault;

/// Measures pairs, metric by metric.
pub(super) struct Own {
    passes: Vec<(Metric, PairPass)>,
    params: Params,
    maps: bool,
}

impl Own {
    pub(super) fn new(plan: &Plan, metrics: &[Metric]) -> Self {
        let passes = metrics.iter().filter_map(|metric| Some((*metric, metric.info().pass?)));
        Self { passes: passes.collect(), params: plan.params.clone(), maps: plan.maps }
    }

    pub(super) fn measure(&self, pair: &Pair<'_>) -> impl Iterator<Item = Result<Scored, Fault>> {
        self.passes.iter().map(|(metric, pass)| {
            let levels = (metric.info().needs.block_levels)(&self.params);
            let none = BlockRegions::default();
            let scored = pass(&PairInput {
                reference: &pair.reference.frame,
                test: &pair.test.frame,
                tables: pair.tables,
                blocks: pair.blocks.get(&levels).unwrap_or(&none),
                params: &self.params,
                map: self.maps,
            });
            scored.map_err(|error| unscored(&pair.test.file, &error))
        })
    }
}
