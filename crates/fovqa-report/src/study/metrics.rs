//! Metrics against mean opinion scores as text.

use fovqa_study::adjust::stars;
use fovqa_study::metrics::{Comparison, Metrics};

use super::Report;
use super::numbers::{half_open, interval, number, p_value};
use crate::text_table::{plain_table, printable};

pub(super) fn text(metrics: &Metrics, report: &mut Report) {
    correlations(metrics, report);
    fits(metrics, report);
    comparisons(&metrics.comparisons, report);
    if !metrics.unmatched.is_empty() {
        let shown: Vec<String> = metrics.unmatched.iter().take(10).cloned().collect();
        let more = metrics.unmatched.len() - shown.len();
        let more = if more > 0 { format!(" and {more} more") } else { String::new() };
        report.line(&format!(
            "conditions without a finite score of each metric: {}{more}",
            shown.join(", ")
        ));
    }
}

fn correlations(metrics: &Metrics, report: &mut Report) {
    let mut table = plain_table(&[
        "metric",
        "Pearson",
        "p",
        "Fisher",
        "bootstrap",
        "Spearman",
        "p",
        "bootstrap",
        "Kendall",
        "bootstrap",
    ]);
    for metric in &metrics.metrics {
        table.add_row([
            printable(&metric.metric),
            number(metric.pearson),
            p_value(metric.pearson_p),
            interval(metric.pearson_fisher),
            half_open(metric.pearson_bootstrap),
            number(metric.spearman),
            p_value(metric.spearman_p),
            half_open(metric.spearman_bootstrap),
            number(metric.kendall),
            half_open(metric.kendall_bootstrap),
        ]);
    }
    report.table(&format!("Correlations with the scores of {} conditions", metrics.n), table);
    report.reasons(
        metrics.metrics.iter().map(|metric| (metric.metric.clone(), metric.reason.clone())),
    );
}

fn fits(metrics: &Metrics, report: &mut Report) {
    let mut table = plain_table(&["metric", "RMSE", "MAE", "Pearson", "outliers", "outlier ratio"]);
    let mut reasons = Vec::new();
    for metric in &metrics.metrics {
        let Some(fit) = &metric.fit else { continue };
        table.add_row([
            printable(&metric.metric),
            number(fit.rmse),
            number(fit.mae),
            number(fit.pearson),
            fit.outliers.map_or_else(|| number(None), |count| count.to_string()),
            number(fit.outlier_ratio),
        ]);
        reasons.push((metric.metric.clone(), fit.reason.clone()));
    }
    report.table("Logistic fits", table);
    report.reasons(reasons);
}

fn comparisons(comparisons: &[Comparison], report: &mut Report) {
    let mut table = plain_table(&[
        "pair",
        "r",
        "r other",
        "r between",
        "Meng z",
        "p",
        "p adjusted",
        "",
        "Williams t",
        "df",
        "p",
    ]);
    let name = |of: &Comparison| format!("{} – {}", of.metric, of.other);
    for comparison in comparisons {
        table.add_row([
            printable(&name(comparison)),
            number(comparison.r),
            number(comparison.r_other),
            number(comparison.r_between),
            number(comparison.meng_z),
            p_value(comparison.meng_p),
            p_value(comparison.meng_p_adjusted),
            stars(comparison.meng_p_adjusted).to_owned(),
            number(comparison.williams_t),
            comparison.williams_df.map_or_else(|| number(None), |df| df.to_string()),
            p_value(comparison.williams_p),
        ]);
    }
    report.table("Differences of correlations", table);
    report.reasons(comparisons.iter().map(|of| (name(of), of.reason.clone())));
}
