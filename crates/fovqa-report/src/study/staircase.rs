//! Tables of staircases.

use fovqa_study::staircase::{MethodThreshold, Staircase, Staircases};

use super::cells::{interval, number, whole};
use super::parts::Parts;
use crate::plain_table::Cell;

pub(super) fn parts(staircases: &Staircases, parts: &mut Parts) {
    let name = |method: &MethodThreshold| method.method.clone().unwrap_or_else(|| "all".to_owned());
    let methods = staircases.methods.iter().map(|method| {
        vec![
            Cell::text(name(method)),
            whole(method.participants),
            number(method.threshold),
            number(method.se),
            interval(method.ci),
        ]
    });
    let columns = [
        ("method", "method"),
        ("participants", "participants"),
        ("threshold", "threshold"),
        ("standard error", "se"),
        ("interval", "ci"),
    ];
    parts.table(("thresholds", "Thresholds of the methods"), &columns, methods.collect());
    parts.reasons(staircases.methods.iter().map(|method| (name(method), method.reason.clone())));
    tracks(&staircases.staircases, parts);
}

fn tracks(staircases: &[Staircase], parts: &mut Parts) {
    let row = |staircase: &Staircase| {
        vec![
            Cell::text(name(staircase)),
            whole(staircase.trials),
            number(staircase.share_correct),
            whole(staircase.reversals),
            whole(staircase.threshold.used),
            number(staircase.threshold.threshold),
            number(staircase.threshold.sd),
        ]
    };
    let columns = [
        ("staircase", "staircase"),
        ("trials", "trials"),
        ("correct", "share_correct"),
        ("reversals", "reversals"),
        ("used", "used"),
        ("threshold", "threshold"),
        ("SD", "sd"),
    ];
    parts.table(("staircases", "Staircases"), &columns, staircases.iter().map(row).collect());
    parts.reasons(
        staircases.iter().map(|staircase| (name(staircase), staircase.threshold.reason.clone())),
    );
}

fn name(staircase: &Staircase) -> String {
    let mut parts = vec![staircase.participant.as_str()];
    for part in [&staircase.method, &staircase.scene, &staircase.staircase].into_iter().flatten() {
        // A staircase is often named after its method.
        if parts.last() != Some(&part.as_str()) {
            parts.push(part);
        }
    }
    parts.dedup();
    parts.join(", ")
}
