//! The table for the page of a run.

use super::grid::{Grid, Group, Label, Section};
use super::marks::Mark;
use super::values::{Cell, Items};
use super::{ComparisonTable, legend};
use crate::html_table::{
    Emphasis, GroupHeading, Heading, HtmlCell, HtmlColumn, HtmlRow, HtmlSection, HtmlTable, full,
};

/// Maximum number of rows and columns of a table that the page shows in full. A longer one scrolls.
const MOST_LINES: usize = 40;
/// Maximum number of cells. A page with more cells opens too slowly.
const MOST_CELLS: usize = 200_000;

impl ComparisonTable {
    /// Whether the table has so many rows or columns that it scrolls in a box of its own.
    pub(crate) fn is_long(&self) -> bool {
        let grid = self.grid();
        grid.rows().count() > MOST_LINES || grid.columns() > MOST_LINES
    }

    /// The layout of the table in HTML; `None` if it is too large for a page.
    pub(crate) fn html(&self) -> Option<HtmlTable> {
        let grid = self.grid();
        if grid.cells().count() > MOST_CELLS {
            return None;
        }
        let groups = grid.groups.iter().filter(|_| grid.has_group_heads());
        let columns = grid.groups.iter().flat_map(|group| {
            group
                .columns
                .iter()
                .map(|column| HtmlColumn { heading: self.column(group, column), is_text: false })
        });
        Some(HtmlTable {
            caption: self.caption().to_owned(),
            is_long: self.is_long(),
            corner: Heading::plain(grid.first_heading()),
            groups: groups.map(|group| self.group(group)).collect(),
            columns: columns.collect(),
            sections: grid.sections.iter().map(|section| self.section(&grid, section)).collect(),
            explained: self.explained(),
        })
    }

    /// What the marks on the page mean.
    pub(crate) fn html_legend(&self) -> String {
        legend(&self.grid(), "bold", "underlined")
    }

    fn group(&self, group: &Group) -> GroupHeading {
        let heading = group.head.as_ref().map(|head| self.heading(head)).unwrap_or_default();
        GroupHeading { heading, span: group.columns.len() }
    }

    /// A column below a measure has its values, and says so too.
    fn column(&self, group: &Group, column: &Label) -> Heading {
        let own = self.heading(column);
        let measure = group.head.as_ref().map(|head| self.heading(head).about);
        let about = [measure.unwrap_or_default(), own.about].join(" ");
        Heading { about: about.trim().to_owned(), ..own }
    }

    fn heading(&self, label: &Label) -> Heading {
        let about = match label {
            Label::Measure(_, measure) => measure.about.clone(),
            Label::Name(name) if self.is_band(name) => {
                format!("Pixels whose eccentricity, the angle from the gaze, is {name}.")
            }
            Label::Name(_) => String::new(),
        };
        Heading { text: label.heading(), about }
    }

    fn is_band(&self, name: &str) -> bool {
        let mut bands = self.values.items.iter().filter(|item| !item.is_average);
        self.values.items_are == Items::Bands && bands.any(|band| band.label == name)
    }

    fn section(&self, grid: &Grid, section: &Section) -> HtmlSection {
        let measures = &self.values.measures;
        let measure = measures.iter().find(|measure| measure.heading() == section.title);
        let title = Heading {
            text: section.title.clone(),
            about: measure.map(|measure| measure.about.clone()).unwrap_or_default(),
        };
        let begins = |group: &Group| (0..group.columns.len()).map(|index| index == 0);
        let begins: Vec<bool> = grid.groups.iter().flat_map(begins).collect();
        let rows = section.rows.iter().map(|row| HtmlRow {
            heading: self.heading(&row.label),
            is_average: row.is_average,
            cells: row
                .cells
                .iter()
                .zip(&begins)
                .map(|(cell, begins)| html_cell(cell, *begins && grid.has_group_heads()))
                .collect(),
        });
        HtmlSection {
            title: Some(title).filter(|title| !title.text.is_empty()),
            rows: rows.collect(),
        }
    }

    /// What the numbers mean.
    fn explained(&self) -> Vec<Heading> {
        let of = |measure: &super::Measure| Heading {
            text: measure.heading(),
            about: measure.about.clone(),
        };
        let bands = (self.values.items_are == Items::Bands).then(|| Heading {
            text: "Eccentricity".to_owned(),
            about: "The angle between the directions to a pixel and to the gaze. A band begins with its \
                    first angle and ends before its last."
                .to_owned(),
        });
        self.values.measures.iter().map(of).chain(bands).collect()
    }
}

fn html_cell(cell: &Cell, begins_group: bool) -> HtmlCell {
    HtmlCell {
        shown: cell.shown(),
        value: Some(full(cell.value)),
        spread: full(cell.spread),
        emphasis: match cell.mark {
            Mark::Best => Emphasis::Bold,
            Mark::Second => Emphasis::Underlined,
            Mark::None => Emphasis::None,
        },
        begins_group,
    }
}
