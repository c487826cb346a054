//! `[[plot]]` and `[[table]]` of a curves file.

use fovqa_methods::Method;
use fovqa_params::Words;

use super::panels::usual_panels;
use super::shown::{nothing_is_left, shown};
use super::{response, values};
use crate::fault::{Fault, Faults};
use crate::node::Node;
use crate::resolve::plots::subset;
use fovqa_methods::curves::{CurveSource, CurveSpec};
use fovqa_plan::{
    AcuityScale, CurvePlan, CurvePlot, CurvePlotKind, CurveTable, CurveTableKind, DensityStyle,
    FigureSettings, RateUnit,
};

/// Resolves a figure.
pub(super) fn plot(
    root: Node<'_>,
    table: Node<'_>,
    (names, plan): (&[&str], &CurvePlan),
    faults: &mut Faults,
) -> CurvePlot {
    let kind = table.word("kind").unwrap_or_default();
    let flag = |key| table.flag(key).unwrap_or(false);
    let curves = subset(table, "curves", names, faults);
    let rate = table.word("rate").unwrap_or_default();
    let usual = || usual_panels(plan, curves.as_deref(), rate);
    let plot = CurvePlot {
        kind,
        name: table.text("name").map(str::to_owned),
        title: table.text("title").map(str::to_owned),
        panels: table.word("panels").unwrap_or_else(usual),
        curves,
        rate,
        unit: table.word("unit").unwrap_or_default(),
        areas: table.flag("areas"),
        display: table.flag("display"),
        beyond_display: flag("beyond_display"),
        y_limits: table.array("y_limits"),
        marks: table.tables("marks").iter().filter_map(|(mark, _)| named_mark(*mark)).collect(),
        log: flag("log"),
        rings_deg: table.numbers("rings_deg").unwrap_or_default(),
        f: table.numbers("f").unwrap_or_default(),
        band: flag("band"),
        dots: flag("dots"),
        style: table.word("style").unwrap_or_default(),
        acuity_scale: table.word("acuity_scale").unwrap_or_default(),
        response: (kind == CurvePlotKind::Response)
            .then(|| response::response(root, table, faults))
            .flatten(),
        values: (kind == CurvePlotKind::Values).then(|| values::values(table, faults)).flatten(),
        figure: FigureSettings::default(),
    };
    fits(table, &plot, faults);
    let nothing = |spec: &CurveSpec| match (plot.kind, &spec.source) {
        (CurvePlotKind::Rates, CurveSource::Acuity(_)) => plot.unit == RateUnit::PerPixel,
        (CurvePlotKind::Accumulated, CurveSource::Method { method, .. }) => {
            !matches!(method, Method::Deamp(_))
        }
        (CurvePlotKind::Steps, CurveSource::Method { method, .. }) => {
            !matches!(method, Method::Deamp(_) | Method::Guenter(_))
        }
        (CurvePlotKind::Outline, CurveSource::Method { method, .. }) => {
            !matches!(method, Method::Vafr(_))
        }
        (CurvePlotKind::Samples, CurveSource::Method { method, setting }) => {
            let over = setting.setting().and_then(|over| method.apply(&over));
            over.is_ok_and(|method| method.mapping().is_none())
        }
        (_, CurveSource::Method { .. }) => false,
        (_, CurveSource::Acuity(_)) => true,
    };
    if faults.is_empty()
        && !plot.kind.needs_no_curve()
        && !nothing_is_left(plan, plot.curves.as_deref())
        && shown(plan, plot.curves.as_deref()).all(nothing)
    {
        let message = match plot.kind {
            CurvePlotKind::Accumulated => "this plot needs a curve of deamp, but it has none",
            CurvePlotKind::Steps => "this plot needs a curve of deamp or guenter, but it has none",
            CurvePlotKind::Outline => "this plot needs a curve of vafr, but it has none",
            CurvePlotKind::Samples => {
                "this plot needs a method with a buffer, but none of its curves has one"
            }
            _ => "the plot has nothing to show: none of its curves has a method",
        };
        faults.push(Fault::new(table.span("kind"), message));
    }
    plot
}

fn named_mark(mark: Node<'_>) -> Option<(String, [f64; 2])> {
    Some((mark.text("name")?.to_owned(), mark.array("at")?))
}

/// Minimum distance between the ends of an axis. If they are closer, the drawing has too few
/// digits.
const NEAREST: f64 = 1e-6;

/// The keys of plots of any kind.
const OF_ALL: &[&str] = &["kind", "name", "title", "figure"];

/// The keys that plots of a kind have beside these.
fn keys_of(kind: CurvePlotKind) -> &'static [&'static str] {
    match kind {
        CurvePlotKind::Rates => &[
            "curves",
            "log",
            "rate",
            "unit",
            "panels",
            "areas",
            "display",
            "beyond_display",
            "y_limits",
            "marks",
            "band",
            "acuity_scale",
        ],
        CurvePlotKind::Density => &["curves", "log", "rings_deg", "style"],
        CurvePlotKind::Samples => &["curves", "rings_deg"],
        CurvePlotKind::SamplesBars => &["curves", "log"],
        CurvePlotKind::Accumulated | CurvePlotKind::Steps | CurvePlotKind::Outline => &["curves"],
        CurvePlotKind::HalfAxis => &["f", "dots"],
        CurvePlotKind::Response => response::KEYS,
        CurvePlotKind::Values => values::KEYS,
    }
}

/// Checks that the keys of a plot belong to its kind.
fn fits(table: Node<'_>, plot: &CurvePlot, faults: &mut Faults) {
    let (kind, own) = (plot.kind.word(), keys_of(plot.kind));
    for (key, ..) in table.entries().filter(|(key, ..)| !OF_ALL.contains(key) && !own.contains(key))
    {
        let message = format!("{key} does not apply to a plot of kind \"{kind}\"");
        faults.push(Fault::new(table.span(key), message).help("remove it"));
    }
    if plot.unit == RateUnit::PerPixel && !plot.marks.is_empty() {
        let fault =
            Fault::new(table.span("marks"), "marks are in cycles per degree, but the plot is not");
        faults.push(fault.help("remove them, or remove unit = \"per_pixel\""));
    }
    if plot.acuity_scale == AcuityScale::Own && plot.unit == RateUnit::Cpd {
        let fault = Fault::new(
            table.span("acuity_scale"),
            "acuity has a scale of its own only in samples per pixel",
        );
        faults.push(fault.help("write unit = \"per_pixel\", or remove it"));
    }
    if plot.band && plot.areas == Some(true) {
        let message = "a plot has either bands or areas against acuity";
        faults.push(Fault::new(table.span("band"), message).help("remove one of the two"));
    }
    if plot.style == DensityStyle::Contours && !plot.rings_deg.is_empty() {
        let message = "a plot has either rings or contours";
        faults.push(Fault::new(table.span("style"), message).help("remove rings_deg or style"));
    }
    if plot.kind == CurvePlotKind::HalfAxis && plot.f.is_empty() {
        let fault = Fault::new(table.span("kind"), "a plot of a half axis needs values of f");
        faults.push(fault.help("write f = [1.1, 2, 5], values above 1"));
    }
    if let Some([low, high]) = plot.y_limits
        && high - low < NEAREST
    {
        let fault = Fault::new(
            table.span("y_limits"),
            "the upper end of the vertical axis is not above its lower end",
        );
        faults.push(fault.label("write [low, high]"));
    }
    if plot.log && plot.y_limits.is_some_and(|[low, _]| low <= 0.0) {
        let fault = Fault::new(table.span("y_limits"), "a logarithmic axis cannot include 0");
        faults.push(fault.label("begin above 0"));
    }
}

/// Resolves a table.
pub(super) fn table(
    table: Node<'_>,
    names: &[&str],
    plan: &CurvePlan,
    faults: &mut Faults,
) -> CurveTable {
    let kind = table.word("kind").unwrap_or(CurveTableKind::SpeedUp);
    let curves = subset(table, "curves", names, faults);
    let of_method = |spec: &CurveSpec| matches!(spec.source, CurveSource::Method { .. });
    let left = !nothing_is_left(plan, curves.as_deref());
    if faults.is_empty() && left && !shown(plan, curves.as_deref()).any(of_method) {
        let message = "the table has nothing to show: none of its curves has a method";
        faults.push(Fault::new(table.span("kind"), message));
    }
    if table.has("across") && kind != CurveTableKind::Samples {
        let fault = Fault::new(table.span("across"), "across only applies to kind = \"samples\"");
        faults.push(fault.help("remove it"));
    }
    let across = table.word("across").unwrap_or_default();
    CurveTable { kind, curves, across }
}
