//! `fovqa study`: statistics of user studies.

use std::fs;
use std::path::Path;

use fovqa_results::write_json_output;
use fovqa_study::input::{Data, Selection, Table};
use fovqa_study::{
    Analysis, Settings, StudyError, anova, metrics, pairs, plan, psychometric, ranks, ratings,
    staircase,
};

use crate::args::{InputArgs, PlanCommand, SettingsArgs, StudyCommand, StudyFormat};
use crate::exit::Exit;
use crate::{diagnostic, output, threads};

pub(crate) fn run(command: &StudyCommand) -> Exit {
    analysed(command).unwrap_or_else(|exit| exit)
}

fn analysed(command: &StudyCommand) -> Result<Exit, Exit> {
    match command {
        StudyCommand::Pairs(args) => of_table(&args.input, &args.settings, |data, settings| {
            let options = pairs::Options {
                ties: args.ties,
                order: args.order.clone(),
                reference: args.reference.clone(),
                pseudo_votes: args.pseudo_votes,
            };
            pairs::pairs(data, &options, settings).map(Analysis::Pairs)
        }),
        StudyCommand::Ranks(args) => of_table(&args.input, &args.settings, |data, settings| {
            let options = ranks::Options {
                unit: args.unit.clone(),
                pairwise: args.pairwise,
                ties: args.ties,
                order: args.order.clone(),
            };
            ranks::ranks(data, &options, settings).map(Analysis::Ranks)
        }),
        StudyCommand::Anova(args) => of_table(&args.input, &args.settings, |data, settings| {
            anova::anova(data, &args.within, settings).map(Analysis::Anova)
        }),
        StudyCommand::Psychometric(args) => {
            of_table(&args.input, &args.settings, |data, settings| {
                let options = args.options();
                psychometric::psychometric(data, &options, settings).map(Analysis::Psychometric)
            })
        }
        StudyCommand::Staircase(args) => of_table(&args.input, &args.settings, |data, settings| {
            let options = args.threshold.options();
            staircase::staircase(data, &options, settings).map(Analysis::Staircase)
        }),
        StudyCommand::Ratings(args) => of_table(&args.input, &args.settings, |data, settings| {
            ratings::ratings(data, &args.options(), settings).map(Analysis::Ratings)
        }),
        StudyCommand::Metrics(args) => {
            let scores = read(&args.scores)?;
            of_table(&args.input, &args.settings, |data, settings| {
                metrics::metrics(data, &scores, &args.options(), settings).map(Analysis::Metrics)
            })
        }
        StudyCommand::Plan(PlanCommand::Pairs(args)) => planned(&args.settings, |settings| {
            Ok(Analysis::PlanPairs(plan::plan_pairs(&args.options(), settings)))
        }),
        StudyCommand::Plan(PlanCommand::Staircase(args)) => planned(&args.settings, |settings| {
            plan::plan_staircase(&args.options(), settings).map(Analysis::PlanStaircase)
        }),
    }
}

/// Computes a plan, which needs no table, and shows it.
fn planned(
    settings: &SettingsArgs,
    compute: impl FnOnce(&Settings) -> Result<Analysis, StudyError>,
) -> Result<Exit, Exit> {
    threads::started(settings.threads)?;
    show(&compute(&settings.settings()).map_err(|error| wrong(&error))?, settings)
}

/// Reads the table, computes the result of its selected rows, and shows it.
fn of_table(
    input: &InputArgs,
    settings: &SettingsArgs,
    compute: impl FnOnce(&Data, &Settings) -> Result<Analysis, StudyError>,
) -> Result<Exit, Exit> {
    threads::started(settings.threads)?;
    let table = read(&input.file)?;
    let selection: Selection = input.selection();
    let analysis =
        Data::new(&table, &selection).and_then(|data| compute(&data, &settings.settings()));
    show(&analysis.map_err(|error| wrong(&error))?, settings)
}

/// Reads a CSV table.
fn read(path: &Path) -> Result<Table, Exit> {
    let file = path.display().to_string();
    let bytes = fs::read(path).map_err(|error| {
        let help = "check the path; `fovqa study --help` shows what the file has to contain";
        diagnostic::error(&format!("{file} cannot be read: {error}"), help);
        Exit::Input
    })?;
    Table::read(&file, &bytes).map_err(|error| wrong(&error))
}

fn wrong(error: &StudyError) -> Exit {
    diagnostic::error(&error.to_string(), &diagnostic::shown(&error.help()));
    Exit::Input
}

/// Prints a result, and writes it to the folder of `--output`.
fn show(analysis: &Analysis, settings: &SettingsArgs) -> Result<Exit, Exit> {
    if let Some(folder) = &settings.output {
        write(analysis, folder)?;
    }
    Ok(match settings.format {
        StudyFormat::Json => output::write(|out| {
            serde_json::to_writer_pretty(&mut *out, analysis)?;
            out.write_all(b"\n")
        }),
        StudyFormat::Text => {
            let text = fovqa_report::study_text(analysis);
            output::write(|out| out.write_all(text.as_bytes()))
        }
    })
}

fn write(analysis: &Analysis, folder: &Path) -> Result<(), Exit> {
    let help = "choose another folder with --output";
    fs::create_dir_all(folder).map_err(|error| {
        let message = format!("{} cannot be created: {error}", folder.display());
        diagnostic::error(&message, help);
        Exit::Input
    })?;
    write_json_output(&folder.join("study.json"), analysis).map_err(|error| {
        diagnostic::error(&error.to_string(), help);
        Exit::Input
    })
}
