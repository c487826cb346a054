//! The tables `fovqa score` prints: whole frames first, then by eccentricity.

use std::fmt::Write;

use fovqa_metrics::{Metric, PairScores};
use fovqa_results::{ScoreReport, Statistics, Summary};

use crate::text_table::{aligned, plain_table, printable};

/// The report as text: what was compared, each metric, and each band.
pub fn score_table(report: &ScoreReport) -> String {
    let summary = Summary::of(report);
    let mut text = heading(report);
    let one = report.frames.len() == 1;
    let mut whole =
        plain_table(if one { &["", "value"][..] } else { &["", "mean", "min", "max", "pooled"] });
    for (metric, s) in &summary.statistics {
        let mut row = vec![label(*metric)];
        if one {
            row.push(number(*metric, s.mean));
        } else {
            row.extend([s.mean, s.min, s.max].map(|v| number(*metric, v)));
            row.push(s.pooled.map(|v| number(*metric, v)).unwrap_or_default());
        }
        whole.add_row(row);
    }
    let _ = writeln!(text, "\n{}", aligned(whole));
    if let Some(identical) = summary.statistics.values().find_map(|s| s.identical_frames)
        && identical > 0
        && !one
    {
        let frames = report.frames.len();
        let means = if identical < frames { "; means are over the others" } else { "" };
        let _ = writeln!(text, "{identical} of {frames} frames are identical{means}");
    }

    let per_band: Vec<Metric> =
        report.metrics.iter().copied().filter(|m| m.info().per_band).collect();
    if !summary.bands.is_empty() && !per_band.is_empty() {
        let labels: Vec<String> = per_band.iter().map(|m| label(*m)).collect();
        let header =
            ["eccentricity", "pixels"].into_iter().chain(labels.iter().map(String::as_str));
        let mut bands = plain_table(&header.collect::<Vec<_>>());
        for band in &summary.bands {
            let mut row = vec![
                format!("{}° to {}°", band.from_deg, band.to_deg),
                format!("{:.0}", band.pixels as f64 / report.frames.len().max(1) as f64),
            ];
            let cell = |metric: &Metric| {
                let statistics: Option<&Statistics> = band.statistics.get(metric)?.as_ref();
                statistics.map(|s| number(*metric, s.mean))
            };
            row.extend(per_band.iter().map(|m| cell(m).unwrap_or_else(|| "–".to_owned())));
            bands.add_row(row);
        }
        let _ = writeln!(text, "\n{}", aligned(bands));
        if !one {
            let _ = writeln!(text, "pixels and values are means over the frames");
        }
    }
    let count = |pixels: fn(&PairScores) -> u64| -> u64 {
        report.frames.iter().map(|frame| pixels(&frame.scores)).sum()
    };
    let outside = if summary.bands.is_empty() { 0 } else { count(|s| s.outside_bands) };
    for (pixels, where_they_are) in
        [(outside, "lie outside all bands"), (count(|s| s.left_out), "are left out by a mask")]
    {
        if pixels > 0 {
            let in_all = if one { "" } else { ", in all frames together" };
            let _ = writeln!(text, "{pixels} pixels {where_they_are}{in_all}");
        }
    }
    text
}

fn heading(report: &ScoreReport) -> String {
    let mut text = String::new();
    match report.frames.as_slice() {
        [frame] => {
            let (test, reference) = (printable(&frame.test), printable(&frame.reference));
            let _ = writeln!(text, "{test} against {reference}");
        }
        [first, .., last] => {
            let count = report.frames.len();
            let _ = writeln!(text, "{count} frames, {} to {}", first.frame, last.frame);
            let (test, reference) = (printable(&first.test), printable(&first.reference));
            let _ = writeln!(text, "{test} … against {reference} …");
        }
        [] => {}
    }
    if let Some(view) = &report.view {
        let [w, h] = view.size;
        let [fx, fy] = view.focal_px;
        let focal = if (fx - fy).abs() < 1e-9 * fx {
            format!("{fx:.2}")
        } else {
            format!("{fx:.2} x {fy:.2}")
        };
        let [gx, gy] = view.gaze_px;
        let gaze = match report.gaze_held {
            None => format!("({gx:.1}, {gy:.1})"),
            Some(0) => "from a trace".to_owned(),
            Some(1) => "from a trace, held over in 1 frame".to_owned(),
            Some(held) => format!("from a trace, held over in {held} frames"),
        };
        let _ = writeln!(
            text,
            "view {w}x{h} px, focal length {focal} px, gaze {gaze}, {} eccentricity",
            view.eccentricity
        );
    }
    text
}

fn label(metric: Metric) -> String {
    let info = metric.info();
    if info.unit.is_empty() {
        info.label.to_owned()
    } else {
        format!("{} {}", info.label, info.unit)
    }
}

fn number(metric: Metric, value: f64) -> String {
    if value.is_infinite() {
        "inf".to_owned()
    } else if metric.is_decibel() {
        format!("{value:.3}")
    } else if value != 0.0 && value.abs() < 0.1 {
        format!("{value:.4e}")
    } else {
        format!("{value:.5}")
    }
}
