//! Figures of ratings: mean scores by level, or over a grid.

use fovqa_plot::{Axis, Figure, LineChart, LineSeries, Look, RasterChart, RasterPanel, Span};
use fovqa_study::json::Document;
use fovqa_study::ratings::{Acceptable, GridRatings, LevelRatings, Ratings};

use super::context::{Context, caption, ends, group_name, parts, rounded, short};
use super::psychometric::{MOST_FIGURES, MOST_PANELS, panel_figure};
use crate::sheet::NamedFigure;

/// The most groups of one chart; more groups have a panel each.
const MOST_SERIES: usize = 3;
/// Space above and below the scores of panels, as a share of their range.
const AIR: f64 = 0.06;

pub(super) fn figures(document: &Document<Ratings>, context: &Context) -> Vec<NamedFigure> {
    let (mut levels, mut grids) = (Vec::new(), Vec::new());
    for (index, group) in document.groups.iter().enumerate() {
        match &group.result {
            Ratings::Levels(of) => {
                levels.push(Levels { look: index, name: group_name(&group.by), ratings: of });
            }
            Ratings::Grid(of) => grids.push((group_name(&group.by), of)),
        }
    }
    levels.retain(|of| of.ratings.levels.iter().any(|level| level.moments.mean.is_some()));
    let per_figure = if levels.len() > MOST_SERIES { MOST_PANELS } else { MOST_SERIES };
    let has_panels = levels.len() > MOST_SERIES;
    let (parts, left) = parts(&levels, per_figure, MOST_FIGURES, "groups");
    let by_level = |part: &[Levels<'_>]| by_level(part, has_panels, context, &left);
    let mut figures: Vec<NamedFigure> = parts.into_iter().map(by_level).collect();
    figures.extend(over_grid(&grids, context));
    figures
}

/// The scores of a group.
#[derive(Clone)]
struct Levels<'a> {
    /// The index of its look.
    look: usize,
    name: String,
    ratings: &'a LevelRatings,
}

impl Levels<'_> {
    fn acceptable(&self) -> Option<&Acceptable> {
        self.ratings.acceptable.as_ref()
    }
}

fn by_level(part: &[Levels<'_>], has_panels: bool, context: &Context, left: &str) -> NamedFigure {
    let coverage = context.coverage();
    let figure = if has_panels {
        let y = common_axis(part);
        let panel = |of: &Levels<'_>| {
            let one = Levels { look: 0, name: String::new(), ratings: of.ratings };
            LineChart { title: Some(of.name.clone()), y: y.clone(), ..chart(&[one], &coverage) }
        };
        panel_figure(part.iter().map(panel).collect(), 3)
    } else {
        Figure::Line(chart(part, &coverage))
    };
    let acceptable = || part.iter().filter_map(Levels::acceptable);
    let has_interval =
        part.iter().any(|of| of.ratings.levels.iter().any(|l| l.moments.ci.is_some()));
    let has_crossing = acceptable().any(|of| of.crossing.is_some());
    let has_span = acceptable().any(|of| ends(of.crossing_ci).is_some());
    let is_shaded = has_span && (has_panels || part.len() == 1);
    let text = caption(&[
        "Mean score by level over the participants' means",
        &if has_interval { format!("intervals: {coverage} t intervals") } else { String::new() },
        if has_crossing { "rings: where the mean falls below the threshold" } else { "" },
        &if is_shaded {
            format!(
                "shaded: {coverage} bootstrap interval of the crossing (participants resampled)"
            )
        } else {
            crossings_in_words(part, &coverage)
        },
        left,
    ]);
    context.figure("levels", "", (text, figure))
}

/// The vertical axis, the same in all panels. It has room for all scores, intervals and thresholds.
fn common_axis(part: &[Levels<'_>]) -> Axis {
    let of = |of: &Levels<'_>| {
        let levels = of.ratings.levels.iter().map(|level| &level.moments);
        let values = levels.flat_map(|of| of.ci.into_iter().flatten().chain(of.mean));
        values.chain(of.acceptable().map(|of| of.threshold)).collect::<Vec<f64>>()
    };
    let values = || part.iter().flat_map(of).filter(|value| value.is_finite());
    let low = values().fold(f64::INFINITY, f64::min);
    let high = values().fold(f64::NEG_INFINITY, f64::max);
    let air = AIR * (high - low);
    Axis { min: Some(low - air), max: Some(high + air), ..Axis::new("Mean score") }
}

/// The scores of up to three groups.
fn chart(part: &[Levels<'_>], coverage: &str) -> LineChart {
    let levels = || part.iter().flat_map(|of| of.ratings.levels.iter().map(|of| of.level));
    let first = levels().fold(f64::INFINITY, f64::min);
    let last = levels().fold(f64::NEG_INFINITY, f64::max);
    let acceptable = || part.iter().filter_map(Levels::acceptable);
    let mut series = Vec::new();
    series.extend(acceptable().next().map(|acceptable| LineSeries {
        name: format!("threshold, {}", rounded(acceptable.threshold)),
        reference: true,
        points: vec![(first, Some(acceptable.threshold)), (last, Some(acceptable.threshold))],
        ..LineSeries::default()
    }));
    let ring = |of: &Levels<'_>| {
        let acceptable = of.acceptable()?;
        Some(LineSeries {
            name: "crossing".to_owned(),
            look: Look::new(of.look),
            rings: true,
            unlisted: true,
            points: vec![(acceptable.crossing?, Some(acceptable.threshold))],
            ..LineSeries::default()
        })
    };
    series.extend(part.iter().filter_map(ring));
    series.extend(part.iter().map(scores));
    let span = |acceptable: &Acceptable| {
        let [low, high] = ends(acceptable.crossing_ci)?;
        let name = format!("{coverage} interval of the crossing");
        Some(Span { name, from: low.max(first), to: high.min(last) })
    };
    // Spans of several groups would hide each other.
    let spans = acceptable().filter(|_| part.len() == 1).filter_map(span);
    LineChart {
        x: Axis::new("Level"),
        y: Axis::new("Mean score"),
        spans: spans.collect(),
        series,
        ..LineChart::default()
    }
}

fn scores(of: &Levels<'_>) -> LineSeries {
    let levels = || of.ratings.levels.iter().filter(|level| level.level.is_finite());
    LineSeries {
        name: of.name.clone(),
        look: Look::new(of.look),
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
        limit => format!("{limit:.3}"),
    };
    let crossing = |of: &Levels<'_>| {
        let acceptable = of.acceptable()?;
        let interval = ends(acceptable.crossing_ci)
            .map(|[low, high]| format!(" [{}, {}]", limit(low), limit(high)));
        let interval = interval.unwrap_or_default();
        Some(format!("{} {:.3}{interval}", short(&of.name), acceptable.crossing?))
    };
    let all: Vec<String> = part.iter().filter(|_| part.len() > 1).filter_map(crossing).collect();
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
