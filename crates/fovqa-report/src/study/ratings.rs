//! Ratings as text.

use fovqa_study::ratings::{GridRatings, LevelRatings, Ratings};

use super::Report;
use super::numbers::{half_open, interval, number};
use crate::text_table::{plain_table, printable};

pub(super) fn text(ratings: &Ratings, report: &mut Report) {
    match ratings {
        Ratings::Levels(levels) => by_level(levels, report),
        Ratings::Grid(grid) => over_grid(grid, report),
    }
}

fn by_level(ratings: &LevelRatings, report: &mut Report) {
    let mut table = plain_table(&["level", "n", "mean", "SD", "standard error", "interval"]);
    for level in &ratings.levels {
        table.add_row([
            number(level.level),
            level.moments.n.to_string(),
            number(level.moments.mean),
            number(level.moments.sd),
            number(level.moments.se),
            interval(level.moments.ci),
        ]);
    }
    report.table(&format!("Mean scores of {} participants", ratings.participants), table);
    report.reasons(
        ratings
            .levels
            .iter()
            .map(|level| (format!("level {}", number(level.level)), level.moments.reason.clone())),
    );
    let Some(acceptable) = &ratings.acceptable else { return };
    let mut table = plain_table(&["largest level", "crossing", "interval"]);
    table.add_row([
        number(acceptable.largest_level),
        number(acceptable.crossing),
        half_open(acceptable.crossing_ci),
    ]);
    report.table("The largest acceptable level, and where the threshold is crossed", table);
    report.reasons([("crossing".to_owned(), acceptable.reason.clone())]);
}

fn over_grid(ratings: &GridRatings, report: &mut Report) {
    let [x, y] = &ratings.columns;
    let is_smoothed = ratings.grid.iter().any(|cell| cell.smoothed.is_some());
    let mut columns = vec![printable(x), printable(y), "n".to_owned(), "mean".to_owned()];
    if is_smoothed {
        columns.push("smoothed".to_owned());
    }
    let mut table = plain_table(&columns.iter().map(String::as_str).collect::<Vec<_>>());
    for cell in &ratings.grid {
        let mut row = vec![number(cell.fx), number(cell.fy), cell.n.to_string(), number(cell.mean)];
        if is_smoothed {
            row.push(number(cell.smoothed));
        }
        table.add_row(row);
    }
    report.table(&format!("Mean scores of {} participants", ratings.participants), table);
    if let Some(best) = &ratings.best {
        let ties = if best.ties > 1 {
            format!("; {} cells have this score", best.ties)
        } else {
            String::new()
        };
        report.line(&format!(
            "best: {x} = {}, {y} = {}, score {}{ties}",
            number(best.fx),
            number(best.fy),
            number(best.mean)
        ));
    }
}
