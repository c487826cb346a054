//! The tables that `fovqa score` prints: whole frames first, then the values by eccentricity.

use std::fmt::Write;

use fovqa_metrics::{Image, Key, Metric, MetricKind, Subject};
use fovqa_params::Words;
use fovqa_results::{
    FvvdpSummary, GuideSource, ScoreReport, Statistics, StereoReport, Summary, TemporalSummary,
    summary_spectra,
};

use crate::text::Text;
use crate::text_table::{TextTable, printable};

/// The report as text: the input, the value of each metric, and the values in each band.
pub fn score_table(report: &ScoreReport) -> Text {
    let mut text = Text::from(heading(report));
    text.push(values(report, true));
    text
}

/// The results of two eyes as text: those of the left eye, of the right eye, and of both with all three
/// side by side.
pub fn stereo_table(report: &StereoReport) -> Text {
    let mut text = Text::default();
    for (title, report) in [("Left eye", &report.left), ("Right eye", &report.right)] {
        text.push_str(&format!("{title}\n"));
        text.push(score_table(report));
        text.push_str("\n");
    }
    let both = &report.both;
    let frames =
        if both.frames.len() == 1 { "1 frame" } else { &format!("{} frames", both.frames.len()) };
    text.push_str(&format!("Both eyes, {frames}\n\n"));
    let summaries = report.named().map(|(_, report)| Summary::of(report));
    let mut table = TextTable::new(["", "left eye", "right eye", "both eyes"]);
    for metric in &both.metrics {
        let value = |summary: &Summary| match metric {
            Metric::Fvvdp => summary.fvvdp.as_ref()?.jod,
            metric => Some(summary.statistics.get(metric)?.mean),
        };
        let cells = summaries.each_ref().map(value);
        if cells.iter().any(Option::is_some) {
            let shown = |cell: Option<f64>| cell.map_or_else(missing, |v| number(*metric, v));
            table.add_row([label(*metric)].into_iter().chain(cells.map(shown)));
        }
    }
    text.push_table(table);
    if both.frames.len() != 1 {
        let jod = if both.fvvdp.is_some() { "; JOD is that of the sequence" } else { "" };
        text.push_str(&format!("means over the frames{jod}\n"));
    }
    text.push(values(both, both.frames.len() != 1));
    text
}

/// The values of each metric and those in each band; `of_frames` says whether to show the former.
fn values(report: &ScoreReport, of_frames: bool) -> Text {
    let summary = Summary::of(report);
    let mut text = Text::default();
    let one = report.frames.len() == 1;
    let pools = summary.statistics.values().any(|statistics| statistics.pooled.is_some());
    let columns: &[&str] = match (one, pools) {
        (true, _) => &["", "value"],
        (false, true) => &["", "mean", "min", "max", "pooled"],
        (false, false) => &["", "mean", "min", "max"],
    };
    let mut whole = TextTable::new(columns.iter().copied());
    // A metric may have been measured without a value, as FWQI of a black reference.
    let is_measured = |metric: &Metric| {
        metric.scores_frames()
            && report.frames.iter().any(|frame| frame.rows.get(Key::of(*metric)).is_some())
    };
    let mut is_empty = true;
    for metric in report.metrics.iter().filter(|metric| is_measured(metric)) {
        let statistics = summary.statistics.get(metric);
        let cell = |value: Option<f64>| value.map_or_else(missing, |value| number(*metric, value));
        let mut row = vec![label(*metric), cell(statistics.map(|of| of.mean))];
        if !one {
            row.push(cell(statistics.map(|of| of.min)));
            row.push(cell(statistics.map(|of| of.max)));
            if pools {
                let pooled = statistics.and_then(|of| of.pooled);
                row.push(pooled.map(|value| number(*metric, value)).unwrap_or_default());
            }
        }
        whole.add_row(row);
        is_empty = false;
    }
    if of_frames && !is_empty {
        text.push_str("\n");
        text.push_table(whole);
    }
    if let Some(identical) = summary.statistics.values().find_map(|s| s.identical_frames)
        && identical > 0
        && !one
    {
        let frames = report.frames.len();
        let means = if identical < frames { "; means are over the others" } else { "" };
        let _ = writeln!(text, "{identical} of {frames} frames are identical{means}");
    }

    if let Some(fvvdp) = &summary.fvvdp {
        let _ = writeln!(text, "\n{}", fvvdp_in_words(fvvdp));
    }
    for (metric, of) in &summary.temporal.0 {
        let _ = writeln!(text, "\n{}", temporal_in_words(*metric, of));
    }
    text.push(band_table(report, &summary));
    text.push(haar_table(&summary));
    text.push(spectrum_table(&summary, report.frames.len()));
    for (subject, where_they_are) in [
        (Subject::PixelsOutsideBands, "lie outside all bands"),
        (Subject::PixelsLeftOut, "are left out by a mask"),
    ] {
        let counted = report.frames.iter().map(|frame| frame.rows.number(Key::pixels(subject)));
        let pixels: u64 = counted.sum();
        if pixels > 0 {
            let in_all = if one { "" } else { ", in all frames together" };
            let _ = writeln!(text, "{pixels} pixels {where_they_are}{in_all}");
        }
    }
    text
}

/// Each band with the metrics that have a value there. For contrast and temporal differences, the
/// value of the test is shown, with the percentage of the reference's value in brackets.
fn band_table(report: &ScoreReport, summary: &Summary) -> Text {
    let per_band = report.metrics.iter().copied().filter(|m| m.info().per_band);
    let (fidelity, compared): (Vec<Metric>, Vec<Metric>) =
        per_band.filter(|m| !has_own_table(*m)).partition(|m| m.is(MetricKind::Fidelity));
    if summary.bands.is_empty() || (fidelity.is_empty() && compared.is_empty()) {
        return Text::default();
    }
    let of_band = |metric: &Metric| match metric {
        Metric::Fvvdp => format!("{} share", metric.info().label),
        metric => label(*metric),
    };
    let labels = fidelity.iter().chain(&compared).map(of_band);
    let header = ["eccentricity", "pixels"].map(str::to_owned).into_iter().chain(labels);
    let mut table = TextTable::new(header);
    for (index, band) in summary.bands.iter().enumerate() {
        let mut row = vec![
            format!("{}° to {}°", band.from_deg, band.to_deg),
            format!("{:.0}", band.pixels as f64 / report.frames.len().max(1) as f64),
        ];
        let cell = |metric: &Metric| {
            if *metric == Metric::Fvvdp {
                let share = summary.fvvdp.as_ref()?.shares.get(index)?.share;
                return share.map(|_| percent(share));
            }
            let statistics: Option<&Statistics> = band.statistics.get(metric)?.as_ref();
            statistics.map(|s| number(*metric, s.mean))
        };
        let beside = |metric: &Metric| {
            let key = Key::of(*metric).of_image(Image::Ratio).in_band(index);
            let statistics = summary.compared.get(&key)?;
            let test = number(*metric, statistics.test?.headline(key.statistic()));
            Some(format!("{test} ({})", percent(statistics.ratio)))
        };
        row.extend(fidelity.iter().map(|m| cell(m).unwrap_or_else(missing)));
        row.extend(compared.iter().map(|m| beside(m).unwrap_or_else(missing)));
        table.add_row(row);
    }
    let mut text = Text::from("\n".to_owned());
    text.push_table(table);
    if report.frames.len() != 1 {
        let pools = |metric: &&Metric| Key::of(**metric).statistic().pools_values();
        let squares = compared.iter().find(pools).map_or_else(String::new, |metric| {
            format!("; of {}, root mean squares", metric.info().label)
        });
        text.push_str(&format!("pixels and values are means over the frames{squares}\n"));
    }
    if !compared.is_empty() {
        text.push_str("in brackets: test / reference\n");
    }
    text
}

/// Whether a metric has several values per band, and so a table of its own.
fn has_own_table(metric: Metric) -> bool {
    matches!(metric, Metric::Haar | Metric::Spectrum)
}

/// The cut-off of the spectrum in each band.
fn spectrum_table(summary: &Summary, frames: usize) -> Text {
    let spectra = summary_spectra(summary);
    if spectra.is_empty() {
        return Text::default();
    }
    let header = ["eccentricity", "blocks", "spectrum cut-off in cpd"].map(str::to_owned);
    let mut table = TextTable::new(header);
    for band in &spectra {
        let cutoff = band.cutoff_cpd.map_or_else(missing, |cpd| format!("{cpd:.2}"));
        let label = format!("{}° to {}°", band.from_deg, band.to_deg);
        table.add_row([label, band.blocks.to_string(), cutoff]);
    }
    let mut text = Text::from("\n".to_owned());
    text.push_table(table);
    let all = if frames == 1 { "" } else { "of the mean power; blocks of all frames together; " };
    text.push_str(&format!(
        "{all}– where the test lacks the lowest half octave, or the reference has no power\n"
    ));
    text
}

/// The share of the reference's energy that the test keeps, for each level and band.
fn haar_table(summary: &Summary) -> Text {
    let haar = Subject::Metric(Metric::Haar);
    let Some(energy) = Key::named(haar, "energy").map(|key| key.of_image(Image::Ratio)) else {
        return Text::default();
    };
    let of_haar = summary.compared.keys().filter(|key| key.subject == haar);
    let levels = of_haar.filter_map(|key| key.level).max().map_or(0, |level| level as usize);
    if levels == 0 {
        return Text::default();
    }
    let names = (1..=levels).map(|level| format!("level {level}"));
    let header = ["Haar energy, test / reference".to_owned()].into_iter().chain(names);
    let mut table = TextTable::new(header);
    for (index, band) in summary.bands.iter().enumerate() {
        let ratio = |level: usize| {
            let found = summary.compared.get(&energy.on_level(level).in_band(index));
            percent(found.and_then(|statistics| statistics.ratio))
        };
        let label = format!("{}° to {}°", band.from_deg, band.to_deg);
        table.add_row([label].into_iter().chain((1..=levels).map(ratio)));
    }
    let mut text = Text::from("\n".to_owned());
    text.push_table(table);
    text
}

fn missing() -> String {
    "–".to_owned()
}

fn percent(ratio: Option<f64>) -> String {
    ratio.map_or_else(missing, |ratio| format!("{:.1} %", ratio * 100.0))
}

fn fvvdp_in_words(fvvdp: &FvvdpSummary) -> String {
    let FvvdpSummary { pixels_per_degree, peak_cd_m2, black_cd_m2, .. } = *fvvdp;
    let looked_at = if fvvdp.foveated { "" } else { ", not foveated" };
    let rate = fvvdp.fps.map(|fps| format!(", {fps} frames/s")).unwrap_or_default();
    let display = format!(
        "display of {peak_cd_m2} cd/m², black {black_cd_m2:.3} cd/m², {pixels_per_degree:.2} px/°{rate}{looked_at}"
    );
    let Some(jod) = fvvdp.jod else {
        let reason = fvvdp.reason.as_deref().unwrap_or("no frame could be scored");
        return format!("FovVideoVDP: no value: {reason}\n{display}");
    };
    let frames = match fvvdp.frame_jod.filter(|_| fvvdp.frames > 1) {
        Some(spread) => format!("; single frames {:.3} to {:.3}", spread.min, spread.max),
        None => String::new(),
    };
    format!("FovVideoVDP: {jod:.3} JOD (10: no visible difference){frames}\n{display}")
}

fn temporal_in_words(metric: Metric, of: &TemporalSummary) -> String {
    let label = metric.info().label;
    let (Some(reference), Some(test)) = (of.reference, of.test) else {
        let reason = of.reason.as_deref().unwrap_or("no value");
        return format!("{label}: no value: {reason}");
    };
    let ratio = of.ratio.map(|_| format!(", {} of it", percent(of.ratio))).unwrap_or_default();
    let left_out = of.left_out.unwrap_or(0.0) * 100.0;
    let along = match of.motion {
        GuideSource::None => "without motion vectors, so that all movement counts",
        GuideSource::Reference => "along the reference's motion",
        GuideSource::Test => "each along its own motion",
    };
    let depth = match of.depth {
        GuideSource::None => "",
        GuideSource::Reference | GuideSource::Test => " and depth",
    };
    let depth = if of.motion == GuideSource::None { "" } else { depth };
    format!(
        "{label}: reference {}, test {}{ratio}; {along}{depth}; {left_out:.2} % of pixels left out",
        number(metric, reference),
        number(metric, test),
    )
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
            Some(1) => "from a trace, kept from an earlier frame in 1 frame".to_owned(),
            Some(held) => format!("from a trace, kept from an earlier frame in {held} frames"),
        };
        let _ = writeln!(
            text,
            "view {w}x{h} px, focal length {focal} px, gaze {gaze}, {} eccentricity",
            view.eccentricity.word()
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
