//! The data of a figure as tidy CSV, with one row per value. The format is RFC 4180 except for the
//! line ends, which are LF only.

use crate::charts::bar::BarChart;
use crate::charts::line::LineChart;
use crate::charts::montage::{MontageChart, MontageRow};
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
    let errors = ErrorColumns::of(std::slice::from_ref(chart));
    let mut csv = format!("series,x,y{}\n", errors.heading());
    for fields in line_rows(chart, errors) {
        row(&mut csv, &fields);
    }
    csv
}

pub(crate) fn panels(chart: &PanelChart) -> String {
    let errors = ErrorColumns::of(&chart.panels);
    let mut csv = format!("panel,series,x,y{}\n", errors.heading());
    for panel in &chart.panels {
        let title = name(panel.title.as_deref().unwrap_or_default());
        for fields in line_rows(panel, errors) {
            row(&mut csv, &[std::slice::from_ref(&title), fields.as_slice()].concat());
        }
    }
    csv
}

/// The columns of error bars.
#[derive(Clone, Copy)]
struct ErrorColumns {
    /// Half their lengths.
    errors: bool,
    /// Their ends.
    intervals: bool,
}

impl ErrorColumns {
    fn of(charts: &[LineChart]) -> Self {
        let mut series = charts.iter().flat_map(|chart| &chart.series);
        Self {
            errors: series.clone().any(|series| !series.errors.is_empty()),
            intervals: series.any(|series| !series.intervals.is_empty()),
        }
    }

    fn heading(self) -> &'static str {
        match (self.errors, self.intervals) {
            (false, false) => "",
            (true, false) => ",error",
            (false, true) => ",low,high",
            (true, true) => ",error,low,high",
        }
    }

    fn fields(
        self,
        errors: &[Option<f64>],
        intervals: &[Option<[f64; 2]>],
        index: usize,
    ) -> impl Iterator<Item = String> {
        let error = errors.get(index).copied().flatten();
        let ends = intervals.get(index).copied().flatten();
        let [low, high] = [0, 1].map(|end| ends.map(|ends| ends[end]));
        let error = self.errors.then(|| optional(error)).into_iter();
        let ends = self.intervals.then(|| [optional(low), optional(high)]);
        error.chain(ends.into_iter().flatten())
    }
}

/// The points of the curves, then the two ends of each span, which have no value.
fn line_rows(chart: &LineChart, errors: ErrorColumns) -> impl Iterator<Item = Vec<String>> {
    let points = chart.series.iter().flat_map(move |series| {
        let fields = move |(i, (x, y)): (usize, &(f64, Option<f64>))| {
            let mut fields = vec![name(&series.name), optional(Some(*x)), optional(*y)];
            fields.extend(errors.fields(&series.errors, &series.intervals, i));
            fields
        };
        series.points.iter().enumerate().map(fields)
    });
    let ends = chart.spans.iter().flat_map(move |span| {
        [span.from, span.to].map(|x| {
            let mut fields = vec![name(&span.name), optional(Some(x)), String::new()];
            fields.extend(errors.fields(&[], &[], 0));
            fields
        })
    });
    points.chain(ends)
}

pub(crate) fn bar(chart: &BarChart) -> String {
    let errors = ErrorColumns {
        errors: chart.series.iter().any(|series| !series.errors.is_empty()),
        intervals: chart.series.iter().any(|series| !series.intervals.is_empty()),
    };
    let mut csv = format!("group,series,value{}\n", errors.heading());
    for series in &chart.series {
        for (i, (group, value)) in chart.groups.iter().zip(&series.values).enumerate() {
            let mut fields = vec![name(group), name(&series.name), optional(*value)];
            fields.extend(errors.fields(&series.errors, &series.intervals, i));
            row(&mut csv, &fields);
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
            let y = match &panel.grid {
                Some(grid) => grid.y.get(r).copied().map(number).unwrap_or_default(),
                None => middle(panel.y_range, r, panel.rows),
            };
            for (c, value) in values.iter().enumerate() {
                let x = match &panel.grid {
                    Some(grid) => grid.x.get(c).copied().map(number).unwrap_or_default(),
                    None => middle(panel.x_range, c, panel.columns),
                };
                row(&mut csv, &[title.clone(), x, y.clone(), optional(Some(*value))]);
            }
        }
        for (x, y) in &panel.dots {
            row(&mut csv, &[title.clone(), number(*x), number(*y), String::new()]);
        }
    }
    csv
}

/// Which pictures there are. Their pixels are no data.
pub(crate) fn montage(chart: &MontageChart) -> String {
    let mut csv = "row,column\n".to_owned();
    for of_row in &chart.rows {
        let shown = chart.columns.iter().zip(&of_row.pictures).filter(|(_, of)| of.is_some());
        // How large they are printed is no data.
        let label = of_row.label.replace(&format!(", {}", MontageRow::MAGNIFICATION), "");
        shown.for_each(|(column, _)| row(&mut csv, &[name(&label), name(column)]));
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
