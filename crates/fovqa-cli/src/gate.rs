//! `fovqa gate`: score, or take what was scored, and hold the rules against it.

use std::path::Path;

use fovqa_plan::{GateRule, Resolved};
use fovqa_report::{github_annotations, gitlab_report, junit, markdown, verdict_table};
use fovqa_results::{
    Baseline, Lacking, State, Verdict, calibrate, write_verdict_json, write_whole,
};

use crate::args::{Annotations, GateArgs, GateFormat, RunArgs};
use crate::diagnostic;
use crate::exit::Exit;
use crate::finished_run::FinishedRun;
use crate::results::{Shown, text_hash};
use crate::run::{say_problems, scored};
use crate::{experiment, output};

pub(crate) fn run(args: &GateArgs) -> Exit {
    let gated = if args.calibrate.is_empty() { gate(args) } else { propose(args) };
    gated.unwrap_or_else(|exit| exit)
}

fn gate(args: &GateArgs) -> Result<Exit, Exit> {
    let (finished, baseline) =
        if args.target.is_dir() { of_folder(args)? } else { of_experiment(args)? };
    let rules = &finished.record.resolved.gates;
    let file = if args.target.is_dir() {
        finished.record.experiment.file.clone()
    } else {
        args.target.display().to_string()
    };
    let names = (finished.record.resolved.name.as_str(), file.as_str());
    let mut verdict = Verdict::of(names, rules, &finished.values, baseline.as_ref());
    if let Some(baseline) = &baseline {
        let other = baseline.other_inputs(&finished.record, &text_hash).into_iter();
        verdict.notes.extend(other.map(|folder| {
            let folder = if folder.is_empty() { ".".to_owned() } else { folder };
            format!("the inputs in {folder} are others than those of the baseline")
        }));
    }
    let printed = print(args, &verdict);
    let written = write_files(args, &verdict);
    let judged = match verdict.state() {
        State::Passed => Exit::Done,
        State::Failed => Exit::Gate,
        State::NotScored => Exit::Input,
        State::Wrong => Exit::Usage,
    };
    Ok(judged.or_worse(printed).or_worse(written))
}

/// A run that is finished, and the baseline it is held against.
fn of_folder(args: &GateArgs) -> Result<(FinishedRun, Option<Baseline>), Exit> {
    let options = [
        ("--output", args.output.is_some()),
        ("--frames", args.frames.is_some()),
        ("--maps", args.maps.is_some()),
        ("--threads", args.threads.is_some()),
    ];
    if let Some((option, _)) = options.iter().find(|(_, given)| *given) {
        let folder = args.target.display();
        let message = format!("{option} is of scoring, and {folder} has been scored");
        diagnostic::error(&message, "leave it out, or give the experiment file");
        return Err(Exit::Usage);
    }
    let finished = FinishedRun::read(&args.target)?;
    let resolved = &finished.record.resolved;
    let file = args.target.join(&finished.record.experiment.file);
    check(&resolved.gates, &file, args)?;
    let baseline = fitting(args, resolved)?;
    Ok((finished, baseline))
}

/// An experiment, scored. What is wrong with it comes before what cannot be read.
fn of_experiment(args: &GateArgs) -> Result<(FinishedRun, Option<Baseline>), Exit> {
    let experiment = experiment::read(&args.target)?;
    check(&experiment.gates, &args.target, args)?;
    let mut resolved = experiment.resolved();
    resolved.frames = args.frames.map(|frames| frames.to_string());
    let found = args
        .baseline
        .as_ref()
        .map(|_| fovqa_engine::find(&experiment.plan, &fovqa_engine::Given::default()));
    if let Some(found) = found.filter(|f| f.problems.iter().any(|p| p.error.is_usage())) {
        say_problems(&experiment, &found);
        return Err(Exit::Usage);
    }
    // Before anything is scored.
    let baseline = fitting(args, &resolved)?;
    Ok((score(args)?, baseline))
}

/// Whether there are rules, and what they need.
fn check(rules: &[GateRule], file: &Path, args: &GateArgs) -> Result<(), Exit> {
    let file = file.display();
    if rules.is_empty() {
        let message = format!("{file}: there is no [[gate]] in it, and no rule is no pass");
        diagnostic::error(&message, "write a rule, such as metric = \"psnr\" with at_least = 30");
        return Err(Exit::Usage);
    }
    if let Some(rule) = rules.iter().find(|rule| rule.needs_baseline())
        && args.baseline.is_none()
    {
        let message = format!("{file}:{}: {} is held against a baseline", rule.line, rule.quantity);
        diagnostic::error(&message, "give it with --baseline; `fovqa baseline save` makes one");
        return Err(Exit::Usage);
    }
    Ok(())
}

/// The baseline, where one is given, if it is of what is scored.
fn fitting(args: &GateArgs, run: &Resolved) -> Result<Option<Baseline>, Exit> {
    let Some(path) = args.baseline.as_deref() else { return Ok(None) };
    let baseline = Baseline::read(path).map_err(|error| {
        diagnostic::error(&error.to_string(), "`fovqa baseline save` makes one of a run");
        Exit::Input
    })?;
    let Some(why) = baseline.refuses(run) else { return Ok(Some(baseline)) };
    let file = path.display();
    let message = format!("{file}: the baseline is of values that were taken otherwise: {why}");
    diagnostic::error(&message, "run the experiment, look at it, and `fovqa baseline accept` it");
    Err(Exit::Input)
}

/// Scores the experiment.
fn score(args: &GateArgs) -> Result<FinishedRun, Exit> {
    let run = RunArgs {
        experiment: args.target.clone(),
        output: args.output.clone(),
        resume: args.resume,
        shard: None,
        frames: args.frames,
        maps: args.maps.clone(),
        threads: args.threads,
        lock: args.lock.clone(),
    };
    match scored(&run, Shown::Nothing) {
        (Some(folder), Exit::Done | Exit::Input) => FinishedRun::read(&folder),
        (_, exit) => Err(exit),
    }
}

/// Each file that is asked for, whatever becomes of the others.
fn write_files(args: &GateArgs, verdict: &Verdict) -> Exit {
    let mut exit = Exit::Done;
    let mut write = |path: &Path, text: &str| {
        if let Err(error) = write_whole(path, text.as_bytes()) {
            diagnostic::error(&error.to_string(), "give another file");
            exit = exit.or_worse(Exit::Input);
        }
    };
    if let Some(path) = args.markdown.as_deref() {
        write(path, &markdown(verdict));
    }
    if let Some(path) = args.junit.as_deref() {
        match junit(verdict) {
            Ok(xml) => write(path, &xml),
            Err(error) => {
                diagnostic::error(&format!("the verdict is no XML: {error}"), "");
                exit = Exit::Bug;
            }
        }
    }
    exit
}

fn print(args: &GateArgs, verdict: &Verdict) -> Exit {
    let table = verdict_table(verdict);
    match (args.annotations, args.format) {
        (Some(Annotations::Gitlab), _) => {
            diagnostic::block(&table);
            let report = gitlab_report(verdict, text_hash);
            output::write(|out| out.write_all(report.as_bytes()))
        }
        (Some(Annotations::Github), _) => {
            let text = format!("{table}{}", github_annotations(verdict));
            output::write(|out| out.write_all(text.as_bytes()))
        }
        (None, GateFormat::Table) => output::write(|out| out.write_all(table.as_bytes())),
        (None, GateFormat::Json) => output::write(|out| write_verdict_json(verdict, out)),
    }
}

/// Prints limits that come from repeated runs.
fn propose(args: &GateArgs) -> Result<Exit, Exit> {
    let experiment = experiment::read(&args.target)?;
    if experiment.gates.is_empty() {
        let message = format!("{}: there is no [[gate]] in it", args.target.display());
        let help = "name what is to be limited: [[gate]] with a metric, and any limit";
        diagnostic::error(&message, help);
        return Err(Exit::Usage);
    }
    if args.calibrate.len() < 2 {
        let message = "one run alone says nothing of how values vary";
        diagnostic::error(message, "give the folders of several runs of one build");
        return Err(Exit::Usage);
    }
    let mut resolved = experiment.resolved();
    resolved.frames = args.frames.map(|frames| frames.to_string());
    let mut runs = Vec::new();
    for folder in &args.calibrate {
        let run = FinishedRun::read(folder)?;
        let other = run.record.resolved.differs(&resolved);
        if let Some(why) = other.or_else(|| run.values.errors.first().cloned()) {
            let message = format!("{}: no limits come of it: {why}", folder.display());
            diagnostic::error(&message, "run the experiment again");
            return Err(Exit::Input);
        }
        runs.push((folder.display().to_string(), run.values));
    }
    let calibration = calibrate(&experiment.gates, &runs).map_err(|lacking| {
        diagnostic::error(&lacking.to_string(), "mend the rule, or run the experiment again");
        if matches!(lacking, Lacking::Band(_)) { Exit::Usage } else { Exit::Input }
    })?;
    if calibration.proposals.is_empty() {
        diagnostic::error("the runs have nothing that the rules are of", "check the rules");
        return Err(Exit::Input);
    }
    if calibration.proposals.iter().all(|proposal| proposal.spread() == 0.0) {
        diagnostic::warning(
            "the runs are the same to the last digit, and say nothing of how values vary: calibrate with renders of other seeds",
        );
    }
    Ok(output::write(|out| out.write_all(calibration.toml().as_bytes())))
}
