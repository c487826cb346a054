//! The baselines of a gate. Of several, such as one for each machine, the best match counts.

use std::path::{Path, PathBuf};

use fovqa_plan::Resolved;
use fovqa_results::{Baseline, Outcome, RunValues, Verdict};

use crate::baseline::BaselineFrames;
use crate::error::Error;

/// A baseline and its file.
#[derive(Debug)]
pub(super) struct Named {
    pub(super) path: PathBuf,
    pub(super) baseline: Baseline,
}

/// The baselines that a run can be compared with, and why others cannot be.
#[derive(Debug, Default)]
pub(super) struct Baselines {
    fitting: Vec<Named>,
    others: Vec<String>,
}

impl Baselines {
    /// Reads baselines.
    ///
    /// # Errors
    /// If one cannot be read, or none fits the run.
    pub(super) fn read(paths: &[PathBuf], run: &Resolved) -> Result<Self, Error> {
        let mut baselines = Self::default();
        for path in paths {
            let baseline = super::super::baseline::read_baseline(path)?;
            match baseline.refuses(run) {
                None => baselines.fitting.push(Named { path: path.clone(), baseline }),
                Some(why) => {
                    let file = path.display();
                    let why =
                        format!("{file}: the baseline's values were measured differently: {why}");
                    baselines.others.push(why);
                }
            }
        }
        match baselines.others.first() {
            Some(why) if baselines.fitting.is_empty() => {
                let help = "run the experiment, look at the results, and update the baseline with `fovqa baseline accept`";
                Err(Error::input(why.clone(), help))
            }
            _ => Ok(baselines),
        }
    }

    /// The verdict against the baseline that the run matches best: with the fewest checks that do not pass,
    /// then with the smallest of the largest distances between a value and the baseline's, in units of the
    /// distance that the rule allows.
    pub(super) fn judge(
        &self,
        run: &Resolved,
        file: &str,
        values: &RunValues,
    ) -> (Verdict, Option<&Named>) {
        let verdicts = self
            .fitting
            .iter()
            .map(|named| (Verdict::of(run, file, values, Some(&named.baseline)), named));
        let best =
            verdicts.reduce(|best, one| if rank(&one.0) < rank(&best.0) { one } else { best });
        let Some((mut verdict, named)) = best else {
            return (Verdict::of(run, file, values, None), None);
        };
        if self.fitting.len() + self.others.len() > 1 {
            verdict.baseline = Some(named.path.display().to_string());
        }
        verdict.notes.extend(self.others.iter().cloned());
        (verdict, Some(named))
    }
}

/// Orders verdicts: the smallest is the best match.
fn rank(verdict: &Verdict) -> (usize, Distance) {
    let checks = || verdict.rules.iter().flat_map(|rule| &rule.checks);
    let broken = checks().filter(|check| check.outcome != Outcome::Passed).count()
        + verdict.rules.iter().filter(|rule| rule.failure.is_some()).count();
    let distances = checks().filter_map(|check| {
        let (value, limit, baseline) = (check.value?, check.limit?, check.baseline?);
        let apart = (value - baseline).abs();
        // What is equal, infinite too, is not apart, whatever the rule allows.
        let is_same = value.to_bits() == baseline.to_bits();
        let allowed = (limit.value - baseline).abs().max(f64::MIN_POSITIVE);
        Some(if is_same { 0.0 } else { apart / allowed })
    });
    (broken, Distance(distances.fold(0.0, f64::max)))
}

/// A number with a total order.
#[derive(Debug, Clone, Copy)]
struct Distance(f64);

impl PartialEq for Distance {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Distance {}

impl PartialOrd for Distance {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Distance {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.0.total_cmp(&other.0)
    }
}

impl Named {
    /// The frames that the baseline keeps, if they belong to it.
    ///
    /// # Errors
    /// If there are frames, but of another baseline.
    pub(super) fn frames(&self) -> Result<Option<BaselineFrames>, String> {
        BaselineFrames::open(Path::new(&self.path), &self.baseline)
    }
}
