//! Tables of rank tests.

use fovqa_params::Words;
use fovqa_study::ranks::{Pairwise, Ranks};

use super::cells::{number, p_value, stars, whole};
use super::parts::Parts;
use crate::plain_table::Cell;

pub(super) fn parts(ranks: &Ranks, parts: &mut Parts) {
    let methods = ranks.methods.iter().map(|method| {
        vec![
            Cell::text(&method.method),
            whole(method.n),
            number(method.mean),
            number(method.median),
        ]
    });
    let columns = [("method", "method"), ("n", "n"), ("mean", "mean"), ("median", "median")];
    parts.table(("values", "Values of the methods"), &columns, methods.collect());
    all_methods(ranks, parts);
    pairs(ranks, parts);
    parts.remark(format!("note: {}", ranks.note));
}

fn all_methods(ranks: &Ranks, parts: &mut Parts) {
    let (kruskal, friedman) = (&ranks.kruskal, &ranks.friedman);
    let rows = vec![
        vec![
            Cell::text("Kruskal-Wallis"),
            number(kruskal.h),
            whole(kruskal.df),
            p_value(kruskal.p),
            Cell::default(),
            Cell::default(),
        ],
        vec![
            Cell::text("Friedman"),
            number(friedman.chi2),
            whole(friedman.df),
            p_value(friedman.p),
            whole(friedman.n),
            number(friedman.kendall_w),
        ],
    ];
    let columns = [
        ("test", "test"),
        ("statistic", "statistic"),
        ("df", "df"),
        ("p", "p"),
        ("units", "n"),
        ("Kendall's W", "kendall_w"),
    ];
    parts.table(("tests", "Tests of all methods"), &columns, rows);
    parts.reasons([
        ("Kruskal-Wallis".to_owned(), kruskal.reason.clone()),
        ("Friedman".to_owned(), friedman.reason.clone()),
    ]);
}

fn pairs(ranks: &Ranks, parts: &mut Parts) {
    let about = |test: &Pairwise| format!("{} – {}", test.method, test.opponent);
    let rows = ranks.pairwise.iter().map(|test| {
        vec![
            Cell::text(about(test)),
            Cell::text(test.test.word()),
            whole(test.n),
            number(test.statistic),
            number(test.effect.flatten()),
            p_value(test.p),
            p_value(test.p_adjusted),
            stars(test.p_adjusted),
        ]
    });
    let columns = [
        ("pair", "pair"),
        ("test", "test"),
        ("n", "n"),
        ("statistic", "statistic"),
        ("effect", "effect"),
        ("p", "p"),
        ("p adjusted", "p_adjusted"),
        ("", "stars"),
    ];
    parts.table(("pairs", "Tests of pairs"), &columns, rows.collect());
    parts.reasons(ranks.pairwise.iter().map(|test| (about(test), test.reason.clone())));
}
