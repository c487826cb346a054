//! `fovqa merge`: merges the shards of a run.

use crate::args::MergeArgs;
use crate::exit::Exit;
use crate::progress::Terminal;
use crate::{experiment, run};
use fovqa::{Dialect, MergeOptions};

pub(crate) fn run(args: &MergeArgs) -> Exit {
    let terminal = Terminal::speaking(Dialect::Experiment);
    let experiment = match args.experiment.as_deref().map(experiment::read).transpose() {
        Ok(experiment) => experiment,
        Err(exit) => return exit,
    };
    let options = MergeOptions { locking: args.lock.locking(), values: args.values, experiment };
    match fovqa::merge(&args.shards, &args.output, options, &terminal) {
        Ok(finished) => run::say(&finished),
        Err(error) => experiment::failed(&error),
    }
}
