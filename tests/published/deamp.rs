//! DEAMP (Wang, Gu, Lu 2024): the outer layer, speed-ups, Table 2, the tests of the user study.

use fovqa_methods::deamp::{Deamp, Params, Projection};

use super::frame::{centred, possible};
use super::row::{Cell, PageRow, Paper};
use super::statistics::f_tail;
use super::tables::{DEAMP_TABLE, Table};
use fovqa_report::{Printed, PrintedVerdict as Verdict};

/// The paper's display, per eye: 90° x 90°.
const FRAME: [usize; 2] = [1600, 1600];
const FOV_DEG: f64 = 90.0;
/// Binocular milliseconds of Table 2: full, eye-dominance KFR (EFR), DEAMP with six layers.
const FULL_MS: f64 = 48.82;
const EFR_MS: f64 = 17.28;
const DEAMP_MS: f64 = 14.74;

/// The rows of DEAMP: section 3.3, Eq. 5-9, Table 2, the study. `table` is Table 2.
pub(super) fn deamp(table: Option<&Table>) -> Vec<PageRow> {
    [outer_share(), speed_ups(), table_2(table), study()].concat()
}

fn one(place: &'static str, quantity: impl Into<String>, cell: Cell) -> PageRow {
    PageRow::one(Paper::Deamp, place, quantity, cell)
}

fn outer_share() -> Vec<PageRow> {
    let share = |projection, name: &str| {
        let params = Params { projection, ..Params::default() };
        let deamp = possible(Deamp::new(&params, &centred(FRAME, FOV_DEG)));
        let cell = Cell::new("", Printed::new("75 %"), 100.0 * deamp.outer_share(), 1);
        one("text", format!("outer layer's share, {name}"), cell)
    };
    vec![
        share(Projection::Linear, "linear in angle").because("contradicts section 3.3").more(
            "The printed share results if the size of a layer is proportional to its angle. In section 3.3 and \
             the published code, the size is proportional to the tangent of the angle.",
        ),
        share(Projection::Tan, "by tangents").because("contradicts section 3.3").more(
            "If the size of a layer is proportional to the tangent of its angle, as in section 3.3 and the published \
             code, the outer layer is larger; the printed share assumes sizes proportional to the angle.",
        ),
    ]
}

/// Frames a second, as Table 2 rounds them.
fn frame_rate(ms: f64) -> f64 {
    (1000.0 / ms).round()
}

fn speed_ups() -> Vec<PageRow> {
    let row = |quantity: &str, printed: &str, computed| {
        one("text", quantity, Cell::new("", Printed::new(printed), computed, 2))
    };
    let mut rows = Vec::new();
    for (printed, ms) in [("3.4x", DEAMP_MS), ("2.9x", EFR_MS)] {
        let rates = [frame_rate(ms), frame_rate(FULL_MS)];
        let [rate, full] = rates;
        rows.push(
            row(&format!("speed-up, {FULL_MS} / {ms} ms"), printed, FULL_MS / ms)
                .because("the paper divides rounded frame rates")
                .more(format!(
                    "The times do not give the printed value. The rounded frame rates do: {rate} / {full}.",
                )),
        );
        rows.push(
            row(&format!("speed-up, {rate} / {full} frames per second"), printed, rate / full)
                .because("the frame rates were rounded first"),
        );
    }
    rows
}

/// What Table 2's rows are called.
const TOTAL: &str = "Total GPU Time";
const BINOCULAR: &str = "Binocular Time";
const RATE: &str = "Fps";

fn table_2(table: Option<&Table>) -> Vec<PageRow> {
    let counted = |quantity: &str, what, cells: Option<Vec<Cell>>| {
        PageRow::counted(Paper::Deamp, "Table 2", quantity, what, cells)
            .because("from the table's own rows")
    };
    let sums = table.map(|table| {
        let passes =
            table.rows_where(&|keys| ![TOTAL, BINOCULAR, RATE].contains(&keys[0].as_str()));
        cells_of(table, TOTAL, 3, &|column| {
            Some(passes.iter().filter_map(|row| row.value(column)).sum())
        })
    });
    // One eye twice, or the dominant and the other eye.
    let binocular = table.map(|table| {
        let totals = table.rows_where(&|keys| keys[0] == TOTAL);
        let total = |column| totals.first().and_then(|row| row.value(column));
        cells_of(table, BINOCULAR, 3, &|column| {
            let other =
                if DEAMP_TABLE.numbers[column].ends_with("_dom") { column + 1 } else { column };
            Some(total(column)? + total(other)?)
        })
    });
    let rates = table.map(|table| {
        let times = table.rows_where(&|keys| keys[0] == BINOCULAR);
        cells_of(table, RATE, 2, &|column| Some(1000.0 / times.first()?.value(column)?))
    });
    vec![
        counted("GPU time, sums of passes", "sums", sums),
        counted("binocular, sums of eyes", "sums", binocular),
        counted("frame rates from times", "rates", rates),
    ]
}

/// The printed numbers of a row beside what is computed for their columns.
fn cells_of(
    table: &Table,
    key: &str,
    decimals: usize,
    computed: &dyn Fn(usize) -> Option<f64>,
) -> Vec<Cell> {
    let rows = table.rows_where(&|keys| keys[0] == key);
    let cell = |(column, name): (usize, &&str)| {
        let printed = rows.first()?.printed(column)?;
        Some(Cell::new(*name, printed, computed(column).unwrap_or(f64::NAN), decimals))
    };
    DEAMP_TABLE.numbers.iter().enumerate().filter_map(cell).collect()
}

/// An analysis of variance of the study as it is printed.
struct Anova {
    p: &'static str,
    f: f64,
    freedom: [u32; 2],
    /// With these the printed p follows.
    fitting: u32,
    decimals: usize,
}

const ANOVAS: [Anova; 4] = [
    Anova { p: ".637", f: 0.229, freedom: [1, 12], fitting: 24, decimals: 3 },
    Anova { p: ".651", f: 0.21, freedom: [1, 12], fitting: 24, decimals: 3 },
    Anova { p: ".003", f: 6.548, freedom: [2, 30], fitting: 45, decimals: 4 },
    Anova { p: ".023", f: 3.817, freedom: [2, 30], fitting: 285, decimals: 4 },
];

/// The largest number of degrees of freedom that is tried.
const MOST_FREEDOM: u32 = 1000;

/// In words, the second degrees of freedom with which F gives the printed p.
fn fitting(printed: &Printed, f: f64, first: u32) -> String {
    let fits = |second: &u32| printed.verdict(f_tail(f, [first, *second])) == Verdict::Reproduced;
    let found: Vec<u32> = (1..=MOST_FREEDOM).filter(fits).collect();
    // The tail falls as they grow, so that what fits stands together.
    match found[..] {
        [] => format!("none up to {MOST_FREEDOM}"),
        [only] => format!("{only} alone"),
        [from, .., MOST_FREEDOM] => format!("from {from} on"),
        [from, .., to] => format!("from {from} to {to}"),
    }
}

fn study() -> Vec<PageRow> {
    let row = |anova: &Anova, freedom: [u32; 2]| {
        let cell = Cell::new("", Printed::new(anova.p), f_tail(anova.f, freedom), anova.decimals);
        one("study", format!("p of F({}, {}) = {}", freedom[0], freedom[1], anova.f), cell)
    };
    let with_freedom = |anova: &Anova, second| row(anova, [anova.freedom[0], second]);
    let printed = ANOVAS.iter().map(|anova| {
        let [first, second] = anova.freedom;
        row(anova, anova.freedom).because("p does not match the degrees of freedom").more(format!(
            "p does not follow from the printed F and degrees of freedom ({first}, {second}). Second degrees of \
             freedom that give the printed p: {}.",
            fitting(&Printed::new(anova.p), anova.f, first),
        ))
    });
    let fitted = ANOVAS.iter().map(|anova| {
        with_freedom(anova, anova.fitting).read_off().because("degrees of freedom chosen to fit").more(format!(
            "These are not the printed degrees of freedom. They were chosen to give the printed p. Second \
             degrees of freedom that give it: {}.",
            fitting(&Printed::new(anova.p), anova.f, anova.freedom[0]),
        ))
    });
    printed.chain(fitted).collect()
}
