//! Fidelity metrics that share a pass with no other metric.

use fovqa_metrics::{BlockRegions, Metric, MetricKind, PairInput, Params, Scored};
use fovqa_plan::Plan;

use super::Pair;
use super::fidelity::unscored;
use crate::load::Fault;

/// Measures pairs, metric by metric.
pub(super) struct Own {
    metrics: Vec<Metric>,
    params: Params,
}

impl Own {
    pub(super) fn new(plan: &Plan, metrics: &[Metric]) -> Self {
        let own = |metric: &Metric| metric.is(MetricKind::Fidelity) && metric.has_own_pass();
        let metrics = metrics.iter().copied().filter(own);
        Self { metrics: metrics.collect(), params: (*plan.params).clone() }
    }

    /// Measures a pair, metric by metric. The maps are included if they are wanted and requested.
    pub(super) fn measure(
        &self,
        pair: &Pair<'_>,
        maps: bool,
    ) -> impl Iterator<Item = Result<Scored, Fault>> {
        let eccentricity = pair.setup.eccentricity(pair.gaze_px);
        self.metrics.iter().filter_map(move |metric| {
            let none = BlockRegions::default();
            let input = PairInput {
                reference: &pair.reference.frame,
                test: &pair.test.frame,
                tables: pair.tables,
                regions: pair.regions,
                blocks: pair.blocks_of(self.params.block_levels(*metric)).unwrap_or(&none),
                eccentricity: eccentricity.as_ref(),
                weight: pair.retina.weight.as_ref(),
                map: pair.maps && maps,
            };
            let scored = self.params.measure(*metric, &input)?;
            Some(scored.map_err(|error| unscored(pair, &error)))
        })
    }
}
