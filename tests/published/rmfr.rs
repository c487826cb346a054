//! RMFR (Ye et al. 2022): samples, the user study, the comparison of Fig. 11, Tables 1 and 3.

use fovqa_methods::{Foveation, Method, Setting, guenter, linear, rmfr};

use super::frame::{centred, possible};
use super::row::{Cell, PageRow, Paper};
use super::statistics::{at_least, two_sided, whole_votes};
use super::tables::{RMFR_TABLE, Table};
use fovqa_report::{Printed, PrintedVerdict as Verdict};

/// The display of the study, per eye, and its field.
const FRAME: [usize; 2] = [1440, 1600];
const FOV_VERTICAL_DEG: f64 = 110.0;
/// Trials of a comparison in the study.
const TRIALS: u64 = 72;
/// The study's share of votes, and the bound printed for its p.
const VOTES: [(&str, &str); 4] =
    [("68.1 %", "< .01"), ("65.3 %", "< .01"), ("69.4 %", "< .001"), ("48.6 %", "> .05")];
/// Table 3: full and foveated frame time in milliseconds.
const FRAME_TIMES_MS: [f64; 2] = [26.2, 14.29];

/// The rows of RMFR: Eq. 4-7, Fig. 11, Tables 1 and 3, the study. `table` is Table 1.
pub(super) fn rmfr(table: Option<&Table>) -> Vec<PageRow> {
    [vec![samples()], vec![trials()], study(), densities(), vec![averages(table)], times()].concat()
}

fn one(place: &'static str, quantity: impl Into<String>, cell: Cell) -> PageRow {
    PageRow::one(Paper::Rmfr, place, quantity, cell)
}

/// Samples over pixels with σ = 2.6.
fn share(setting: &Setting) -> f64 {
    possible(Method::Rmfr(rmfr::Params::default()).apply(setting)).counts().samples
        / setting.pixels()
}

fn samples() -> PageRow {
    let share = 100.0 * share(&centred(FRAME, FOV_VERTICAL_DEG));
    one("text", "share of samples at σ = 2.6", Cell::new("", Printed::new("14.8 %"), share, 2))
        .because("1 / σ²")
}

/// The number of trials that all percentages of the study are whole votes of.
fn trials() -> PageRow {
    let fit = |trials: &u64| {
        VOTES.iter().all(|(share, _)| !whole_votes(&Printed::new(share), *trials).is_empty())
    };
    let fewest = (1..=TRIALS).find(fit).map_or(f64::NAN, |trials| trials as f64);
    let cell = Cell::new("", Printed::new(&TRIALS.to_string()), fewest, 0);
    one("study", "trials of a comparison", cell)
        .because("the fewest that give all four percentages")
        .read_off()
}

fn study() -> Vec<PageRow> {
    let mut votes_rows = Vec::new();
    let mut two_sided_rows = Vec::new();
    let mut one_sided_rows = Vec::new();
    for (percentage, bound) in VOTES {
        let printed = Printed::new(percentage);
        let fits = whole_votes(&printed, TRIALS);
        let nearest = (printed.value() / 100.0 * TRIALS as f64).round() as u64;
        let votes = fits.first().copied().unwrap_or(nearest);
        let why = match fits.len() {
            0 => "no whole number fits".to_owned(),
            1 => format!("{votes} votes, no other number fits"),
            several => format!("{several} whole numbers fit"),
        };
        let computed = 100.0 * votes as f64 / TRIALS as f64;
        let quantity = format!("votes of {TRIALS}");
        votes_rows.push(one("study", quantity, Cell::new("", printed, computed, 2)).because(why));

        let p = |sides: &str, p: f64| {
            let decimals = if p < 0.1 { 4 } else { 3 };
            let cell = Cell::new("", Printed::new(bound), p, decimals);
            one("study", format!("p of {votes} votes, {sides}"), cell)
        };
        let two = p("two-sided", two_sided(votes, TRIALS));
        if two.verdict() == Verdict::Reproduced {
            two_sided_rows.push(two.because("binomial test"));
        } else {
            let one_sided = at_least(votes, TRIALS);
            two_sided_rows.push(two.because("a one-sided p").more(format!(
                "Two-sided, {votes} of {TRIALS} votes do not give the printed bound; one-sided, p is \
                 {one_sided:.4}.",
            )));
            one_sided_rows.push(p("one-sided", one_sided).because("binomial test"));
        }
    }
    [votes_rows, two_sided_rows, one_sided_rows].concat()
}

/// Mean densities of Fig. 11's three methods.
#[derive(Debug, Clone, Copy)]
enum Mean {
    /// Guenter's layers as they are seen.
    Hyperbolic,
    /// Its discs, with the fovea that is shaded repeatedly.
    HyperbolicRepeated,
    /// Linear fall-off.
    Linear,
}

impl Mean {
    fn at(self, fov_vertical_deg: f64) -> f64 {
        let setting = centred(FRAME, fov_vertical_deg);
        let guenter = || possible(guenter::Guenter::new(&guenter::Params::default(), &setting));
        let samples = match self {
            Self::Hyperbolic => guenter().counts().samples_seen,
            Self::HyperbolicRepeated => guenter().samples_in_discs(),
            Self::Linear => {
                let linear = linear::Linear::new(&linear::Params::default(), &setting);
                possible(linear).counts().samples_seen
            }
        };
        samples / setting.pixels()
    }

    /// The vertical field of view with a mean density, which falls with it.
    fn fov_deg(self, density: f64) -> f64 {
        let [mut low, mut high] = FIELDS_DEG;
        for _ in 0..60 {
            let middle = low.midpoint(high);
            if self.at(middle) > density { low = middle } else { high = middle }
        }
        low.midpoint(high)
    }
}

/// Vertical fields that are searched, in degrees.
const FIELDS_DEG: [f64; 2] = [20.0, 170.0];

/// The field in which the worse of two methods is nearest to a density.
fn best_fov_deg(means: [Mean; 2], density: f64) -> f64 {
    let off =
        |fov: f64| means.iter().map(|mean| (mean.at(fov) - density).abs()).fold(0.0, f64::max);
    let [from, to] = FIELDS_DEG;
    let tenths = (10.0 * (to - from)) as usize;
    let fields = (0..=tenths).map(|i| (10.0 * from + i as f64) / 10.0);
    let nearer =
        |best: (f64, f64), fov: f64| if off(fov) < best.1 { (fov, off(fov)) } else { best };
    fields.fold((from, f64::INFINITY), nearer).0
}

fn densities() -> Vec<PageRow> {
    let target = share(&centred(FRAME, FOV_VERTICAL_DEG));
    let rmfr = format!("{target:.3}");
    let cell =
        |name: &str, computed| Cell::new(name, Printed::in_words("equal", &rmfr), computed, 3);
    let at = |name: &str, mean: Mean, what: &str| {
        one("Fig. 11", format!("mean density at 110°, {name}"), cell("", mean.at(FOV_VERTICAL_DEG)))
            .because(format!("RMFR's is {rmfr}"))
            .more(format!(
                "The paper compares at equal mean density; RMFR's is 1 / σ² = {rmfr}. The density of {what} \
                 has this value for a vertical field of {:.1}°.",
                mean.fov_deg(target)
            ))
    };
    let both = |name: &str, hyperbolic: Mean| {
        let means = [hyperbolic, Mean::Linear];
        let fov = best_fov_deg(means, target);
        let cells = vec![cell(name, means[0].at(fov)), cell("linear", means[1].at(fov))];
        PageRow::joined(Paper::Rmfr, "Fig. 11", format!("{name} / linear in one field"), " / ", cells)
            .because("no field fits both")
            .more(format!(
                "Among vertical fields from {:.0}° to {:.0}° in steps of 0.1°, {fov:.1}° brings both methods \
                 closest to RMFR's {rmfr}.",
                FIELDS_DEG[0], FIELDS_DEG[1],
            ))
    };
    vec![
        at(
            "hyperbolic",
            Mean::Hyperbolic,
            "the hyperbolic layers, without what is shaded repeatedly,",
        ),
        at(
            "discs",
            Mean::HyperbolicRepeated,
            "the hyperbolic layers as discs, the fovea repeated,",
        ),
        at("linear", Mean::Linear, "the linear fall-off"),
        both("hyperbolic", Mean::Hyperbolic),
        both("discs", Mean::HyperbolicRepeated),
    ]
}

const METRICS: [&str; 4] = ["FPSNR", "PSNR", "SSIM", "FovVideoVDP"];

/// The averages over scenes, from the scenes' rows.
fn averages(table: Option<&Table>) -> PageRow {
    let cells = table.map(|table| {
        let mut cells = Vec::new();
        for metric in METRICS {
            let scenes = table.rows_where(&|keys| keys[0] == metric && keys[1] != "Average");
            let average = table.rows_where(&|keys| keys[0] == metric && keys[1] == "Average");
            for (column, method) in RMFR_TABLE.numbers.iter().enumerate() {
                let sum: f64 = scenes.iter().filter_map(|row| row.value(column)).sum();
                let printed = average.first().and_then(|row| row.printed(column));
                let name = format!("{metric} of {method}");
                let printed = printed.unwrap_or_else(|| Printed::new(""));
                cells.push(Cell::new(name, printed, sum / scenes.len() as f64, 3));
            }
        }
        cells
    });
    PageRow::counted(Paper::Rmfr, "Table 1", "means over the scenes", "averages", cells)
        .because("from the table's own rows")
}

fn times() -> Vec<PageRow> {
    let [full, foveated] = FRAME_TIMES_MS;
    let row = |quantity: &str, printed: &str, computed| {
        one("Table 3", quantity, Cell::new("", Printed::new(printed), computed, 2))
            .because(format!("from {full} and {foveated} ms"))
    };
    vec![
        row("speed-up", "1.83", full / foveated),
        row("frame time saved", "45.46 %", 100.0 * (1.0 - foveated / full)),
    ]
}
