//! The data of a figure as tidy CSV, with one row per value. The format is RFC 4180 except for the
//! line ends, which are LF only.

use crate::charts::bar::BarChart;
use crate::charts::line::LineChart;
use crate::charts::panels::PanelChart;
use crate::charts::raster::RasterChart;
use crate::charts::spread::SpreadChart;

/// Writes a number such that it is read back as the same float: "1.0".
fn number(value: f64) -> String {
    format!("{value:?}")
}

/// A value, or an empty field if there is none.
fn optional(value: Option<f64>) -> String {
    value.filter(|value| !value.is_nan()).map(number).unwrap_or_default()
}

/// A name, in quotes if it needs them.
fn name(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

fn row(csv: &mut String, fields: &[String]) {
    csv.push_str(&fields.join(","));
    csv.push('\n');
}

pub(crate) fn line(chart: &LineChart) -> String {
    let mut csv = "series,x,y\n".to_owned();
    for fields in line_rows(chart) {
        row(&mut csv, &fields);
    }
    csv
}

pub(crate) fn panels(chart: &PanelChart) -> String {
    let mut csv = "panel,series,x,y\n".to_owned();
    for panel in &chart.panels {
        let title = name(panel.title.as_deref().unwrap_or_default());
        for [series, x, y] in line_rows(panel) {
            row(&mut csv, &[title.clone(), series, x, y]);
        }
    }
    csv
}

/// The points of the curves, then the two ends of each span, which have no value.
fn line_rows(chart: &LineChart) -> impl Iterator<Item = [String; 3]> {
    let points = chart.series.iter().flat_map(|series| {
        let fields =
            |(x, y): &(f64, Option<f64>)| [name(&series.name), optional(Some(*x)), optional(*y)];
        series.points.iter().map(fields)
    });
    let ends = chart.spans.iter().flat_map(|span| {
        [span.from, span.to].map(|x| [name(&span.name), optional(Some(x)), String::new()])
    });
    points.chain(ends)
}

pub(crate) fn bar(chart: &BarChart) -> String {
    let mut csv = "group,series,value\n".to_owned();
    for series in &chart.series {
        for (group, value) in chart.groups.iter().zip(&series.values) {
            row(&mut csv, &[name(group), name(&series.name), optional(*value)]);
        }
    }
    csv
}

/// The values at the centres of their cells, then the dots, without a value. Lines are not included, because they are only a visual
/// aid.
pub(crate) fn raster(chart: &RasterChart) -> String {
    let mut csv = "panel,x,y,value\n".to_owned();
    for panel in &chart.panels {
        let title = name(panel.title.as_deref().unwrap_or_default());
        let middle = |(from, to): (f64, f64), cell: usize, cells: usize| {
            let share = (cell as f64 + 0.5) / cells as f64;
            let at = from * (1.0 - share) + to * share;
            // Seven digits are enough for a position such as a third of something.
            number(format!("{at:.6e}").parse().unwrap_or(at))
        };
        for (r, values) in panel.values.chunks(panel.columns.max(1)).enumerate() {
            let y = middle(panel.y_range, r, panel.rows);
            for (c, value) in values.iter().enumerate() {
                let x = middle(panel.x_range, c, panel.columns);
                row(&mut csv, &[title.clone(), x, y.clone(), optional(Some(*value))]);
            }
        }
        for (x, y) in &panel.dots {
            row(&mut csv, &[title.clone(), number(*x), number(*y), String::new()]);
        }
    }
    csv
}

pub(crate) fn spread(chart: &SpreadChart) -> String {
    let mut csv = "group,series,value\n".to_owned();
    for series in &chart.series {
        for (group, values) in chart.groups.iter().zip(&series.values) {
            for value in values {
                row(&mut csv, &[name(group), name(&series.name), optional(Some(*value))]);
            }
        }
    }
    csv
}
