//! Merges the shards of a run into its results.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use fovqa_engine::{
    Events, Findings, Given, Header, Journal, Locking, ResultsFolder, Shard, Shards, results,
};
use fovqa_plan::{Experiment, Plan};
use fovqa_results::HAS_PARQUET;

use crate::crops::copy_crops;
use crate::error::Error;
use crate::events::Silent;
use crate::finish::{clear, finish, in_folder, no_space};
use crate::kept_frames::copy_kept;
use crate::maps::copy_maps;
use crate::opinions::{check_shards, copy_opinions};
use crate::pictures::{Pictures, Taking, clear_pictures, copy_pictures, take_missing};
use crate::run::{Finished, scored_frames};
use crate::values::ValuesFolder;

/// How shards are merged.
#[derive(Debug, Clone, Default)]
pub struct MergeOptions {
    /// Whether the results folder is locked.
    pub locking: Locking,
    /// Whether the results have a folder `values` with the values as a Parquet data set, one file per
    /// shard.
    pub values: bool,
    /// The experiment of the shards, if its frames can be read here. The report then has pictures of
    /// the frames that only all scores together choose, such as the worst.
    pub experiment: Option<Experiment>,
}

/// Merges the shards of a run. The results are the same as those of the whole run. Without the
/// experiment and its frames, the report lacks pictures of frames that no shard has taken.
///
/// # Errors
/// If shards are missing or do not belong together, or the results cannot be written.
pub fn merge(
    shards: &[PathBuf],
    output: &Path,
    options: MergeOptions,
    events: &dyn Events,
) -> Result<Finished, Error> {
    if let Some(shard) = shards.iter().find(|shard| same(shard, output)) {
        let message = format!("{}: this folder is one of the shards", shard.display());
        return Err(Error::usage(message, "give another folder with {output}"));
    }
    if options.values && !HAS_PARQUET {
        let message = "this build of fovqa has no support for Parquet".to_owned();
        return Err(Error::usage(
            message,
            "build it with the feature parquet, or leave out {values}",
        ));
    }
    let failed = |error: fovqa_engine::MergeError| Error::input(error.to_string(), error.help());
    let read = Shards::read(shards).map_err(failed)?;
    let header = read.header();
    let frames = options.experiment.is_some();
    let Some(experiment) = experiment(header, options.experiment)? else {
        let message =
            format!("{}: its record of the experiment cannot be read", shards[0].display());
        return Err(Error::input(message, "score its shard again"));
    };
    let plan = &experiment.plan;
    let mut changed = BTreeSet::new();
    let note = &mut |shard| {
        changed.insert(shard);
    };
    let findings = read.findings(plan, note).map_err(failed)?;
    check_shards(shards)?;
    // Nothing is written until all shards are known to be correct.
    let folder = ResultsFolder::open(output, options.locking).map_err(|error| in_folder(&error))?;
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
    let values = if options.values {
        Some(values_of(&read, &changed, (plan, &findings), folder.path())?)
    } else {
        None
    };
    let mut pictures = Pictures::new(folder.path(), experiment.report.size);
    let found = frames.then(|| fovqa_engine::find(plan, &Given::default()));
    let found = found.as_ref();
    let taking = Taking { experiment: &experiment, found, findings: &findings, events };
    take_missing(&taking, folder.path(), &mut pictures);
    let results = results(plan, events, findings);
    if let Some(values) = values {
        values.write_sequences(&results).map_err(|error| no_space(&error))?;
    }
    let scored = scored_frames(&results);
    let (errors, drawn) = finish(&experiment, results, &folder, events, &mut |_| Ok(()))?;
    let folder = folder.path().to_owned();
    Ok(Finished { folder, scored, known: 0, errors, drawn: Some(drawn) })
}

/// Makes a data set of the values of all shards. Most of them have written theirs.
fn values_of(
    shards: &Shards,
    changed: &BTreeSet<Shard>,
    (plan, findings): (&Plan, &Findings),
    folder: &Path,
) -> Result<ValuesFolder, Error> {
    let values = ValuesFolder::new(folder).map_err(|error| {
        Error::input(
            format!("{}: its folder for values cannot be created: {error}", folder.display()),
            "give a writable folder with {output}",
        )
    })?;
    for (shard, of_shard) in shards.folders() {
        let is_there = !changed.contains(&shard)
            && values.take(shard, of_shard).map_err(|error| no_space(&error))?;
        if !is_there {
            let part = results(plan, &Silent, shards.part(plan, findings, shard));
            values.write(shard, &part).map_err(|error| no_space(&error))?;
        }
    }
    Ok(values)
}

/// The experiment whose text is in a journal; `None` if it cannot be read. With the file, its paths
/// lead to its frames.
fn experiment(header: &Header, given: Option<Experiment>) -> Result<Option<Experiment>, Error> {
    let recorded = || {
        let path = Path::new(header.experiment_file());
        fovqa_config::parse_experiment(path, header.experiment_text().to_owned()).ok()
    };
    let experiment = match given {
        Some(given) if given.text == header.experiment_text() => Some(given),
        Some(given) => {
            let message =
                format!("{}: the shards belong to another experiment", given.path.display());
            return Err(Error::input(message, "give the file that they were scored with"));
        }
        None => recorded(),
    };
    let Ok(frames) = header.frames().map(str::parse).transpose() else { return Ok(None) };
    Ok(experiment.map(|mut experiment| {
        experiment.plan.frames = frames;
        experiment.plan.pictures = experiment.wanted_pictures();
        experiment
    }))
}

fn same(one: &Path, other: &Path) -> bool {
    let real = |path: &Path| -> Option<PathBuf> { path.canonicalize().ok() };
    one == other || real(one).is_some_and(|one| real(other) == Some(one))
}
