//! An analysis of variance as text.

use fovqa_study::adjust::stars;
use fovqa_study::anova::{Anova, Effect, PairedTest};

use super::Report;
use super::numbers::{interval, number, p_value};
use crate::text_table::{plain_table, printable};

pub(super) fn text(anova: &Anova, report: &mut Report) {
    report.line(&format!("{} participants", anova.participants));
    if !anova.left_out.is_empty() {
        report.reasons([(
            anova.left_out.join(", "),
            Some("left out, because a cell has no value".to_owned()),
        )]);
    }
    report.reasons([("effects".to_owned(), anova.reason.clone())]);
    effects(anova.effects.as_deref().unwrap_or_default(), report);
    posthoc(anova.posthoc.as_deref().unwrap_or_default(), report);
    cells(anova, report);
}

fn effects(effects: &[Effect], report: &mut Report) {
    let mut table =
        plain_table(&["effect", "F", "df", "df error", "p", "", "partial η²", "general η²"]);
    let mut sphericity = plain_table(&[
        "effect",
        "ε (Greenhouse-Geisser)",
        "p",
        "ε (Huynh-Feldt)",
        "p",
        "Mauchly's W",
        "p",
    ]);
    for effect in effects {
        table.add_row([
            printable(&effect.effect),
            number(effect.f),
            effect.df.to_string(),
            effect.df_error.to_string(),
            p_value(effect.p),
            stars(effect.p).to_owned(),
            number(effect.partial_eta_squared),
            number(effect.generalized_eta_squared),
        ]);
        sphericity.add_row([
            printable(&effect.effect),
            number(effect.greenhouse_geisser.epsilon),
            p_value(effect.greenhouse_geisser.p),
            number(effect.huynh_feldt.epsilon),
            p_value(effect.huynh_feldt.p),
            number(effect.mauchly.w),
            p_value(effect.mauchly.p),
        ]);
    }
    report.table("Effects", table);
    report.reasons(effects.iter().map(|effect| (effect.effect.clone(), effect.reason.clone())));
    report.table("Without sphericity", sphericity);
    let mauchly = |effect: &Effect| {
        (format!("Mauchly's test of {}", effect.effect), effect.mauchly.reason.clone())
    };
    report.reasons(effects.iter().map(mauchly));
}

fn posthoc(tests: &[PairedTest], report: &mut Report) {
    let name = |test: &PairedTest| format!("{}: {} – {}", test.factor, test.a, test.b);
    let mut table = plain_table(&[
        "pair",
        "difference",
        "interval",
        "t",
        "df",
        "p",
        "p adjusted",
        "",
        "Cohen's dz",
    ]);
    for test in tests {
        table.add_row([
            printable(&name(test)),
            number(test.mean_difference),
            interval(test.ci),
            number(test.t),
            test.df.to_string(),
            p_value(test.p),
            p_value(test.p_adjusted),
            stars(test.p_adjusted).to_owned(),
            number(test.cohen_dz),
        ]);
    }
    report.table("Paired t tests", table);
    report.reasons(tests.iter().map(|test| (name(test), test.reason.clone())));
}

fn cells(anova: &Anova, report: &mut Report) {
    let mut table =
        plain_table(&["cell", "n", "mean", "sd", "SE", "interval", "SE within participants"]);
    let name = |levels: &[(String, String)]| {
        levels.iter().map(|(_, level)| level.clone()).collect::<Vec<_>>().join(", ")
    };
    for cell in &anova.cells {
        let moments = &cell.moments;
        table.add_row([
            printable(&name(&cell.levels)),
            moments.n.to_string(),
            number(moments.mean),
            number(moments.sd),
            number(moments.se),
            interval(moments.ci),
            number(cell.se_within),
        ]);
    }
    report.table("Cells", table);
    report.reasons(
        anova.cells.iter().map(|cell| (name(&cell.levels), cell.reason().map(str::to_owned))),
    );
}
