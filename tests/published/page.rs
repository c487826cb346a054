//! The page: one table a paper, then what is not reproduced, in Markdown that reads in a terminal too.

use std::fmt::Write;

use super::printed::{CLOSE, Verdict};
use super::row::{PageRow, Paper};

/// All rows as a page of Markdown.
pub(super) fn page(rows: &[PageRow]) -> String {
    let mut text = "<!-- Made by `make published-numbers`; do not edit. -->\n\n".to_owned();
    text.push_str("# The papers' numbers\n\n");
    let close = 100.0 * CLOSE;
    let _ = write!(
        text,
        "\
Numbers that four papers print, beside those that this program computes from the same models. A verdict
follows from the printed digits alone, and none is bent to fit:

- **reproduced**: the computed number gives the printed digits by rounding (a tie may go either way) or,
  where said, by cutting off;
- **close**: it does not, but is within {close} % of the printed number;
- **not reproduced**: neither; the reasons stand at the end;
- **not independent**: it gives the printed digits, but something that went into it was read off them;
- **not checked**: the paper's table is not at hand.

Of several numbers in a row the worst decides, and the relative error is the largest.
"
    );
    for paper in Paper::ALL {
        let rows: Vec<&PageRow> = rows.iter().filter(|row| row.paper == paper).collect();
        let _ = write!(text, "\n## {}\n\n{}.\n\n", paper.name(), paper.reference());
        table(&mut text, &rows);
    }
    closing(&mut text, rows);
    text
}

const HEADER: [&str; 7] =
    ["place", "quantity", "printed", "computed", "rel. error", "verdict", "why"];

/// The columns of numbers, which stand to the right.
const NUMBERS: std::ops::RangeInclusive<usize> = 2..=4;

/// A paper's table, padded, and the notes below it.
fn table(text: &mut String, rows: &[&PageRow]) {
    let mut notes = Vec::new();
    let mut lines = vec![HEADER.map(str::to_owned)];
    for row in rows {
        let mut why = row.why.clone();
        match (row.verdict(), &row.more) {
            (Verdict::NotChecked, _) => "the tables were not given".clone_into(&mut why),
            // Told at the end.
            (Verdict::NotReproduced, _) | (_, None) => {}
            (_, Some(more)) => {
                let known = notes.iter().position(|note| note == more);
                let number = known.unwrap_or_else(|| {
                    notes.push(more.clone());
                    notes.len() - 1
                });
                let _ = write!(why, " ({})", number + 1);
            }
        }
        lines.push([
            row.place.to_owned(),
            row.quantity.clone(),
            row.printed(),
            row.computed(),
            row.relative_error().map_or_else(|| "–".to_owned(), percent),
            row.verdict().words().to_owned(),
            why,
        ]);
    }
    let lines: Vec<[String; 7]> = lines.into_iter().map(|line| line.map(|c| escaped(&c))).collect();
    let width = |column: usize| lines.iter().map(|line| line[column].chars().count()).max();
    let widths: [usize; 7] = std::array::from_fn(|column| width(column).unwrap_or_default());
    for (i, line) in lines.iter().enumerate() {
        for (column, (cell, width)) in line.iter().zip(widths).enumerate() {
            let _ = if NUMBERS.contains(&column) {
                write!(text, "| {cell:>width$} ")
            } else {
                write!(text, "| {cell:<width$} ")
            };
        }
        text.push_str("|\n");
        if i == 0 {
            for (column, width) in widths.into_iter().enumerate() {
                let (left, right) = if NUMBERS.contains(&column) { ("-", ":") } else { (":", "-") };
                let _ = write!(text, "| {left}{}{right} ", "-".repeat(width - 2));
            }
            text.push_str("|\n");
        }
    }
    if !notes.is_empty() {
        text.push('\n');
    }
    for (i, note) in notes.iter().enumerate() {
        let _ = writeln!(text, "{}. {}", i + 1, escaped(note));
    }
}

/// What is not reproduced, and what is not checked.
fn closing(text: &mut String, rows: &[PageRow]) {
    let with = |verdict| rows.iter().filter(move |row| row.verdict() == verdict);
    text.push_str("\n## Not reproduced, and why\n\n");
    for row in with(Verdict::NotReproduced) {
        let place = format!("{}, {}: {}", row.paper.name(), row.place, row.quantity);
        let numbers = format!("printed {}, computed {}", row.printed(), row.computed());
        let _ = write!(text, "- **{}**: {}", escaped(&place), escaped(&numbers));
        let exceptions = row.exceptions();
        if !exceptions.is_empty() {
            let missing: Vec<String> = exceptions
                .iter()
                .map(|c| format!("{} ({}, not {})", c.name, c.computed_text(), c.printed.text()))
                .collect();
            let _ = write!(text, "; without {}", escaped(&missing.join(", ")));
        }
        let _ = writeln!(text, ". {}", escaped(row.more.as_ref().unwrap_or(&row.why)));
    }
    if with(Verdict::NotChecked).next().is_some() {
        text.push_str("\n## Not checked: the tables were not given\n\n");
        for row in with(Verdict::NotChecked) {
            let _ = writeln!(text, "- {}, {}: {}", row.paper.name(), row.place, row.quantity);
        }
    }
}

/// A share as a signed percentage of two digits.
fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    // What computing itself leaves over.
    if percent.abs() < 1e-9 {
        return "0 %".to_owned();
    }
    if !percent.is_finite() {
        return "–".to_owned();
    }
    let decimals = (1.0 - percent.abs().log10().floor()).clamp(0.0, 12.0) as usize;
    format!("{percent:+.decimals$} %").replace('-', "−")
}

/// Text that Markdown takes as it is.
fn escaped(text: &str) -> String {
    let mut plain = String::new();
    for c in text.chars() {
        if matches!(c, '|' | '*' | '`' | '\\' | '[' | ']') {
            plain.push('\\');
        }
        plain.push(c);
    }
    plain
}
