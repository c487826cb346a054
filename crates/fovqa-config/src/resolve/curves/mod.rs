//! Resolves a curves file: every curve with each of its settings. Each method is applied once to
//! check that this is possible.

mod panels;
mod plots;
mod response;
mod screens;
mod shown;
mod values;

use std::ops::Range;

use fovqa_methods::{BudgetError, Method};
use fovqa_params::{ParamError, ParamValue, Words};
use fovqa_vision::acuity::AcuityModel;

use super::figures::{figure, has_effect};
use super::metrics::param_value;
use super::scenes::unique;
use crate::fault::{Fault, Faults};
use crate::grammar::MOST_CURVES;
use crate::node::Node;
use fovqa_methods::curves::{CurveBudget, CurveRange, CurveSetting, CurveSource, CurveSpec};
use fovqa_plan::{CurvePlan, CurvePlot, FigureForm, FigureSettings};
use panels::{all_that_fit, few_panels};
use plots::{plot, table};
use screens::Screens;
use shown::nothing_is_left;

/// The name, the description and the plan. Mistakes are added to `faults`.
pub(crate) fn curves(root: Node<'_>, faults: &mut Faults) -> (String, String, CurvePlan) {
    let text = |key| root.text(key).unwrap_or_default().to_owned();
    let default = CurveRange::default();
    let range = CurveRange {
        step_deg: root.number("step_deg").unwrap_or(default.step_deg),
        to_deg: root.number("to_deg").unwrap_or(default.to_deg),
    };
    let acuity = acuity_model(root, faults).unwrap_or_default();
    let tables = root.tables("curve");
    unique(&tables, "curve", faults);
    let mut curves = Vec::new();
    let mut left_out: Vec<(Range<usize>, String)> = Vec::new();
    for (table, span) in &tables {
        curves.extend(curve(root, *table, span.clone(), (faults, &mut left_out)));
        // The number is checked before further curves are made, because each may have a budget to
        // be solved.
        if curves.len() > MOST_CURVES {
            let message = format!("the file has more than {MOST_CURVES} curves");
            faults.push(Fault::new(root.span("curve"), message));
        }
        if curves.len() > MOST_CURVES || faults.are_many() {
            break;
        }
    }
    if curves.is_empty() && faults.is_empty() {
        for (span, why) in left_out.drain(..) {
            faults.push(Fault::new(span, why));
        }
    }
    let left_out = left_out.into_iter().map(|(_, why)| why).collect();
    let names: Vec<&str> = tables.iter().filter_map(|(table, _)| table.text("name")).collect();
    let acuity_parameters = root.table("acuity").map(written).unwrap_or_default();
    let mut plan =
        CurvePlan { curves, acuity, acuity_parameters, range, left_out, ..CurvePlan::default() };
    let figures = figure(root.table("figures"), &FigureSettings::default(), faults);
    plan.plots = root
        .tables("plot")
        .iter()
        .map(|(table, _)| {
            printed(*table, plot(root, *table, (&names, &plan), faults), &figures, faults)
        })
        .collect();
    plan.tables =
        root.tables("table").iter().map(|(t, _)| table(*t, &names, &plan, faults)).collect();
    if plan.plots.is_empty() && plan.tables.is_empty() {
        all_that_fit(&mut plan);
        plan.plots.iter_mut().for_each(|plot| plot.figure = figures.clone());
    }
    if faults.is_empty() {
        for (i, plot) in plan.plots.iter().enumerate() {
            let table = root.tables("plot").into_iter().nth(i);
            let span = table.map_or_else(|| root.span("curve"), |(table, _)| table.span("kind"));
            few_panels(plot, &plan, span, faults);
        }
    }
    plan.figures = figures;
    leave_out(&mut plan);
    let drawn_without = |plot: &CurvePlot| plot.kind.needs_no_curve();
    if tables.is_empty() && !plan.plots.iter().any(drawn_without) {
        let fault = Fault::new(0..0, "the file has no curve");
        faults.push(fault.help("add [[curve]] with a name and method = { model = \"rmfr\" }"));
    }
    (text("name"), text("about"), plan)
}

/// A plot with how it is printed.
fn printed(
    table: Node<'_>,
    plot: CurvePlot,
    all: &FigureSettings,
    faults: &mut Faults,
) -> CurvePlot {
    let node = table.table("figure");
    let own = || figure(node, &FigureSettings::default(), &mut Faults::default());
    let form = FigureForm::of_curves(plot.kind);
    has_effect(table, Some(form), plot.kind.word(), own, faults);
    CurvePlot { figure: figure(node, all, faults), ..plot }
}

/// Leaves out the figures and tables all of whose curves are left out.
fn leave_out(plan: &mut CurvePlan) {
    let (plots, tables) = (std::mem::take(&mut plan.plots), std::mem::take(&mut plan.tables));
    let mut notes = Vec::new();
    let mut left = |what: &str, name: &str, curves: Option<&[String]>| {
        let nothing = nothing_is_left(plan, curves);
        if nothing {
            notes.push(format!("{what} {name} is left out: so are all of its curves"));
        }
        !nothing
    };
    let plots = plots.into_iter().filter(|plot| {
        let name = plot.name.as_deref().unwrap_or(plot.kind.word());
        plot.kind.needs_no_curve() || left("the plot", name, plot.curves.as_deref())
    });
    let plots = plots.collect();
    let tables = tables
        .into_iter()
        .filter(|table| left("the table", table.kind.word(), table.curves.as_deref()))
        .collect();
    (plan.plots, plan.tables) = (plots, tables);
    plan.left_out.extend(notes);
}

/// Why a curve is left out, if it is because its budget cannot be reached.
fn out_of_reach(name: &str, setting: &CurveSetting, error: &BudgetError) -> Option<String> {
    let BudgetError::OutOfReach { others, .. } = error else { return None };
    let [width, height] = [setting.view.width, setting.view.height];
    let change = if others.is_empty() { String::new() } else { format!(", or change {others}") };
    Some(format!(
        "curve \"{name}\" at {width}x{height} is left out: {error}; give a budget within these{change}"
    ))
}

/// The acuity model in the key `acuity` of a table.
fn acuity_model(table: Node<'_>, faults: &mut Faults) -> Option<AcuityModel> {
    let node = table.table("acuity")?;
    let mut model = AcuityModel::find(node.text("model")?)?;
    for (name, value, span) in params(node) {
        said(model.set(name, &value), span, faults);
    }
    if let Err(error) = model.curve() {
        faults.push(Fault::new(table.span("acuity"), error.to_string()));
    }
    Some(model)
}

/// The parameters in the table of a model, with their positions.
fn params(node: Node<'_>) -> impl Iterator<Item = (&str, ParamValue, Range<usize>)> {
    node.entries()
        .filter(|(name, ..)| *name != "model")
        .filter_map(|(name, span, value)| Some((name, param_value(value)?, span)))
}

fn said(set: Result<(), ParamError>, span: Range<usize>, faults: &mut Faults) {
    if let Err(error) = set {
        faults.push(Fault::new(span, error.to_string()));
    }
}

/// The parameters in one line, as the file has them.
fn written(node: Node<'_>) -> String {
    let written = params(node).map(|(name, value, _)| format!("{name}={}", value.in_words()));
    written.collect::<Vec<_>>().join(";")
}

/// A curve with each of its settings, except those that are left out.
fn curve(
    root: Node<'_>,
    table: Node<'_>,
    span: Range<usize>,
    (faults, left_out): (&mut Faults, &mut Vec<(Range<usize>, String)>),
) -> Vec<CurveSpec> {
    let name = table.text("name").unwrap_or_default().to_owned();
    let one_of = "give it either method = { model = … } or acuity = { model = … }";
    match (table.table("method"), table.table("acuity")) {
        (None, None) => {
            let message = format!("curve \"{name}\" has neither a method nor an acuity model");
            faults.push(Fault::new(span, message).help(one_of));
            Vec::new()
        }
        (Some(_), Some(_)) => {
            let message = format!("curve \"{name}\" has both a method and an acuity model");
            faults.push(Fault::new(table.span("acuity"), message).help(one_of));
            Vec::new()
        }
        (None, Some(node)) => {
            for key in ["budget", "budget_of"].into_iter().filter(|key| table.has(key)) {
                let message = format!("{key} needs a method, but curve \"{name}\" has none");
                faults.push(Fault::new(table.span(key), message));
            }
            let model = acuity_model(table, faults);
            let source = model.map(CurveSource::Acuity);
            source
                .map(|source| CurveSpec { name, source, parameters: written(node) })
                .into_iter()
                .collect()
        }
        (Some(node), None) => {
            let Some(mut method) = node.text("model").and_then(Method::find) else {
                return Vec::new();
            };
            for (name, value, span) in params(node) {
                said(method.set(name, &value), span, faults);
            }
            let settings =
                Screens { tables: [root.table("view"), Some(table)], of: "a curve of a method" }
                    .settings(&span, faults);
            let budget = table.number("budget").map(|share| CurveBudget {
                share,
                samples: table.word("budget_of").unwrap_or_default(),
            });
            if table.has("budget_of") && budget.is_none() {
                let message = "budget_of needs a budget, but none is given";
                faults.push(Fault::new(table.span("budget_of"), message));
            }
            let at = if budget.is_some() { table.span("budget") } else { table.span("method") };
            let written = written(node);
            let mut specs = Vec::new();
            for setting in settings {
                let (name, method, written) = (name.clone(), method.clone(), written.clone());
                match CurveSpec::of_method(name.clone(), method, written, setting, budget) {
                    Ok(spec) => specs.push(spec),
                    Err(error) => match out_of_reach(&name, &setting, &error) {
                        // Curves that differ only in direction have the same reason.
                        Some(why) if left_out.iter().any(|(_, known)| *known == why) => {}
                        Some(why) => left_out.push((at.clone(), why)),
                        None => faults.push(Fault::new(at.clone(), error.to_string())),
                    },
                }
            }
            specs
        }
    }
}
