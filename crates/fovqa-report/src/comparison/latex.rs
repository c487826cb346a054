//! The table for a paper: a LaTeX `tabular`, with the rules of the booktabs package.

use std::fmt::Write;

use fovqa_metrics::Better;

use super::group::Group;
use super::{ComparedRow, ComparisonTable};
use crate::text_table::printable;

impl ComparisonTable {
    /// A `tabular` for use in a `table`. The best value of each row is bold. Needs
    /// `\usepackage{booktabs}`.
    pub fn latex(&self) -> String {
        let mut text = String::new();
        for note in &self.notes {
            let _ = writeln!(text, "% {}", printable(note));
        }
        let methods = self.methods.len();
        let columns = format!(" {}", "r".repeat(methods)).repeat(self.groups.len());
        let _ = writeln!(text, "\\begin{{tabular}}{{l{columns}}}\n\\toprule");
        for group in &self.groups {
            let _ = write!(text, " & \\multicolumn{{{methods}}}{{c}}{{{}}}", heading(group));
        }
        text.push_str(" \\\\\n");
        for index in 0..self.groups.len() {
            let first = 2 + index * methods;
            let _ = write!(text, "\\cmidrule(lr){{{first}-{}}}", first + methods - 1);
        }
        let _ = write!(text, "\n{}", self.corner);
        for _ in &self.groups {
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

    fn latex_row(&self, row: &ComparedRow, text: &mut String) {
        text.push_str(&escaped(&row.label));
        for (group, cells) in self.groups.iter().zip(&row.cells) {
            for cell in cells {
                let number = number(group, cell.value);
                if cell.best {
                    // Mathematics needs its own command for bold.
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

fn heading(group: &Group) -> String {
    let unit = match group.unit {
        "" => String::new(),
        unit => format!(" ({})", escaped(unit)),
    };
    let arrow = match group.better {
        Better::Higher => " $\\uparrow$",
        Better::Lower => " $\\downarrow$",
        Better::Neither => "",
    };
    format!("{}{unit}{arrow}", escaped(&group.label))
}

fn number(group: &Group, value: Option<f64>) -> String {
    match value {
        None => "--".to_owned(),
        Some(value) if value.is_infinite() => "$\\infty$".to_owned(),
        value => {
            let text = group.shown(value);
            // Papers do not write numbers as 1.36e-3, which is the notation of code.
            match text.split_once('e') {
                Some((digits, exponent)) => format!("${digits} \\cdot 10^{{{exponent}}}$"),
                None => text,
            }
        }
    }
}

/// Escapes text so that LaTeX prints it unchanged.
fn escaped(text: &str) -> String {
    let mut plain = String::new();
    for c in printable(text).chars() {
        match c {
            '&' | '%' | '$' | '#' | '_' | '{' | '}' => plain.extend(['\\', c]),
            '~' => plain.push_str("\\textasciitilde{}"),
            '^' => plain.push_str("\\textasciicircum{}"),
            '\\' => plain.push_str("\\textbackslash{}"),
            '<' => plain.push_str("\\textless{}"),
            '>' => plain.push_str("\\textgreater{}"),
            '|' => plain.push_str("\\textbar{}"),
            '"' => plain.push_str("''"),
            '°' => plain.push_str("$^{\\circ}$"),
            c => plain.push(c),
        }
    }
    plain
}
