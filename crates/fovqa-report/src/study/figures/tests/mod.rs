//! The figures of small tables: they show the numbers of the analysis, and no more than fits.
#![allow(clippy::float_cmp, reason = "what is exact is compared exactly")]

use std::fmt::Write as _;

use fovqa_plot::{BarChart, Figure, LineChart, LineSeries, Look, Style};
use fovqa_study::adjust::stars;
use fovqa_study::input::{Data, Selection, Table};
use fovqa_study::options::{Alternative, LevelMean, Smoothing, Ties};
use fovqa_study::{
    Settings, StudyError, anova, metrics, pairs, plan, psychometric, ranks, ratings, staircase,
};

use super::*;

mod comparisons;
mod levels;
mod predictions;

fn settings() -> Settings {
    Settings { bootstrap: 50, ..Settings::default() }
}

/// The result for a table, whose rows are grouped by these columns.
fn analysed(
    csv: &str,
    by: &[&str],
    run: impl Fn(&Data, &Settings) -> Result<Analysis, StudyError>,
) -> Analysis {
    let table = Table::read("t.csv", csv.as_bytes()).unwrap();
    let by = by.iter().map(|&column| column.to_owned()).collect();
    let selection = Selection { by, ..Selection::default() };
    run(&Data::new(&table, &selection).unwrap(), &settings()).unwrap()
}

fn drawn(analysis: &Analysis) -> Vec<NamedFigure> {
    let figures = figures(analysis, "study", &settings());
    for figure in &figures {
        figure.figure.print(&Style::default()).unwrap();
        assert!(figure.name.len() < 250, "{}", figure.name);
    }
    figures
}

fn names(figures: &[NamedFigure]) -> Vec<&str> {
    figures.iter().map(|figure| figure.name.as_str()).collect()
}

fn bar<'a>(figures: &'a [NamedFigure], name: &str) -> (&'a str, &'a BarChart) {
    let figure = figures.iter().find(|figure| figure.name == name).unwrap();
    let Figure::Bar(chart) = &figure.figure else { unreachable!() };
    (&figure.caption, chart)
}

fn line<'a>(figures: &'a [NamedFigure], name: &str) -> (&'a str, &'a LineChart) {
    let figure = figures.iter().find(|figure| figure.name == name).unwrap();
    let Figure::Line(chart) = &figure.figure else { unreachable!() };
    (&figure.caption, chart)
}

fn series<'a>(chart: &'a LineChart, name: &str) -> &'a LineSeries {
    chart.series.iter().find(|series| series.name == name).unwrap()
}
