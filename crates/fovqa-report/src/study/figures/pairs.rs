//! Figures of pairwise comparisons: shares of votes, and scores in JOD.

use std::collections::HashMap;

use fovqa_plot::{Axis, BarChart, Figure, ReferenceLine};
use fovqa_study::adjust::stars;
use fovqa_study::json::{Document, Group};
use fovqa_study::pairs::{Pair, Pairs, Scaled};

use super::context::{Context, caption, ends, group_name, left_out, parts};
use super::dots::{Dot, MOST_GROUPS, Row, chart, distinct};
use crate::sheet::NamedFigure;

/// The most dots of a figure.
const MOST_DOTS: usize = 120;
/// The most groups of a figure.
const MOST_SERIES: usize = 6;
/// The most figures.
const MOST_FIGURES: usize = 4;

pub(super) fn figures(document: &Document<Pairs>, context: &Context) -> Vec<NamedFigure> {
    let mut figures = shares(document, context);
    figures.extend(scores(document, context));
    figures
}

/// Two methods whose pair is counted as the wins of the first one.
type Names<'a> = (&'a str, &'a str);

/// The pairs of all groups, by first appearance.
fn all_pairs(document: &Document<Pairs>) -> Vec<Names<'_>> {
    let mut seen = std::collections::HashSet::new();
    let mut all = Vec::new();
    for pair in document.groups.iter().flat_map(|group| &group.result.pairs) {
        let names = (pair.method.as_str(), pair.opponent.as_str());
        if !seen.contains(&(names.1, names.0)) && seen.insert(names) {
            all.push(names);
        }
    }
    all
}

/// The groups with their indices, which are those of their looks.
fn indexed<T>(document: &Document<T>) -> Vec<(usize, &Group<T>)> {
    document.groups.iter().enumerate().collect()
}

fn shares(document: &Document<Pairs>, context: &Context) -> Vec<NamedFigure> {
    let all = all_pairs(document);
    let pairs = &all[..all.len().min(MOST_GROUPS)];
    if pairs.is_empty() {
        return Vec::new();
    }
    let per_figure = (MOST_DOTS / pairs.len()).clamp(1, MOST_SERIES);
    let groups = indexed(document);
    let (parts, groups_left) = parts(&groups, per_figure, MOST_FIGURES, "groups");
    let every = || document.groups.iter().flat_map(|group| &group.result.pairs);
    let is_exact = every().all(|pair| pair.clopper_pearson.is_some());
    let interval = if is_exact { "Clopper-Pearson" } else { "bootstrap (participants resampled)" };
    let has_interval = is_exact || every().any(|pair| pair.cluster.is_some());
    let intervals = format!("intervals: {} {interval}", context.coverage());
    let has_tests = every().any(|pair| pair.p_adjusted.is_some());
    let stars = context.stars("two-sided binomial test against 50 %");
    let text = caption(&[
        "Share of votes for the first method of each pair",
        if has_interval { &intervals } else { "" },
        if has_tests { &stars } else { "" },
        &left_out(all.len(), pairs.len(), "pairs"),
        &groups_left,
    ]);
    let names: Vec<String> = pairs.iter().map(|(a, b)| format!("{a} – {b}")).collect();
    let figure = |part: &[(usize, &Group<Pairs>)]| {
        let row =
            |&(index, group): &(usize, &Group<Pairs>)| share_row(index, group, pairs, is_exact);
        let y = Axis { min: Some(0.0), max: Some(100.0), ..Axis::new("Share of votes (%)") };
        let chart = chart(y, names.clone(), part.iter().map(row).collect())?;
        let references = vec![ReferenceLine { name: "50 %".to_owned(), value: 50.0 }];
        let figure = Figure::Bar(BarChart { references, ..chart });
        Some(context.figure("shares", "", (text.clone(), figure)))
    };
    parts.into_iter().filter_map(figure).collect()
}

fn share_row(index: usize, group: &Group<Pairs>, pairs: &[Names<'_>], is_exact: bool) -> Row {
    let of = |pair: &'_ Pair| {
        let interval = if is_exact { pair.clopper_pearson } else { ends(pair.cluster) };
        (pair.share, interval, stars(pair.p_adjusted))
    };
    let names = |pair: &'_ Pair| (pair.method.clone(), pair.opponent.clone());
    let known: HashMap<(String, String), _> =
        group.result.pairs.iter().map(|pair| (names(pair), of(pair))).collect();
    let find = |&(a, b): &Names<'_>| {
        let (a, b) = (a.to_owned(), b.to_owned());
        known.get(&(a.clone(), b.clone())).copied().or_else(|| {
            // The other method comes first in this group.
            let (share, interval, stars) = known.get(&(b, a)).copied()?;
            Some((1.0 - share, interval.map(|[low, high]| [1.0 - high, 1.0 - low]), stars))
        })
    };
    let found: Vec<_> = pairs.iter().map(find).collect();
    let percent = |share: f64| 100.0 * share;
    let dot = |found: &Option<(f64, Option<[f64; 2]>, &str)>| match found {
        Some((share, interval, _)) => Dot {
            value: Some(percent(*share)),
            interval: interval.map(|interval| interval.map(percent)),
        },
        None => Dot::default(),
    };
    let note = |found: &Option<(f64, Option<[f64; 2]>, &str)>| {
        found.map(|(_, _, stars)| stars.to_owned()).unwrap_or_default()
    };
    Row {
        name: group_name(&group.by),
        look: index,
        dots: found.iter().map(dot).collect(),
        notes: found.iter().map(note).collect(),
    }
}

fn scores(document: &Document<Pairs>, context: &Context) -> Vec<NamedFigure> {
    let scaled = |group: &Group<Pairs>| {
        let scaling = &group.result.scaling;
        let models =
            [("Bradley-Terry", &scaling.bradley_terry), ("Thurstone V", &scaling.thurstone)];
        models.map(|(name, model)| (name.to_owned(), model.clone()))
    };
    let (rows, groups): (Vec<(usize, String, Scaled)>, &str) = match document.groups.as_slice() {
        [one] => {
            let models = scaled(one).into_iter().enumerate();
            (models.map(|(look, (name, model))| (look, name, model)).collect(), "")
        }
        groups => {
            let of = |(look, group): (usize, &Group<Pairs>)| {
                (look, group_name(&group.by), group.result.scaling.bradley_terry.clone())
            };
            (groups.iter().enumerate().map(of).collect(), ", Bradley-Terry model")
        }
    };
    let rows: Vec<_> = rows.into_iter().filter(|(_, _, model)| model.scores.is_some()).collect();
    let all = rows.iter().flat_map(|(_, _, model)| model.scores.iter().flatten());
    let all = distinct(all.map(|score| score.method.as_str()));
    let methods = &all[..all.len().min(MOST_GROUPS)];
    if methods.is_empty() {
        return Vec::new();
    }
    let per_figure = (MOST_DOTS / methods.len()).clamp(1, MOST_SERIES);
    let (parts, rows_left) = parts(&rows, per_figure, MOST_FIGURES, "groups");
    let scores = || rows.iter().flat_map(|(_, _, model)| model.scores.iter().flatten());
    let has_interval = scores().any(|score| score.lo.is_some() || score.hi.is_some());
    let intervals = format!("intervals: {} bootstrap (participants resampled)", context.coverage());
    let text = caption(&[
        &format!(
            "Quality of the methods{groups}; a difference of 1 JOD is a share of 75 % of the votes"
        ),
        if has_interval { &intervals } else { "" },
        &left_out(all.len(), methods.len(), "methods"),
        &rows_left,
    ]);
    let names: Vec<String> = methods.iter().map(|&method| method.to_owned()).collect();
    let figure = |part: &[(usize, String, Scaled)]| {
        let row =
            |(look, name, model): &(usize, String, Scaled)| score_row(*look, name, model, methods);
        let chart =
            chart(Axis::new("Quality (JOD)"), names.clone(), part.iter().map(row).collect())?;
        Some(context.figure("scores", "", (text.clone(), Figure::Bar(chart))))
    };
    parts.into_iter().filter_map(figure).collect()
}

fn score_row(look: usize, name: &str, model: &Scaled, methods: &[&str]) -> Row {
    let scores = model.scores.as_deref().unwrap_or_default();
    let known: HashMap<&str, Dot> = scores
        .iter()
        .map(|score| {
            let interval = ends(Some([score.lo, score.hi]));
            (score.method.as_str(), Dot { value: Some(score.jod), interval })
        })
        .collect();
    let dots = methods.iter().map(|method| known.get(method).copied().unwrap_or_default());
    Row { name: name.to_owned(), look, dots: dots.collect(), notes: Vec::new() }
}
