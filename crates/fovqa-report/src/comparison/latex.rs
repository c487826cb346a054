//! The table for a paper: a LaTeX `tabular`, with the rules of the booktabs package.

use std::fmt::Write;

use fovqa_metrics::{Better, Metric};

use super::{ComparisonTable, Row, shown};

impl ComparisonTable {
    /// A `tabular` to be put into a `table`; the best of each row in bold. Needs
    /// `\usepackage{booktabs}`.
    pub fn latex(&self) -> String {
        let mut text = String::new();
        for note in &self.notes {
            let _ = writeln!(text, "% {note}");
        }
        let methods = self.methods.len();
        let columns = format!(" {}", "r".repeat(methods)).repeat(self.metrics.len());
        let _ = writeln!(text, "\\begin{{tabular}}{{l{columns}}}\n\\toprule");
        for metric in &self.metrics {
            let _ = write!(text, " & \\multicolumn{{{methods}}}{{c}}{{{}}}", heading(*metric));
        }
        text.push_str(" \\\\\n");
        for index in 0..self.metrics.len() {
            let first = 2 + index * methods;
            let _ = write!(text, "\\cmidrule(lr){{{first}-{}}}", first + methods - 1);
        }
        text.push_str("\nscene");
        for _ in &self.metrics {
            for method in &self.methods {
                let _ = write!(text, " & {}", escaped(method));
            }
        }
        text.push_str(" \\\\\n\\midrule\n");
        for row in &self.rows {
            if row.average {
                text.push_str("\\midrule\n");
            }
            self.latex_row(row, &mut text);
        }
        text.push_str("\\bottomrule\n\\end{tabular}\n");
        text
    }

    fn latex_row(&self, row: &Row, text: &mut String) {
        text.push_str(&escaped(&row.label));
        for (metric, cells) in self.metrics.iter().zip(&row.cells) {
            for cell in cells {
                let number = number(*metric, cell.value);
                if cell.best {
                    // Mathematics is bold by a switch of its own.
                    let switch = if number.contains('$') { "\\boldmath" } else { "" };
                    let _ = write!(text, " & \\textbf{{{switch}{number}}}");
                } else {
                    let _ = write!(text, " & {number}");
                }
            }
        }
        text.push_str(" \\\\\n");
    }
}

fn heading(metric: Metric) -> String {
    let info = metric.info();
    let unit = if info.unit.is_empty() { String::new() } else { format!(" ({})", info.unit) };
    let arrow = match info.better {
        Better::Higher => "$\\uparrow$",
        Better::Lower => "$\\downarrow$",
        Better::Neither => "",
    };
    format!("{}{unit} {arrow}", escaped(info.label))
}

fn number(metric: Metric, value: Option<f64>) -> String {
    match value {
        None => "--".to_owned(),
        Some(value) if value.is_infinite() => "$\\infty$".to_owned(),
        value => {
            let text = shown(metric, value);
            // 1.36e-3 is code, and no number of a paper.
            match text.split_once('e') {
                Some((digits, exponent)) => format!("${digits} \\cdot 10^{{{exponent}}}$"),
                None => text,
            }
        }
    }
}

/// Text that LaTeX takes as it is.
fn escaped(text: &str) -> String {
    let mut plain = String::new();
    for c in text.chars() {
        match c {
            '&' | '%' | '$' | '#' | '_' | '{' | '}' => plain.extend(['\\', c]),
            '~' => plain.push_str("\\textasciitilde{}"),
            '^' => plain.push_str("\\textasciicircum{}"),
            '\\' => plain.push_str("\\textbackslash{}"),
            '<' => plain.push_str("\\textless{}"),
            '>' => plain.push_str("\\textgreater{}"),
            '|' => plain.push_str("\\textbar{}"),
            '"' => plain.push_str("''"),
            c => plain.push(c),
        }
    }
    plain
}
