//! Errors of the library as exceptions of the package, with the same words.

use fovqa::{Complaint, Dialect, Error, ExperimentError, Fault};
use pyo3::prelude::*;

use crate::document::working_folder;

mod exceptions {
    //! The exceptions, which are defined in Python.
    pyo3::import_exception!(fovqa._errors, FovqaError);
    pyo3::import_exception!(fovqa._errors, RequestError);
    pyo3::import_exception!(fovqa._errors, ExperimentError);
    pyo3::import_exception!(fovqa._errors, InputError);
}

/// The name of the file that the arguments of a function stand for. It is never shown.
pub(crate) const ARGUMENTS: &str = "(arguments)";

/// The name of the file that a table with the keys of a file stands for. It is never shown.
pub(crate) const TABLE: &str = "(table)";

/// The exception for an error of the library, whose settings are spelled in `dialect`.
pub(crate) fn exception(error: &Error, dialect: Dialect) -> PyErr {
    let spell = |text: &str| in_python(&dialect.spell(text));
    let spelled = |of: &Complaint| (spell(&of.message), spell(&of.help));
    match error {
        Error::Experiment(error) => of_experiment(error),
        Error::Usage(complaints) => request(complaints.iter().map(spelled).collect()),
        Error::Input(complaints) => {
            exceptions::InputError::new_err((complaints.iter().map(spelled).collect::<Vec<_>>(),))
        }
        other => exceptions::FovqaError::new_err((vec![(other.to_string(), String::new())],)),
    }
}

/// The exception for a request that is not possible: messages, each with how to mend it.
fn request(complaints: Vec<(String, String)>) -> PyErr {
    exceptions::RequestError::new_err((complaints,))
}

/// The exception for one mistake in a request.
pub(crate) fn wrong_request(message: impl Into<String>, help: impl Into<String>) -> PyErr {
    request(vec![(message.into(), help.into())])
}

/// The exception for an input that does not fit.
pub(crate) fn wrong_input(message: impl Into<String>, help: impl Into<String>) -> PyErr {
    exceptions::InputError::new_err((vec![(message.into(), help.into())],))
}

/// The exception for a bug.
pub(crate) fn bug(what: &str) -> PyErr {
    let message = format!("fovqa has a bug: {what}");
    let help = "please report it with the call and, if you can, the input".to_owned();
    exceptions::FovqaError::new_err((vec![(message, help)],))
}

fn of_experiment(error: &ExperimentError) -> PyErr {
    let (path, text, faults) = match error {
        ExperimentError::Unreadable { .. } => {
            let help = "give a TOML file, in UTF-8".to_owned();
            return exceptions::ExperimentError::new_err((vec![(error.to_string(), help)],));
        }
        ExperimentError::Faults { path, text, faults } => (path, text, faults),
    };
    let is_named = |name: &str| path.file_name().is_some_and(|file| file == name);
    let is_file = !is_named(ARGUMENTS) && !is_named(TABLE);
    let place = |fault: &Fault| {
        let has_place = is_file && !(fault.span.is_empty() && fault.span.start == 0);
        let (line, column) = line_and_column(text, fault.span.start);
        match (is_file, has_place) {
            (false, _) => String::new(),
            (true, false) => format!("{}: ", path.display()),
            (true, true) => format!("{}:{line}:{column}: ", path.display()),
        }
    };
    let complaint = |fault: &Fault| {
        let label = if fault.label.is_empty() { "" } else { "; " };
        let message = format!("{}{}{label}{}", place(fault), fault.message, fault.label);
        let help = in_python(&fault.help);
        if is_named(ARGUMENTS) {
            (as_arguments(&message), as_arguments(&help))
        } else if is_named(TABLE) {
            (message, as_list(&help))
        } else {
            (message, help)
        }
    };
    let complaints: Vec<_> = faults.iter().map(complaint).collect();
    if is_file { exceptions::ExperimentError::new_err((complaints,)) } else { request(complaints) }
}

/// The text for Python: without the name of a file that does not exist, and without options of the command.
fn in_python(text: &str) -> String {
    const WORDS: [(&str, &str); 8] = [
        ("--output", "output"),
        ("--resume", "resume=True"),
        ("--maps", "maps"),
        (" (or --frames A..B)", ""),
        ("`fovqa list metrics`", "fovqa.metrics()"),
        ("`fovqa list methods`", "fovqa.methods()"),
        ("`fovqa list displays`", "fovqa.displays()"),
        ("luminance = \"htc-vive-pro\" in [view]", "luminance=\"htc-vive-pro\" in view"),
    ];
    let path = working_folder().join(TABLE);
    let text = text.replace(&format!("{}: ", path.display()), "");
    WORDS.iter().fold(text, |text, (word, python)| text.replace(word, python))
}

/// The text for a caller who gives a dict: entries of TOML are a list of dicts.
fn as_list(text: &str) -> String {
    match text
        .strip_prefix("write [[")
        .and_then(|text| text.split_once("]] above the keys of each entry"))
    {
        Some((_, rest)) => format!("give a list of dicts{rest}"),
        None => text.to_owned(),
    }
}

/// The text for a caller whose arguments are the keys of the only scene and the only method.
fn as_arguments(text: &str) -> String {
    const WORDS: [(&str, &str); 9] = [
        ("method \"test\".emulate.", ""),
        ("method \"test\": ", ""),
        ("method \"test\".", ""),
        ("scene \"scene\".", ""),
        ("scene \"scene\"", "it"),
        (
            "give one in [view], such as display = \"vive-pro-eye\" or fov_vertical_deg = 100",
            "give view=\"vive-pro-eye\" or another display, or view={\"fov_vertical_deg\": 100}",
        ),
        (
            "give one in [view], such as fov_vertical_deg = 110 or display = \"vive-pro-eye\"",
            "give view=\"vive-pro-eye\" or another display, or view={\"fov_vertical_deg\": 110}",
        ),
        ("add resolution = \"1440x1600\" to the scene", "give resolution=(1440, 1600)"),
        ("[metrics] has", "metrics have"),
    ];
    WORDS.iter().fold(text.to_owned(), |text, (key, argument)| text.replace(key, argument))
}

/// Line and column of a place in a text, both counted from 1.
fn line_and_column(text: &str, at: usize) -> (usize, usize) {
    let before = text.get(..at).unwrap_or(text);
    let line = before.matches('\n').count() + 1;
    (line, before.rsplit('\n').next().unwrap_or_default().chars().count() + 1)
}
