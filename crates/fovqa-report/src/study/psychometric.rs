//! Tables of psychometric functions.

use fovqa_study::psychometric::{Estimate, MaximumLikelihood, Posterior, Psychometric};

use super::cells::{half_open, interval, number, p_value, shown, whole, whole_or};
use super::parts::Parts;
use crate::plain_table::Cell;

pub(super) fn parts(function: &Psychometric, parts: &mut Parts) {
    let levels = function.levels.iter().map(|level| {
        vec![
            number(level.level),
            whole(level.correct),
            whole(level.trials),
            number(level.correct as f64 / level.trials as f64),
        ]
    });
    let columns =
        [("level", "level"), ("correct", "correct"), ("trials", "trials"), ("share", "share")];
    parts.table(("answers", "Answers by level"), &columns, levels.collect());
    parameters(function, parts);
    if let Some(ml) = &function.ml {
        goodness(ml, parts);
    }
    thresholds(function, parts);
    parts.reasons([("fit".to_owned(), function.reason.clone())]);
}

fn parameters(function: &Psychometric, parts: &mut Parts) {
    let (ml, posterior) = (function.ml.as_ref(), function.posterior.as_ref());
    let of_ml = |of: fn(&MaximumLikelihood) -> Option<f64>| ml.and_then(of);
    let of = |estimate: fn(&Estimate) -> f64| {
        posterior.map(|p| [estimate(&p.map), estimate(&p.mean), estimate(&p.median)])
    };
    let limits = posterior.map(|p| p.intervals);
    let row =
        |name: &str, ml: Option<f64>, estimates: Option<[f64; 3]>, limits: Option<[f64; 2]>| {
            let [mode, mean, median] = match estimates {
                Some(estimates) => estimates.map(number),
                None => [(); 3].map(|()| number(None)),
            };
            vec![Cell::text(name), number(ml), mode, mean, median, interval(limits)]
        };
    let rows = vec![
        row(
            "threshold",
            of_ml(|ml| ml.threshold),
            of(|e| e.threshold),
            limits.map(|l| l.threshold),
        ),
        row("width", of_ml(|ml| ml.width), of(|e| e.width), limits.map(|l| l.width)),
        row("lapse", of_ml(|ml| ml.lapse), of(|e| e.lapse), limits.map(|l| l.lapse)),
        row("eta", None, of(|e| e.eta), limits.map(|l| l.eta)),
    ];
    let columns = [
        ("parameter", "parameter"),
        ("ML", "ml"),
        ("posterior mode", "map"),
        ("mean", "mean"),
        ("median", "median"),
        ("interval", "interval"),
    ];
    let caption = "Parameters: maximum likelihood (ML), and posterior with its interval";
    parts.table(("parameters", caption), &columns, rows);
}

fn goodness(ml: &MaximumLikelihood, parts: &mut Parts) {
    let row = vec![
        number(ml.log_likelihood),
        number(ml.deviance),
        whole(ml.df),
        p_value(ml.p_chi2),
        p_value(ml.p_bootstrap),
        whole_or(ml.at_bound),
    ];
    let columns = [
        ("log-likelihood", "log_likelihood"),
        ("deviance", "deviance"),
        ("df", "df"),
        ("p χ²", "p_chi2"),
        ("p bootstrap", "p_bootstrap"),
        ("at a bound", "at_bound"),
    ];
    let caption = "Goodness of the maximum-likelihood fit";
    parts.table(("goodness", caption), &columns, vec![row]);
    parts.reasons([("ML".to_owned(), ml.reason.clone())]);
}

fn thresholds(function: &Psychometric, parts: &mut Parts) {
    let mut reasons = Vec::new();
    let ml = function.ml.iter().flat_map(|ml| &ml.thresholds);
    let posterior: Vec<_> =
        function.posterior.iter().flat_map(|posterior: &Posterior| &posterior.thresholds).collect();
    let mut rows = Vec::new();
    for (index, level) in ml.enumerate() {
        let other = posterior.get(index);
        rows.push(vec![
            number(level.performance),
            number(level.level),
            half_open(level.ci),
            number(other.and_then(|other| other.median)),
            half_open(other.and_then(|other| other.ci)),
        ]);
        let name = shown(level.performance);
        reasons.push((format!("ML level at {name}"), level.reason.clone()));
        let reason = other.and_then(|other| other.reason.clone());
        reasons.push((format!("posterior at {name}"), reason));
    }
    let columns = [
        ("performance", "performance"),
        ("ML level", "ml"),
        ("bootstrap", "ml_ci"),
        ("posterior median", "posterior_median"),
        ("interval", "posterior_ci"),
    ];
    let caption = "Levels at which a performance is reached";
    parts.table(("thresholds", caption), &columns, rows);
    parts.reasons(reasons);
}
