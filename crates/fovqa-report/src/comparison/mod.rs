//! Tables that compare methods. [`values`] has the numbers by scene, measure and method, with the
//! best ones marked ([`marks`]); [`layout`] arranges them in rows and columns ([`grid`]), and each
//! format has a file that writes these. The numbers come from whole frames ([`scenes`]) or from
//! eccentricity bands ([`ratios`]).

mod average;
mod column;
mod csv;
mod grid;
mod html;
mod latex;
mod layout;
mod markdown;
mod marks;
mod measure;
mod notes;
mod ratios;
mod scenes;
mod terminal;
mod values;

use fovqa_plan::TableLayout;

pub(crate) use average::{average_label, common_scenes};
use grid::Grid;
pub(crate) use markdown::escaped_markdown;
use marks::Mark;
pub(crate) use measure::Measure;
pub(crate) use ratios::{DEFAULT_STATISTIC, Ratios, statistic, statistic_in_words};
use values::Values;
pub(crate) use values::mean;

/// A table that compares methods.
#[derive(Debug, Clone, PartialEq)]
pub struct ComparisonTable {
    /// What the table shows.
    title: String,
    /// The author's caption, which replaces the title and the description in LaTeX.
    caption: Option<String>,
    /// The label in LaTeX; empty for none.
    label: String,
    layout: TableLayout,
    /// What the values are, as a sentence.
    means: String,
    notes: Vec<String>,
    values: Box<Values>,
}

impl ComparisonTable {
    /// The caption of the table.
    pub fn caption(&self) -> &str {
        self.caption.as_deref().unwrap_or(&self.title)
    }

    /// Remarks that must be shown together with the numbers.
    pub fn notes(&self) -> Vec<String> {
        std::iter::once(self.means.clone()).chain(self.notes.iter().cloned()).collect()
    }

    /// The table with another label in LaTeX.
    pub(crate) fn labelled(self, label: String) -> Self {
        Self { label, ..self }
    }

    /// Whether the table is one of scenes, not of eccentricity bands.
    pub(crate) fn is_of_scenes(&self) -> bool {
        self.values.items_are == values::Items::Scenes
    }

    fn grid(&self) -> Grid {
        layout::arrange(&self.values, self.layout)
    }
}

/// How the marked values look, as a sentence; empty if none is marked.
fn legend(grid: &Grid, best: &str, second: &str) -> String {
    let has = |mark: Mark| grid.cells().any(|cell| cell.mark == mark);
    match (has(Mark::Best), has(Mark::Second)) {
        (false, _) => String::new(),
        (true, false) => format!("Best: {best}."),
        (true, true) => format!("Best: {best}; second best: {second}."),
    }
}

/// The names that a list contains, in its order; all names if there is no list.
pub(crate) fn named<'a>(
    wanted: Option<&[String]>,
    known: impl Iterator<Item = &'a str> + Clone,
) -> Vec<&'a str> {
    match wanted {
        None => known.collect(),
        Some(wanted) => {
            let mut found: Vec<&str> = Vec::new();
            for name in wanted {
                let same = known.clone().find(|known| known == name);
                found.extend(same.filter(|name| !found.contains(name)));
            }
            found
        }
    }
}
