//! Turns the findings about all pairs into the results of a run, comparison by comparison, in
//! order.

use std::collections::BTreeMap;

use fovqa_metrics::MetricKind;
use fovqa_plan::{Eye, Plan};
use fovqa_results::{Comparison, Failure, RunResults, ScoreReport, Swept, both_eyes};

use crate::events::Events;
use crate::findings::{ComparisonIndex, Findings, Outcome, Settled, ViewFindings, ViewIndex};

/// A failure that concerns a whole comparison.
pub(crate) fn whole(message: String, help: String) -> Failure {
    Failure { frame: None, reference: String::new(), test: String::new(), message, help }
}

/// The results of a whole run.
pub fn results(plan: &Plan, events: &dyn Events, mut findings: Findings) -> RunResults {
    let inputs = std::mem::take(&mut findings.inputs);
    RunResults { comparisons: in_order(plan, events, reports(plan, findings)), inputs }
}

fn reports(plan: &Plan, findings: Findings) -> BTreeMap<ComparisonIndex, ScoreReport> {
    let mut reports: BTreeMap<ComparisonIndex, ScoreReport> = BTreeMap::new();
    for (place, failure) in findings.problems {
        reports.entry(place).or_default().failures.push(failure);
    }
    for (view, findings) in findings.views {
        report_view(plan, view, findings, &mut reports);
    }
    reports
}

fn report_view(
    plan: &Plan,
    (scene, eye): ViewIndex,
    findings: ViewFindings,
    reports: &mut BTreeMap<ComparisonIndex, ScoreReport>,
) {
    let methods = plan.scenes[scene].eyes[eye].tests.iter().map(|(method, _)| *method);
    if let Some(failure) = findings.failed {
        for method in methods {
            let report = reports.entry((scene, method, eye)).or_default();
            report.failures.push(failure.clone());
        }
        return;
    }
    for outcome in findings.pairs.into_values() {
        let Outcome { method, result, guides } = *outcome;
        let report = reports.entry((scene, method, eye)).or_default();
        match result {
            Ok(frame) => {
                if frame.rows.has_kind(MetricKind::Temporal) {
                    report.guide_sources = guides;
                }
                report.frames.push(frame);
            }
            Err(failure) => report.failures.push(failure),
        }
    }
    let Some(settled) = findings.settled else { return };
    for method in methods {
        settle(plan, reports.entry((scene, method, eye)).or_default(), method, &settled);
    }
}

/// Adds to a report what holds for its sequence as a whole.
fn settle(plan: &Plan, report: &mut ScoreReport, method: usize, settled: &Settled) {
    report.view.clone_from(&settled.view);
    report.metrics.clone_from(&settled.metrics);
    report.gaze_held = settled.gaze_held;
    let temporal = settled.metrics.iter().filter(|metric| metric.is(MetricKind::Temporal));
    report.frames_needed =
        temporal.map(|metric| (*metric, plan.params.frames_needed(*metric))).collect();
    report.fvvdp = settled.fvvdp.get(&method).cloned();
    if let Some(fvvdp) = &mut report.fvvdp {
        fvvdp.missing = settled.missing.get(&method).cloned();
    }
    // A frame that could not be scored has its own error already. A frame that was never there has
    // none.
    let missing = report.fvvdp.as_ref().and_then(|fvvdp| fvvdp.missing.clone());
    if let Some(why) = missing.filter(|_| report.failures.is_empty()) {
        let message = format!("FovVideoVDP has no value for the sequence: {why}");
        let help = "render the frames that are missing, or leave fvvdp out of {metrics}";
        report.failures.push(whole(message, help.to_owned()));
    }
}

/// The comparisons in the order of scenes, methods and eyes. The comparison of both eyes follows
/// the two single eyes.
fn in_order(
    plan: &Plan,
    events: &dyn Events,
    mut reports: BTreeMap<ComparisonIndex, ScoreReport>,
) -> Vec<Comparison> {
    let mut comparisons = Vec::new();
    for (scene_index, scene) in plan.scenes.iter().enumerate() {
        for (method_index, method) in plan.methods.iter().enumerate() {
            let swept = plan
                .swept(method_index)
                .map(|(method, parameters)| Swept { method: method.to_owned(), parameters });
            let mut push = |eye, report| {
                let (scene, method) = (scene.name.clone(), method.clone());
                comparisons.push(Comparison { scene, method, swept: swept.clone(), eye, report });
            };
            let mut eyes = Vec::new();
            for (index, view) in scene.eyes.iter().enumerate() {
                if let Some(report) = reports.remove(&(scene_index, method_index, index)) {
                    eyes.push((view.eye.map_or("", Eye::name), report));
                }
            }
            let both = match eyes.as_slice() {
                [(_, left), (_, right)] => {
                    let both = both_eyes(left, right);
                    let alone = left.frames.len() + right.frames.len() - 2 * both.frames.len();
                    if alone > 0 {
                        let frames = if alone == 1 { "frame" } else { "frames" };
                        // The only scene of a command has no name, and neither has its method.
                        let place = if scene.name.is_empty() {
                            String::new()
                        } else {
                            format!("{}, {method}: ", scene.name)
                        };
                        events.warn(&format!(
                            "{place}left out of the results of both eyes: {alone} {frames} of one \
                             eye without a partner of the other eye"
                        ));
                    }
                    Some(both)
                }
                _ => None,
            };
            for (eye, report) in eyes {
                push(eye, report);
            }
            if let Some(both) = both {
                push("both", both);
            }
        }
    }
    comparisons
}
