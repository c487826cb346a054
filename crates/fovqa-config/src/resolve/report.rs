//! `[report]`: what the page of a run shows of the frames.

use fovqa_metrics::Metric;
use fovqa_params::Words;
use fovqa_plan::{FrameChoice, FrameWord, MetricChoice, ReportSettings};
use serde_spanned::Spanned;
use toml::de::DeValue;

use crate::fault::{Fault, Faults};
use crate::grammar::number;
use crate::node::{Node, text};

/// The settings. A frame that appears twice, or a metric that cannot rank frames, is a mistake.
pub(super) fn report(root: Node<'_>, chosen: &MetricChoice, faults: &mut Faults) -> ReportSettings {
    let mut settings = ReportSettings::default();
    let Some(table) = root.table("report") else { return settings };
    if let Some(size) = table.number("size") {
        settings.size = size as usize;
    }
    if let Some(DeValue::Array(items)) = table.value("frames").map(Spanned::get_ref) {
        settings.frames.clear();
        for item in items {
            let word = text(item).and_then(FrameWord::find).map(FrameChoice::Of);
            let number = number(item.get_ref()).map(|number| FrameChoice::Number(number as i64));
            match word.or(number) {
                Some(frame) if settings.frames.contains(&frame) => {
                    faults.push(Fault::new(item.span(), "the frame appears twice"));
                }
                Some(frame) => settings.frames.push(frame),
                None => {}
            }
        }
    }
    if let Some(metric) = table.text("metric").and_then(Metric::find) {
        let span = table.span("metric");
        if !metric.scores_frames() {
            let ranking: Vec<&str> = ReportSettings::ranking_metrics().map(Metric::key).collect();
            let message = format!("{} has no score of a single frame", metric.key());
            let help = format!("choose one of {}", ranking.join(", "));
            faults.push(Fault::new(span, message).help(help));
        } else if !chosen.metrics().contains(&metric) {
            let message = format!("{} ranks frames, but is not scored", metric.key());
            let help = format!("add {} = {{}} to [metrics]", metric.key());
            faults.push(Fault::new(span, message).help(help));
        } else {
            settings.metric = Some(metric);
        }
    }
    settings
}
