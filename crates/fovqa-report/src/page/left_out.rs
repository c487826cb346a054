//! What a run did not measure, and why: metrics without values, pixels, and frames.

use fovqa_metrics::{Metric, MetricKind};
use fovqa_results::RunRecord;
use serde_json::Value;

use super::places::{place_name, some};
use crate::frame_values::FrameValues;
use crate::overview::{Measured, Overview};

/// Lines about everything that was left out.
pub(super) fn left_out(run: &RunRecord, overview: &Overview, values: &FrameValues) -> Vec<String> {
    let mut lines = metrics(run, overview);
    lines.extend(settings(run));
    lines.extend(pixels(run, values));
    lines
}

/// The metrics that have no value, with the reason and with the places.
fn metrics(run: &RunRecord, overview: &Overview) -> Vec<String> {
    let resolved = &run.resolved;
    let wanted = resolved.metrics_in_order().into_iter();
    let wanted = wanted.filter(|metric| resolved.metrics.contains_key(metric.key()));
    let mut lines: Vec<String> = Vec::new();
    for metric in wanted {
        let mut reasons: Vec<(String, Vec<String>)> = Vec::new();
        let mut scored = 0;
        for scene in &resolved.scenes {
            for method in &resolved.methods {
                let Some(measured) = overview.of(&scene.name, method) else { continue };
                // Frames that cannot be scored are errors, which the page lists.
                if measured.frames == 0 || measured.is_scored(metric) {
                    scored += 1;
                    continue;
                }
                let reason = reason(metric, measured);
                let place = format!("{}, {method}", scene.name);
                match reasons.iter_mut().find(|(known, _)| *known == reason) {
                    Some((_, places)) => places.push(place),
                    None => reasons.push((reason, vec![place])),
                }
            }
        }
        let everywhere = scored == 0 && reasons.len() == 1;
        for (reason, places) in reasons {
            let places = if everywhere { "everywhere".to_owned() } else { some(&places) };
            lines.push(format!("{}: {reason} ({places}).", metric.info().label));
        }
    }
    lines
}

fn reason(metric: Metric, measured: &Measured) -> String {
    let needs_view =
        metric.info().needs.view && measured.view.is_none() && !measured.is_of_both_eyes;
    let recorded = match metric {
        metric if metric.is(MetricKind::Temporal) => {
            measured.temporal.of(metric).and_then(|of| of.reason.clone())
        }
        Metric::Fvvdp => measured.jod_missing.as_deref().map(str::to_owned),
        _ => None,
    };
    recorded.unwrap_or_else(|| {
        let reason = match metric.info().kind {
            _ if needs_view => "needs a view",
            MetricKind::Temporal if measured.frames < 2 => "needs two frames",
            _ => "has no value",
        };
        reason.to_owned()
    })
}

/// The settings of scenes that leave something out.
fn settings(run: &RunRecord) -> Vec<String> {
    let resolved = &run.resolved;
    let mut lines: Vec<(String, Vec<String>)> = Vec::new();
    let mut add =
        |line: String, place: String| match lines.iter_mut().find(|(known, _)| *known == line) {
            Some((_, places)) => places.push(place),
            None => lines.push((line, vec![place])),
        };
    for scene in &resolved.scenes {
        if scene.allow_missing {
            add("Frames without a partner are ignored".to_owned(), scene.name.clone());
        }
        for eye in &scene.eyes {
            let place = place_name(scene, eye);
            if let Value::String(mask) = &eye.signal["mask"] {
                add(format!("The mask {mask} leaves out pixels"), place.clone());
            }
            if eye.signal["nonfinite"] == "mask" {
                add("Pixels with NaN or infinity are left out, in both pictures".to_owned(), place);
            }
        }
    }
    lines.into_iter().map(|(line, places)| format!("{line} ({}).", some(&places))).collect()
}

/// How many pixels masks and values that are not finite left out.
fn pixels(run: &RunRecord, values: &FrameValues) -> Vec<String> {
    let mut lines = Vec::new();
    for scene in &run.resolved.scenes {
        for eye in &scene.eyes {
            let name = eye.eye.map_or("", |eye| eye.name());
            let methods = run.resolved.methods.iter();
            let counts =
                methods.filter_map(|method| values.pixels_left_out(&scene.name, method, name));
            let range = counts.reduce(|all, next| (all.0.min(next.0), all.1.max(next.1)));
            let count = match range {
                None | Some((_, 0)) => continue,
                Some((low, high)) if low == high => high.to_string(),
                Some((low, high)) => format!("{low} to {high}"),
            };
            lines.push(format!(
                "{}: {count} pixels of a frame are left out.",
                place_name(scene, eye)
            ));
        }
    }
    lines
}
