//! The text that `fovqa foveate` prints: the method, and how many samples it would have shaded.

use std::fmt::Write;

use fovqa_params::ParamValue;
use fovqa_results::{BudgetRecord, FoveateRecord, FoveatedRecord};

use crate::text::Text;
use crate::text_table::{TextTable, printable};

/// Largest number of rows of the table, so that it fits on a terminal.
const MOST_ROWS: usize = 20;

/// The record as text. Frames in a row with the same numbers share a row of the table.
pub fn foveate_text(record: &FoveateRecord) -> Text {
    let mut text = Text::from(heading(record));
    let runs = runs(&record.frames);
    let has_quads = record.frames.iter().any(|frame| frame.quads.is_some());
    let mut header = vec!["frame", "samples", "on screen", "beyond", "share of pixels"];
    header.extend(has_quads.then_some("quads"));
    let mut table = TextTable::new(header);
    for run in runs.iter().take(MOST_ROWS) {
        let [first, .., last] = run else {
            table.add_row(row(run[0].frame.to_string(), &run[0], has_quads));
            continue;
        };
        let name = format!("{} to {}", first.frame, last.frame);
        table.add_row(row(name, first, has_quads));
    }
    text.push_str("\n");
    text.push_table(table);
    let more = runs.len().saturating_sub(MOST_ROWS);
    if more > 0 {
        let _ = writeln!(text, "{more} more rows; --format json lists all frames");
    }
    if let Some(budget) = &record.budget {
        let moves = record.frames.iter().any(|frame| frame.budget.is_some());
        let _ = writeln!(text, "\n{}", budget_in_words(budget, moves));
    }
    text
}

fn heading(record: &FoveateRecord) -> String {
    let mut text = String::new();
    let parameters = record.parameters.iter();
    let parameters: Vec<String> =
        parameters.map(|(name, value)| format!("{name} = {}", in_words(value))).collect();
    let method = record.method.replace('_', "-");
    let separator = if parameters.is_empty() { "" } else { ": " };
    let _ = writeln!(text, "{method}{separator}{}", parameters.join(", "));
    let mut around = vec![format!("{} sampling", record.sampling)];
    around.extend((record.filter != "none").then(|| format!("filter {}", record.filter)));
    around.push(format!("{} values", record.space));
    around.extend(record.temporal.then(|| "temporal filter".to_owned()));
    around.extend(record.enhance.map(|f_max| format!("enhancement up to {f_max}")));
    let _ = writeln!(text, "{}", around.join(", "));
    match record.frames.as_slice() {
        // Frames that were handed over in memory have no files.
        [frame] if frame.output.is_empty() => {}
        [first, .., last] if last.output.is_empty() => {
            let (count, first, last) = (record.frames.len(), first.frame, last.frame);
            let _ = writeln!(text, "{count} frames, {first} to {last}");
        }
        [frame] => {
            let (input, output) = (printable(&frame.input), printable(&frame.output));
            let _ = writeln!(text, "{input} to {output}");
        }
        [first, .., last] => {
            let _ = writeln!(
                text,
                "{} frames, {} to {}, in {} to {}",
                record.frames.len(),
                first.frame,
                last.frame,
                printable(&first.output),
                printable(&last.output)
            );
        }
        [] => {}
    }
    text
}

fn row(name: String, frame: &FoveatedRecord, has_quads: bool) -> Vec<String> {
    let mut row = vec![
        name,
        count(frame.samples),
        count(frame.samples_on_screen),
        count(frame.samples_beyond),
        percent(frame.samples_share),
    ];
    if has_quads {
        row.push(frame.quads.map(|quads| quads.to_string()).unwrap_or_default());
    }
    row
}

/// Frames in a row with the same numbers.
fn runs(frames: &[FoveatedRecord]) -> Vec<&[FoveatedRecord]> {
    let key = |frame: &FoveatedRecord| {
        let counts = [frame.samples, frame.samples_on_screen, frame.samples_beyond];
        (counts.map(f64::to_bits), frame.quads)
    };
    frames.chunk_by(|a, b| key(a) == key(b)).collect()
}

fn budget_in_words(budget: &BudgetRecord, moves: bool) -> String {
    let BudgetRecord { share, of, parameter, value, ideal_share, rounded_share } = budget;
    let of = match *of {
        "on_screen" => "samples on screen",
        _ => "samples of the buffer",
    };
    let first = if moves { " (of the first frame; the gaze moves)" } else { "" };
    format!(
        "budget: {} of the pixels asked, as {of}; ideal buffer {}, rounded buffer {}; {parameter} = {}{first}",
        percent(*share),
        percent(*ideal_share),
        percent(*rounded_share),
        in_words(value)
    )
}

fn in_words(value: &ParamValue) -> String {
    match value {
        ParamValue::Text(word) => word.clone(),
        value => value.in_words(),
    }
}

fn count(number: f64) -> String {
    if number.fract() == 0.0 { format!("{number:.0}") } else { format!("{number:.1}") }
}

fn percent(share: f64) -> String {
    format!("{:.2} %", share * 100.0)
}
