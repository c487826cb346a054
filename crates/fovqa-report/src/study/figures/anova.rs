//! Figures of an analysis of variance: means of cells, and of the levels of each factor.

use fovqa_plot::{Axis, BarChart, BarSeries, Bracket, Figure, Look};
use fovqa_study::adjust::stars;
use fovqa_study::anova::{Anova, LevelMean};
use fovqa_study::json::{Document, Group};
use fovqa_study::moments::Moments;

use super::brackets::{Compared, brackets};
use super::context::{
    Context, MOST_FIGURES, caption, group_in_words, group_name, left_out, parts, short,
};
use super::dots::{MOST_GROUPS, distinct};
use crate::sheet::NamedFigure;

/// The most levels of the second factor.
const MOST_SERIES: usize = 8;

/// A mean with its standard error.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Bar {
    pub(super) mean: Option<f64>,
    pub(super) se: Option<f64>,
}

impl Bar {
    fn of(moments: &Moments) -> Self {
        Self { mean: moments.mean, se: moments.se }
    }
}

/// A chart of means with standard errors; dots if a mean is below 0. `None` without means.
pub(super) fn bars(
    y: Axis,
    groups: Vec<String>,
    rows: &[(String, Vec<Bar>)],
    brackets: Vec<Bracket>,
) -> Option<BarChart> {
    let finite = |value: Option<f64>| value.filter(|value| value.is_finite());
    let means = || rows.iter().flat_map(|(_, bars)| bars).filter_map(|bar| finite(bar.mean));
    means().next()?;
    let from_zero = means().all(|mean| mean >= 0.0);
    let series = rows.iter().enumerate().map(|(look, (name, bars))| BarSeries {
        name: name.clone(),
        look: Look::new(look),
        values: bars.iter().map(|bar| finite(bar.mean)).collect(),
        errors: bars.iter().map(|bar| finite(bar.se)).collect(),
        ..BarSeries::default()
    });
    let series = series.collect();
    Some(BarChart { y, groups, series, from_zero, brackets, ..BarChart::default() })
}

pub(super) fn figures(document: &Document<Anova>, context: &Context) -> Vec<NamedFigure> {
    let (parts, left) = parts(&document.groups, 1, MOST_FIGURES, "groups");
    parts.into_iter().flatten().flat_map(|group| of_group(group, context, &left)).collect()
}

fn of_group(group: &Group<Anova>, context: &Context, groups_left: &str) -> Vec<NamedFigure> {
    let anova = &group.result;
    let factors = distinct(anova.levels.iter().map(|level| level.factor.as_str()));
    let of = Of { group, context, groups_left };
    match factors.as_slice() {
        [factor] => of.factor(factor, false).into_iter().collect(),
        [first, second] => {
            let is_significant = |factor: &&str| {
                let tests = anova.posthoc.iter().flatten();
                tests
                    .filter(|test| test.factor == **factor)
                    .any(|t| !stars(t.p_adjusted).is_empty())
            };
            let mut figures: Vec<NamedFigure> = of.cells([first, second]).into_iter().collect();
            let factors = [first, second].into_iter().filter(|factor| is_significant(factor));
            figures.extend(factors.filter_map(|factor| of.factor(factor, true)));
            figures
        }
        _ => Vec::new(),
    }
}

/// What the figures of a group have in common.
struct Of<'a> {
    group: &'a Group<Anova>,
    context: &'a Context,
    groups_left: &'a str,
}

const ERRORS: &str = "error bars: standard error of the mean over participants";

impl Of<'_> {
    /// The means of the levels of a factor, averaged over the other factor if there is one.
    fn factor(&self, factor: &str, is_averaged: bool) -> Option<NamedFigure> {
        let anova = &self.group.result;
        let all: Vec<&LevelMean> =
            anova.levels.iter().filter(|level| level.factor == factor).collect();
        let shown = &all[..all.len().min(MOST_GROUPS)];
        let names: Vec<&str> = shown.iter().map(|level| level.level.as_str()).collect();
        let tests = anova.posthoc.iter().flatten().filter(|test| test.factor == factor);
        let tests = tests.map(|test| Compared {
            names: [test.a.as_str(), test.b.as_str()],
            p_adjusted: test.p_adjusted,
        });
        let (brackets, brackets_left) = brackets(&names, tests);
        let averaged = if is_averaged { ", averaged over the other factor" } else { "" };
        let test = format!("paired t test of two levels{averaged}");
        let stars = if brackets.is_empty() { String::new() } else { self.context.stars(&test) };
        let text = caption(&[
            &format!("Means by {}{averaged}", short(factor)),
            &group_in_words(&self.group.by),
            if shown.iter().any(|level| level.moments.se.is_some()) { ERRORS } else { "" },
            &stars,
            &brackets_left,
            &left_out(all.len(), shown.len(), "levels"),
            self.groups_left,
        ]);
        let groups = names.iter().map(|&name| name.to_owned()).collect();
        let rows = shown.iter().map(|level| Bar::of(&level.moments)).collect();
        let chart = bars(Axis::new("Mean value"), groups, &[(String::new(), rows)], brackets)?;
        Some(self.figure("factor", factor, (text, Figure::Bar(chart))))
    }

    /// The means of the cells: the levels of the first factor are groups, those of the second one
    /// series.
    fn cells(&self, [first, second]: [&str; 2]) -> Option<NamedFigure> {
        let anova = &self.group.result;
        let levels = |factor: &str| {
            let of = anova.levels.iter().filter(|level| level.factor == factor);
            of.map(|level| level.level.as_str()).collect::<Vec<&str>>()
        };
        let (groups, series) = (levels(first), levels(second));
        let shown = &groups[..groups.len().min(MOST_GROUPS)];
        // The last factor is fastest.
        let bar = |group: usize, of: usize| {
            let cell = anova.cells.get(group * series.len() + of);
            cell.map(|cell| Bar::of(&cell.moments)).unwrap_or_default()
        };
        let row = |(of, name): (usize, &&str)| {
            ((*name).to_owned(), (0..shown.len()).map(|group| bar(group, of)).collect())
        };
        let rows: Vec<_> = series.iter().enumerate().take(MOST_SERIES).map(row).collect();
        let has_errors = anova.cells.iter().any(|cell| cell.moments.se.is_some());
        let text = caption(&[
            &format!("Means by {} and {}", short(first), short(second)),
            &group_in_words(&self.group.by),
            if has_errors { ERRORS } else { "" },
            &left_out(groups.len(), shown.len(), &format!("levels of {}", short(first))),
            &left_out(
                series.len(),
                series.len().min(MOST_SERIES),
                &format!("levels of {}", short(second)),
            ),
            self.groups_left,
        ]);
        let names = shown.iter().map(|&name| name.to_owned()).collect();
        let chart = bars(Axis::new("Mean value"), names, &rows, Vec::new())?;
        Some(self.figure("cells", "", (text, Figure::Bar(chart))))
    }

    fn figure(&self, kind: &str, factor: &str, drawn: (String, Figure)) -> NamedFigure {
        let group = group_name(&self.group.by);
        let names = [factor, group.as_str()].into_iter().filter(|name| !name.is_empty());
        self.context.figure(kind, &names.collect::<Vec<_>>().join("-"), drawn)
    }
}
