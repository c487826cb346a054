//! Pairwise comparisons as text.

use fovqa_study::adjust::stars;
use fovqa_study::pairs::{Consistency, Pairs, Scaled};

use super::Report;
use super::numbers::{half_open, interval, number, p_value};
use crate::text_table::{plain_table, printable};

pub(super) fn text(pairs: &Pairs, report: &mut Report) {
    shares(pairs, report);
    scores(pairs, report);
    consistency(&pairs.consistency, report);
}

fn shares(pairs: &Pairs, report: &mut Report) {
    let mut table = plain_table(&[
        "pair",
        "wins",
        "losses",
        "ties",
        "share",
        "Clopper-Pearson",
        "Wilson",
        "by participants",
        "p",
        "p adjusted",
        "",
    ]);
    let name = |method: &str, opponent: &str| format!("{method} – {opponent}");
    for pair in &pairs.pairs {
        table.add_row([
            printable(&name(&pair.method, &pair.opponent)),
            number(pair.wins),
            number(pair.losses),
            number(pair.ties),
            number(pair.share),
            interval(pair.clopper_pearson),
            interval(pair.wilson),
            half_open(pair.cluster),
            p_value(pair.p_two_sided),
            p_value(pair.p_adjusted),
            stars(pair.p_adjusted).to_owned(),
        ]);
    }
    let title =
        format!("Shares of votes; {} participants; two-sided binomial tests", pairs.participants);
    report.table(&title, table);
    report.reasons(
        pairs.pairs.iter().map(|pair| (name(&pair.method, &pair.opponent), pair.reason.clone())),
    );
}

fn scores(pairs: &Pairs, report: &mut Report) {
    let models = [&pairs.scaling.bradley_terry, &pairs.scaling.thurstone];
    let names = ["Bradley-Terry", "Thurstone V"];
    if let [Some(first), Some(second)] = models.map(|model| model.scores.as_ref()) {
        let mut table = plain_table(&["method", names[0], "interval", names[1], "interval"]);
        for (a, b) in first.iter().zip(second) {
            table.add_row([
                printable(&a.method),
                number(a.jod),
                half_open(Some([a.lo, a.hi])),
                number(b.jod),
                half_open(Some([b.lo, b.hi])),
            ]);
        }
        report.table("Scores in JOD; 1 JOD is a share of 75 %", table);
        let mut fit = plain_table(&["fit", "deviance", "df", "p", "failed replicates"]);
        for (name, model) in names.iter().zip(models) {
            fit.add_row([
                (*name).to_owned(),
                number(model.deviance),
                whole(model.df),
                p_value(model.p),
                whole(model.failed_replicates),
            ]);
        }
        report.table("How well the scores explain the votes", fit);
    } else {
        report.line("Scores in JOD");
    }
    let reason = |(name, model): (&&str, &Scaled)| ((*name).to_owned(), model.reason.clone());
    report.reasons(names.iter().zip(models).map(reason));
}

fn consistency(consistency: &Consistency, report: &mut Report) {
    let mut table = plain_table(&["judges", "complete", "mean ζ", "u", "least u", "χ²", "df", "p"]);
    let agreement = consistency.agreement.as_ref();
    let test = agreement.and_then(|agreement| agreement.test.as_ref());
    table.add_row([
        consistency.judges.len().to_string(),
        consistency.judges_complete.to_string(),
        number(consistency.mean_zeta),
        number(agreement.map(|agreement| agreement.u)),
        number(agreement.map(|agreement| agreement.u_min)),
        number(test.map(|test| test.chi2)),
        number(test.map(|test| test.df)),
        p_value(test.and_then(|test| test.p)),
    ]);
    report.table("Consistency of judges (ζ) and their agreement (u)", table);
    report.reasons([("ζ".to_owned(), consistency.reason.clone())]);
}

fn whole(value: Option<usize>) -> String {
    value.map_or_else(|| "–".to_owned(), |value| value.to_string())
}
