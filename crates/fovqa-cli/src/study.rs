//! `fovqa study`: statistics of user studies, of one table by options or of all of a study file.

use std::fs;
use std::path::Path;

use fovqa::StudyFile;
use fovqa_io::read_head;
use fovqa_results::{RUN_JSON, STUDY_JSON, write_json_output};
use fovqa_study::input::{Selection, Table};
use fovqa_study::{Analysis, Inputs};

use crate::args::{Asked, InputArgs, SettingsArgs, StudyArgs, StudyCommand, StudyFormat};
use crate::exit::Exit;
use crate::progress::Terminal;
use crate::{diagnostic, experiment, output, threads};
use fovqa::Dialect;

/// Bytes at the beginning of a file that tell what it is.
const HEAD_BYTES: u64 = 256;

pub(crate) fn run(args: &StudyArgs) -> Exit {
    let outcome = match &args.command {
        Some(command) => one(command),
        None => files(args),
    };
    outcome.unwrap_or_else(|exit| exit)
}

/// Carries out study files. If one of them contains a mistake, nothing is done.
fn files(args: &StudyArgs) -> Result<Exit, Exit> {
    let read: Vec<Result<StudyFile, Exit>> =
        args.files.iter().map(|path| experiment::read_study(path)).collect();
    let files = read.into_iter().collect::<Result<Vec<StudyFile>, Exit>>()?;
    for (index, file) in files.iter().enumerate() {
        if let Some(other) =
            files[..index].iter().find(|other| is_same_folder(&other.name, &file.name))
        {
            let (a, b) = (other.path.display(), file.path.display());
            let name = &file.name;
            let message =
                format!("{a} and {b} have the same name, {name:?}, and would share a folder");
            diagnostic::error(&message, "give each file its own name");
            return Err(Exit::Usage);
        }
    }
    threads::started(args.threads)?;
    let mut outcome = Exit::Done;
    for file in &files {
        let folder = args.output.as_ref();
        let folder = folder.map(|folder| match files.as_slice() {
            [_] => folder.clone(),
            _ => folder.join(&file.name),
        });
        // An error in one file does not prevent the others.
        match carried_out(args, file, folder.as_deref()) {
            Ok(Exit::Done) => {}
            Ok(exit) | Err(exit) => outcome = exit,
        }
    }
    Ok(outcome)
}

/// Whether two names are one folder on some file systems.
fn is_same_folder(a: &str, b: &str) -> bool {
    a.to_lowercase() == b.to_lowercase()
}

/// Carries out all analyses of a study file.
fn carried_out(args: &StudyArgs, file: &StudyFile, folder: Option<&Path>) -> Result<Exit, Exit> {
    let terminal = Terminal::speaking(Dialect::Options);
    let finished = fovqa::study(file, folder, args.lock.locking(), &terminal)
        .map_err(|error| experiment::said(&error, Dialect::Options))?;
    let printed = match args.format {
        StudyFormat::Text => output::text(&finished.drawn.text),
        StudyFormat::Json => output::write(|out| out.write_all(finished.drawn.json.as_bytes())),
    };
    let figures = match finished.drawn.figures {
        1 => "1 figure".to_owned(),
        count => format!("{count} figures"),
    };
    let shown = finished.folder.display();
    diagnostic::note(&format!("{shown}: {STUDY_JSON}, {figures}; look at {shown}/index.html"));
    Ok(printed)
}

/// Carries out one analysis, and shows it.
fn one(command: &StudyCommand) -> Result<Exit, Exit> {
    let Asked { request, input, scores, settings } = command.asked();
    threads::started(settings.threads)?;
    let table = input.map(|input| read(&input.file)).transpose()?;
    let scores = scores.map(|path| read(&path)).transpose()?;
    let selection = input.map_or_else(Selection::default, InputArgs::selection);
    let inputs = Inputs { table: table.as_ref(), scores: scores.as_ref() };
    let analysis = request.answer(inputs, &selection, &settings.settings()).map_err(|error| {
        diagnostic::error(&error.to_string(), &diagnostic::shown(&error.help()));
        if error.is_of_options() { Exit::Usage } else { Exit::Input }
    })?;
    if let Some(text) = fovqa::not_negated(&analysis) {
        diagnostic::warning(&text);
    }
    show(&analysis, settings)
}

/// Reads a CSV table.
fn read(path: &Path) -> Result<Table, Exit> {
    fovqa::read_table(path).map_err(|error| experiment::said(&error, Dialect::Options))
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
        StudyFormat::Text => output::text(&fovqa_report::study_text(analysis)),
    })
}

fn write(analysis: &Analysis, folder: &Path) -> Result<(), Exit> {
    let help = "choose another folder with --output";
    fs::create_dir_all(folder).map_err(|error| {
        let message = format!("{} cannot be created: {error}", folder.display());
        diagnostic::error(&message, help);
        Exit::Input
    })?;
    let path = folder.join(STUDY_JSON);
    // The study of a run or of a study file belongs to their pages.
    let head = read_head(&path, HEAD_BYTES).unwrap_or_default();
    let is_ours = String::from_utf8_lossy(&head).contains("\"fovqa.study/1\"");
    if path.exists() && (!is_ours || folder.join(RUN_JSON).exists()) {
        let message = format!("{}: a single analysis did not write this file", path.display());
        diagnostic::error(&message, help);
        return Err(Exit::Input);
    }
    write_json_output(&path, analysis).map_err(|error| {
        diagnostic::error(&error.to_string(), help);
        Exit::Input
    })
}
