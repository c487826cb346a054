//! Tables of metrics against mean opinion scores.

use fovqa_study::metrics::{Comparison, Metrics};

use super::cells::{half_open, interval, number, p_value, stars, whole_or};
use super::parts::Parts;
use crate::plain_table::Cell;

/// Conditions beyond these are only counted.
const MOST_CONDITIONS: usize = 10;

pub(super) fn parts(metrics: &Metrics, parts: &mut Parts) {
    correlations(metrics, parts);
    fits(metrics, parts);
    comparisons(&metrics.comparisons, parts);
    if !metrics.unmatched.is_empty() {
        let shown: Vec<String> = metrics.unmatched.iter().take(MOST_CONDITIONS).cloned().collect();
        let more = metrics.unmatched.len() - shown.len();
        let more = if more > 0 { format!(" and {more} more") } else { String::new() };
        parts.remark(format!(
            "conditions without a finite score of each metric: {}{more}",
            shown.join(", ")
        ));
    }
}

fn correlations(metrics: &Metrics, parts: &mut Parts) {
    let rows = metrics.metrics.iter().map(|metric| {
        vec![
            Cell::text(&metric.metric),
            number(metric.pearson),
            p_value(metric.pearson_p),
            interval(metric.pearson_fisher),
            half_open(metric.pearson_bootstrap),
            number(metric.spearman),
            p_value(metric.spearman_p),
            half_open(metric.spearman_bootstrap),
            number(metric.kendall),
            half_open(metric.kendall_bootstrap),
        ]
    });
    let columns = [
        ("metric", "metric"),
        ("Pearson", "pearson"),
        ("p", "pearson_p"),
        ("Fisher", "pearson_fisher"),
        ("bootstrap", "pearson_bootstrap"),
        ("Spearman", "spearman"),
        ("p", "spearman_p"),
        ("bootstrap", "spearman_bootstrap"),
        ("Kendall", "kendall"),
        ("bootstrap", "kendall_bootstrap"),
    ];
    let caption = "Correlations with mean opinion scores";
    parts.table(("correlations", caption), &columns, rows.collect());
    parts.detail(if metrics.n == 1 {
        "1 condition".to_owned()
    } else {
        format!("{} conditions", metrics.n)
    });
    parts.reasons(
        metrics.metrics.iter().map(|metric| (metric.metric.clone(), metric.reason.clone())),
    );
}

fn fits(metrics: &Metrics, parts: &mut Parts) {
    let fitted = || metrics.metrics.iter().filter_map(|m| Some((m, m.fit.as_ref()?)));
    let rows = fitted().map(|(metric, fit)| {
        vec![
            Cell::text(&metric.metric),
            number(fit.rmse),
            number(fit.mae),
            number(fit.pearson),
            whole_or(fit.outliers),
            number(fit.outlier_ratio),
        ]
    });
    let columns = [
        ("metric", "metric"),
        ("RMSE", "rmse"),
        ("MAE", "mae"),
        ("Pearson", "pearson"),
        ("outliers", "outliers"),
        ("outlier ratio", "outlier_ratio"),
    ];
    parts.table(("fits", "Logistic fits"), &columns, rows.collect());
    parts.reasons(fitted().map(|(metric, fit)| (metric.metric.clone(), fit.reason.clone())));
}

fn comparisons(comparisons: &[Comparison], parts: &mut Parts) {
    let name = |of: &Comparison| format!("{} – {}", of.metric, of.other);
    let rows = comparisons.iter().map(|comparison| {
        vec![
            Cell::text(name(comparison)),
            number(comparison.r),
            number(comparison.r_other),
            number(comparison.r_between),
            number(comparison.meng_z),
            p_value(comparison.meng_p),
            p_value(comparison.meng_p_adjusted),
            stars(comparison.meng_p_adjusted),
            number(comparison.williams_t),
            whole_or(comparison.williams_df),
            p_value(comparison.williams_p),
        ]
    });
    let columns = [
        ("pair", "pair"),
        ("r", "r"),
        ("r other", "r_other"),
        ("r between", "r_between"),
        ("Meng z", "meng_z"),
        ("p", "meng_p"),
        ("p adjusted", "meng_p_adjusted"),
        ("", "stars"),
        ("Williams t", "williams_t"),
        ("df", "williams_df"),
        ("p", "williams_p"),
    ];
    parts.table(("differences", "Differences of correlations"), &columns, rows.collect());
    parts.reasons(comparisons.iter().map(|of| (name(of), of.reason.clone())));
}
