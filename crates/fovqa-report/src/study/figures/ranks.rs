//! Figures of rank tests: the mean of each method with brackets of significance.

use fovqa_plot::{Axis, Figure};
use fovqa_study::json::{Document, Group};
use fovqa_study::options::PairwiseTest;
use fovqa_study::ranks::Ranks;

use super::anova::{Bar, bars};
use super::brackets::{Compared, brackets};
use super::context::{Context, MOST_FIGURES, caption, group_in_words, group_name, left_out, parts};
use super::dots::MOST_GROUPS;
use crate::sheet::NamedFigure;

pub(super) fn figures(document: &Document<Ranks>, context: &Context) -> Vec<NamedFigure> {
    let (parts, left) = parts(&document.groups, 1, MOST_FIGURES, "groups");
    parts.into_iter().flatten().filter_map(|group| means(group, context, &left)).collect()
}

fn means(group: &Group<Ranks>, context: &Context, groups_left: &str) -> Option<NamedFigure> {
    let Ranks { methods: all, pairwise, .. } = &group.result;
    let methods = &all[..all.len().min(MOST_GROUPS)];
    let bar = |method: &fovqa_study::ranks::Method| Bar { mean: method.mean, se: method.se };
    let names: Vec<&str> = methods.iter().map(|method| method.method.as_str()).collect();
    let tests = pairwise.iter().map(|test| Compared {
        names: [test.method.as_str(), test.opponent.as_str()],
        p_adjusted: test.p_adjusted,
    });
    let (brackets, brackets_left) = brackets(&names, tests);
    let test = pairwise.first().map_or("", |test| match test.test {
        PairwiseTest::Kruskal => "Kruskal-Wallis test of two methods",
        PairwiseTest::Dunn => "Dunn's test of two methods",
        PairwiseTest::SignedRank => "Wilcoxon's signed-rank test of two methods",
    });
    let stars = if brackets.is_empty() { String::new() } else { context.stars(test) };
    let has_errors = methods.iter().any(|method| method.se.is_some());
    let text = caption(&[
        "Mean of each method over participants or other units",
        &group_in_words(&group.by),
        if has_errors { "error bars: standard error of the mean" } else { "" },
        &stars,
        &brackets_left,
        &left_out(all.len(), methods.len(), "methods"),
        groups_left,
    ]);
    let groups = names.iter().map(|&name| name.to_owned()).collect();
    let rows = [(String::new(), methods.iter().map(bar).collect())];
    let chart = bars(Axis::new("Mean value"), groups, &rows, brackets)?;
    Some(context.figure("means", &group_name(&group.by), (text, Figure::Bar(chart))))
}
