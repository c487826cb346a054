//! Writes the table for a paper.

use fovqa_metrics::Better;

use super::grid::{Grid, Label};
use super::marks::Mark;
use super::measure::{Digits, Measure};
use super::values::Cell;
use super::{ComparisonTable, legend};
use crate::latex::{self, Column, Group, Head, Number, Section, Sheet, power_of_ten, scaled};

impl ComparisonTable {
    /// A complete `table` float with caption and label. The best values are bold, the second best
    /// ones underlined. It needs `\usepackage{booktabs}`.
    pub fn latex(&self) -> String {
        let grid = self.grid();
        let powers = Powers::of(&grid, self.values.measures.len());
        let mut columns = vec![Column {
            head: Head::named(capital(&grid.corner)),
            is_text: true,
            is_repeated: true,
        }];
        let mut groups = Vec::new();
        for group in &grid.groups {
            let first = columns.len();
            columns.extend(group.columns.iter().map(|label| Column {
                head: powers.head(label),
                is_text: false,
                is_repeated: false,
            }));
            let last = columns.len() - 1;
            let head = group.head.as_ref().map(|head| powers.head(head));
            groups.extend(head.map(|head| Group { head, first, last }));
        }
        let mut sections: Vec<Section> = Vec::new();
        for section in &grid.sections {
            let mut was_average = None;
            for row in &section.rows {
                // A rule separates the average from the scenes.
                if was_average != Some(row.is_average) {
                    let title = if was_average.is_none() { &section.title } else { "" };
                    sections.push(Section { title: title.to_owned(), rows: Vec::new() });
                }
                was_average = Some(row.is_average);
                let label = match &row.label {
                    Label::Name(name) => name.clone(),
                    Label::Measure(index, measure) => powers.row(*index, measure),
                };
                let cells = row.cells.iter().map(|cell| latex::Cell::Number(powers.number(cell)));
                let cells = [latex::Cell::Text(label)].into_iter().chain(cells).collect();
                sections.last_mut().into_iter().for_each(|last| last.rows.push(Vec::clone(&cells)));
            }
        }
        Sheet {
            comments: self.notes(),
            caption: self.latex_caption(&grid),
            label: self.label.clone(),
            columns,
            groups,
            sections,
        }
        .text()
    }

    fn latex_caption(&self, grid: &Grid) -> String {
        if let Some(caption) = &self.caption {
            return caption.clone();
        }
        let subject = match grid.subject.as_str() {
            "" => String::new(),
            _ if self.values.items[0].is_average => format!(", {}", grid.subject.to_lowercase()),
            scene => format!(", {scene}"),
        };
        let marks = legend(grid, "bold", "underlined");
        let about = format!("{}{subject}. {} {marks}", self.title, self.means);
        about.trim_end().to_owned()
    }
}

fn capital(name: &str) -> String {
    let mut chars = name.chars();
    let first: String = chars.next().map(|c| c.to_uppercase().collect()).unwrap_or_default();
    first + chars.as_str()
}

/// The powers of ten that are written once, in the heading of a measure, rather than in each cell.
struct Powers(Vec<Option<i32>>);

impl Powers {
    fn of(grid: &Grid, measures: usize) -> Self {
        let of = |index: usize| {
            let cells = || grid.cells().filter(|cell| cell.measure == index);
            let is_scientific = cells().any(|cell| cell.digits == Digits::Scientific);
            is_scientific.then(|| scaled(cells().filter_map(|cell| cell.value))).flatten()
        };
        Self((0..measures).map(of).collect())
    }

    fn head(&self, label: &Label) -> Head {
        let (index, measure) = match label {
            Label::Name(name) => return Head::named(name.clone()),
            Label::Measure(index, measure) => (*index, measure),
        };
        Head {
            name: measure.label.clone(),
            unit: measure.unit.to_owned(),
            higher_is_better: match measure.better {
                Better::Higher => Some(true),
                Better::Lower => Some(false),
                Better::Neither => None,
            },
            power: self.0[index],
        }
    }

    /// The heading of a row.
    fn row(&self, index: usize, measure: &Measure) -> String {
        match self.0[index] {
            None => measure.heading(),
            Some(power) => {
                let plain = Measure { unit: "", ..measure.clone() };
                let unit = if measure.unit.is_empty() { "" } else { " " };
                let heading = plain.heading();
                let (label, arrow) = heading.split_at(measure.label.len());
                format!("{label} (10{}{unit}{}){arrow}", superscript(power), measure.unit)
            }
        }
    }

    fn number(&self, cell: &Cell) -> Number {
        let power = self.0[cell.measure];
        let shown = |value: f64| match power {
            Some(power) if value.is_finite() => format!("{:.2}", value / power_of_ten(power)),
            _ => cell.digits.shown(Some(value)),
        };
        Number {
            value: cell.value.map_or_else(|| "–".to_owned(), shown),
            spread: cell.spread.map(shown).unwrap_or_default(),
            is_best: cell.mark == Mark::Best,
            is_second: cell.mark == Mark::Second,
        }
    }
}

/// A number in the characters for exponents.
fn superscript(power: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digit = |c: char| c.to_digit(10).map_or('⁻', |digit| DIGITS[digit as usize]);
    power.to_string().chars().map(digit).collect()
}
