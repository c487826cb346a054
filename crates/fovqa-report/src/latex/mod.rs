//! Tables for papers: complete LaTeX floats with the rules of the booktabs package. The other files
//! of this folder know nothing about scenes, methods or curves.

mod cells;
mod escape;
mod floats;
mod head;
mod number;
mod parts;
mod width;

use std::fmt::Write;

pub(crate) use number::{Number, power_of_ten, scaled};

use crate::text_table::printable;

/// A table, before it is divided into floats that fit on a page.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Sheet {
    /// Remarks for the author, one line each.
    pub(crate) comments: Vec<String>,
    /// The caption, as plain text.
    pub(crate) caption: String,
    /// The label; empty for none.
    pub(crate) label: String,
    pub(crate) columns: Vec<Column>,
    /// Headings over several columns. They are in order and do not overlap.
    pub(crate) groups: Vec<Group>,
    pub(crate) sections: Vec<Section>,
}

/// A column. All texts are plain.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Column {
    pub(crate) head: Head,
    /// Whether its cells are names. They are aligned to the left and wrapped if they are long.
    pub(crate) is_text: bool,
    /// Whether every part of a divided table repeats it.
    pub(crate) is_repeated: bool,
}

/// A heading.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Head {
    pub(crate) name: String,
    /// The unit; empty for none.
    pub(crate) unit: String,
    /// `Some(true)` if higher values are better, `Some(false)` if lower ones are.
    pub(crate) higher_is_better: Option<bool>,
    /// The power of ten by which values are divided.
    pub(crate) power: Option<i32>,
}

impl Head {
    pub(crate) fn named(name: impl Into<String>) -> Self {
        Self { name: name.into(), ..Self::default() }
    }
}

/// A heading over the columns from `first` to `last`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Group {
    pub(crate) head: Head,
    pub(crate) first: usize,
    pub(crate) last: usize,
}

/// Rows between two rules.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Section {
    /// A line above the rows; empty for none.
    pub(crate) title: String,
    /// The rows, each with one cell per column.
    pub(crate) rows: Vec<Vec<Cell>>,
}

/// A cell.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Cell {
    Text(String),
    Number(Number),
}

impl Sheet {
    /// The LaTeX text. It needs `\usepackage{booktabs}`, and nothing else.
    pub(crate) fn text(&self) -> String {
        let drawn = floats::floats(self);
        let mut text = String::from("% Needs \\usepackage{booktabs} before \\begin{document}.\n");
        let inches = drawn.width / width::INCH;
        let wide =
            if drawn.is_wide { "; table* spans both columns of a page with two" } else { "" };
        let _ = writeln!(text, "% The table is about {inches:.1} in wide at 10 pt{wide}.");
        for comment in &self.comments {
            let _ = writeln!(text, "% {}", printable(comment));
        }
        let missing = self.not_printed();
        if !missing.is_empty() {
            let _ = writeln!(
                text,
                "% pdflatex has no letters for {missing}. Use lualatex or xelatex with a font that has them \
                 (\\usepackage[T1]{{fontenc}} is enough for Latin letters)."
            );
        }
        text.push_str(&drawn.text);
        text
    }

    /// The characters that pdflatex does not print.
    fn not_printed(&self) -> String {
        let heads = self.columns.iter().map(|column| &column.head);
        let heads = heads.chain(self.groups.iter().map(|group| &group.head));
        let heads = heads.flat_map(|head| [&head.name, &head.unit]);
        let titles = self.sections.iter().map(|section| &section.title);
        let cells = self.sections.iter().flat_map(|section| section.rows.iter().flatten());
        let cells = cells.filter_map(|cell| match cell {
            Cell::Text(text) => Some(text),
            Cell::Number(_) => None,
        });
        let texts = heads.chain(titles).chain(cells).chain([&self.caption]);
        let mut found: Vec<char> = texts.flat_map(|text| escape::not_printed(text)).collect();
        found.sort_unstable();
        found.dedup();
        found.into_iter().map(String::from).collect::<Vec<_>>().join(" ")
    }
}

/// The usual label of a table, from the names of its experiment and its files as parts of file
/// names. It has only letters and digits that every LaTeX takes.
pub(crate) fn usual_label(experiment: &str, table: &str) -> String {
    let plain = |name: &str| name.chars().filter(char::is_ascii).collect::<String>();
    let parts = [plain(experiment), plain(table)];
    let parts: Vec<String> = parts.into_iter().filter(|part| !part.is_empty()).collect();
    format!("tab:{}", parts.join("-"))
}

#[cfg(test)]
mod tests;
