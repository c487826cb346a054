//! Tables of an analysis of variance.

use fovqa_study::anova::{Anova, Effect, PairedTest};

use super::cells::{interval, number, p_value, participants, stars, whole};
use super::parts::Parts;
use crate::plain_table::Cell;

pub(super) fn parts(anova: &Anova, parts: &mut Parts) {
    effects(anova, parts);
    posthoc(anova.posthoc.as_deref().unwrap_or_default(), parts);
    cells(anova, parts);
}

fn effects(anova: &Anova, parts: &mut Parts) {
    let effects = anova.effects.as_deref().unwrap_or_default();
    let row = |effect: &Effect| {
        vec![
            Cell::text(&effect.effect),
            number(effect.f),
            whole(effect.df),
            whole(effect.df_error),
            p_value(effect.p),
            stars(effect.p),
            number(effect.partial_eta_squared),
            number(effect.generalized_eta_squared),
        ]
    };
    let columns = [
        ("effect", "effect"),
        ("F", "f"),
        ("df", "df"),
        ("df error", "df_error"),
        ("p", "p"),
        ("", "stars"),
        ("partial η²", "partial_eta_squared"),
        ("general η²", "generalized_eta_squared"),
    ];
    parts.table(("effects", "Effects"), &columns, effects.iter().map(row).collect());
    parts.detail(participants(anova.participants));
    if !anova.left_out.is_empty() {
        let why = "left out, because a cell has no value".to_owned();
        parts.reasons([(anova.left_out.join(", "), Some(why))]);
    }
    parts.reasons([("effects".to_owned(), anova.reason.clone())]);
    parts.reasons(effects.iter().map(|effect| (effect.effect.clone(), effect.reason.clone())));
    sphericity(effects, parts);
}

fn sphericity(effects: &[Effect], parts: &mut Parts) {
    let row = |effect: &Effect| {
        vec![
            Cell::text(&effect.effect),
            number(effect.greenhouse_geisser.epsilon),
            p_value(effect.greenhouse_geisser.p),
            number(effect.huynh_feldt.epsilon),
            p_value(effect.huynh_feldt.p),
            number(effect.mauchly.w),
            p_value(effect.mauchly.p),
        ]
    };
    let columns = [
        ("effect", "effect"),
        ("ε (Greenhouse-Geisser)", "greenhouse_geisser_epsilon"),
        ("p", "greenhouse_geisser_p"),
        ("ε (Huynh-Feldt)", "huynh_feldt_epsilon"),
        ("p", "huynh_feldt_p"),
        ("Mauchly's W", "mauchly_w"),
        ("p", "mauchly_p"),
    ];
    let caption = "Corrected for a lack of sphericity";
    parts.table(("sphericity", caption), &columns, effects.iter().map(row).collect());
    let mauchly = |effect: &Effect| {
        (format!("Mauchly's test of {}", effect.effect), effect.mauchly.reason.clone())
    };
    parts.reasons(effects.iter().map(mauchly));
}

fn posthoc(tests: &[PairedTest], parts: &mut Parts) {
    let name = |test: &PairedTest| format!("{}: {} – {}", test.factor, test.a, test.b);
    let row = |test: &PairedTest| {
        vec![
            Cell::text(name(test)),
            number(test.mean_difference),
            interval(test.ci),
            number(test.t),
            whole(test.df),
            p_value(test.p),
            p_value(test.p_adjusted),
            stars(test.p_adjusted),
            number(test.cohen_dz),
        ]
    };
    let columns = [
        ("pair", "pair"),
        ("difference", "mean_difference"),
        ("interval", "ci"),
        ("t", "t"),
        ("df", "df"),
        ("p", "p"),
        ("p adjusted", "p_adjusted"),
        ("", "stars"),
        ("Cohen's dz", "cohen_dz"),
    ];
    parts.table(("posthoc", "Paired t tests"), &columns, tests.iter().map(row).collect());
    parts.reasons(tests.iter().map(|test| (name(test), test.reason.clone())));
}

fn cells(anova: &Anova, parts: &mut Parts) {
    let name = |levels: &[(String, String)]| {
        levels.iter().map(|(_, level)| level.clone()).collect::<Vec<_>>().join(", ")
    };
    let rows = anova.cells.iter().map(|cell| {
        let moments = &cell.moments;
        vec![
            Cell::text(name(&cell.levels)),
            whole(moments.n),
            number(moments.mean),
            number(moments.sd),
            number(moments.se),
            interval(moments.ci),
            number(cell.se_within),
        ]
    });
    let columns = [
        ("cell", "cell"),
        ("n", "n"),
        ("mean", "mean"),
        ("SD", "sd"),
        ("SE", "se"),
        ("interval", "ci"),
        ("SE within participants", "se_within"),
    ];
    parts.table(("cells", "Cells"), &columns, rows.collect());
    parts.reasons(
        anova.cells.iter().map(|cell| (name(&cell.levels), cell.reason().map(str::to_owned))),
    );
}
