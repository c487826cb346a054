//! `fovqa gate`: scores an experiment, or uses the results of a finished run, and checks the rules.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use fovqa::{Against, FALSE_ALARMS, Given, RunOptions, Verdict, text_hash};
use fovqa_report::{
    github_annotations, gitlab_report, junit, markdown, verdict_table, without_commands,
};
use fovqa_results::{State, write_output, write_verdict_json};

use crate::args::{Annotations, GateArgs, GateFormat};
use crate::exit::Exit;
use crate::progress::Terminal;
use crate::{diagnostic, experiment, output, threads};
use fovqa::Dialect;

pub(crate) fn run(args: &GateArgs) -> Exit {
    let gated = if args.calibrate.is_empty() { gate(args) } else { propose(args) };
    gated.unwrap_or_else(|exit| exit)
}

fn gate(args: &GateArgs) -> Result<Exit, Exit> {
    let judged = if args.target.is_dir() { of_folder(args) } else { of_experiment(args) };
    let verdict = match judged {
        Ok(verdict) => verdict,
        Err(exit) => {
            // Files of an earlier gate would say that it holds.
            let why = "the gate was not possible; its messages say why";
            let verdict = Verdict::none(&args.target.display().to_string(), why);
            return Err(exit.or_worse(write_files(args, &verdict)));
        }
    };
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

/// What the run is compared with.
fn against(args: &GateArgs) -> Against {
    Against { baselines: args.baseline.clone(), repeats: args.repeats.clone() }
}

/// The verdict for a finished run.
fn of_folder(args: &GateArgs) -> Result<Verdict, Exit> {
    let options = [
        ("--output", args.output.is_some()),
        ("--frames", args.frames.is_some()),
        ("--maps", args.maps.is_some()),
        ("--threads", args.threads.is_some()),
    ];
    if let Some((option, _)) = options.iter().find(|(_, given)| *given) {
        let folder = args.target.display();
        let message =
            format!("{option} only applies to scoring, but {folder} has already been scored");
        diagnostic::error(&message, "leave it out, or give the experiment file");
        return Err(Exit::Usage);
    }
    let terminal = Terminal::speaking(Dialect::Experiment);
    fovqa::gate_folder(&args.target, &against(args), args.lock.locking(), &terminal)
        .map_err(|error| experiment::failed(&error))
}

/// Scores an experiment and returns the verdict.
fn of_experiment(args: &GateArgs) -> Result<Verdict, Exit> {
    let experiment = experiment::read(&args.target)?;
    threads::started(args.threads)?;
    let options = RunOptions {
        output: args.output.clone(),
        resume: args.resume,
        shard: None,
        frames: args.frames,
        maps: args.maps.clone(),
        locking: args.lock.locking(),
    };
    let terminal = Terminal::speaking(Dialect::Experiment);
    fovqa::gate(experiment, options, &against(args), &Given::default(), &terminal)
        .map_err(|error| experiment::failed(&error))
}

/// Writes each requested file, even if another one cannot be written.
fn write_files(args: &GateArgs, verdict: &Verdict) -> Exit {
    let mut exit = Exit::Done;
    let mut write = |path: &Path, text: &str| {
        if let Err(error) = write_output(path, text.as_bytes()) {
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
                diagnostic::error(&format!("the verdict cannot be written as XML: {error}"), "");
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
            diagnostic::text(&table);
            let report = gitlab_report(verdict, text_hash);
            output::write(|out| out.write_all(report.as_bytes()))
        }
        (Some(Annotations::Github), _) => {
            let text =
                format!("{}{}", without_commands(&table.to_string()), github_annotations(verdict));
            output::write(|out| out.write_all(text.as_bytes()))
        }
        (None, GateFormat::Table) => output::text(&table),
        (None, GateFormat::Json) => output::write(|out| write_verdict_json(verdict, out)),
    }
}

/// Proposes limits from repeated runs, and prints them or writes them into the experiment file.
fn propose(args: &GateArgs) -> Result<Exit, Exit> {
    let failed = |error: fovqa::Error| experiment::failed(&error);
    let mut experiment = experiment::read(&args.target)?;
    experiment.plan.frames = args.frames;
    let rate = args.false_alarms.unwrap_or(FALSE_ALARMS);
    let mut seen = BTreeSet::new();
    let twice = |folder: &&PathBuf| folder.canonicalize().is_ok_and(|real| !seen.insert(real));
    if let Some(folder) = args.calibrate.iter().find(twice) {
        diagnostic::warning(&format!(
            "{}: this run is given twice, and a copy of a run looks like less noise",
            folder.display()
        ));
    }
    let calibration = fovqa::calibrate(&experiment, &args.calibrate, rate).map_err(failed)?;
    if calibration.proposals.iter().all(|proposal| proposal.range == 0.0) {
        diagnostic::warning(
            "the runs are identical to the last digit and do not show how values vary: calibrate with renders \
             that use other seeds",
        );
    }
    diagnostic::note(&format!("limits from {}", calibration.in_words()));
    if !args.write {
        return Ok(output::write(|out| out.write_all(calibration.toml().as_bytes())));
    }
    fovqa::write_limits(&experiment, &calibration).map_err(failed)?;
    let (file, limits) = (args.target.display(), calibration.limits());
    diagnostic::note(&format!("{file}: limits written: {limits}"));
    Ok(Exit::Done)
}
