//! Reads further runs of the same build, for rules that test the spread of repeated runs.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use fovqa_plan::{GateRule, Resolved};
use fovqa_results::RunValues;

use crate::error::Error;
use crate::finished_run::FinishedRun;

/// The values of repeated runs, with their folders.
pub(crate) struct Repeats(Vec<(PathBuf, RunValues)>);

impl Repeats {
    /// Reads repeated runs of an experiment. `first` is the folder of the run that they repeat.
    ///
    /// # Errors
    /// If no rule tests the spread of runs, a folder is given twice, or a run is not finished, was made
    /// with other settings or has errors.
    pub(crate) fn read(
        first: &Path,
        folders: &[PathBuf],
        resolved: &Resolved,
        rules: &[GateRule],
    ) -> Result<Self, Error> {
        if !folders.is_empty() && rules.iter().all(|rule| rule.spread.is_none()) {
            let message = "no rule of the experiment tests the spread of repeated runs";
            return Err(Error::usage(
                message,
                "add alpha = 0.01 to a [[gate]] rule, or leave out --repeats",
            ));
        }
        let mut seen: BTreeSet<PathBuf> = first.canonicalize().into_iter().collect();
        let mut runs = Vec::new();
        for folder in folders {
            let shown = folder.display();
            if folder.canonicalize().is_ok_and(|path| !seen.insert(path)) {
                let message = format!("{shown}: this run is given twice");
                let help = "give each run once: a copy of a run does not vary";
                return Err(Error::usage(message, help));
            }
            let run = FinishedRun::read(folder)?;
            let other = run.record.resolved.differs(resolved);
            if let Some(why) = other.or_else(|| run.values.errors.first().cloned()) {
                let message = format!("{shown}: it is no repeated run of this experiment: {why}");
                return Err(Error::input(message, "run the experiment again"));
            }
            runs.push((folder.clone(), run.values));
        }
        Ok(Self(runs))
    }

    /// Adds the repeated runs to the run that they repeat.
    ///
    /// # Errors
    /// If a run does not have the same comparisons with the same number of frames.
    pub(crate) fn add_to(self, values: &mut RunValues) -> Result<(), Error> {
        for (folder, run) in self.0 {
            let places = values.places().chain(run.places());
            for place in places {
                let [is, was] = [&run, values].map(|run| run.frames_of(place));
                if is != was {
                    let (scene, method, _) = place;
                    let message = format!(
                        "{}: it is no repeated run of this experiment: it has {is} frames of {scene}, {method} \
                         instead of {was}",
                        folder.display()
                    );
                    return Err(Error::input(message, "run the experiment again"));
                }
            }
            values.repeats.push(run);
        }
        Ok(())
    }
}
