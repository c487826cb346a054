//! Psychometric functions as text.

use fovqa_study::psychometric::{MaximumLikelihood, Posterior, Psychometric};

use super::Report;
use super::numbers::{half_open, interval, number, p_value};
use crate::text_table::plain_table;

pub(super) fn text(function: &Psychometric, report: &mut Report) {
    let mut levels = plain_table(&["level", "correct", "trials", "share"]);
    for level in &function.levels {
        levels.add_row([
            number(level.level),
            level.correct.to_string(),
            level.trials.to_string(),
            number(level.correct as f64 / level.trials as f64),
        ]);
    }
    report.table("Answers by level", levels);
    parameters(function, report);
    if let Some(ml) = &function.ml {
        goodness(ml, report);
    }
    thresholds(function, report);
    report.reasons([("fit".to_owned(), function.reason.clone())]);
}

fn parameters(function: &Psychometric, report: &mut Report) {
    let mut table =
        plain_table(&["parameter", "ML", "posterior mode", "mean", "median", "interval"]);
    let ml = function.ml.as_ref();
    let of_ml = |of: fn(&MaximumLikelihood) -> Option<f64>| number(ml.and_then(of));
    let mut row = |name: &str, ml: String, posterior: Option<([f64; 3], [f64; 2])>| {
        let [mode, mean, median] = match posterior {
            Some((estimates, _)) => estimates.map(number),
            None => [(); 3].map(|()| number(None)),
        };
        let limits = interval(posterior.map(|(_, limits)| limits));
        table.add_row([name.to_owned(), ml, mode, mean, median, limits]);
    };
    let posterior = function.posterior.as_ref();
    let of = |estimate: fn(&fovqa_study::psychometric::Estimate) -> f64| {
        posterior.map(|p| [estimate(&p.map), estimate(&p.mean), estimate(&p.median)])
    };
    let limits = posterior.map(|p| p.intervals);
    row(
        "threshold",
        of_ml(|ml| ml.threshold),
        of(|e| e.threshold).zip(limits.map(|l| l.threshold)),
    );
    row("width", of_ml(|ml| ml.width), of(|e| e.width).zip(limits.map(|l| l.width)));
    row("lapse", of_ml(|ml| ml.lapse), of(|e| e.lapse).zip(limits.map(|l| l.lapse)));
    row("eta", number(None), of(|e| e.eta).zip(limits.map(|l| l.eta)));
    report.table("Parameters: maximum likelihood (ML), and posterior with its interval", table);
}

fn goodness(ml: &MaximumLikelihood, report: &mut Report) {
    let mut table =
        plain_table(&["log-likelihood", "deviance", "df", "p χ²", "p bootstrap", "at a bound"]);
    table.add_row([
        number(ml.log_likelihood),
        number(ml.deviance),
        ml.df.to_string(),
        p_value(ml.p_chi2),
        p_value(ml.p_bootstrap),
        ml.at_bound.map_or_else(|| number(None), |count| count.to_string()),
    ]);
    report.table("Goodness of the maximum-likelihood fit", table);
    report.reasons([("ML".to_owned(), ml.reason.clone())]);
}

fn thresholds(function: &Psychometric, report: &mut Report) {
    let mut table =
        plain_table(&["performance", "ML level", "bootstrap", "posterior median", "interval"]);
    let mut reasons = Vec::new();
    let ml = function.ml.iter().flat_map(|ml| &ml.thresholds);
    let posterior: Vec<_> =
        function.posterior.iter().flat_map(|posterior: &Posterior| &posterior.thresholds).collect();
    for (index, level) in ml.enumerate() {
        let other = posterior.get(index);
        table.add_row([
            number(level.performance),
            number(level.level),
            half_open(level.ci),
            number(other.and_then(|other| other.median)),
            half_open(other.and_then(|other| other.ci)),
        ]);
        let name = number(level.performance);
        reasons.push((format!("ML level at {name}"), level.reason.clone()));
        let reason = other.and_then(|other| other.reason.clone());
        reasons.push((format!("posterior at {name}"), reason));
    }
    report.table("Levels at which a performance is reached", table);
    report.reasons(reasons);
}
