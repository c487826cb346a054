//! Runs an experiment or one of its shards: finds and scores the frames, and writes results, tables
//! and figures.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use fovqa_engine::{
    Entry, Events, Findings, FoundInputs, Given, Header, Journal, Locking, ResultsFolder, Shard,
    Unit, found_regions, results, resume, units, warn_of_regions,
};
use fovqa_io::sequence::FrameRange;
use fovqa_plan::{Experiment, Eye, TableFormat};
use fovqa_report::Drawn;
use fovqa_results::{HAS_PARQUET, RunResults, table_file};

use crate::crops::Crops;
use crate::error::{Complaint, Error};
use crate::events::Silent;
use crate::finish::{Judge, clear, finish, in_folder, no_space, say_failures_of_shard, text_hash};
use crate::foreseen_figures::foresee_figures_of_run;
use crate::kept_frames::{KeptFrames, check_inputs};
use crate::maps::{MapsFolder, maps_lacking};
use crate::opinions::Opinions;
use crate::pictures::{Pictures, Taking, clear_pictures, no_pictures, take_missing};
use crate::values::write_values_of_shard;

/// How an experiment is run.
#[derive(Debug, Clone, Default)]
pub struct RunOptions {
    /// The folder for the results. `None` stands for `reports/NAME` in the working directory, where
    /// NAME is the name of the experiment, or for `reports/NAME-shard-I-of-N`.
    pub output: Option<PathBuf>,
    /// Whether to continue a run that was interrupted.
    pub resume: bool,
    /// Scores only this shard. [`merge`](crate::merge) combines the shards.
    pub shard: Option<Shard>,
    /// Scores only these frames of each scene.
    pub frames: Option<FrameRange>,
    /// A folder for the maps of each frame.
    pub maps: Option<PathBuf>,
    /// Whether the results folder is locked.
    pub locking: Locking,
}

/// An experiment whose frames were found.
#[derive(Debug)]
pub struct Run {
    experiment: Experiment,
    options: RunOptions,
    found: FoundInputs,
    /// It is made when it is needed, and then kept for all shards: it depends on every frame.
    header: OnceLock<Header>,
}

/// What was scored, in its folder.
struct Scored {
    folder: ResultsFolder,
    findings: Findings,
    pictures: Pictures,
    /// Number of pairs that an earlier run had scored.
    known: usize,
}

/// The result of a run.
#[derive(Debug)]
pub struct Finished {
    /// The results folder.
    pub folder: PathBuf,
    /// Number of frames that were scored.
    pub scored: usize,
    /// Number of pairs of images among them that an earlier run had scored.
    pub known: usize,
    /// Number of items that could not be scored. Each was reported.
    pub errors: usize,
    /// The tables and figures; `None` for a shard, which has no results of its own.
    pub drawn: Option<Drawn>,
}

impl Finished {
    /// States in words where the results are.
    pub fn in_words(&self) -> String {
        let folder = self.folder.display();
        let figures = match self.drawn.as_ref().map_or(0, |drawn| drawn.figures) {
            0 => String::new(),
            1 => ", 1 figure".to_owned(),
            n => format!(", {n} figures"),
        };
        let table = table_file(&self.folder);
        let table = table.file_name().unwrap_or_default().display();
        format!("{folder}: {table}, summary.json{figures}; look at {folder}/report.html")
    }

    /// States in words how many items could not be scored; `None` if everything was scored.
    pub fn errors_in_words(&self) -> Option<String> {
        let errors = match self.errors {
            0 => return None,
            1 => "1 error".to_owned(),
            n => format!("{n} errors"),
        };
        Some(match self.scored {
            0 => format!("{errors}, and nothing was scored"),
            scored => format!("{errors}, but {scored} frames were scored"),
        })
    }
}

impl Run {
    /// Finds the frames of an experiment. Reads names and gaze traces, but no pixels. `given` are
    /// the sources that its plan names but does not contain.
    ///
    /// # Errors
    /// If the request is not possible. Frames that do not exist are not an error yet; the other
    /// frames are still scored.
    pub fn new(experiment: Experiment, options: RunOptions, given: &Given) -> Result<Self, Error> {
        let mut experiment = experiment;
        experiment.plan.frames = options.frames;
        experiment.plan.maps = options.maps.is_some() || !experiment.output.maps.is_empty();
        experiment.plan.pictures = experiment.wanted_pictures();
        let lacking = maps_lacking(experiment.plan.metrics.metrics());
        if let Some(message) = lacking.filter(|_| options.maps.is_some()) {
            return Err(Error::usage(message, "add one of them to [metrics], such as ssim = {}"));
        }
        if experiment.output.tables.contains(&TableFormat::Parquet) && !HAS_PARQUET {
            let message = "this build of fovqa has no support for Parquet".to_owned();
            return Err(Error::usage(
                message,
                "build it with the feature parquet, or write tables = [\"csv\"]",
            ));
        }
        let found = fovqa_engine::find(&experiment.plan, given);
        let run = Self { experiment, options, found, header: OnceLock::new() };
        let wrong = run.found.problems.iter().any(|problem| problem.error.is_usage());
        if wrong { Err(Error::Usage(run.problems())) } else { Ok(run) }
    }

    /// The experiment.
    pub fn experiment(&self) -> &Experiment {
        &self.experiment
    }

    /// The folder that the results will be written to.
    pub fn folder(&self) -> PathBuf {
        self.options.output.clone().unwrap_or_else(|| self.default_folder())
    }

    /// The frames that were found.
    pub fn found(&self) -> &FoundInputs {
        &self.found
    }

    /// The units of work of the run, or of its shard.
    pub fn units(&self) -> Vec<Unit> {
        units(&self.found, self.options.shard)
    }

    /// Errors that concern the inputs as a whole.
    pub fn problems(&self) -> Vec<Complaint> {
        problems(&self.experiment, &self.found)
    }

    /// Checks what would only be noticed after scoring: whether figures can be as the experiment says, and
    /// its table of opinion scores.
    ///
    /// # Errors
    /// If something is wrong with them.
    pub fn foresee(&self, events: &dyn Events) -> Result<(), Error> {
        foresee_figures_of_run(&self.experiment, &self.found, events)?;
        Opinions::read(&self.experiment).map(drop)
    }

    /// Whether scoring a frame reads frames before it: these are read again at the beginning of each shard.
    pub fn reads_frames_before(&self) -> bool {
        self.found.reads_frames_before(&self.experiment.plan)
    }

    /// A hash of everything that shards of one run have in common: the version, the experiment, and the
    /// files that were found.
    pub fn fingerprint(&self) -> String {
        text_hash(&serde_json::to_string(self.header()).unwrap_or_default())
    }

    /// Scores the frames, and writes the results, tables and figures.
    ///
    /// # Errors
    /// If the results or the figures cannot be written. Items that could not be scored are reported
    /// and counted.
    pub fn start(self, events: &dyn Events) -> Result<Finished, Error> {
        self.start_judged(events, &mut |_| Ok(()))
    }

    /// As [`Run::start`]; calls `judge` when the results are written, before the report is made.
    pub(crate) fn start_judged(
        self,
        events: &dyn Events,
        judge: &mut Judge<'_>,
    ) -> Result<Finished, Error> {
        foresee_figures_of_run(&self.experiment, &self.found, events)?;
        if let Some(shard) = self.options.shard {
            for problem in &self.found.problems {
                let scene = &self.experiment.plan.scenes[problem.scene].name;
                let merged = "this will be an error after merging";
                events.warn(&format!("{scene}: {} ({merged})", problem.error));
            }
            return self.score_shard(shard, &self.folder(), self.options.resume, events);
        }
        let Scored { folder, findings, mut pictures, known } =
            self.score(&self.folder(), None, self.options.resume, events)?;
        let path = folder.path().to_owned();
        let (experiment, found) = (&self.experiment, Some(&self.found));
        let taking = Taking { experiment, found, findings: &findings, events };
        take_missing(&taking, folder.path(), &mut pictures);
        // The results name all files that they need, and a long sequence has very many.
        drop(self.found);
        let results = results(&self.experiment.plan, events, findings);
        let scored = scored_frames(&results);
        let (errors, drawn) = finish(&self.experiment, results, &folder, events, judge)?;
        Ok(Finished { folder: path, scored, known, errors, drawn: Some(drawn) })
    }

    /// Scores a shard into a folder, in which [`merge`](crate::merge) finds it, or continues with it. A
    /// program that scores many shards finds their frames once: those in [`RunOptions`] do not matter.
    ///
    /// # Errors
    /// As [`Run::start`].
    pub fn score_shard(
        &self,
        shard: Shard,
        folder: &Path,
        resume: bool,
        events: &dyn Events,
    ) -> Result<Finished, Error> {
        let plan = &self.experiment.plan;
        let Scored { folder, findings, known, .. } =
            self.score(folder, Some(shard), resume, events)?;
        let failures = findings.failures(plan);
        say_failures_of_shard(&failures, events);
        let (scored, errors) = (findings.scored(plan).count(), failures.len());
        // What it has to say, it says again when the shards are merged.
        write_values_of_shard(folder.path(), &results(plan, &Silent, findings))
            .map_err(|error| no_space(&error))?;
        Ok(Finished { folder: folder.path().to_owned(), scored, known, errors, drawn: None })
    }

    /// Scores the frames, or those of a shard, into a folder, as far as they are not known.
    fn score(
        &self,
        folder: &Path,
        shard: Option<Shard>,
        resume: bool,
        events: &dyn Events,
    ) -> Result<Scored, Error> {
        check_inputs(&self.experiment.plan, &self.found, folder)?;
        let opinions = Opinions::read(&self.experiment)?;
        if let Some(opinions) = &opinions {
            opinions.warn(events);
        }
        // The folder is opened before anything is scored, so that a folder that cannot be written
        // to is noticed at once.
        let folder =
            ResultsFolder::open(folder, self.options.locking).map_err(|error| in_folder(&error))?;
        let header = shard.map(|shard| self.header().of_shard(shard));
        let header = header.as_ref().unwrap_or_else(|| self.header());
        let maps = self.maps(folder.path());
        let known =
            if resume { self.known(&folder, header, &maps, events)? } else { Findings::default() };
        let known_pairs = known.pairs();
        warn_of_regions(&self.experiment.plan, &self.found, events);
        let mut pictures = Pictures::new(folder.path(), self.experiment.report.size);
        let units = units(&self.found, shard);
        let findings =
            self.record(&folder, (header, &units, known), (&maps, &mut pictures), events)?;
        if let Some(opinions) = opinions {
            opinions.write(folder.path())?;
        }
        Ok(Scored { folder, findings, pictures, known: known_pairs })
    }

    /// The header of the journal of the whole run.
    fn header(&self) -> &Header {
        self.header.get_or_init(|| {
            Header::new(&self.experiment, &self.found, None).with_maps(self.options.maps.as_deref())
        })
    }

    fn default_folder(&self) -> PathBuf {
        let name = &self.experiment.name;
        Path::new("reports").join(match self.options.shard {
            None => name.clone(),
            Some(shard) => format!("{name}-shard-{}-of-{}", shard.index(), shard.of()),
        })
    }

    /// The folders that maps are written to.
    fn maps(&self, results: &Path) -> Vec<MapsFolder> {
        let asked = self.options.maps.clone().map(|folder| MapsFolder::new(folder, true));
        let kept = &self.experiment.output.maps;
        let kept = (!kept.is_empty()).then(|| MapsFolder::kept(results, kept));
        asked.into_iter().chain(kept).collect()
    }

    /// The findings of an earlier identical run. If they cannot be used, the reason is reported.
    fn known(
        &self,
        folder: &ResultsFolder,
        header: &Header,
        maps: &[MapsFolder],
        events: &dyn Events,
    ) -> Result<Findings, Error> {
        const SHOWN: usize = 10;
        let plan = &self.experiment.plan;
        let resumed = resume(folder.path(), header, plan, &self.found)?;
        let mut changes = resumed.changes;
        let lacks = |maps: &MapsFolder| {
            resumed.known.scored(plan).any(|(named, frame)| !maps.has(named, frame))
        };
        changes.extend(maps.iter().filter(|maps| lacks(maps)).map(MapsFolder::lacking));
        let kept = KeptFrames::new(folder.path());
        if resumed.known.scored(plan).any(|(named, frame)| !kept.has(plan, named, frame)) {
            changes.push("emulated frames that the experiment keeps are missing".to_owned());
        }
        let crops = Crops::new(folder.path());
        if !crops.has(&found_regions(plan, &self.found), resumed.known.scored(plan)) {
            changes.push("regions of frames that figures show are missing".to_owned());
        }
        let shown = folder.path().display();
        if changes.is_empty() {
            let pairs = resumed.known.pairs();
            if pairs > 0 {
                let frames = if pairs == 1 { "1 frame is" } else { &format!("{pairs} frames are") };
                events.note(&format!("{shown}: {frames} finished; continuing from there"));
            }
            return Ok(resumed.known);
        }
        for change in changes.iter().take(SHOWN) {
            events.warn(&format!("{shown}: {change}"));
        }
        if changes.len() > SHOWN {
            events.warn(&format!("{shown}: {} more changes", changes.len() - SHOWN));
        }
        events.warn(&format!(
            "{shown}: its finished frames are not used; everything is scored again"
        ));
        Ok(Findings::default())
    }

    fn record(
        &self,
        folder: &ResultsFolder,
        (header, units, known): (&Header, &[Unit], Findings),
        (maps, pictures): (&[MapsFolder], &mut Pictures),
        events: &dyn Events,
    ) -> Result<Findings, Error> {
        clear(folder)?;
        if known.pairs() == 0 {
            clear_pictures(folder.path());
        }
        let plan = &self.experiment.plan;
        let kept = KeptFrames::new(folder.path());
        let crops = Crops::new(folder.path());
        let mut lost = None;
        let scored = Journal::begin(folder.path(), header, plan, &known).and_then(|mut journal| {
            let record = &mut |entry: Entry<'_>| {
                maps.iter().try_for_each(|maps| maps.write(&entry))?;
                kept.write(&entry)?;
                crops.write(&entry)?;
                journal.write(entry)?;
                // Last, and no reason to end: a picture that cannot be written costs no result.
                if let Err(error) = pictures.write(&entry) {
                    lost.get_or_insert(error);
                }
                Ok(())
            };
            let scored = fovqa_engine::score(plan, &self.found, units, known, events, record)?;
            journal.finish(header, plan, &scored)?;
            Ok(scored)
        });
        events.finish();
        if let Some(error) = lost {
            events.warn(&format!("{error}; {}", no_pictures(folder.path())));
        }
        Ok(scored?)
    }
}

/// Number of frames of a run that were scored, with each eye counted on its own.
pub(crate) fn scored_frames(results: &RunResults) -> usize {
    let own = results.comparisons.iter().filter(|comparison| comparison.eye != "both");
    own.map(|comparison| comparison.report.frames.len()).sum()
}

/// Errors that concern the inputs of an experiment as a whole.
pub fn problems(experiment: &Experiment, found: &FoundInputs) -> Vec<Complaint> {
    let complaint = |problem: &fovqa_engine::Problem| {
        let scene = &experiment.plan.scenes[problem.scene];
        let eye = scene.eyes[problem.eye].eye.map(Eye::name);
        let method = problem.method.map(|method| experiment.plan.methods[method].as_str());
        let place: Vec<&str> =
            [Some(scene.name.as_str()), method, eye].into_iter().flatten().collect();
        let message = format!("{}: {}", place.join(", "), problem.error);
        Complaint { message, help: problem.error.help() }
    };
    found.problems.iter().map(complaint).collect()
}
