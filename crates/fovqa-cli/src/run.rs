//! `fovqa run`: experiment, frames, scores, files, tables and figures; or one shard of the scores.

use std::path::{Path, PathBuf};

use fovqa_engine::{
    EngineError, Findings, Found, Header, Journal, NO_MAPS, ResultsFolder, Shard, results, resume,
};
use fovqa_plan::{Experiment, Eye};

use crate::args::RunArgs;
use crate::diagnostic;
use crate::dialect::Dialect;
use crate::exit::Exit;
use crate::heat_maps::{self, HeatMaps};
use crate::progress::Terminal;
use crate::results::{Shown, clear, failed, finish, say_failures_of_shard};
use crate::{experiment, threads};

/// A run that can begin.
struct Run<'a> {
    experiment: &'a Experiment,
    found: &'a Found,
    folder: &'a ResultsFolder,
    shard: Option<Shard>,
    maps: Option<HeatMaps>,
}

pub(crate) fn run(args: &RunArgs) -> Exit {
    scored(args, Shown::Table).1
}

/// Scores an experiment; the folder with its results, where they could be written, and how that ended.
pub(crate) fn scored(args: &RunArgs, shown: Shown) -> (Option<PathBuf>, Exit) {
    match into_folder(args, shown) {
        Ok((folder, exit)) => (Some(folder), exit),
        Err(exit) => (None, exit),
    }
}

fn into_folder(args: &RunArgs, shown: Shown) -> Result<(PathBuf, Exit), Exit> {
    if let Err(message) = threads::start(args.threads) {
        diagnostic::error(&message, "ask for fewer");
        return Err(Exit::Usage);
    }
    let mut experiment = experiment::read(&args.experiment)?;
    experiment.plan.frames = args.frames;
    experiment.plan.maps = args.maps.is_some();
    let lacking = heat_maps::lacking(experiment.plan.metrics.metrics());
    if let Some(message) = lacking.filter(|_| args.maps.is_some()) {
        diagnostic::error(&message, "add one of them to [metrics], such as ssim = {}");
        return Err(Exit::Usage);
    }
    let folder = args.output.clone().unwrap_or_else(|| default_folder(&experiment, args.shard));
    // Before anything is read or scored: a folder that cannot be written to is found now.
    let folder = ResultsFolder::open(&folder, args.lock.locking())
        .map_err(|error| failed(&error, error.help()))?;
    let found = fovqa_engine::find(&experiment.plan, &fovqa_engine::Given::default());
    if found.problems.iter().any(|problem| problem.error.is_usage()) {
        say_problems(&experiment, &found);
        return Err(Exit::Usage);
    }
    let run = Run {
        experiment: &experiment,
        found: &found,
        folder: &folder,
        shard: args.shard,
        maps: args.maps.clone().map(|folder| HeatMaps::new(folder, true)),
    };
    let header = Header::new(&experiment, &found, args.shard).with_maps(args.maps.as_deref());
    let known = if args.resume { run.known(&header)? } else { Findings::default() };
    let terminal = Terminal::speaking(Dialect::Experiment);
    let findings = run.score(&header, known, &terminal)?;
    let exit = match args.shard {
        None => {
            let results = results(&experiment.plan, &terminal, findings);
            finish(&experiment, &results, &folder, shown)?
        }
        Some(shard) => run.say_shard(shard, &findings),
    };
    Ok((folder.path().to_owned(), exit))
}

fn default_folder(experiment: &Experiment, shard: Option<Shard>) -> PathBuf {
    let name = &experiment.name;
    Path::new("reports").join(match shard {
        None => name.clone(),
        Some(shard) => format!("{name}-shard-{}-of-{}", shard.index(), shard.of()),
    })
}

/// Says what is wrong with the inputs as a whole.
pub(crate) fn say_problems(experiment: &Experiment, found: &Found) {
    for problem in &found.problems {
        let scene = &experiment.plan.scenes[problem.scene];
        let eye = scene.eyes[problem.eye].eye.map(Eye::name);
        let method = problem.method.map(|method| experiment.plan.methods[method].as_str());
        let place: Vec<&str> =
            [Some(scene.name.as_str()), method, eye].into_iter().flatten().collect();
        let help = Dialect::Experiment.spell(&problem.error.help());
        diagnostic::error(&format!("{}: {}", place.join(", "), problem.error), &help);
    }
}

impl Run<'_> {
    /// What an earlier run of the same has left; what keeps it from being of use is said.
    fn known(&self, header: &Header) -> Result<Findings, Exit> {
        const SHOWN: usize = 10;
        let folder = self.folder.path();
        let resumed = resume(folder, header, &self.experiment.plan, self.found).map_err(broken)?;
        let mut changes = resumed.changes;
        let lacks = self.maps.as_ref().is_some_and(|maps| {
            let mut scored = resumed.known.scored(&self.experiment.plan);
            scored.any(|(named, frame)| !maps.has(named, frame))
        });
        if lacks {
            changes.push(NO_MAPS.to_owned());
        }
        let shown = folder.display();
        if changes.is_empty() {
            let pairs = resumed.known.pairs();
            if pairs > 0 {
                let frames = if pairs == 1 { "1 frame is" } else { &format!("{pairs} frames are") };
                diagnostic::note(&format!("{shown}: {frames} finished; going on from there"));
            }
            return Ok(resumed.known);
        }
        for change in changes.iter().take(SHOWN) {
            diagnostic::warning(&format!("{shown}: {change}"));
        }
        if changes.len() > SHOWN {
            diagnostic::warning(&format!("{shown}: {} more changes", changes.len() - SHOWN));
        }
        diagnostic::warning(&format!("{shown}: what is finished there is not used: all is scored"));
        Ok(Findings::default())
    }

    fn score(
        &self,
        header: &Header,
        known: Findings,
        terminal: &Terminal,
    ) -> Result<Findings, Exit> {
        clear(self.folder).map_err(|error| failed(&error, error.help()))?;
        let plan = &self.experiment.plan;
        let units = fovqa_engine::units(self.found, self.shard);
        let scored =
            Journal::begin(self.folder.path(), header, plan, &known).and_then(|mut journal| {
                let record = &mut |entry: fovqa_engine::Entry<'_>| {
                    self.maps.as_ref().map_or(Ok(()), |maps| maps.write(&entry))?;
                    journal.write(entry)
                };
                let scored =
                    fovqa_engine::score(plan, self.found, &units, known, terminal, record)?;
                if self.shard.is_some() { journal.done().map(|()| scored) } else { Ok(scored) }
            });
        terminal.finish();
        scored.map_err(broken)
    }

    /// Says what could not be scored of a shard, and where it is.
    fn say_shard(&self, shard: Shard, findings: &Findings) -> Exit {
        let plan = &self.experiment.plan;
        for problem in &self.found.problems {
            let scene = &plan.scenes[problem.scene].name;
            let merged = "it will be an error of what is merged";
            diagnostic::warning(&format!("{scene}: {} ({merged})", problem.error));
        }
        let scored = findings.scored(plan).count();
        let failures = say_failures_of_shard(&findings.failures(plan), scored);
        let frames = if scored == 1 { "1 frame" } else { &format!("{scored} frames") };
        diagnostic::note(&format!(
            "{}: shard {shard} of {}, {frames}; `fovqa merge` puts shards together",
            self.folder.path().display(),
            self.experiment.name
        ));
        if failures { Exit::Input } else { Exit::Done }
    }
}

/// Says why a run cannot be.
#[allow(clippy::needless_pass_by_value, reason = "it is the error of a result")]
pub(crate) fn broken(error: EngineError) -> Exit {
    diagnostic::error(&error.to_string(), &Dialect::Experiment.spell(&error.help()));
    if error.is_usage() { Exit::Usage } else { Exit::Input }
}
