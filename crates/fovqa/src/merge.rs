//! Merges the shards of a run into its results.

use std::path::{Path, PathBuf};

use fovqa_engine::{Events, Header, Journal, Locking, ResultsFolder, Shards, results};
use fovqa_plan::Experiment;

use crate::crops::copy_crops;
use crate::error::Error;
use crate::finish::{clear, finish, in_folder};
use crate::kept_frames::copy_kept;
use crate::maps::copy_maps;
use crate::opinions::{check_shards, copy_opinions};
use crate::pictures::{Pictures, Taking, clear_pictures, copy_pictures, take_missing};
use crate::run::Finished;

/// Merges the shards of a run. The results are the same as those of the whole run. Neither the
/// experiment file nor the frames are needed.
///
/// # Errors
/// If shards are missing or do not belong together, or the results cannot be written.
pub fn merge(
    shards: &[PathBuf],
    output: &Path,
    locking: Locking,
    events: &dyn Events,
) -> Result<Finished, Error> {
    if let Some(shard) = shards.iter().find(|shard| same(shard, output)) {
        let message = format!("{}: this folder is one of the shards", shard.display());
        return Err(Error::usage(message, "give another folder with {output}"));
    }
    let failed = |error: fovqa_engine::MergeError| Error::input(error.to_string(), error.help());
    let read = Shards::read(shards).map_err(failed)?;
    let header = read.header();
    let Some(experiment) = experiment(header) else {
        let message =
            format!("{}: its record of the experiment cannot be read", shards[0].display());
        return Err(Error::input(message, "score its shard again"));
    };
    let plan = &experiment.plan;
    let findings = read.findings(plan).map_err(failed)?;
    check_shards(shards)?;
    // Nothing is written until all shards are known to be correct.
    let folder = ResultsFolder::open(output, locking).map_err(|error| in_folder(&error))?;
    clear(&folder)?;
    clear_pictures(folder.path());
    Journal::begin(folder.path(), header, plan, &findings)?;
    for shard in shards {
        let copies = [copy_kept, copy_crops, copy_maps, copy_pictures, copy_opinions];
        copies.into_iter().try_for_each(|copy| copy(shard, folder.path())).map_err(|error| {
            let message = format!("{}: its files cannot be copied: {error}", shard.display());
            Error::input(message, "free some space, or give another folder with {output}")
        })?;
    }
    let mut pictures = Pictures::new(folder.path(), experiment.report.size);
    let taking = Taking { experiment: &experiment, found: None, findings: &findings, events };
    take_missing(&taking, folder.path(), &mut pictures);
    let results = results(plan, events, findings);
    let own = results.comparisons.iter().filter(|comparison| comparison.eye != "both");
    let scored = own.map(|comparison| comparison.report.frames.len()).sum();
    let (errors, drawn) = finish(&experiment, results, &folder, events, &mut |_| Ok(()))?;
    Ok(Finished { folder: folder.path().to_owned(), scored, errors, drawn: Some(drawn) })
}

/// The experiment whose text is in a journal.
fn experiment(header: &Header) -> Option<Experiment> {
    let path = Path::new(header.experiment_file());
    let text = header.experiment_text().to_owned();
    let mut experiment = fovqa_config::parse_experiment(path, text).ok()?;
    experiment.plan.frames = header.frames().map(str::parse).transpose().ok()?;
    Some(experiment)
}

fn same(one: &Path, other: &Path) -> bool {
    let real = |path: &Path| -> Option<PathBuf> { path.canonicalize().ok() };
    one == other || real(one).is_some_and(|one| real(other) == Some(one))
}
