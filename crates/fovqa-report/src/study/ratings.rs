//! Tables of ratings.

use fovqa_study::ratings::{GridRatings, LevelRatings, Ratings};

use super::cells::{half_open, interval, number, participants, shown, whole};
use super::parts::Parts;
use crate::plain_table::Cell;

pub(super) fn parts(ratings: &Ratings, parts: &mut Parts) {
    match ratings {
        Ratings::Levels(levels) => by_level(levels, parts),
        Ratings::Grid(grid) => over_grid(grid, parts),
    }
}

fn by_level(ratings: &LevelRatings, parts: &mut Parts) {
    let rows = ratings.levels.iter().map(|level| {
        let moments = &level.moments;
        vec![
            number(level.level),
            whole(moments.n),
            number(moments.mean),
            number(moments.sd),
            number(moments.se),
            interval(moments.ci),
        ]
    });
    let columns = [
        ("level", "level"),
        ("n", "n"),
        ("mean", "mean"),
        ("SD", "sd"),
        ("standard error", "se"),
        ("interval", "ci"),
    ];
    parts.table(("levels", "Mean scores"), &columns, rows.collect());
    parts.detail(participants(ratings.participants));
    parts.reasons(
        ratings
            .levels
            .iter()
            .map(|level| (format!("level {}", shown(level.level)), level.moments.reason.clone())),
    );
    let Some(acceptable) = &ratings.acceptable else { return };
    let row = vec![
        number(acceptable.largest_level),
        number(acceptable.crossing),
        half_open(acceptable.crossing_ci),
    ];
    let columns =
        [("largest level", "largest_level"), ("crossing", "crossing"), ("interval", "crossing_ci")];
    let caption = "The largest acceptable level, and where the threshold is crossed";
    parts.table(("acceptable", caption), &columns, vec![row]);
    parts.reasons([("crossing".to_owned(), acceptable.reason.clone())]);
}

fn over_grid(ratings: &GridRatings, parts: &mut Parts) {
    let [x, y] = &ratings.columns;
    let is_smoothed = ratings.grid.iter().any(|cell| cell.smoothed.is_some());
    let mut columns = vec![(x.as_str(), x.as_str()), (y, y), ("n", "n"), ("mean", "mean")];
    columns.extend(is_smoothed.then_some(("smoothed", "smoothed")));
    let rows = ratings.grid.iter().map(|cell| {
        let mut row: Vec<Cell> =
            vec![number(cell.fx), number(cell.fy), whole(cell.n), number(cell.mean)];
        row.extend(is_smoothed.then(|| number(cell.smoothed)));
        row
    });
    parts.table(("grid", "Mean scores"), &columns, rows.collect());
    parts.detail(participants(ratings.participants));
    if let Some(best) = &ratings.best {
        let ties = if best.ties > 1 {
            format!("; {} cells have this score", best.ties)
        } else {
            String::new()
        };
        parts.remark(format!(
            "best: {x} = {}, {y} = {}, score {}{ties}",
            shown(best.fx),
            shown(best.fy),
            shown(best.mean)
        ));
    }
}
