//! VaFR (Zhang, Gai, Li): counts of the log-polar buffer, Table 1, what a device saves.
//!
//! The paper mixes two sets of knots: its samples are those of f(60°) = 4 cpd, its buffer is that of
//! f(60°) = 5 cpd. Both are computed with both.

use fovqa_methods::vafr::{FIELD_DEG, Params, Vafr};
use fovqa_methods::{Foveation, Method, lafr};
use fovqa_vision::acuity::{AcuityModel, PiecewiseParams};
use fovqa_vision::find_display;

use super::frame::{centred, possible};
use super::row::{Cell, PageRow, Paper};
use fovqa_report::Printed;

/// Table 1's resolutions with their names.
const RESOLUTIONS: [(&str, [usize; 2]); 5] = [
    ("2K", [2560, 1440]),
    ("4K", [3840, 2160]),
    ("6K", [5760, 3240]),
    ("8K", [7680, 4320]),
    ("retinal", RETINAL),
];
const RETINAL: [usize; 2] = [11520, 6480];
/// The share of the second eye that Table 1's VaFR_Rep leaves to shade, read off that table.
const REPROJECTED: [f64; 5] = [0.2, 0.4, 0.6, 0.8, 0.95];

/// Acuity at 60°, in cycles per degree, of the knots of Eq. 12 …
const FALLING_CPD: f64 = 4.0;
/// … and of those that give the printed buffer.
const FLAT_CPD: f64 = 5.0;

/// A field whose pixels at the acuity of the gaze are those printed as retinal: ours.
const FIELD_OF_EYE_DEG: [f64; 2] = [120.0, 100.0];

/// The rows of VaFR: text, Eq. 3-12 and 19, Table 1.
pub(super) fn vafr() -> Vec<PageRow> {
    [caps(), buffer(), table_1(), savings(), retinal()].concat()
}

fn applied(resolution: [usize; 2], params: &Params) -> Vafr {
    possible(Vafr::new(params, &centred(resolution, 110.0)))
}

fn with_knot(last_cpd: f64, cap_cpd: Option<f64>) -> Vafr {
    let mut params = Params::default();
    if let Some(last) = params.piecewise.knots_cpd.last_mut() {
        *last = last_cpd;
    }
    params.piecewise.cap_cpd = cap_cpd;
    applied(RESOLUTIONS[0].1, &params)
}

fn samples(last_cpd: f64, cap_cpd: Option<f64>) -> f64 {
    with_knot(last_cpd, cap_cpd).counts().samples
}

/// u(60°) and the rows of the longest column.
fn size(last_cpd: f64, cap_cpd: Option<f64>) -> [f64; 2] {
    with_knot(last_cpd, cap_cpd).counts().buffers[0]
}

const MIXED: &str = "The paper mixes two sets of knots: its samples belong to f(60°) = 4 cpd, its \
                     buffer belongs to f(60°) = 5 cpd.";

fn buffer() -> Vec<PageRow> {
    let cell = |name, printed, computed| Cell::new(name, Printed::new(printed), computed, 1);
    let mut rows = Vec::new();
    for cpd in [FALLING_CPD, FLAT_CPD] {
        let cell = cell("", "1,061,735", samples(cpd, None));
        rows.push(PageRow::one(Paper::Vafr, "text", format!("samples, f(60°) = {cpd}"), cell));
    }
    for cpd in [FLAT_CPD, FALLING_CPD] {
        let [columns, longest] = size(cpd, None);
        let (widest_deg, _) = with_knot(cpd, None).longest_column(FIELD_DEG);
        let sides = vec![cell("columns", "932", columns), cell("rows", "1800", longest)];
        let widest = cell("", "45°", widest_deg);
        let two = [
            PageRow::joined(Paper::Vafr, "text", format!("buffer, f(60°) = {cpd}"), " x ", sides),
            PageRow::one(Paper::Vafr, "text", format!("longest column, f(60°) = {cpd}"), widest),
        ];
        rows.extend(two);
    }
    rows.into_iter()
        .map(|row| row.because("the paper mixes two sets of knots").more(MIXED))
        .collect()
}

/// Thousands per eye: W H, W H / δ², ∫ l du; further digits are cut off in print.
fn table_1() -> Vec<PageRow> {
    let printed: [(&str, [&str; 5]); 4] = [
        ("GT", ["3686", "8294", "18662", "33177", "74649"]),
        ("LaFR(2.2)", ["761", "1713", "3855", "6854", "15423"]),
        ("LaFR(1.8)", ["1137", "2560", "5760", "10240", "23040"]),
        ("VaFR_Dup", ["1061"; 5]),
    ];
    let lafr = |sigma| Method::Lafr(lafr::Params { sigma, ..lafr::Params::default() });
    let methods = [Method::Full, lafr(2.2), lafr(1.8), Method::Vafr(Params::default())];
    let mut cells = Vec::new();
    for (method, (name, printed)) in methods.iter().zip(printed) {
        for ((resolution, size), printed) in RESOLUTIONS.iter().zip(printed) {
            let counts = possible(method.apply(&centred(*size, 110.0))).counts();
            let thousands = counts.samples / 1000.0;
            let name = format!("{name} at {resolution}");
            cells.push(Cell::new(name, Printed::truncated(printed), thousands, 1));
        }
    }
    let all = PageRow::counted(
        Paper::Vafr,
        "Table 1",
        "thousands of samples",
        "cells",
        Some(cells),
    )
    .because("the paper truncates digits")
    .more(
        "GT, LaFR(2.2), LaFR(1.8) and VaFR_Dup at five resolutions, per eye: W H, W H / δ² and the \
             sample count with f(60°) = 4 cpd. The paper truncates digits below a thousand.",
    );

    let printed = ["637", "743", "849", "955", "1035"];
    let cells =
        RESOLUTIONS.iter().zip(REPROJECTED).zip(printed).map(|((resolution, s), printed)| {
            let params = Params { reprojected_share: Some(s), ..Params::default() };
            let thousands = applied(resolution.1, &params).counts().samples / 1000.0;
            Cell::new(resolution.0, Printed::truncated(printed), thousands, 1)
        });
    let what = "thousands, VaFR_Rep";
    let rep = PageRow::counted(Paper::Vafr, "Table 1", what, "cells", Some(cells.collect()))
        .read_off()
        .because("the shares come from the table")
        .more(
            "The shares of the second eye that remain to be shaded after reprojection (20, 40, 60, 80, 95 %) were \
             taken from this table itself.",
        );
    vec![all, rep]
}

/// What is saved when no more is shaded than a device shows: 9 cpd (Vive Pro Eye), 18 cpd (Pimax
/// Crystal).
fn savings() -> Vec<PageRow> {
    const CAPS_CPD: [f64; 2] = [9.0, 18.0];
    let both = |quantity: &str, load: &dyn Fn(Option<f64>) -> f64| {
        let cells = CAPS_CPD.iter().zip(["20 %", "8 %"]).map(|(cap, printed)| {
            let saved = 100.0 * (1.0 - load(Some(*cap)) / load(None));
            Cell::new(format!("{cap} cpd"), Printed::new(printed), saved, 1)
        });
        PageRow::joined(Paper::Vafr, "text", quantity, " / ", cells.collect())
    };
    vec![
        both("samples saved at 9 / 18 cpd", &|cap| samples(FALLING_CPD, cap))
            .because("with f(60°) = 4")
            .more("The sample counts, with the knots that give the printed count, reproduce neither number."),
        both("buffer width saved at 9 / 18 cpd", &|cap| size(FLAT_CPD, cap)[0])
            .because("with f(60°) = 5")
            .more(
                "The buffer width, with the knots that give its printed size, is closer, but does not reproduce both \
                 numbers either.",
            ),
    ]
}

/// The caps of Fig. 3, from the pixels per degree at the centre of the displays.
fn caps() -> Vec<PageRow> {
    let row = |name: &str, key: &str, printed: &str, why: &str| {
        let ppd =
            find_display(key).map_or(f64::NAN, fovqa_vision::Display::central_pixels_per_degree);
        let cell = Cell::new("", Printed::new(printed), ppd / 2.0, 1);
        PageRow::one(Paper::Vafr, "Fig. 3", format!("what the {name} shows"), cell)
            .because(why)
            .more(format!(
                "Half of its {ppd:.1} pixels per degree at the centre, since a cycle is two pixels."
            ))
    };
    vec![
        row("Pimax Crystal", "pimax-crystal", "18 cpd", "half of 35 pixels per degree"),
        row("Vive Pro Eye", "vive-pro-eye", "9 cpd", "less at its resolution and field"),
    ]
}

fn retinal() -> Vec<PageRow> {
    let pixels = possible(Method::Full.apply(&centred(RETINAL, 110.0))).counts().samples;
    let cell = Cell::new("", Printed::new("74,649,600"), pixels, 0);
    let product = PageRow::one(Paper::Vafr, "Table 1", "pixels of 11520 x 6480", cell)
        .because("the product of the sides");

    // Two pixels a cycle: twice f(0) pixels per degree.
    let per_degree =
        2.0 * possible(AcuityModel::Piecewise(PiecewiseParams::default()).curve()).cutoff_cpd(0.0);
    let field = FIELD_OF_EYE_DEG[0] * FIELD_OF_EYE_DEG[1];
    let millions = field * per_degree * per_degree / 1e6;
    let cell = Cell::new("", Printed::new("76.8 M"), millions, 1);
    let eye = PageRow::one(Paper::Vafr, "text", "retinal pixels", cell)
        .read_off()
        .because("the field is our assumption")
        .more(format!(
            "At {per_degree:.0} pixels per degree, two for each cycle of f(0), a field of {:.0}° x {:.0}° \
             has as many pixels; the field was derived from the number.",
            FIELD_OF_EYE_DEG[0], FIELD_OF_EYE_DEG[1],
        ));
    vec![eye, product]
}
