//! Metrics of fidelity that share a pass with no other.

use fovqa_metrics::{BlockRegions, Metric, PairInput, PairPass, Params, Scored};
use fovqa_plan::Plan;

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
        Self { passes: passes.collect(), params: (*plan.params).clone(), maps: plan.maps }
    }

    /// Measures a pair, metric by metric; with its maps, where they are wanted and asked for.
    pub(super) fn measure(
        &self,
        pair: &Pair<'_>,
        maps: bool,
    ) -> impl Iterator<Item = Result<Scored, Fault>> {
        self.passes.iter().map(move |(metric, pass)| {
            let needs = metric.info().needs;
            let none = BlockRegions::default();
            let scored = pass(&PairInput {
                reference: &pair.reference.frame,
                test: &pair.test.frame,
                tables: pair.tables,
                regions: pair.regions,
                weight: pair.retina.weight.as_ref().filter(|_| needs.foveal_weight),
                blocks: pair.blocks_of((needs.block_levels)(&self.params)).unwrap_or(&none),
                params: &self.params,
                map: self.maps && maps,
            });
            scored.map_err(|error| unscored(&pair.test.file, &error))
        })
    }
}
