//! Scores over a grid of two parameters, and the best cell (RMFR, Fig. 9).

use serde::Serialize;

use super::scores::Scores;
use crate::StudyError;
use crate::input::Data;
use crate::moments::mean;
use crate::options::Smoothing;

/// Scores that differ by less are tied.
const TIE: f64 = 1e-12;

/// Scores over a grid.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GridRatings {
    /// The number of participants.
    pub participants: usize,
    /// The columns of the two parameters fx and fy.
    pub columns: [String; 2],
    /// The cells that have scores, ascending by fx, then fy.
    pub grid: Vec<Cell>,
    /// The cell with the highest score, after smoothing.
    pub best: Option<Best>,
}

/// A cell of the grid.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Cell {
    /// The first parameter.
    pub fx: f64,
    /// The second parameter.
    pub fy: f64,
    /// The number of participants with scores.
    pub n: usize,
    /// The mean of the participants' means.
    pub mean: f64,
    /// The smoothed mean.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub smoothed: Option<f64>,
}

/// The cell with the highest score.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Best {
    /// The first parameter; the smallest of tied cells.
    pub fx: f64,
    /// The second parameter; the smallest of tied cells with this fx.
    pub fy: f64,
    /// The score, smoothed if the grid is.
    pub mean: f64,
    /// The number of cells with this score.
    pub ties: usize,
}

/// The grid of two columns.
pub(super) fn grid(
    data: &Data,
    columns: &[String; 2],
    smoothing: Smoothing,
) -> Result<GridRatings, StudyError> {
    let scores = Scores::read(data, [&columns[0], &columns[1]])?;
    let values = scores.by_condition();
    let cell = |(&[fx, fy], values): (&[f64; 2], &Vec<f64>)| {
        mean(values).map(|mean| Cell { fx, fy, n: values.len(), mean, smoothed: None })
    };
    let mut grid: Vec<Cell> = scores.conditions.iter().zip(&values).filter_map(cell).collect();
    if smoothing == Smoothing::Binomial {
        let smoothed = smooth(&grid);
        for (cell, smoothed) in grid.iter_mut().zip(smoothed) {
            cell.smoothed = Some(smoothed);
        }
    }
    let best = best(&grid);
    Ok(GridRatings { participants: scores.means.len(), columns: columns.clone(), grid, best })
}

/// The values of one parameter, ascending.
fn values(grid: &[Cell], of: impl Fn(&Cell) -> f64) -> Vec<f64> {
    let mut values: Vec<f64> = grid.iter().map(of).collect();
    values.sort_by(f64::total_cmp);
    values.dedup_by(|a, b| a.total_cmp(b).is_eq());
    values
}

/// Weights 1, 2, 1 in both directions over the neighbours that are present, divided by their sum.
fn smooth(grid: &[Cell]) -> Vec<f64> {
    let (xs, ys) = (values(grid, |cell| cell.fx), values(grid, |cell| cell.fy));
    let place = |values: &[f64], value: f64| {
        values.partition_point(|other| other.total_cmp(&value).is_lt())
    };
    let places: Vec<[usize; 2]> =
        grid.iter().map(|cell| [place(&xs, cell.fx), place(&ys, cell.fy)]).collect();
    // Cells ascend by fx, then fy: neighbours are found by bisection.
    let weight = |a: usize, b: usize| if a == b { 2.0 } else { 1.0 };
    places
        .iter()
        .map(|&[x, y]| {
            let (mut sum, mut weights) = (0.0, 0.0);
            for near_x in x.saturating_sub(1)..=x + 1 {
                for near_y in y.saturating_sub(1)..=y + 1 {
                    if let Ok(index) = places.binary_search(&[near_x, near_y]) {
                        let weight = weight(x, near_x) * weight(y, near_y);
                        sum += weight * grid[index].mean;
                        weights += weight;
                    }
                }
            }
            sum / weights
        })
        .collect()
}

fn best(grid: &[Cell]) -> Option<Best> {
    let score = |cell: &Cell| cell.smoothed.unwrap_or(cell.mean);
    let highest = grid.iter().map(score).max_by(f64::total_cmp)?;
    let mut tied = grid.iter().filter(|cell| highest - score(cell) <= TIE);
    let first = tied.next()?;
    Some(Best { fx: first.fx, fy: first.fy, mean: score(first), ties: 1 + tied.count() })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cell(fx: f64, fy: f64, mean: f64) -> Cell {
        Cell { fx, fy, n: 1, mean, smoothed: None }
    }

    #[test]
    fn smoothing_leaves_missing_neighbours_out() {
        let grid = [cell(0.0, 0.0, 4.0), cell(0.0, 1.0, 1.0), cell(1.0, 0.0, 7.0)];
        let smoothed = smooth(&grid);
        assert!((smoothed[0] - (16.0 + 2.0 + 14.0) / 8.0).abs() < 1e-12);
        assert!((smoothed[1] - (4.0 + 8.0 + 7.0) / 7.0).abs() < 1e-12);
    }

    #[test]
    fn the_best_of_tied_cells_has_the_smallest_parameters() {
        let grid = [cell(0.0, 1.0, 2.0), cell(1.0, 0.0, 3.0), cell(1.0, 1.0, 3.0)];
        assert_eq!(best(&grid), Some(Best { fx: 1.0, fy: 0.0, mean: 3.0, ties: 2 }));
        assert_eq!(best(&[]), None);
    }
}
