//! A file of curves: every curve with each of its settings, methods applied once to see that they
//! can be.

use std::ops::Range;

use fovqa_methods::{BudgetOf, Method};
use fovqa_params::{ParamError, ParamValue};
use fovqa_vision::acuity::AcuityModel;
use fovqa_vision::{EccentricityKind, Tangential, View, ViewSpec};
use serde_spanned::Spanned;
use toml::de::DeValue;

use super::metrics::param_value;
use super::plots::subset;
use super::scenes::unique;
use super::view::{gives_view, view};
use crate::curves::{
    CurveBudget, CurvePlan, CurvePlot, CurvePlotKind, CurveRange, CurveSetting, CurveSource,
    CurveSpec, CurveTable, CurveTableKind, PanelOf, RateKind, RateUnit,
};
use crate::fault::Fault;
use crate::grammar::resolution;
use crate::node::{Node, numbers, text};

/// More are no longer told apart.
const MOST_CURVES: usize = 1000;

/// Name, about and plan; mistakes go to `faults`.
pub(crate) fn curves(root: Node<'_>, faults: &mut Vec<Fault>) -> (String, String, CurvePlan) {
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
    for (table, span) in &tables {
        curves.extend(curve(root, *table, span.clone(), faults));
    }
    if curves.len() > MOST_CURVES {
        let message = format!("these are {} curves, and {MOST_CURVES} at most", curves.len());
        faults.push(Fault::new(root.span("curve"), message));
    }
    let names: Vec<&str> = tables.iter().filter_map(|(table, _)| table.text("name")).collect();
    let mut plan = CurvePlan { curves, acuity, range, ..CurvePlan::default() };
    plan.plots = root.tables("plot").iter().map(|(t, _)| plot(*t, &names, &plan, faults)).collect();
    plan.tables =
        root.tables("table").iter().map(|(t, _)| table(*t, &names, &plan, faults)).collect();
    let drawn_without = |plot: &CurvePlot| plot.kind == CurvePlotKind::HalfAxis;
    if tables.is_empty() && !plan.plots.iter().any(drawn_without) {
        let fault = Fault::new(0..0, "the file has no curve");
        faults.push(fault.help("add [[curve]] with a name and method = { model = \"rmfr\" }"));
    }
    (text("name"), text("about"), plan)
}

/// The acuity model of a table's `acuity`.
fn acuity_model(table: Node<'_>, faults: &mut Vec<Fault>) -> Option<AcuityModel> {
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

/// Parameters of a model's table, with their places.
fn params(node: Node<'_>) -> impl Iterator<Item = (&str, ParamValue, Range<usize>)> {
    node.entries()
        .filter(|(name, ..)| *name != "model")
        .filter_map(|(name, span, value)| Some((name, param_value(value)?, span)))
}

fn said(set: Result<(), ParamError>, span: Range<usize>, faults: &mut Vec<Fault>) {
    if let Err(error) = set {
        faults.push(Fault::new(span, error.to_string()));
    }
}

/// Parameters as they are written, in one line.
fn written(node: Node<'_>) -> String {
    let written = params(node).map(|(name, value, _)| format!("{name}={}", value.in_words()));
    written.collect::<Vec<_>>().join(";")
}

/// A curve with each of its settings.
fn curve(
    root: Node<'_>,
    table: Node<'_>,
    span: Range<usize>,
    faults: &mut Vec<Fault>,
) -> Vec<CurveSpec> {
    let name = table.text("name").unwrap_or_default().to_owned();
    let one_of = "give it either method = { model = … } or acuity = { model = … }";
    match (table.table("method"), table.table("acuity")) {
        (None, None) => {
            let message = format!("curve \"{name}\" is of no method and no acuity model");
            faults.push(Fault::new(span, message).help(one_of));
            Vec::new()
        }
        (Some(_), Some(_)) => {
            let message = format!("curve \"{name}\" is of both a method and an acuity model");
            faults.push(Fault::new(table.span("acuity"), message).help(one_of));
            Vec::new()
        }
        (None, Some(node)) => {
            for key in ["budget", "budget_of"].into_iter().filter(|key| table.has(key)) {
                let message = format!("{key} is of a method, and curve \"{name}\" is of none");
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
                Screens { tables: [root.table("view"), Some(table)] }.settings(&span, faults);
            let budget = table.number("budget").map(|share| CurveBudget {
                share,
                of: if table.text("budget_of") == Some("on_screen") {
                    BudgetOf::OnScreen
                } else {
                    BudgetOf::Buffer
                },
            });
            if table.has("budget_of") && budget.is_none() {
                let message = "budget_of says of what a budget is, and there is none";
                faults.push(Fault::new(table.span("budget_of"), message));
            }
            let at = if budget.is_some() { table.span("budget") } else { table.span("method") };
            let written = written(node);
            let spec = |setting| {
                CurveSpec::of_method(name.clone(), method.clone(), written.clone(), setting, budget)
            };
            let specs = settings.into_iter().map(spec);
            specs
                .filter_map(|spec| match spec {
                    Ok(spec) => Some(spec),
                    Err(message) => {
                        faults.push(Fault::new(at.clone(), message));
                        None
                    }
                })
                .collect()
        }
    }
}

impl CurveSpec {
    /// A curve of a method, its budget solved.
    ///
    /// # Errors
    /// When the method cannot be applied there, or does not reach the budget; in words.
    pub fn of_method(
        name: String,
        method: Method,
        parameters: String,
        setting: CurveSetting,
        budget: Option<CurveBudget>,
    ) -> Result<Self, String> {
        let over = setting.setting().map_err(|error| error.to_string())?;
        let (mut method, mut parameters) = (method, parameters);
        if let Some(CurveBudget { share, of }) = budget {
            let found = method.at_budget(&over, share, of).map_err(|error| error.to_string())?;
            method = found.method;
            // What is solved stands for what was given.
            let given = parameters.split(';').filter(|given| {
                !given.is_empty() && given.split('=').next() != Some(found.parameter)
            });
            let solved = format!("{}={}", found.parameter, found.value);
            parameters = given.chain([solved.as_str()]).collect::<Vec<_>>().join(";");
        }
        method.over(&over).map_err(|error| error.to_string())?;
        Ok(Self { name, source: CurveSource::Method { method, setting }, parameters })
    }
}

/// Tables that say on which screens a curve is, the more special one last.
struct Screens<'a> {
    tables: [Option<Node<'a>>; 2],
}

impl<'a> Screens<'a> {
    fn having(&self, key: &str) -> Option<Node<'a>> {
        self.tables.iter().rev().flatten().find(|table| table.has(key)).copied()
    }

    fn values(&self, key: &str) -> Vec<&'a Spanned<DeValue<'a>>> {
        let value = self.having(key).and_then(|table| table.value(key)).map(Spanned::get_ref);
        match value {
            Some(DeValue::Array(items)) => items.iter().collect(),
            _ => Vec::new(),
        }
    }

    /// Every resolution with every gaze and direction.
    fn settings(&self, span: &Range<usize>, faults: &mut Vec<Fault>) -> Vec<CurveSetting> {
        let gives = |table: &&Node<'a>| gives_view(**table);
        let Some(seen) = self.tables.iter().rev().flatten().find(gives) else {
            let message = "the curve is on a screen, and no view is given";
            let help =
                "give one in [view], such as fov_vertical_deg = 110 or display = \"vive-pro-eye\"";
            faults.push(Fault::new(span.clone(), message).help(help));
            return Vec::new();
        };
        let Some(spec) = view(*seen, faults) else { return Vec::new() };
        let mut sizes: Vec<[usize; 2]> =
            self.values("resolutions").into_iter().filter_map(|v| resolution(text(v)?)).collect();
        if sizes.is_empty() {
            if let ViewSpec::Display(display) = &spec {
                sizes.push(display.resolution);
            } else {
                let message = "the curve is on a screen, and no resolution is given";
                let help = "give some, such as resolutions = [\"2560x1440\"] in [view]";
                faults.push(Fault::new(span.clone(), message).help(help));
            }
        }
        let gazes: Vec<Option<[f64; 2]>> = self
            .values("gazes")
            .into_iter()
            .map(|gaze| numbers(gaze).and_then(|xy| <[f64; 2]>::try_from(xy).ok()))
            .collect();
        let gazes = if gazes.is_empty() { vec![None] } else { gazes };
        let directions = self.having("directions_deg").and_then(|t| t.numbers("directions_deg"));
        let directions = directions.unwrap_or_else(|| vec![0.0]);
        let word = |key: &str| self.having(key).and_then(|table| table.text(key));
        let tangential =
            if word("tangential") == Some("angle") { Tangential::Angle } else { Tangential::Paper };
        let eccentricity = match word("eccentricity") {
            Some("angular") => EccentricityKind::Angular,
            _ => EccentricityKind::Planar,
        };
        let mut settings = Vec::new();
        for [width, height] in sizes {
            let view: View = match spec.resolve(width, height) {
                Ok(resolved) => resolved.view,
                Err(error) => {
                    faults.push(Fault::new(span.clone(), error.to_string()));
                    continue;
                }
            };
            for gaze in &gazes {
                let gaze_px = gaze.unwrap_or(view.principal_px);
                settings.extend(directions.iter().map(|&direction_deg| CurveSetting {
                    view,
                    gaze_px,
                    direction_deg,
                    tangential,
                    eccentricity,
                }));
            }
        }
        settings
    }
}

/// The curves a plot or table shows.
fn shown<'a>(
    plan: &'a CurvePlan,
    wanted: Option<&'a [String]>,
) -> impl Iterator<Item = &'a CurveSpec> {
    let wanted = move |spec: &&CurveSpec| wanted.is_none_or(|wanted| wanted.contains(&spec.name));
    plan.curves.iter().filter(wanted)
}

fn plot(table: Node<'_>, names: &[&str], plan: &CurvePlan, faults: &mut Vec<Fault>) -> CurvePlot {
    let word = |key| table.text(key).unwrap_or_default();
    let flag = |key| table.flag(key).unwrap_or(false);
    let plot = CurvePlot {
        kind: match word("kind") {
            "density" => CurvePlotKind::Density,
            "accumulated" => CurvePlotKind::Accumulated,
            "half_axis" => CurvePlotKind::HalfAxis,
            _ => CurvePlotKind::Rates,
        },
        name: table.text("name").map(str::to_owned),
        title: table.text("title").map(str::to_owned),
        curves: subset(table, "curves", names, faults),
        rate: match word("rate") {
            "tangential" => RateKind::Tangential,
            "both" => RateKind::Both,
            _ => RateKind::Radial,
        },
        unit: if word("unit") == "per_pixel" { RateUnit::PerPixel } else { RateUnit::Cpd },
        panels: match word("panels") {
            "one" => PanelOf::One,
            "resolution" => PanelOf::Resolution,
            "gaze" => PanelOf::Gaze,
            "direction" => PanelOf::Direction,
            _ => PanelOf::Curve,
        },
        areas: table.flag("areas"),
        display: flag("display"),
        y_limits: table.array("y_limits"),
        log: flag("log"),
        rings_deg: table.numbers("rings_deg").unwrap_or_default(),
        f: table.numbers("f").unwrap_or_default(),
    };
    fits(table, &plot, faults);
    let nothing = |spec: &CurveSpec| match (plot.kind, &spec.source) {
        (CurvePlotKind::Rates, CurveSource::Acuity(_)) => plot.unit == RateUnit::PerPixel,
        (CurvePlotKind::Rates | CurvePlotKind::Density, CurveSource::Method { .. })
        | (CurvePlotKind::HalfAxis, _) => false,
        (CurvePlotKind::Accumulated, CurveSource::Method { method, .. }) => {
            !matches!(method, Method::Deamp(_))
        }
        (_, CurveSource::Acuity(_)) => true,
    };
    if faults.is_empty()
        && plot.kind != CurvePlotKind::HalfAxis
        && shown(plan, plot.curves.as_deref()).all(nothing)
    {
        let message = match plot.kind {
            CurvePlotKind::Accumulated => "the plot is of deamp, and none of its curves is",
            _ => "the plot has nothing to show: none of its curves is of a method",
        };
        faults.push(Fault::new(table.span("kind"), message));
    }
    plot
}

/// Whether a plot's keys are of its kind.
fn fits(table: Node<'_>, plot: &CurvePlot, faults: &mut Vec<Fault>) {
    let (kind, keys): (&str, &[&str]) = match plot.kind {
        CurvePlotKind::Rates => ("rates", &["rings_deg", "f"]),
        CurvePlotKind::Density => {
            ("density", &["rate", "unit", "panels", "areas", "display", "y_limits", "f"])
        }
        CurvePlotKind::Accumulated => (
            "accumulated",
            &["rate", "unit", "panels", "areas", "display", "y_limits", "log", "rings_deg", "f"],
        ),
        CurvePlotKind::HalfAxis => (
            "half_axis",
            &[
                "curves",
                "rate",
                "unit",
                "panels",
                "areas",
                "display",
                "y_limits",
                "log",
                "rings_deg",
            ],
        ),
    };
    for key in keys.iter().filter(|key| table.has(key)) {
        let message = format!("{key} says nothing about a plot of kind \"{kind}\"");
        faults.push(Fault::new(table.span(key), message).help("take it out"));
    }
    if plot.kind == CurvePlotKind::HalfAxis && plot.f.is_empty() {
        let fault = Fault::new(table.span("kind"), "a plot of a half axis has no f");
        faults.push(fault.help("write f = [1.1, 2, 5], values above 1"));
    }
    if let Some([low, high]) = plot.y_limits
        && low >= high
    {
        let fault = Fault::new(table.span("y_limits"), "the vertical axis ends before it begins");
        faults.push(fault.label("write [low, high]"));
    }
    if plot.log && plot.y_limits.is_some_and(|[low, _]| low <= 0.0) {
        let fault = Fault::new(table.span("y_limits"), "a logarithmic axis has no 0");
        faults.push(fault.label("begin above 0"));
    }
}

fn table(table: Node<'_>, names: &[&str], plan: &CurvePlan, faults: &mut Vec<Fault>) -> CurveTable {
    let kind = match table.text("kind") {
        Some("samples") => CurveTableKind::Samples,
        Some("acuity") => CurveTableKind::Acuity,
        _ => CurveTableKind::SpeedUp,
    };
    let curves = subset(table, "curves", names, faults);
    let of_method = |spec: &CurveSpec| matches!(spec.source, CurveSource::Method { .. });
    if faults.is_empty() && !shown(plan, curves.as_deref()).any(of_method) {
        let message = "the table has nothing to show: none of its curves is of a method";
        faults.push(Fault::new(table.span("kind"), message));
    }
    CurveTable { kind, curves }
}
