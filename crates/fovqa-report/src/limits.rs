//! How far methods can foveate: a table of limits, and figures of quality against what was varied.

use std::path::Path;

use askama::Template;
use fovqa_metrics::{Better, Metric};
use fovqa_plan::Quantity;
use fovqa_plot::{Axis, Figure, LineChart, LineSeries, Look};
use fovqa_results::{
    CsvNames, LIMITS_CSV, LIMITS_JSON, LimitRecord, LimitRule, LimitState, LimitsRecord,
};

use crate::comparison::Measure;
use crate::figures::slug;
use crate::latex::usual_label;
use crate::page::{PageFigure, PageTable, Shell};
use crate::plain_table::{Cell, Column, PlainTable};
use crate::sheet::{MakeText, NamedFigure, NamedTable, ReportError, Sheet};
use crate::steps::BeginStep;
use crate::text::Text;

/// What was made of a search for limits.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnLimits {
    /// The table, for a terminal.
    pub table: Text,
    /// Number of figures.
    pub figures: usize,
    /// What the user should know of the figures.
    pub warnings: Vec<String>,
}

/// The name of the table's files.
const TABLE: &str = "table-limits";
/// The ratio of the ends of a range from which its axis is logarithmic.
const LOG_RATIO: f64 = 4.0;

/// Writes the table, figures and page of a search for limits into its folder. Each step is begun
/// with `begin`.
///
/// # Errors
/// If the folder cannot be written to, or a figure does not fit into the size that was asked for.
pub fn draw_limits(
    folder: &Path,
    record: &LimitsRecord,
    begin: &BeginStep<'_>,
) -> Result<DrawnLimits, ReportError> {
    let table = table(record);
    let figures = figures(record);
    let label = usual_label(&slug(&record.experiment), TABLE);
    let markdown: MakeText<'_> = Box::new(|| table.markdown());
    let files = vec![
        ("md", markdown),
        ("csv", Box::new(|| table.csv())),
        ("tex", Box::new(|| table.latex(&label))),
    ];
    let sheet = Sheet {
        tables: vec![NamedTable { name: TABLE, files }],
        figures,
        page: Box::new(|figures| page(record, &table, figures)),
        forward: None,
        names: CsvNames::Plain,
    };
    let warnings = sheet.write(folder, begin)?;
    let mut text = Text::from(format!("{}\n\n", table.caption));
    text.push_table(table.terminal());
    table.notes.iter().for_each(|note| text.push_str(&["\n", note].concat()));
    text.push_str("\n");
    Ok(DrawnLimits { table: text, figures: sheet.figures.len(), warnings })
}

/// What was varied, as the title of an axis.
fn varied(record: &LimitsRecord) -> String {
    match (record.vary.as_str(), record.budget_of.as_deref()) {
        ("budget", Some("on_screen")) => {
            "Budget (samples on the screen, share of the frame's pixels)".to_owned()
        }
        ("budget", _) => "Budget (share of the frame's pixels)".to_owned(),
        (parameter, _) => parameter.to_owned(),
    }
}

/// How values of a quantity are written.
fn measure(quantity: &Quantity) -> Option<Measure> {
    let metric = Metric::find(&quantity.metric)?;
    let plain = quantity.image == "pair" && matches!(quantity.statistic.as_str(), "" | "jod");
    plain.then(|| Measure::of(metric))
}

fn shown(quantity: &Quantity, value: f64) -> String {
    match measure(quantity) {
        Some(measure) => measure.shown(Some(value)),
        None => format!("{value:.4}"),
    }
}

/// The limits of a rule in words: `≥ 30`.
fn bounds(rule: &LimitRule) -> String {
    let least = rule.at_least.map(|least| format!("≥ {least}"));
    let most = rule.at_most.map(|most| format!("≤ {most}"));
    least.into_iter().chain(most).collect::<Vec<_>>().join(", ")
}

/// A value of what was varied with as many digits as the tolerance allows.
fn at_tolerance(record: &LimitsRecord, value: f64) -> String {
    let (mut digits, mut unit) = (2, 0.1);
    while unit > record.tolerance && digits < 12 {
        (digits, unit) = (digits + 1, unit / 10.0);
    }
    let rounded: f64 = format!("{value:.*e}", digits - 1).parse().unwrap_or(value);
    rounded.to_string()
}

fn table(record: &LimitsRecord) -> PlainTable {
    let is_budget = record.vary == "budget";
    let has_eyes = record.limits.iter().any(|limit| !limit.eye.is_empty());
    let mut columns = vec![
        Column::new("Rule", "rule").repeated(),
        Column::new("Scene", "scene").repeated(),
        Column::new("Method", "method").repeated(),
        Column::new("Eye", "eye").repeated(),
        Column::new("Limit", "limit")
            .about("The last value of what was varied at which the rule still holds."),
        Column::new("Fails at", "fails_at")
            .about("The value beside the limit at which the rule no longer holds."),
        Column::new("Value", "value").about("The value of the rule's quantity at the limit."),
        Column::new("Samples", "samples_share")
            .about("The samples that the method shades at the limit, as a share of the frame's pixels."),
        Column::new("Parameter", "parameter"),
        Column::new("Monotone", "monotone").about(
            "Whether the quantity only falls, or only rises, from one end of the range to the other.",
        ),
    ];
    let mut rows: Vec<Vec<Cell>> = record.limits.iter().map(|limit| row(record, limit)).collect();
    for (index, wanted) in [(8, is_budget), (3, has_eyes)] {
        if !wanted {
            columns.remove(index);
            for row in &mut rows {
                row.remove(index);
            }
        }
    }
    let what = if is_budget { "Smallest budget" } else { "Last value" };
    let of = if is_budget { String::new() } else { format!(" of {}", record.vary) };
    let mut notes = vec![format!(
        "Limits are known to within {} %; the rule holds at the limit and fails at the value beside it.",
        100.0 * record.tolerance
    )];
    if record.limits.iter().any(|limit| !limit.monotone) {
        notes.push(
            "Where a metric is not monotone, the rule may hold again beyond the limit: the limit is the \
             first one from the end that saves least."
                .to_owned(),
        );
    }
    notes.extend(record.limits.iter().filter_map(|limit| limit.note.clone()));
    PlainTable {
        caption: format!("{what}{of} at which each rule still holds"),
        columns,
        rows,
        notes,
    }
}

fn row(record: &LimitsRecord, limit: &LimitRecord) -> Vec<Cell> {
    let Some(rule) = record.rules.get(limit.rule) else { return Vec::new() };
    let varied = |value: Option<f64>| {
        value.map_or_else(Cell::default, |value| Cell::number(at_tolerance(record, value), value))
    };
    let state = match limit.state {
        LimitState::Found => varied(limit.limit),
        LimitState::Always => Cell::named("always", ""),
        LimitState::Never => Cell::named("never", ""),
        LimitState::NotScored => Cell::named("not scored", ""),
    };
    let value = limit
        .value
        .map_or_else(Cell::default, |value| Cell::number(shown(&rule.quantity, value.0), value.0));
    let samples = limit
        .samples_share
        .map_or_else(Cell::default, |share| Cell::number(format!("{:.2} %", 100.0 * share), share));
    let solved: Vec<String> =
        limit.parameter_value.iter().map(|value| at_tolerance(record, *value)).collect();
    let parameter = match (&limit.parameter, solved.as_slice()) {
        (Some(name), [one]) => format!("{name} = {one}"),
        (Some(name), [_, ..]) => format!("{name} = [{}]", solved.join(", ")),
        _ => String::new(),
    };
    vec![
        Cell::text(format!("{} {}", rule.name, bounds(rule))),
        Cell::text(limit.scene.clone()),
        Cell::text(limit.method.clone()),
        Cell::text(limit.eye.clone()),
        state,
        varied(limit.fails_at),
        value,
        samples,
        Cell::text(parameter),
        Cell::text(if limit.monotone { "yes" } else { "no" }),
    ]
}

/// One figure for each rule and scene: the quality of all methods against what was varied, the bounds of
/// the rule, and the limits as rings.
fn figures(record: &LimitsRecord) -> Vec<NamedFigure> {
    let mut methods: Vec<&str> = Vec::new();
    for limit in &record.limits {
        if !methods.contains(&limit.method.as_str()) {
            methods.push(&limit.method);
        }
    }
    let mut figures: Vec<NamedFigure> = Vec::new();
    for (index, rule) in record.rules.iter().enumerate() {
        let of_rule = || record.limits.iter().filter(|limit| limit.rule == index);
        let mut places: Vec<(&str, &str)> = Vec::new();
        for limit in of_rule() {
            let place = (limit.scene.as_str(), limit.eye.as_str());
            if !places.contains(&place) && !limit.points.is_empty() {
                places.push(place);
            }
        }
        let several = places.len() > 1;
        for (scene, eye) in places {
            let here = of_rule()
                .filter(|limit| (limit.scene.as_str(), limit.eye.as_str()) == (scene, eye));
            let here: Vec<&LimitRecord> = here.collect();
            let eye = if eye.is_empty() { String::new() } else { format!(", {eye}") };
            let title = several.then(|| format!("{scene}{eye}"));
            let chart = chart(record, rule, &here, &methods, title);
            let mut parts = vec!["limit".to_owned(), slug(&rule.quantity.metric)];
            if record.rules.len() > 1 {
                parts.push(format!("rule-{}", index + 1));
            }
            if several {
                parts.push(slug(&format!("{scene}{eye}")));
            }
            let caption = format!(
                "{} {} in {scene}{eye}: {} against {}; rings: limits",
                rule.name,
                bounds(rule),
                rule.quantity,
                if record.vary == "budget" { "the budget" } else { &record.vary }
            );
            let mut figure = NamedFigure::new(parts.join("-"), caption, Figure::Line(chart));
            figure.settings = record.figures.clone();
            figures.push(figure);
        }
    }
    figures
}

fn chart(
    record: &LimitsRecord,
    rule: &LimitRule,
    limits: &[&LimitRecord],
    methods: &[&str],
    title: Option<String>,
) -> LineChart {
    let ends = limits.iter().flat_map(|limit| limit.range);
    let (low, high) =
        (ends.clone().fold(f64::INFINITY, f64::min), ends.fold(f64::NEG_INFINITY, f64::max));
    let mut series = Vec::new();
    for bound in [rule.at_least, rule.at_most].into_iter().flatten() {
        series.push(LineSeries {
            name: format!("limit of the rule, {bound}"),
            reference: true,
            points: vec![(low, Some(bound)), (high, Some(bound))],
            ..LineSeries::default()
        });
    }
    for limit in limits {
        let index = methods.iter().position(|method| *method == limit.method).unwrap_or(0);
        let look = Look::new(index);
        let ring = limit.limit.zip(limit.value);
        series.extend(ring.map(|(at, value)| LineSeries {
            name: format!("{}, limit", limit.method),
            look,
            rings: true,
            unlisted: true,
            points: vec![(at, Some(value.0))],
            ..LineSeries::default()
        }));
        // Points close to the limit would only show how scores depend on whole sizes of buffers.
        let steps = limit.points.iter().filter(|point| !point.closer);
        series.push(LineSeries {
            name: limit.method.clone(),
            look,
            smooth: true,
            points: steps.map(|point| (point.at, Some(point.value.0))).collect(),
            ..LineSeries::default()
        });
    }
    // Rings are behind all curves.
    series.sort_by_key(|series: &LineSeries| !series.rings);
    let better = match rule.quantity.better() {
        Better::Higher => " (higher is better)",
        Better::Lower => " (lower is better)",
        Better::Neither => "",
    };
    let y = match measure(&rule.quantity) {
        Some(measure) if !measure.unit.is_empty() => {
            format!("{} in {}{better}", measure.label, measure.unit)
        }
        Some(measure) => format!("{}{better}", measure.label),
        None => format!("{}{better}", rule.quantity),
    };
    LineChart {
        title,
        x: Axis { log: low > 0.0 && high / low >= LOG_RATIO, ..Axis::new(varied(record)) },
        y: Axis::new(y),
        series,
        ..LineChart::default()
    }
}

#[derive(Template)]
#[template(path = "limits.html")]
struct LimitsPage<'a> {
    shell: Shell,
    /// The files with all values.
    files: [&'static str; 2],
    table: PageTable,
    figures: &'a [PageFigure<'a>],
    version: &'a str,
}

fn page(record: &LimitsRecord, table: &PlainTable, figures: &[PageFigure<'_>]) -> String {
    let page = LimitsPage {
        shell: Shell::new(&format!("{}: limits", record.experiment)),
        files: [LIMITS_CSV, LIMITS_JSON],
        table: PageTable::plain(TABLE, table),
        figures,
        version: &record.version,
    };
    // Writing to memory does not fail.
    page.render().unwrap_or_default()
}
