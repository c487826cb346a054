//! The band of a method: all rates that it has over the settings of a panel.

use fovqa_plot::{Fill, FillKind, LineSeries, Look};

/// Points of a curve: eccentricity in degrees and rate.
pub(super) type Points = Vec<(f64, Option<f64>)>;

/// The relative difference below which rates are the same.
const SAME: f64 = 1e-9;

/// The curves of one method in a panel.
pub(super) struct Member {
    pub(super) name: String,
    pub(super) look: Look,
    pub(super) points: Points,
}

/// The bands of a panel: an area for each method, and its lower and upper edge as curves. A method
/// that has the same rates in all settings remains a curve.
pub(super) fn bands(members: Vec<Member>) -> (Vec<LineSeries>, Vec<Fill>) {
    let mut methods: Vec<(String, Look, Vec<Points>)> = Vec::new();
    for Member { name, look, points } in members {
        match methods.iter_mut().find(|(known, ..)| *known == name) {
            Some((_, _, all)) => all.push(points),
            None => methods.push((name, look, vec![points])),
        }
    }
    let (mut series, mut fills) = (Vec::new(), Vec::new());
    for (name, look, all) in methods {
        let line = |name: String, points, unlisted| LineSeries {
            name,
            look,
            points,
            smooth: true,
            unlisted,
            ..LineSeries::default()
        };
        let edges = edges(&all);
        // Rates that are the same for all settings may differ in the last digits.
        if edges.iter().all(|(_, low, high)| high - low <= SAME * high.abs()) {
            let only = edges.iter().map(|(e, low, _)| (*e, Some(*low))).collect();
            series.push(line(name, only, false));
            continue;
        }
        let of = |edge: fn(&(f64, f64, f64)) -> f64| -> Points {
            edges.iter().map(|point| (point.0, Some(edge(point)))).collect()
        };
        series.push(line(format!("{name}, lowest"), of(|p| p.1), true));
        series.push(line(format!("{name}, highest"), of(|p| p.2), true));
        fills.push(Fill { name, kind: FillKind::Band(look), points: edges });
    }
    (series, fills)
}

/// The lowest and the highest value at each position that one of the curves has.
fn edges(all: &[Points]) -> Vec<(f64, f64, f64)> {
    let mut values: Vec<(f64, f64)> =
        all.iter().flatten().filter_map(|(e, rate)| Some((*e, (*rate)?))).collect();
    values.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut edges: Vec<(f64, f64, f64)> = Vec::new();
    for (e, rate) in values {
        match edges.last_mut() {
            Some((known, low, high)) if known.total_cmp(&e).is_eq() => {
                (*low, *high) = (low.min(rate), high.max(rate));
            }
            _ => edges.push((e, rate, rate)),
        }
    }
    edges
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_band_lies_between_the_lowest_and_the_highest() {
        let member = |name: &str, rates: &[f64]| Member {
            name: name.to_owned(),
            look: Look::new(3),
            points: rates.iter().enumerate().map(|(e, rate)| (e as f64, Some(*rate))).collect(),
        };
        let twice = [member("C", &[7.0, 8.0]), member("C", &[7.0, 8.000_000_000_1])];
        let (one, none) = bands(twice.into());
        assert_eq!((one.len(), one[0].name.as_str(), none.len()), (1, "C", 0));
        let members = vec![
            member("A", &[3.0, 1.0]),
            member("B", &[9.0]),
            member("A", &[2.0, 4.0, 5.0]),
            member("A", &[2.5, 2.0]),
        ];
        let (series, fills) = bands(members);
        let names: Vec<&str> = series.iter().map(|series| series.name.as_str()).collect();
        assert_eq!(names, ["A, lowest", "A, highest", "B"]);
        assert_eq!(series[1].points, [(0.0, Some(3.0)), (1.0, Some(4.0)), (2.0, Some(5.0))]);
        assert_eq!(fills.len(), 1);
        assert_eq!(fills[0].points, [(0.0, 2.0, 3.0), (1.0, 1.0, 4.0), (2.0, 5.0, 5.0)]);
        assert_eq!(fills[0].kind, FillKind::Band(Look::new(3)));
        assert!(series[0].unlisted && !series[2].unlisted);
    }
}
