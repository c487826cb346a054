//! What figures show, for readers who do not see them.

use fovqa_plot::{Figure, LineChart};

/// Maximum number of names that a description lists.
const MOST_NAMES: usize = 12;

/// The kind of chart, its axes, and what it compares.
pub(crate) fn in_words(figure: &Figure) -> String {
    match figure {
        Figure::Line(chart) => format!("Line chart of {}{}", axes(chart), of_series(chart)),
        Figure::Bar(chart) => {
            let series = names(chart.series.iter().map(|series| series.name.as_str()));
            let groups = names(chart.groups.iter().map(String::as_str));
            format!(
                "Bar chart of {}{}{}",
                chart.y.title,
                listed(" for ", &series),
                listed(" in ", &groups)
            )
        }
        Figure::Spread(chart) => {
            let series = names(chart.series.iter().map(|series| series.name.as_str()));
            format!("Distributions of {}{}", chart.y.title, listed(" for ", &series))
        }
        Figure::Panels(chart) => {
            let first = chart.panels.first();
            let titles = names(chart.panels.iter().filter_map(|panel| panel.title.as_deref()));
            let axes = first.map(|panel| format!(" of {}{}", self::axes(panel), of_series(panel)));
            let count = chart.panels.len();
            format!(
                "{count} line charts{}{}",
                axes.unwrap_or_default(),
                listed("; panels: ", &titles)
            )
        }
        Figure::Raster(chart) => {
            let titles = names(chart.panels.iter().filter_map(|panel| panel.title.as_deref()));
            format!("Coloured map of {}{}", chart.colour.title, listed(": ", &titles))
        }
        Figure::Montage(chart) => {
            let columns = names(chart.columns.iter().map(String::as_str));
            let rows = names(chart.rows.iter().map(|row| row.label.as_str()));
            format!("Pictures side by side{}{}", listed(": ", &columns), listed("; rows: ", &rows))
        }
    }
}

fn axes(chart: &LineChart) -> String {
    format!("{} against {}", chart.y.title, chart.x.title)
}

fn of_series(chart: &LineChart) -> String {
    let series = chart.series.iter().filter(|series| !series.unlisted);
    listed(" for ", &names(series.map(|series| series.name.as_str())))
}

/// The names that are not empty, each once.
fn names<'a>(all: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let mut names: Vec<&str> = Vec::new();
    for name in all.filter(|name| !name.is_empty()) {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names
}

fn listed(before: &str, names: &[&str]) -> String {
    if names.is_empty() {
        return String::new();
    }
    let shown = names[..names.len().min(MOST_NAMES)].join(", ");
    match names.len().saturating_sub(MOST_NAMES) {
        0 => format!("{before}{shown}"),
        more => format!("{before}{shown} and {more} more"),
    }
}

#[cfg(test)]
mod tests {
    use fovqa_plot::{Axis, LineSeries};

    use super::*;

    #[test]
    fn axes_and_series_are_named() {
        let series = |name: &str, unlisted| LineSeries {
            name: name.to_owned(),
            unlisted,
            ..LineSeries::default()
        };
        let chart = LineChart {
            x: Axis::new("Eccentricity (°)".to_owned()),
            y: Axis::new("PSNR in dB".to_owned()),
            series: vec![series("A", false), series("B", false), series("hidden", true)],
            ..LineChart::default()
        };
        let said = "Line chart of PSNR in dB against Eccentricity (°) for A, B";
        assert_eq!(in_words(&Figure::Line(chart)), said);
        let many: Vec<String> = (0..20).map(|nth| format!("m{nth}")).collect();
        let names: Vec<&str> = many.iter().map(String::as_str).collect();
        assert!(listed(": ", &names).ends_with("m10, m11 and 8 more"));
    }
}
