//! Tables from Python as the text of a TOML file, so that they have the keys, the checks and the messages of
//! an experiment file.

use std::path::{Path, PathBuf};

use fovqa::{CurvesFile, Dialect, Error, Experiment, StudyFile};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyString, PyTuple};
use toml::{Table, Value};

use crate::error::{ARGUMENTS, TABLE, exception, wrong_request};

/// Maximum number of values in an array of a table.
const LONGEST_LIST: usize = 10_000;

/// The depth at which a value refers to itself.
const DEEPEST: usize = 32;

/// A file, or a table with the keys of a file.
pub(crate) enum Document {
    File(PathBuf),
    Table { path: PathBuf, text: String },
}

impl Document {
    /// The arguments of a function, as a dictionary with the keys of a file.
    pub(crate) fn arguments(table: &Bound<'_, PyDict>) -> PyResult<Self> {
        Ok(Self::Table { path: working_folder().join(ARGUMENTS), text: text(table)? })
    }

    /// The text of a file that another process has read.
    pub(crate) fn of_text(path: PathBuf, text: String) -> Self {
        Self::Table { path, text }
    }

    /// A path to a file, or a dictionary with its keys.
    pub(crate) fn of(given: &Bound<'_, PyAny>) -> PyResult<Self> {
        if let Ok(table) = given.cast::<PyDict>() {
            let path = working_folder().join(TABLE);
            return Ok(Self::Table { path, text: text(table)? });
        }
        match given.extract::<PathBuf>() {
            Ok(path) => Ok(Self::File(path)),
            Err(_) => Err(PyTypeError::new_err(format!(
                "give the path of a TOML file or a dict with its keys, not {}",
                type_name(given)
            ))),
        }
    }

    pub(crate) fn experiment(self) -> PyResult<Experiment> {
        self.read(fovqa::read_experiment, fovqa::parse_experiment)
    }

    pub(crate) fn curves(self) -> PyResult<CurvesFile> {
        self.read(fovqa::read_curves, fovqa::parse_curves)
    }

    pub(crate) fn study(self) -> PyResult<StudyFile> {
        self.read(fovqa::read_study, |path, text| fovqa::parse_study(path, &text))
    }

    fn read<T>(
        self,
        file: impl FnOnce(&Path) -> Result<T, Error>,
        table: impl FnOnce(&Path, String) -> Result<T, Error>,
    ) -> PyResult<T> {
        let read = match self {
            Self::File(path) => file(&path),
            Self::Table { path, text } => table(&path, text),
        };
        read.map_err(|error| exception(&error, Dialect::Experiment))
    }
}

/// The working directory.
pub(crate) fn working_folder() -> PathBuf {
    std::env::current_dir().unwrap_or_default()
}

/// The text of a TOML file with the values of a dictionary.
fn text(table: &Bound<'_, PyDict>) -> PyResult<String> {
    let table = of_table(table, "", 0)?;
    toml::to_string(&table)
        .map_err(|error| wrong_request(format!("the table cannot be written as TOML: {error}"), ""))
}

fn of_table(table: &Bound<'_, PyDict>, at: &str, depth: usize) -> PyResult<Table> {
    let mut values = Table::new();
    for (key, value) in table {
        // What is None is as if it were not given.
        if value.is_none() {
            continue;
        }
        let key: String = key.extract().map_err(|_| {
            PyTypeError::new_err(format!("{at}: keys are texts, not {}", type_name(&key)))
        })?;
        let at = if at.is_empty() { key.clone() } else { format!("{at}.{key}") };
        values.insert(key, of_value(&value, &at, depth + 1)?);
    }
    Ok(values)
}

fn of_value(value: &Bound<'_, PyAny>, at: &str, depth: usize) -> PyResult<Value> {
    if depth > DEEPEST {
        return Err(wrong_request(format!("{at}: the values are nested too deeply"), ""));
    }
    let of_items = |items: Vec<Bound<'_, PyAny>>| -> PyResult<Value> {
        items
            .iter()
            .map(|item| of_value(item, at, depth + 1))
            .collect::<PyResult<_>>()
            .map(Value::Array)
    };
    if let Ok(flag) = value.cast::<PyBool>() {
        return Ok(Value::Boolean(flag.is_true()));
    }
    if value.is_instance_of::<PyInt>() {
        return whole(value, at);
    }
    if let Ok(number) = value.cast::<PyFloat>() {
        return Ok(Value::Float(number.value()));
    }
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(Value::String(text.extract()?));
    }
    if let Ok(table) = value.cast::<PyDict>() {
        return of_table(table, at, depth).map(Value::Table);
    }
    if let Ok(list) = value.cast::<PyList>() {
        return of_items(list.iter().collect());
    }
    if let Ok(tuple) = value.cast::<PyTuple>() {
        return of_items(tuple.iter().collect());
    }
    // Numbers and arrays of numpy.
    if value.hasattr("tolist")? {
        let size = value.getattr("size").and_then(|size| size.extract::<usize>());
        if size.is_ok_and(|size| size > LONGEST_LIST) {
            return Err(wrong_request(
                format!("{at} is a large array, but it is written into a table"),
                "frames are given to fovqa.score and fovqa.foveate, or are files that the table names",
            ));
        }
        return of_value(&value.call_method0("tolist")?, at, depth + 1);
    }
    if value.hasattr("__index__")? {
        return whole(&value.call_method0("__index__")?, at);
    }
    if value.hasattr("__fspath__")? {
        return Ok(Value::String(value.call_method0("__fspath__")?.extract()?));
    }
    Err(PyTypeError::new_err(format!(
        "{at} is {}; give a number, a text, True or False, a list or a dict",
        type_name(value)
    )))
}

fn whole(value: &Bound<'_, PyAny>, at: &str) -> PyResult<Value> {
    let number: i64 = value
        .extract()
        .map_err(|_| wrong_request(format!("{at}: {value} is too large"), "give fewer digits"))?;
    Ok(Value::Integer(number))
}

/// The name of the type of a value, for messages.
pub(crate) fn type_name(value: &Bound<'_, PyAny>) -> String {
    value
        .get_type()
        .name()
        .map_or_else(|_| "another type".to_owned(), |name| format!("a value of type {name}"))
}
