//! `fovqa merge`: merges the shards of a run.

use crate::args::MergeArgs;
use crate::exit::Exit;
use crate::progress::Terminal;
use crate::{experiment, run};
use fovqa::Dialect;

pub(crate) fn run(args: &MergeArgs) -> Exit {
    let terminal = Terminal::speaking(Dialect::Experiment);
    match fovqa::merge(&args.shards, &args.output, args.lock.locking(), &terminal) {
        Ok(finished) => run::say(&finished),
        Err(error) => experiment::failed(&error),
    }
}
