//! Figures of ratings: mean scores by level, or over a grid.

use fovqa_plot::{Axis, Figure, LineChart, LineSeries, Look, RasterChart, RasterPanel, Span};
use fovqa_study::json::Document;
use fovqa_study::ratings::{Acceptable, GridRatings, LevelRatings, Ratings};

use super::context::{Context, caption, ends, group_name, parts, rounded, short};
use super::psychometric::{MOST_FIGURES, MOST_PANELS};
use crate::sheet::NamedFigure;

/// The most groups of a figure.
const MOST_SERIES: usize = 8;

pub(super) fn figures(document: &Document<Ratings>, context: &Context) -> Vec<NamedFigure> {
    let (mut levels, mut grids) = (Vec::new(), Vec::new());
    for (index, group) in document.groups.iter().enumerate() {
        match &group.result {
            Ratings::Levels(of) => levels.push((index, group_name(&group.by), of)),
            Ratings::Grid(of) => grids.push((group_name(&group.by), of)),
        }
    }
    levels
        .retain(|(_, _, ratings)| ratings.levels.iter().any(|level| level.moments.mean.is_some()));
    let (parts, left) = parts(&levels, MOST_SERIES, MOST_FIGURES, "groups");
    let mut figures: Vec<NamedFigure> =
        parts.into_iter().map(|part| by_level(part, context, &left)).collect();
    figures.extend(over_grid(&grids, context));
    figures
}

/// The index of a group's look, its name, and its scores.
type Levels<'a> = (usize, String, &'a LevelRatings);

fn by_level(part: &[Levels<'_>], context: &Context, left: &str) -> NamedFigure {
    let coverage = context.coverage();
    let acceptable = || part.iter().filter_map(|(_, _, of)| of.acceptable.as_ref());
    let all_levels = || part.iter().flat_map(|(_, _, of)| of.levels.iter().map(|of| of.level));
    let first = all_levels().fold(f64::INFINITY, f64::min);
    let last = all_levels().fold(f64::NEG_INFINITY, f64::max);
    let mut series = Vec::new();
    series.extend(acceptable().next().map(|acceptable| LineSeries {
        name: format!("threshold, {}", rounded(acceptable.threshold)),
        reference: true,
        points: vec![(first, Some(acceptable.threshold)), (last, Some(acceptable.threshold))],
        ..LineSeries::default()
    }));
    let ring = |&(look, _, of): &Levels<'_>| {
        let acceptable = of.acceptable.as_ref()?;
        Some(LineSeries {
            name: "crossing".to_owned(),
            look: Look::new(look),
            rings: true,
            unlisted: true,
            points: vec![(acceptable.crossing?, Some(acceptable.threshold))],
            ..LineSeries::default()
        })
    };
    series.extend(part.iter().filter_map(ring));
    series.extend(part.iter().map(|(look, name, of)| scores(*look, name, of)));
    let is_one = part.len() == 1;
    let span = |acceptable: &Acceptable| {
        let [low, high] = ends(acceptable.crossing_ci)?;
        Some(Span {
            name: format!("{coverage} interval of the crossing"),
            from: low.max(first),
            to: high.min(last),
        })
    };
    let spans: Vec<Span> = acceptable().filter(|_| is_one).filter_map(span).collect();
    let has_interval =
        part.iter().any(|(_, _, of)| of.levels.iter().any(|l| l.moments.ci.is_some()));
    let text = caption(&[
        "Mean score by level over the participants' means",
        &if has_interval { format!("intervals: {coverage} t intervals") } else { String::new() },
        if acceptable().any(|of| of.crossing.is_some()) {
            "rings: where the mean falls below the threshold"
        } else {
            ""
        },
        &if spans.is_empty() {
            String::new()
        } else {
            format!("shaded: its {coverage} bootstrap interval (participants resampled)")
        },
        &if is_one { String::new() } else { crossings_in_words(part, &coverage) },
        left,
    ]);
    let chart = LineChart {
        x: Axis::new("Level"),
        y: Axis::new("Mean score"),
        series,
        spans,
        ..LineChart::default()
    };
    context.figure("levels", "", (text, Figure::Line(chart)))
}

fn scores(look: usize, name: &str, ratings: &LevelRatings) -> LineSeries {
    let levels = || ratings.levels.iter().filter(|level| level.level.is_finite());
    LineSeries {
        name: name.to_owned(),
        look: Look::new(look),
        points: levels().map(|level| (level.level, level.moments.mean)).collect(),
        intervals: levels().map(|level| level.moments.ci).collect(),
        ..LineSeries::default()
    }
}

/// The crossings of several groups, whose intervals would hide each other in the figure.
fn crossings_in_words(part: &[Levels<'_>], coverage: &str) -> String {
    let limit = |limit: f64| match limit {
        limit if limit == f64::INFINITY => "∞".to_owned(),
        limit if limit == f64::NEG_INFINITY => "−∞".to_owned(),
        limit => format!("{:.3}", limit),
    };
    let of = |(_, name, of): &Levels<'_>| {
        let acceptable = of.acceptable.as_ref()?;
        let interval = ends(acceptable.crossing_ci)
            .map(|[low, high]| format!(" [{}, {}]", limit(low), limit(high)));
        Some(format!("{} {:.3}{}", short(name), acceptable.crossing?, interval.unwrap_or_default()))
    };
    let all: Vec<String> = part.iter().filter_map(of).collect();
    match all.as_slice() {
        [] => String::new(),
        all => format!("crossings with {coverage} bootstrap intervals: {}", all.join(", ")),
    }
}

fn over_grid(grids: &[(String, &GridRatings)], context: &Context) -> Vec<NamedFigure> {
    let panels: Vec<RasterPanel> =
        grids.iter().filter_map(|(name, ratings)| map(name, ratings)).collect();
    let (parts, left) = parts(&panels, MOST_PANELS, MOST_FIGURES, "groups");
    let cells = || grids.iter().flat_map(|(_, ratings)| &ratings.grid);
    let is_smoothed = cells().any(|cell| cell.smoothed.is_some());
    let smoothed = if is_smoothed { ", smoothed with the weights 1, 2, 1" } else { "" };
    let text = caption(&[
        &format!("Mean score over two parameters{smoothed}"),
        "cross: the highest score",
        "gray: no scores",
        &left,
    ]);
    let figure = |part: &[RasterPanel]| {
        let colour = if is_smoothed { "Mean score, smoothed" } else { "Mean score" };
        let columns = match part.len() {
            0..=1 => 1,
            2..=4 => 2,
            _ => 3,
        };
        let chart = RasterChart {
            panels: part.to_vec(),
            columns,
            colour: Axis::new(colour),
            ..RasterChart::default()
        };
        context.figure("grid", "", (text.clone(), Figure::Raster(chart)))
    };
    parts.into_iter().map(figure).collect()
}

/// The map of a group; `None` if a parameter has one value only.
fn map(name: &str, ratings: &GridRatings) -> Option<RasterPanel> {
    let values = |of: fn(&fovqa_study::ratings::Cell) -> f64| {
        let mut values: Vec<f64> = ratings.grid.iter().map(of).filter(|v| v.is_finite()).collect();
        values.sort_by(f64::total_cmp);
        values.dedup_by(|a, b| a.total_cmp(b).is_eq());
        values
    };
    let (xs, ys) = (values(|cell| cell.fx), values(|cell| cell.fy));
    if xs.len() < 2 || ys.len() < 2 {
        return None;
    }
    let place = |values: &[f64], value: f64| values.partition_point(|other| *other < value);
    let mut scores = vec![None; xs.len() * ys.len()];
    for cell in &ratings.grid {
        let score = cell.smoothed.unwrap_or(cell.mean);
        if let Some(at) = scores.get_mut(place(&xs, cell.fx) * ys.len() + place(&ys, cell.fy)) {
            *at = Some(score);
        }
    }
    let [x, y] = &ratings.columns;
    let panel =
        RasterPanel::map((Axis::new(x.as_str()), &xs), (Axis::new(y.as_str()), &ys), |x, y| {
            scores[x * ys.len() + y]
        });
    let cross = ratings.best.map(|best| (best.fx, best.fy));
    Some(RasterPanel { title: (!name.is_empty()).then(|| name.to_owned()), cross, ..panel })
}
