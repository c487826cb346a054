//! Tables of pairwise comparisons.

use fovqa_study::pairs::{Consistency, Pairs, Scaled};

use super::cells::{half_open, interval, number, p_value, participants, stars, whole, whole_or};
use super::parts::Parts;
use crate::plain_table::Cell;

pub(super) fn parts(pairs: &Pairs, parts: &mut Parts) {
    shares(pairs, parts);
    scores(pairs, parts);
    consistency(&pairs.consistency, parts);
}

fn shares(pairs: &Pairs, parts: &mut Parts) {
    let name = |method: &str, opponent: &str| format!("{method} – {opponent}");
    let row = |pair: &fovqa_study::pairs::Pair| {
        vec![
            Cell::text(name(&pair.method, &pair.opponent)),
            votes(pair.wins),
            votes(pair.losses),
            votes(pair.ties),
            number(pair.share),
            interval(pair.clopper_pearson),
            interval(pair.wilson),
            half_open(pair.cluster),
            p_value(pair.p_two_sided),
            p_value(pair.p_adjusted),
            stars(pair.p_adjusted),
        ]
    };
    let columns = [
        ("pair", "pair"),
        ("wins", "wins"),
        ("losses", "losses"),
        ("ties", "ties"),
        ("share", "share"),
        ("Clopper-Pearson", "clopper_pearson"),
        ("Wilson", "wilson"),
        ("by participants", "cluster"),
        ("p", "p_two_sided"),
        ("p adjusted", "p_adjusted"),
        ("", "stars"),
    ];
    let caption = "Shares of votes, with two-sided binomial tests";
    parts.table(("shares", caption), &columns, pairs.pairs.iter().map(row).collect());
    parts.detail(participants(pairs.participants));
    parts.reasons(
        pairs.pairs.iter().map(|pair| (name(&pair.method, &pair.opponent), pair.reason.clone())),
    );
}

/// A number of votes, of which ties may be halves.
fn votes(count: f64) -> Cell {
    if count.fract() == 0.0 && count < 9e15 { whole(count as i64) } else { number(count) }
}

fn scores(pairs: &Pairs, parts: &mut Parts) {
    let models = [&pairs.scaling.bradley_terry, &pairs.scaling.thurstone];
    let names = ["Bradley-Terry", "Thurstone V"];
    if let [Some(first), Some(second)] = models.map(|model| model.scores.as_ref()) {
        let rows = first.iter().zip(second).map(|(a, b)| {
            vec![
                Cell::text(&a.method),
                number(a.jod),
                half_open(Some([a.lo, a.hi])),
                number(b.jod),
                half_open(Some([b.lo, b.hi])),
            ]
        });
        let columns = [
            ("method", "method"),
            (names[0], "bradley_terry"),
            ("interval", "bradley_terry_interval"),
            (names[1], "thurstone"),
            ("interval", "thurstone_interval"),
        ];
        let caption = "Scores in JOD; 1 JOD is a share of 75 %";
        parts.table(("scores", caption), &columns, rows.collect());
        let fit = names.iter().zip(models).map(|(name, model)| {
            vec![
                Cell::text(*name),
                number(model.deviance),
                whole_or(model.df),
                p_value(model.p),
                whole_or(model.failed_replicates),
            ]
        });
        let columns = [
            ("fit", "fit"),
            ("deviance", "deviance"),
            ("df", "df"),
            ("p", "p"),
            ("failed replicates", "failed_replicates"),
        ];
        let caption = "How well the scores explain the votes";
        parts.table(("fit", caption), &columns, fit.collect());
    } else {
        parts.remark("Scores in JOD are undefined");
    }
    let reason = |(name, model): (&&str, &Scaled)| ((*name).to_owned(), model.reason.clone());
    parts.reasons(names.iter().zip(models).map(reason));
}

fn consistency(consistency: &Consistency, parts: &mut Parts) {
    let agreement = consistency.agreement.as_ref();
    let test = agreement.and_then(|agreement| agreement.test.as_ref());
    let row = vec![
        whole(consistency.judges.len()),
        whole(consistency.judges_complete),
        number(consistency.mean_zeta),
        number(agreement.map(|agreement| agreement.u)),
        number(agreement.map(|agreement| agreement.u_min)),
        number(test.map(|test| test.chi2)),
        number(test.map(|test| test.df)),
        p_value(test.and_then(|test| test.p)),
    ];
    let columns = [
        ("judges", "judges"),
        ("complete", "judges_complete"),
        ("mean ζ", "mean_zeta"),
        ("u", "u"),
        ("least u", "u_min"),
        ("χ²", "chi2"),
        ("df", "df"),
        ("p", "p"),
    ];
    let caption = "Consistency of judges (ζ) and their agreement (u)";
    parts.table(("consistency", caption), &columns, vec![row]);
    parts.reasons([("ζ".to_owned(), consistency.reason.clone())]);
}
