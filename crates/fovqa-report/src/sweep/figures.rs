//! Maps over two parameters, and curves or bars over one.

use fovqa_metrics::Metric;
use fovqa_params::ParamValue;
use fovqa_plan::{Plot, shown_value};
use fovqa_plot::{
    Axis, BarChart, BarSeries, Figure, LineChart, LineSeries, Look, RasterChart, RasterPanel,
};

use super::grid::{Grid, Place, best_and_worst, numbers};
use crate::comparison::{Measure, named};
use crate::figures::{Source, metric_axis, metrics, slug};
use crate::sheet::NamedFigure;

/// Maximum number of maps in a figure.
const MOST_MAPS: usize = 48;
/// Maximum number of curves in a figure.
const MOST_CURVES: usize = 20;
/// The ratio of the largest to the smallest value from which evenly spaced ratios get a logarithmic
/// axis.
const LOG_RATIO: f64 = 4.0;

/// The figures of a sweep: for each metric and scene, a map of each method with two or more numbers as
/// parameters, and curves over the parameter of those with one.
pub(crate) fn figures(source: &Source<'_>, plot: &Plot) -> Vec<NamedFigure> {
    let scenes = source.run.resolved.scenes.iter().map(|scene| scene.name.as_str());
    let scenes = named(plot.scenes.as_deref(), scenes);
    let grids = Grid::all(source, plot);
    let (maps, curves): (Vec<Grid<'_>>, Vec<Grid<'_>>) =
        grids.into_iter().partition(|grid| map_keys(grid).is_some());
    let others = Grid::others(source, plot);
    // A plot of one scene names it too, if the run has others.
    let is_one_of_several = source.run.resolved.scenes.len() > 1;
    let mut figures = Vec::new();
    for metric in metrics(source, plot) {
        for place in Place::all(&scenes) {
            let of = Of { source, metric, place, is_one_of_several };
            figures.extend(of.maps(&maps));
            figures.extend(of.curves(&curves, &others));
        }
    }
    figures
}

/// The indices of the two keys that span a map: the last two, if both have numbers.
fn map_keys(grid: &Grid<'_>) -> Option<[usize; 2]> {
    let keys = &grid.sweep.keys;
    let [.., x, y] = keys.as_slice() else { return None };
    let long = |numbers: Vec<f64>| numbers.len() > 1;
    let both = numbers(x).is_some_and(long) && numbers(y).is_some_and(long);
    both.then(|| [keys.len() - 2, keys.len() - 1])
}

/// The index of the key that is the horizontal axis of curves, the last one with numbers, or of bars,
/// the last one.
fn curve_key(grid: &Grid<'_>) -> usize {
    let keys = &grid.sweep.keys;
    let with_numbers = keys.iter().rposition(|key| numbers(key).is_some());
    with_numbers.unwrap_or(keys.len().saturating_sub(1))
}

/// An axis for the values of a swept key.
fn axis(key: &str, values: &[f64]) -> Axis {
    let title = match key {
        "budget" => "Budget (share of the frame's pixels)".to_owned(),
        key => key.to_owned(),
    };
    Axis { log: is_log(values), ..Axis::new(title) }
}

/// Whether values rise by equal ratios rather than by equal differences.
fn is_log(values: &[f64]) -> bool {
    const EQUAL: f64 = 1e-6;
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let (Some(low), Some(high)) = (sorted.first(), sorted.last()) else { return false };
    if !(sorted.len() > 2 && *low > 0.0 && high / low >= LOG_RATIO) {
        return false;
    }
    let ratios: Vec<f64> = sorted.windows(2).map(|pair| pair[1] / pair[0]).collect();
    ratios.iter().all(|ratio| (ratio / ratios[0] - 1.0).abs() < EQUAL)
}

/// What a figure is of.
struct Of<'a> {
    source: &'a Source<'a>,
    metric: Metric,
    place: Place<'a>,
    is_one_of_several: bool,
}

impl Of<'_> {
    fn title(&self) -> Option<String> {
        self.is_one_of_several.then(|| self.place.title())
    }

    fn name(&self, what: &str) -> String {
        let key = slug(self.metric.key());
        let place = if self.is_one_of_several { self.place.name() } else { String::new() };
        let parts = ["sweep", &key, &slug(what), &slug(&place)].map(str::to_owned);
        parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join("-")
    }

    fn values(&self, grid: &Grid<'_>) -> Vec<Option<f64>> {
        grid.values(self.source.overview, self.place, self.metric)
    }

    /// The best value of a grid and its place, in words.
    fn best_in_words(&self, grid: &Grid<'_>, values: &[Option<f64>]) -> Option<String> {
        let (best, _) = best_and_worst(self.metric, values)?;
        let value = Measure::of_value(self.metric).shown(values[best]);
        Some(format!("{}, {value} at {}", grid.sweep.method, grid.at_in_words(best)))
    }

    fn caption(&self, what: &str, best: &[String], how: &str) -> String {
        let label = self.metric.info().label;
        let place = if self.is_one_of_several {
            format!(", {}", self.place.title())
        } else {
            String::new()
        };
        let best = if best.is_empty() {
            String::new()
        } else {
            format!("; best{how}: {}", best.join("; "))
        };
        format!("{label} over {what}{place}{best}")
    }

    /// One map for each method and each combination of its other parameters.
    fn maps(&self, grids: &[Grid<'_>]) -> Option<NamedFigure> {
        let (mut panels, mut best) = (Vec::new(), Vec::new());
        for grid in grids {
            let values = self.values(grid);
            best.extend(self.best_in_words(grid, &values));
            panels.extend(self.maps_of(grid, &values, grids.len() > 1));
        }
        let keys = |grid: &Grid<'_>| grid.sweep.keys.iter().map(|key| key.key.clone()).collect();
        let keys: Vec<Vec<String>> = grids.iter().map(keys).collect();
        if panels.is_empty() || panels.len() > MOST_MAPS {
            return None;
        }
        let columns = match panels.len() {
            0..=1 => 1,
            2..=4 => 2,
            _ => 3,
        };
        let what = keys.first().map(|keys| keys.join(", ")).unwrap_or_default();
        let figure = Figure::Raster(RasterChart {
            title: self.title(),
            panels,
            columns,
            colour: Axis::new(metric_axis(self.metric)),
            ..RasterChart::default()
        });
        let caption = self.caption(&what, &best, " (cross)");
        Some(NamedFigure::new(self.name(""), caption, figure))
    }

    fn maps_of(&self, grid: &Grid<'_>, values: &[Option<f64>], several: bool) -> Vec<RasterPanel> {
        let Some([x, y]) = map_keys(grid) else { return Vec::new() };
        let keys = &grid.sweep.keys;
        let (across, down) = (&keys[x], &keys[y]);
        let (xs, ys) = (numbers(across).unwrap_or_default(), numbers(down).unwrap_or_default());
        let cells = xs.len() * ys.len();
        let best = best_and_worst(self.metric, values).map(|(best, _)| best);
        let panel = |(index, of_panel): (usize, &[Option<f64>])| {
            let first = index * cells;
            let others = grid.sweep.at(first).take(x);
            let others = others.map(|(key, value)| format!("{key} = {}", shown_value(value)));
            let name = several.then(|| grid.sweep.method.clone());
            let title: Vec<String> = name.into_iter().chain(others).collect();
            let value = |column: usize, row: usize| of_panel[column * ys.len() + row];
            let cross = best.and_then(|best| best.checked_sub(first)).filter(|at| *at < cells);
            let cross = cross.map(|at| (xs[at / ys.len()], ys[at % ys.len()]));
            RasterPanel {
                title: (!title.is_empty()).then(|| title.join(", ")),
                cross,
                ..RasterPanel::map(
                    (axis(&across.key, &xs), &xs),
                    (axis(&down.key, &ys), &ys),
                    value,
                )
            }
        };
        values.chunks(cells).enumerate().map(panel).collect()
    }

    /// The curves of all methods with the same parameter, for each parameter.
    fn curves(&self, grids: &[Grid<'_>], others: &[&str]) -> Vec<NamedFigure> {
        let mut keys: Vec<&str> = Vec::new();
        for grid in grids {
            let key = grid.sweep.keys[curve_key(grid)].key.as_str();
            if !keys.contains(&key) {
                keys.push(key);
            }
        }
        let several = keys.len() > 1;
        keys.into_iter()
            .filter_map(|key| {
                let of_key =
                    grids.iter().filter(|grid| grid.sweep.keys[curve_key(grid)].key == key);
                let of_key: Vec<&Grid<'_>> = of_key.collect();
                self.curves_of(key, several, &of_key, others)
            })
            .collect()
    }

    fn curves_of(
        &self,
        key: &str,
        several: bool,
        grids: &[&Grid<'_>],
        others: &[&str],
    ) -> Option<NamedFigure> {
        let mut all: Vec<Named<'_>> = Vec::new();
        let mut best = Vec::new();
        for grid in grids {
            let values = self.values(grid);
            best.extend(self.best_in_words(grid, &values));
            let along = curve_key(grid);
            for (point, value) in values.iter().enumerate() {
                let rest = grid.sweep.at(point).enumerate().filter(|(index, _)| *index != along);
                let rest = rest.map(|(_, (key, value))| format!("{key} = {}", shown_value(value)));
                let name = std::iter::once(grid.sweep.method.clone()).chain(rest);
                let name = name.collect::<Vec<_>>().join(", ");
                let Some((_, at)) = grid.sweep.at(point).nth(along) else { continue };
                match all.iter_mut().find(|(known, _)| *known == name) {
                    Some((_, points)) => points.push((at, *value)),
                    None => all.push((name, vec![(at, *value)])),
                }
            }
        }
        if all.is_empty() || all.len() > MOST_CURVES {
            return None;
        }
        let figure = match numbers_of(&all) {
            Some(curves) => self.line_chart(key, curves, others),
            None => self.bar_chart(&all),
        };
        let name = self.name(if several { key } else { "" });
        Some(NamedFigure::new(name, self.caption(key, &best, " (ring)"), figure))
    }

    fn line_chart(&self, key: &str, curves: Vec<Curve>, others: &[&str]) -> Figure {
        let xs: Vec<f64> = curves.iter().flat_map(|(_, points)| points).map(|of| of.0).collect();
        let ends = [f64::min, f64::max].map(|pick| xs.iter().copied().reduce(pick));
        let mut distinct = xs.clone();
        distinct.sort_by(f64::total_cmp);
        distinct.dedup();
        let mut series = Vec::new();
        let count = curves.len();
        for (index, (name, mut points)) in curves.into_iter().enumerate() {
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            let values: Vec<Option<f64>> = points.iter().map(|of| of.1).collect();
            let best = best_and_worst(self.metric, &values).map(|(best, _)| points[best]);
            let look = Look::new(index);
            series.extend(best.map(|best| LineSeries {
                name: format!("{name}, best"),
                look,
                rings: true,
                unlisted: true,
                points: vec![best],
                ..LineSeries::default()
            }));
            series.push(LineSeries { name, look, points, ..LineSeries::default() });
        }
        // A method that is not swept is the same everywhere.
        for (index, name) in others.iter().enumerate() {
            let value = self.place.value(self.source.overview, name, |of| of.value(self.metric));
            let (Some(value), [Some(from), Some(to)]) = (value, ends) else { continue };
            series.push(LineSeries {
                name: (*name).to_owned(),
                look: Look::new(count + index),
                points: vec![(from, Some(value)), (to, Some(value))],
                ..LineSeries::default()
            });
        }
        // Rings are behind all curves.
        series.sort_by_key(|series: &LineSeries| !series.rings);
        Figure::Line(LineChart {
            title: self.title(),
            x: axis(key, &distinct),
            y: Axis::new(metric_axis(self.metric)),
            series,
            ..LineChart::default()
        })
    }

    fn bar_chart(&self, all: &[Named<'_>]) -> Figure {
        let mut groups: Vec<String> = Vec::new();
        for (value, _) in all.iter().flat_map(|(_, points)| points) {
            let shown = shown_value(value);
            if !groups.contains(&shown) {
                groups.push(shown);
            }
        }
        let series = all.iter().enumerate().map(|(index, (name, points))| BarSeries {
            name: name.clone(),
            look: Look::new(index),
            values: groups
                .iter()
                .map(|group| points.iter().find(|of| shown_value(of.0) == *group)?.1)
                .collect(),
            ..BarSeries::default()
        });
        let series = series.collect();
        Figure::Bar(BarChart {
            title: self.title(),
            y: Axis::new(metric_axis(self.metric)),
            groups,
            series,
            ..BarChart::default()
        })
    }
}

/// A name, and its points by the values of a key.
type Named<'a> = (String, Vec<(&'a ParamValue, Option<f64>)>);

/// A name, and its points by numbers.
type Curve = (String, Vec<(f64, Option<f64>)>);

/// The curves, if all their positions are numbers.
fn numbers_of(all: &[Named<'_>]) -> Option<Vec<Curve>> {
    let curve = |(name, points): &Named<'_>| {
        let points = points.iter().map(|(at, value)| Some((at.number()?, *value)));
        Some((name.clone(), points.collect::<Option<Vec<_>>>()?))
    };
    all.iter().map(curve).collect()
}
