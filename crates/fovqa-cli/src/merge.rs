//! `fovqa merge`: the shards of a run to its results.

use std::path::{Path, PathBuf};

use fovqa_engine::{Header, Journal, ResultsFolder, Shards, results};
use fovqa_plan::Experiment;

use crate::args::MergeArgs;
use crate::diagnostic;
use crate::dialect::Dialect;
use crate::exit::Exit;
use crate::progress::Terminal;
use crate::results::{Shown, clear, failed, finish};
use crate::run::broken;

pub(crate) fn run(args: &MergeArgs) -> Exit {
    if let Some(shard) = args.shards.iter().find(|shard| same(shard, &args.output)) {
        let message = format!("{}: it is one of the shards", shard.display());
        diagnostic::error(&message, "give another folder with --output");
        return Exit::Usage;
    }
    let shards = match Shards::read(&args.shards) {
        Ok(shards) => shards,
        Err(error) => return failed(&error, error.help()),
    };
    let header = shards.header();
    let Some(experiment) = experiment(header) else {
        let message = format!("{}: its experiment is none", args.shards[0].display());
        diagnostic::error(&message, "score its shard again");
        return Exit::Input;
    };
    let plan = &experiment.plan;
    let findings = match shards.findings(plan) {
        Ok(findings) => findings,
        Err(error) => return failed(&error, error.help()),
    };
    // Nothing is written before all of it is known to be right.
    let folder = match ResultsFolder::open(&args.output, args.lock.locking()) {
        Ok(folder) => folder,
        Err(error) => return failed(&error, error.help()),
    };
    if let Err(error) = clear(&folder) {
        return failed(&error, error.help());
    }
    if let Err(error) = Journal::begin(folder.path(), header, plan, &findings) {
        return broken(error);
    }
    let terminal = Terminal::speaking(Dialect::Experiment);
    let results = results(plan, &terminal, findings);
    finish(&experiment, &results, &folder, Shown::Table).unwrap_or_else(|exit| exit)
}

/// The experiment whose text a journal has.
fn experiment(header: &Header) -> Option<Experiment> {
    let path = Path::new(header.experiment_file());
    let mut experiment =
        fovqa_config::parse_experiment(path, header.experiment_text().to_owned()).ok()?;
    experiment.plan.frames = header.frames().map(str::parse).transpose().ok()?;
    Some(experiment)
}

fn same(one: &Path, other: &Path) -> bool {
    let real = |path: &Path| -> Option<PathBuf> { path.canonicalize().ok() };
    one == other || real(one).is_some_and(|one| real(other) == Some(one))
}
