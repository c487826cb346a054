//! The contents of a baseline, and its differences from a new one, as text for a terminal.

use std::fmt::Write as _;

use fovqa_results::{Baseline, Difference};

use super::digits::number;
use crate::text::Text;
use crate::text_table::{TextTable, printable};

/// The contents of a baseline.
pub fn baseline_table(baseline: &Baseline) -> Text {
    let mut text = Text::from(format!(
        "{}, by fovqa {}: {} comparisons\n\n",
        printable(&baseline.experiment),
        printable(&baseline.version),
        baseline.comparisons.len()
    ));
    let mut table = TextTable::new(["of", "value", ""]);
    for comparison in &baseline.comparisons {
        for (quantity, value) in comparison.values() {
            table.add_row([printable(&comparison.named()), printable(quantity), number(value)]);
        }
    }
    text.push_table(table);
    text.push_str("\n");
    let metrics = baseline.metrics.iter().map(|(key, metric)| format!("{key} {}", metric.version));
    let metrics: Vec<String> = metrics.collect();
    let _ = writeln!(text, "versions of metrics: {}", printable(&metrics.join(", ")));
    for (folder, group) in &baseline.inputs {
        let digest = group.sha256.get(..16).unwrap_or(&group.sha256);
        let folder = if folder.is_empty() { "." } else { folder };
        let files = if group.files == 1 { "file" } else { "files" };
        let _ = writeln!(
            text,
            "{}: {} {files}, SHA-256 {}…",
            printable(folder),
            group.files,
            printable(digest)
        );
    }
    text
}

/// All values that differ; empty if there are none.
pub fn difference_table(differences: &[Difference]) -> Text {
    let mut text = Text::default();
    if differences.is_empty() {
        return text;
    }
    let mut table = TextTable::new(["of", "value", "baseline", "run", "change"]);
    for Difference { place, quantity, before, after } in differences {
        let shown = |value: &Option<f64>| value.map_or_else(|| "–".to_owned(), number);
        let change = before.zip(*after).map(|(before, after)| after - before);
        let change = change.filter(|change| change.is_finite()).map(|change| {
            let sign = if change >= 0.0 { "+" } else { "" };
            format!("{sign}{}", number(change))
        });
        table.add_row([
            printable(place),
            printable(quantity),
            shown(before),
            shown(after),
            change.unwrap_or_default(),
        ]);
    }
    text.push_table(table);
    text
}
