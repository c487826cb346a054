//! Carries out the analyses of study files.

use std::fs;
use std::path::{Path, PathBuf};

use fovqa_engine::{Events, Locking, ResultsFolder};
use fovqa_metrics::{Better, Metric};
use fovqa_plan::{StudyAnalysis, StudyFile};
use fovqa_report::{AnsweredAnalysis, DrawnStudy, StudySheet, printed_results};
use fovqa_study::input::Table;
use fovqa_study::{Analysis, Inputs, StudyError};

use crate::error::{Complaint, Error};
use crate::finish::in_folder;
use crate::foreseen_figures::CHANGE;

/// What was made of a study file.
#[derive(Debug)]
pub struct FinishedStudy {
    /// The folder.
    pub folder: PathBuf,
    /// The tables, the results, and the number of figures.
    pub drawn: DrawnStudy,
}

/// Carries out all analyses of a file, and writes results, figures, tables and a page into a folder. The
/// folder is `output`, or `reports/NAME` in the working directory, where NAME is the name in the file.
///
/// # Errors
/// If a table is missing or does not fit, a printed number has no result, or the folder cannot be written
/// to. Earlier results then stay as they are.
pub fn study(
    file: &StudyFile,
    output: Option<&Path>,
    locking: Locking,
    events: &dyn Events,
) -> Result<FinishedStudy, Error> {
    let answers = answers(file)?;
    let folder = output.map_or_else(|| Path::new("reports").join(&file.name), Path::to_owned);
    let folder =
        ResultsFolder::open_for_study(&folder, locking).map_err(|error| in_folder(&error))?;
    let sheet = StudySheet::new(file, &answers);
    if let Some(path) = sheet.foreign(folder.path()) {
        let message =
            format!("{}: fovqa did not write this file, so it is not replaced", path.display());
        return Err(Error::input(message, "move it away, or give another folder with {output}"));
    }
    folder.clear().map_err(|error| in_folder(&error))?;
    let begin = |what: &str, items| events.step(what, items);
    let drawn = sheet.write(folder.path(), &begin).map_err(|error| {
        if error.is_of_settings() {
            Error::usage(error.to_string(), CHANGE)
        } else {
            Error::input(error.to_string(), "free some space, or give another folder with {output}")
        }
    })?;
    for of in &answers {
        if let Some(text) = not_negated(&of.result) {
            events.warn(&format!("{:?}: {}", of.of.name, as_keys(&text)));
        }
    }
    drawn.warnings.iter().for_each(|warning| events.warn(warning));
    Ok(FinishedStudy { folder: folder.path().to_owned(), drawn })
}

/// Which metrics are better if lower but were not said to be, in words; `None` if there are none.
pub fn not_negated(result: &Analysis) -> Option<String> {
    let Analysis::Metrics(document) = result else { return None };
    let metrics = document.groups.first().map(|group| group.result.metrics.as_slice());
    let is_forgotten = |metric: &&fovqa_study::metrics::Metric| {
        let known = Metric::find(&metric.metric);
        !metric.lower_is_better && known.is_some_and(|m| m.info().better == Better::Lower)
    };
    let names: Vec<&str> =
        metrics?.iter().filter(is_forgotten).map(|metric| metric.metric.as_str()).collect();
    (!names.is_empty()).then(|| {
        let names = names.join(",");
        format!("lower scores of {names} are better: name these with --lower-is-better {names}")
    })
}

/// Checks a study file with its tables: all analyses are carried out, and nothing is written.
///
/// # Errors
/// As [`study`], without those of the folder.
pub fn check_study(file: &StudyFile) -> Result<(), Error> {
    answers(file).map(|_| ())
}

fn answers(file: &StudyFile) -> Result<Vec<AnsweredAnalysis<'_>>, Error> {
    // Several analyses often have the same table.
    let mut tables: Vec<(&Path, Table)> = Vec::new();
    for path in file.analyses.iter().flat_map(|of| [&of.table, &of.scores]).flatten() {
        if !tables.iter().any(|(known, _)| known == path) {
            let named = |error| in_study(file, path, error);
            tables.push((path, read_table(path).map_err(named)?));
        }
    }
    let table = |path: Option<&Path>| {
        let known = tables.iter().find(|(known, _)| Some(*known) == path);
        known.map(|(_, table)| table)
    };
    let mut answers = Vec::with_capacity(file.analyses.len());
    for of in &file.analyses {
        let inputs =
            Inputs { table: table(of.table.as_deref()), scores: table(of.scores.as_deref()) };
        let result = of
            .request
            .answer(inputs, &of.selection, &of.settings)
            .map_err(|error| of_analysis(file, of, &error))?;
        let printed = printed_results(&result, &of.printed).map_err(|error| {
            let help = "the place is that in the JSON of the analysis: `fovqa study … --format json` \
                        prints it, and study.json has it as result";
            Error::usage(format!("{}: analysis {:?}: {error}", file.path.display(), of.name), help)
        })?;
        answers.push(AnsweredAnalysis { of, result, printed });
    }
    Ok(answers)
}

/// The error of a table with the study and the analysis that name it.
fn in_study(file: &StudyFile, path: &Path, error: Error) -> Error {
    let names = |of: &&StudyAnalysis| [&of.table, &of.scores].contains(&&Some(path.to_owned()));
    let Some(of) = file.analyses.iter().find(names) else { return error };
    let place = format!("{}: analysis {:?}", file.path.display(), of.name);
    let placed = |complaints: Vec<Complaint>| {
        let one = |of: Complaint| Complaint { message: format!("{place}: {}", of.message), ..of };
        complaints.into_iter().map(one).collect()
    };
    match error {
        Error::Input(complaints) => Error::Input(placed(complaints)),
        Error::Usage(complaints) => Error::Usage(placed(complaints)),
        other => other,
    }
}

/// Reads a CSV table of a study.
///
/// # Errors
/// If it cannot be read.
pub fn read_table(path: &Path) -> Result<Table, Error> {
    let file = path.display().to_string();
    if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml")) {
        let help =
            format!("`fovqa study {file}` carries out a study file; an analysis needs a CSV table");
        return Err(Error::usage(format!("{file} is no CSV table"), help));
    }
    let bytes = fs::read(path).map_err(|error| {
        let help = "check the path; `fovqa study --help` shows what the file has to contain";
        Error::input(format!("{file} cannot be read: {error}"), help)
    })?;
    Table::read(&file, &bytes).map_err(|error| Error::input(error.to_string(), error.help()))
}

fn of_analysis(file: &StudyFile, of: &StudyAnalysis, error: &StudyError) -> Error {
    let place = format!("{}: analysis {:?}", file.path.display(), of.name);
    let message = format!("{place}: {}", as_keys(&error.to_string()));
    let help = as_keys(&error.help());
    if error.is_of_options() { Error::usage(message, help) } else { Error::input(message, help) }
}

/// Options of the command line as keys of a file: `--max-errors` is `max_errors`, and `--column value=NAME`
/// is `column = { value = "NAME" }`.
pub(crate) fn as_keys(text: &str) -> String {
    if let Some((before, option)) = text.split_once("--column ")
        && let Some((role, after)) = option.split_once("=NAME")
    {
        return as_keys(before) + &format!("column = {{ {role} = \"NAME\" }}") + &as_keys(after);
    }
    let mut words: Vec<String> = Vec::new();
    let mut is_value = false;
    for word in text.split(' ') {
        let option = word.strip_prefix("--").map(|option| option.replace('-', "_"));
        let is_option = option.is_some();
        match option {
            Some(option) => words.push(option),
            // Of an option with a word, both are named.
            None if is_value && VALUES.contains(&word) => words.push(format!("= \"{word}\"")),
            None => words.push(word.to_owned()),
        }
        is_value = is_option;
    }
    words.join(" ")
}

/// Words that messages name with their option, such as `--ties drop`.
const VALUES: [&str; 7] =
    ["arithmetic", "drop", "error", "geometric", "half", "logistic", "weibull"];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_become_keys() {
        assert_eq!(
            as_keys("--max-errors needs --validation-expected: a-b"),
            "max_errors needs validation_expected: a-b"
        );
        assert_eq!(as_keys("--by"), "by");
        let ties = as_keys("choose how ties count: --ties drop or --ties half");
        assert_eq!(ties, "choose how ties count: ties = \"drop\" or ties = \"half\"");
        assert_eq!(as_keys("set --start and --lowest to 1"), "set start and lowest to 1");
        assert_eq!(
            as_keys("name it with --column value=NAME; the file has a"),
            "name it with column = { value = \"NAME\" }; the file has a"
        );
    }
}
