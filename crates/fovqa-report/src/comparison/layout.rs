//! Arranges values in rows and columns.

use fovqa_plan::TableLayout;

use super::grid::{Grid, Group, Label, Row, Section};
use super::values::{Cell, Item, Items, Values};

/// The rows and columns of a layout. With one measure, scenes become columns or rows rather than
/// sections, as do bands in any layout.
pub(super) fn arrange(values: &Values, layout: TableLayout) -> Grid {
    let one = values.measures.len() == 1;
    let of_bands = values.items_are == Items::Bands;
    match layout {
        TableLayout::Methods if one && (of_bands || values.items.len() > 1) => Grid {
            corner: METHOD.to_owned(),
            subject: String::new(),
            groups: vec![Group { head: Some(measure(values, 0)), columns: items(values) }],
            sections: vec![methods_of_items(values, 0, String::new())],
        },
        TableLayout::Methods if of_bands => Grid {
            corner: METHOD.to_owned(),
            subject: String::new(),
            groups: vec![Group { head: None, columns: items(values) }],
            sections: (0..values.measures.len())
                .map(|index| methods_of_items(values, index, values.measures[index].heading()))
                .collect(),
        },
        TableLayout::Methods => {
            of_each_item(values, METHOD, Group { head: None, columns: measures(values) }, |item| {
                let row = |(at, name): (usize, &String)| Row {
                    label: Label::Name(name.clone()),
                    is_average: false,
                    cells: item.cells.iter().map(|cells| cells[at]).collect(),
                };
                values.methods.iter().enumerate().map(row).collect()
            })
        }
        TableLayout::Transposed if of_bands && !one => Grid {
            corner: values.items_are.heading().to_owned(),
            subject: String::new(),
            groups: vec![Group { head: None, columns: methods(values) }],
            sections: (0..values.measures.len())
                .map(|index| Section {
                    title: values.measures[index].heading(),
                    rows: rows_of_items(values, |item| item.cells[index].clone()),
                })
                .collect(),
        },
        TableLayout::Transposed if !one => {
            of_each_item(values, "metric", Group { head: None, columns: methods(values) }, |item| {
                let row = |(index, cells): (usize, &Vec<Cell>)| Row {
                    label: measure(values, index),
                    is_average: false,
                    cells: cells.clone(),
                };
                item.cells.iter().enumerate().map(row).collect()
            })
        }
        TableLayout::Scenes | TableLayout::Transposed => {
            let group =
                |index| Group { head: Some(measure(values, index)), columns: methods(values) };
            Grid {
                corner: values.items_are.heading().to_owned(),
                subject: String::new(),
                groups: (0..values.measures.len()).map(group).collect(),
                sections: vec![Section {
                    title: String::new(),
                    rows: rows_of_items(values, |item| item.cells.concat()),
                }],
            }
        }
    }
}

const METHOD: &str = "method";

/// One section per scene, all with the same columns.
fn of_each_item(
    values: &Values,
    corner: &str,
    group: Group,
    rows: impl Fn(&Item) -> Vec<Row>,
) -> Grid {
    let one = values.items.len() == 1;
    let title = |item: &Item| if one { String::new() } else { item.title.clone() };
    let section = |item: &Item| Section { title: title(item), rows: rows(item) };
    Grid {
        corner: corner.to_owned(),
        subject: values.items.first().filter(|_| one).map(|i| i.title.clone()).unwrap_or_default(),
        groups: vec![group],
        sections: values.items.iter().map(section).collect(),
    }
}

/// One row per method, with the values of all items for one measure.
fn methods_of_items(values: &Values, index: usize, title: String) -> Section {
    let row = |(at, name): (usize, &String)| Row {
        label: Label::Name(name.clone()),
        is_average: false,
        cells: values.items.iter().map(|item| item.cells[index][at]).collect(),
    };
    Section { title, rows: values.methods.iter().enumerate().map(row).collect() }
}

fn rows_of_items(values: &Values, cells: impl Fn(&Item) -> Vec<Cell>) -> Vec<Row> {
    let row = |item: &Item| Row {
        label: Label::Name(item.label.clone()),
        is_average: item.is_average,
        cells: cells(item),
    };
    values.items.iter().map(row).collect()
}

fn measure(values: &Values, index: usize) -> Label {
    Label::Measure(index, values.measures[index].clone())
}

fn measures(values: &Values) -> Vec<Label> {
    (0..values.measures.len()).map(|index| measure(values, index)).collect()
}

fn methods(values: &Values) -> Vec<Label> {
    values.methods.iter().cloned().map(Label::Name).collect()
}

fn items(values: &Values) -> Vec<Label> {
    values.items.iter().map(|item| Label::Name(item.label.clone())).collect()
}
