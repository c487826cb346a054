//! Rank tests as text.

use fovqa_study::adjust::stars;
use fovqa_study::ranks::Ranks;

use super::Report;
use super::numbers::{number, p_value};
use crate::text_table::{plain_table, printable};

pub(super) fn text(ranks: &Ranks, report: &mut Report) {
    let mut methods = plain_table(&["method", "n", "mean", "median"]);
    for method in &ranks.methods {
        methods.add_row([
            printable(&method.method),
            method.n.to_string(),
            number(method.mean),
            number(method.median),
        ]);
    }
    report.table("Values of the methods", methods);
    let (kruskal, friedman) = (&ranks.kruskal, &ranks.friedman);
    let mut tests = plain_table(&["test", "statistic", "df", "p", "units", "Kendall's W"]);
    tests.add_row([
        "Kruskal-Wallis".to_owned(),
        number(kruskal.h),
        kruskal.df.to_string(),
        p_value(kruskal.p),
        String::new(),
        String::new(),
    ]);
    tests.add_row([
        "Friedman".to_owned(),
        number(friedman.chi2),
        friedman.df.to_string(),
        p_value(friedman.p),
        friedman.n.to_string(),
        number(friedman.kendall_w),
    ]);
    report.table("Tests of all methods", tests);
    report.reasons([
        ("Kruskal-Wallis".to_owned(), kruskal.reason.clone()),
        ("Friedman".to_owned(), friedman.reason.clone()),
    ]);
    let mut pairwise =
        plain_table(&["pair", "test", "n", "statistic", "effect", "p", "p adjusted", ""]);
    for test in &ranks.pairwise {
        pairwise.add_row([
            printable(&format!("{} – {}", test.method, test.opponent)),
            fovqa_params::Words::word(test.test).to_owned(),
            test.n.to_string(),
            number(test.statistic),
            number(test.effect.flatten()),
            p_value(test.p),
            p_value(test.p_adjusted),
            stars(test.p_adjusted).to_owned(),
        ]);
    }
    report.table("Tests of pairs", pairwise);
    let about =
        |test: &fovqa_study::ranks::Pairwise| format!("{} – {}", test.method, test.opponent);
    report.reasons(ranks.pairwise.iter().map(|test| (about(test), test.reason.clone())));
    report.line(&format!("note: {}", ranks.note));
}
