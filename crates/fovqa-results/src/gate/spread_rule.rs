//! Checks a rule against the spread of repeated runs: each scored band of each comparison is one test.

use fovqa_metrics::{Metric, Subject};
use fovqa_plan::{GateRule, Quantity, SpreadTest};
use fovqa_statistics::adjust::{Adjustment, adjusted, shares};

use super::noise::rounding_noise;
use super::t_test::TTest;
use super::values::{ComparisonName, Lacking, RunValues};
use super::verdict::{Check, Limit, Outcome, is_of};
use crate::baseline::Baseline;

/// The quantities that a rule tests in a comparison: its value in each scored band, or only in the band
/// that it names, or in the whole frame if the metric has no bands. There are none if the rule does not
/// apply to the comparison.
pub(crate) fn tested_quantities(
    rule: &GateRule,
    run: &RunValues,
    place: &ComparisonName,
) -> Vec<Quantity> {
    if !is_of(rule, place) {
        return Vec::new();
    }
    let quantity = &rule.quantity;
    let has_bands = Metric::find(&quantity.metric).is_some_and(|metric| {
        metric.info().per_band && (metric != Metric::Fvvdp || quantity.statistic == "share")
    });
    let bands = if has_bands { run.bands_of(place) } else { Vec::new() };
    if quantity.band_deg.is_some() || bands.is_empty() {
        return vec![quantity.clone()];
    }
    let in_band = |band: [f64; 2]| Quantity { band_deg: Some(band), ..quantity.clone() };
    bands.into_iter().map(in_band).collect()
}

impl RunValues {
    /// The edges of the scored bands of a comparison in degrees, from the gaze outwards.
    fn bands_of(&self, place: &ComparisonName) -> Vec<[f64; 2]> {
        let pixels = (Subject::Pixels.name().to_owned(), String::new(), "pair".to_owned(), None);
        let rows = self.places.get(place).and_then(|values| values.rows.get(&pixels));
        let mut bands: Vec<[f64; 2]> =
            rows.into_iter().flatten().filter_map(|row| row.band).collect();
        bands.sort_by(|a, b| a[0].total_cmp(&b[0]));
        bands.dedup();
        bands
    }

    /// A value in this run, and in the further runs of the same build.
    ///
    /// # Errors
    /// If a run has no value.
    pub(crate) fn of_all_runs(
        &self,
        place: &ComparisonName,
        quantity: &Quantity,
    ) -> Result<Vec<f64>, Lacking> {
        let first = self.of(place, quantity)?.value;
        let further = self.repeats.iter().map(|run| {
            let found = run.of(place, quantity).map(|found| found.value);
            found.map_err(|lacking| lacking.within("in a repeated run"))
        });
        std::iter::once(Ok(first)).chain(further).collect()
    }
}

/// The checks of a rule, one per comparison and band.
pub(super) fn checks(
    rule: &GateRule,
    test: SpreadTest,
    run: &RunValues,
    baseline: Option<&Baseline>,
) -> Vec<Check> {
    let mut checks = Vec::new();
    let mut tests: Vec<(usize, Quantity, TTest)> = Vec::new();
    for place in run.places() {
        for quantity in tested_quantities(rule, run, place) {
            let band = quantity.band_deg;
            let mut check = Check { band, ..Check::of(place) };
            match compared(rule, &quantity, run, place, baseline) {
                Compared::Test(test) => tests.push((checks.len(), quantity, test)),
                Compared::Without(outcome) => check.outcome = outcome,
                Compared::Nothing => continue,
            }
            checks.push(check);
        }
    }
    let p: Vec<f64> = tests.iter().map(|(_, _, test)| test.p()).collect();
    let adjusted = adjusted(&p, test.adjust);
    let shares = shares(test.alpha, &p, test.adjust);
    for (((index, quantity, found), p), share) in tests.iter().zip(adjusted).zip(shares) {
        let check = &mut checks[*index];
        let (limit, at_least) = found.limit(share);
        let margin = if at_least { found.value - limit } else { limit - found.value };
        check.value = Some(found.value);
        check.baseline = Some(found.baseline);
        check.limit = Some(Limit { at_least, value: limit, margin });
        check.p = Some(p);
        if p <= test.alpha {
            check.outcome = Outcome::Failed(reason(test, quantity, found, p));
        } else if run.errors_of(&check.place) > 0 {
            let errors = run.errors_of(&check.place);
            let why = format!("{errors} of its frames could not be scored");
            check.outcome = Outcome::NotScored(why);
        }
    }
    checks
}

/// The comparison of a quantity with the baseline.
enum Compared {
    /// The test.
    Test(TTest),
    /// The outcome without a test.
    Without(Outcome),
    /// Neither this run nor the baseline has a pixel in the band.
    Nothing,
}

fn compared(
    rule: &GateRule,
    quantity: &Quantity,
    run: &RunValues,
    place: &ComparisonName,
    baseline: Option<&Baseline>,
) -> Compared {
    let failed = |why: String| Compared::Without(Outcome::Failed(why));
    let not_scored = |why: String| Compared::Without(Outcome::NotScored(why));
    let Some(baseline) = baseline else { return failed("there is no baseline".to_owned()) };
    let old = match baseline.repeats(place, quantity) {
        Ok(old) => old,
        Err(why) => return failed(why),
    };
    let new = match run.of_all_runs(place, quantity) {
        Ok(new) => new,
        // A band that the rule does not name may lie beyond the frame.
        Err(Lacking::Nothing(_)) if rule.quantity.band_deg.is_none() && old.is_empty() => {
            return Compared::Nothing;
        }
        Err(Lacking::Band(why)) => return Compared::Without(Outcome::Wrong(why)),
        Err(Lacking::NotScored(why)) => return not_scored(why),
        Err(Lacking::Nothing(why)) => return failed(why),
    };
    if old.len() < 2 {
        return not_scored(format!(
            "the baseline has no repeated runs of {quantity}: render its build at least twice, and save the \
             runs with `fovqa baseline save RESULTS FILE --repeats DIR…`"
        ));
    }
    let frames = run.frames_of(place);
    if let Some(was) = baseline.frames_of(place).filter(|was| *was != frames) {
        return not_scored(format!("the baseline has {was} frames, but the run has {frames}"));
    }
    let noise = |magnitude: f64| rounding_noise(quantity, magnitude);
    if let Some(test) = TTest::new(&new, &old, quantity.better(), noise) {
        return Compared::Test(test);
    }
    let same = new.iter().chain(&old).all(|value| value.to_bits() == new[0].to_bits());
    if same {
        return Compared::Without(Outcome::Passed);
    }
    not_scored(format!("{quantity} is infinite in some runs, and has no test"))
}

/// Why a test fails.
fn reason(test: SpreadTest, quantity: &Quantity, found: &TTest, p: f64) -> String {
    let side = if found.value < found.baseline { "lower" } else { "higher" };
    let (value, baseline) = (short(found.value), short(found.baseline));
    let statistic = if found.error == 0.0 {
        "the repeated runs do not vary".to_owned()
    } else {
        let name = if found.runs == 1 { "one run: t" } else { "Welch's t" };
        let freedom = digits(found.freedom, 2);
        format!("{name} = {}, {freedom} degrees of freedom", digits(found.t(), 2))
    };
    let after = match test.adjust {
        Adjustment::Holm => " after Holm",
        Adjustment::Bonferroni => " after Bonferroni",
        Adjustment::None => "",
    };
    let p = digits(p, 2);
    format!(
        "{quantity} is {value}, {side} than the baseline's {baseline} ({statistic}, p = {p}{after}, alpha {})",
        test.alpha
    )
}

/// A value with six significant digits.
fn short(value: f64) -> String {
    digits(value, 6)
}

/// A number with some significant digits.
fn digits(value: f64, count: usize) -> String {
    let rounded: Option<f64> = format!("{value:.*e}", count - 1).parse().ok();
    let rounded = rounded.unwrap_or(value);
    if rounded != 0.0 && rounded.abs() < 1e-4 {
        format!("{rounded:e}")
    } else {
        rounded.to_string()
    }
}

#[cfg(test)]
mod tests;
