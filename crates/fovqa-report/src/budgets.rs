//! How methods met their budgets, as a table.

use fovqa_plan::Plot;
use fovqa_results::BudgetSummary;

use crate::comparison::named;
use crate::figures::Source;
use crate::plain_table::{Cell, Column, PlainTable};

/// Digits of a solved parameter that people read. The CSV file has all.
const DIGITS: usize = 5;

/// The budget of each method in each scene: what was asked for, the share of the ideal and of the
/// rounded buffers, and the parameter that was solved; `None` if no method has a budget.
pub(crate) fn budgets(source: &Source<'_>, plot: &Plot) -> Option<PlainTable> {
    let resolved = &source.run.resolved;
    let scenes = resolved.scenes.iter().map(|scene| scene.name.as_str());
    let methods = named(plot.methods.as_deref(), resolved.methods.iter().map(String::as_str));
    let mut rows = Vec::new();
    let mut has_eyes = false;
    for scene in named(plot.scenes.as_deref(), scenes) {
        for method in &methods {
            for measured in source.overview.eyes_of(scene, method) {
                let Some(BudgetSummary { share, ideal_share, value }) = &measured.budget else {
                    continue;
                };
                has_eyes |= measured.is_of_one_eye;
                let rounded = measured.samples_percent.unwrap_or(f64::NAN) / 100.0;
                let parameter = source.parameter_of_budget(scene, method);
                rows.push(vec![
                    Cell::text(scene),
                    Cell::text(*method),
                    Cell::text(measured.eye.clone()),
                    percent(*share),
                    percent(*ideal_share),
                    percent(rounded),
                    Cell::text(parameter),
                    self::value(value),
                ]);
            }
        }
    }
    if rows.is_empty() {
        return None;
    }
    let mut columns = vec![
        Column::new("Scene", "scene").repeated(),
        Column::new("Method", "method").repeated(),
        Column::new("Eye", "eye").repeated(),
        Column::new("Budget", "budget_share")
            .about("The samples that were asked for, as a share of the frame's pixels."),
        Column::new("Ideal buffer", "ideal_share")
            .about("The samples of buffers whose sides are not rounded to whole numbers."),
        Column::new("Rounded buffer", "rounded_share")
            .about("The samples that the method shades, as a share of the frame's pixels."),
        Column::new("Parameter", "parameter")
            .about("The parameter that was solved so that the method meets its budget."),
        Column::new("Value", "value").about("The value of that parameter, a mean over the frames."),
    ];
    if !has_eyes {
        columns.remove(2);
        for row in &mut rows {
            row.remove(2);
        }
    }
    Some(PlainTable {
        caption: "Budgets as shares of the frame's pixels, and how they were met".to_owned(),
        columns,
        rows,
        notes: vec![
            "Means over the frames: a budget is solved anew for each gaze. Sides of buffers are whole \
             numbers, so that the rounded buffer differs from the ideal one."
                .to_owned(),
        ],
    })
}

fn percent(share: f64) -> Cell {
    Cell::number(format!("{:.3} %", 100.0 * share), share)
}

/// The solved parameter: a number, or the numbers of a list.
fn value(values: &[f64]) -> Cell {
    let short = |value: &f64| {
        let rounded: f64 = format!("{value:.*e}", DIGITS - 1).parse().unwrap_or(*value);
        rounded.to_string()
    };
    match values {
        [] => Cell::default(),
        [one] => Cell::number(short(one), *one),
        list => {
            let shown = list.iter().map(short).collect::<Vec<_>>().join(", ");
            Cell::named(format!("[{shown}]"), format!("{list:?}"))
        }
    }
}
