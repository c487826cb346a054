//! `fovqa gate`: score, or take what was scored, and hold the rules against it.

use std::path::Path;

use fovqa_config::{Experiment, GateRule};
use fovqa_report::{github_annotations, gitlab_report, junit, markdown, verdict_table};
use fovqa_results::{Baseline, State, Verdict, calibrate, write_verdict_json, write_whole};

use crate::args::{Annotations, GateArgs, GateFormat, RunArgs};
use crate::diagnostic;
use crate::exit::Exit;
use crate::finished_run::FinishedRun;
use crate::results::{Shown, text_hash};
use crate::run::scored;
use crate::{experiment, output};

pub(crate) fn run(args: &GateArgs) -> Exit {
    let gated = if args.calibrate.is_empty() { gate(args) } else { propose(args) };
    gated.unwrap_or_else(|exit| exit)
}

fn gate(args: &GateArgs) -> Result<Exit, Exit> {
    let baseline = args.baseline.as_deref().map(baseline).transpose()?;
    let finished = if args.target.is_dir() {
        let finished = FinishedRun::read(&args.target)?;
        check(&finished.record.resolved.gates, &args.target, baseline.as_ref())?;
        finished
    } else {
        let experiment = experiment::read(&args.target)?;
        check(&experiment.gates, &args.target, baseline.as_ref())?;
        // Before anything is scored.
        fits(baseline.as_ref(), args, &experiment)?;
        score(args)?
    };
    if let Some(baseline) = &baseline {
        refused(baseline.refuses(&finished.record.resolved), args)?;
    }
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
    write_files(args, &verdict)?;
    let printed = print(args, &verdict);
    Ok(match verdict.state() {
        State::Passed => printed,
        State::Failed => Exit::Gate,
        State::NotScored => Exit::Input,
        State::Wrong => Exit::Usage,
    })
}

/// Whether there are rules, and what they need.
fn check(rules: &[GateRule], target: &Path, baseline: Option<&Baseline>) -> Result<(), Exit> {
    let target = target.display();
    if rules.is_empty() {
        let message = format!("{target}: there is no [[gate]] in it, and no rule is no pass");
        diagnostic::error(&message, "write a rule, such as metric = \"psnr\" with at_least = 30");
        return Err(Exit::Usage);
    }
    if let Some(rule) = rules.iter().find(|rule| rule.needs_baseline())
        && baseline.is_none()
    {
        let message =
            format!("{target}:{}: {} is held against a baseline", rule.line, rule.quantity);
        diagnostic::error(&message, "give it with --baseline; `fovqa baseline save` makes one");
        return Err(Exit::Usage);
    }
    Ok(())
}

fn baseline(path: &Path) -> Result<Baseline, Exit> {
    Baseline::read(path).map_err(|error| {
        diagnostic::error(&error.to_string(), "`fovqa baseline save` makes one of a run");
        Exit::Input
    })
}

fn fits(baseline: Option<&Baseline>, args: &GateArgs, experiment: &Experiment) -> Result<(), Exit> {
    let Some(baseline) = baseline else { return Ok(()) };
    let mut resolved = experiment.resolved();
    resolved.frames = args.frames.map(|frames| frames.to_string());
    refused(baseline.refuses(&resolved), args)
}

fn refused(why: Option<String>, args: &GateArgs) -> Result<(), Exit> {
    let Some(why) = why else { return Ok(()) };
    let file = args.baseline.as_deref().unwrap_or(Path::new("")).display();
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
        maps: None,
        threads: args.threads,
    };
    match scored(&run, Shown::Nothing) {
        (Some(folder), Exit::Done | Exit::Input) => FinishedRun::read(&folder),
        (_, exit) => Err(exit),
    }
}

fn write_files(args: &GateArgs, verdict: &Verdict) -> Result<(), Exit> {
    let xml = || {
        junit(verdict).map_err(|error| {
            diagnostic::error(&format!("the verdict is no XML: {error}"), "");
            Exit::Bug
        })
    };
    let files = [
        args.junit.as_deref().map(|path| Ok((path, xml()?))),
        args.markdown.as_deref().map(|path| Ok((path, markdown(verdict)))),
    ];
    for file in files.into_iter().flatten() {
        let (path, text) = file?;
        write_whole(path, text.as_bytes()).map_err(|error| {
            diagnostic::error(&error.to_string(), "give another file");
            Exit::Input
        })?;
    }
    Ok(())
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
    let mut runs = Vec::new();
    for folder in &args.calibrate {
        let run = FinishedRun::read(folder)?;
        let other = run.record.resolved.metrics != experiment.resolved().metrics;
        if other || !run.values.errors.is_empty() {
            let why = run.values.errors.first().map_or("it is of other metrics", String::as_str);
            let message = format!("{}: no limits come of it: {why}", folder.display());
            diagnostic::error(&message, "run the experiment again");
            return Err(Exit::Input);
        }
        runs.push(run.values);
    }
    let calibration = calibrate(&experiment.gates, &runs).map_err(|why| {
        diagnostic::error(&why, "run the experiment again");
        Exit::Input
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
