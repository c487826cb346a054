//! Going on in the middle of a view: the pairs before the first that is to be scored leave behind what they
//! would have left, and are not scored.

use std::collections::BTreeSet;

use fovqa_frame::{Mask, PairSignal};
use fovqa_metrics::Profiler;
use fovqa_results::Failure;

use super::{Measuring, ViewRun, unscored};
use crate::events::Warnings;
use crate::load::{Fault, Loaded, Side, Step};
use crate::meters::temporal::Present;
use crate::work::Work;

impl ViewRun<'_> {
    /// Gets ready to go on before the first pair that is to be scored: the pairs before it that what is
    /// measured over time has to have seen.
    pub(crate) fn go_on(&mut self, work: &Work<'_>) -> BTreeSet<usize> {
        let mut kept = BTreeSet::new();
        for method in work.methods() {
            let before = work.before(work.first(), method);
            if let Some(light) = &mut self.light {
                let end = work.before(work.end(), method).len();
                kept.extend(&before[light.go_on(method, before.len(), end)]);
            }
            if self.temporal.is_some() && work.is_of(method) {
                kept.extend(before.last());
            }
        }
        kept
    }

    /// Whether a pair decides something of those that are to be scored, which is not yet decided.
    pub(crate) fn wants(&self, step: &Step<'_>, work: &Work<'_>) -> bool {
        let lacks =
            self.temporal.as_ref().map(|temporal| temporal.lacks(step.method, step.frame == 0));
        self.setup.is_none()
            || lacks.is_some_and(|[reference, test]| {
                !work.todo.is_empty() && (reference || (test && work.is_of(step.method)))
            })
    }

    /// Takes a pair in without scoring it; `kept`: with all that those after it need of it.
    pub(crate) fn warm_up(
        &mut self,
        step: &Step<'_>,
        loaded: Loaded,
        kept: bool,
        warnings: &mut Warnings<'_>,
    ) -> Result<(), Failure> {
        self.take(step, loaded, |run, reference, test| {
            let finite = run.enter(step, reference, test, warnings)?;
            if kept { run.keep(step, reference, test, finite) } else { Ok(()) }
        })
    }

    /// Keeps what the pairs after this one need of it.
    fn keep(
        &mut self,
        step: &Step<'_>,
        reference: &Side,
        test: &Side,
        finite: Option<Mask>,
    ) -> Result<(), Fault> {
        let view = self.view;
        let Some(setup) = &mut self.setup else { unreachable!("it has just been settled") };
        if let Some(finite) = &finite {
            // Whether too much is left out is a matter of this pair alone, and costs those after it too.
            if let Some(trace) = &view.trace {
                setup.look_at(trace[step.frame].px);
            }
            let (mask, retina) = (setup.within_mask(finite), setup.retina());
            let (regions, _) = retina.regions_within(&mask, setup.scorer.window_radius());
            let signal = PairSignal::new(&reference.frame, &test.frame, &self.tables);
            let scores = setup.scorer.score(&signal, &regions, retina.weight.as_ref());
            scores.map_err(|error| unscored(&test.file, &error))?;
        }
        if let Some(light) = self.light.as_mut().filter(|_| setup.fvvdp().is_some()) {
            let frames = [&reference.frame, &test.frame];
            light.warm_up((step.frame, step.method), frames, &|frame, method| {
                self.loader.pair(&view.frames[frame], method)
            });
        }
        if let Some(temporal) = &mut self.temporal {
            let position = view.frames[step.frame].position;
            let present = Present { reference, test, method: step.method, position };
            let retina = setup.retina();
            let (regions, blocks) = retina.regions();
            let luma = Measuring {
                profiler: &Profiler::new(&[], &self.plan.params),
                tables: &self.tables,
                regions: &regions,
                blocks: &blocks,
            };
            luma.both(&present, None, Some(temporal));
            temporal.keep(&present, finite);
        }
        Ok(())
    }
}
