//! What can be wrong with a study's table, or with settings that do not fit it.

use thiserror::Error;

/// An error in the input of a study. [`StudyError::help`] says what to do.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum StudyError {
    /// The file is no CSV table.
    #[error("{file}{} cannot be read as CSV: {reason}", at(*.line))]
    NotCsv {
        /// The file.
        file: String,
        /// The line, from 1, if it is known.
        line: Option<u64>,
        /// What the reader says.
        reason: String,
    },
    /// No row remains.
    #[error("{file} has no rows{selected}")]
    NoRows {
        /// The file.
        file: String,
        /// What the rows were selected by, such as ` with method = A`.
        selected: String,
    },
    /// A column that the analysis needs is not there.
    #[error("{file}, line 1: there is no column {column:?}{}", role_of(.role, .column))]
    MissingColumn {
        /// The file.
        file: String,
        /// What the column is for.
        role: String,
        /// The name that was looked for.
        column: String,
        /// The columns of the file.
        present: Vec<String>,
    },
    /// Two columns have the same name.
    #[error("{file}, line 1: the column {column:?} occurs more than once")]
    DuplicateColumn {
        /// The file.
        file: String,
        /// The name.
        column: String,
    },
    /// A cell has a value that the analysis does not know.
    #[error(transparent)]
    Cell(Box<WrongCell>),
    /// Options are not possible, whatever the table.
    #[error("{message}")]
    Options {
        /// What is wrong.
        message: String,
        /// How to correct it.
        help: String,
    },
    /// A setting does not fit the table.
    #[error("{message}")]
    Setting {
        /// What is wrong.
        message: String,
        /// How to correct it.
        help: String,
    },
}

/// A cell with a value that the analysis does not know.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{file}, line {line}, column {column:?}: {cell:?} is not {wanted}")]
pub struct WrongCell {
    /// The file.
    pub file: String,
    /// The line, from 1.
    pub line: u64,
    /// The name of the column in the file.
    pub column: String,
    /// The cell's text.
    pub cell: String,
    /// What is allowed there, such as `a number`.
    pub wanted: String,
    /// How to correct it.
    pub help: String,
}

fn at(line: Option<u64>) -> String {
    line.map(|line| format!(", line {line},")).unwrap_or_default()
}

fn role_of(role: &str, column: &str) -> String {
    if role == column { String::new() } else { format!(" for {role:?}") }
}

impl StudyError {
    /// How to correct it.
    pub fn help(&self) -> String {
        match self {
            StudyError::NotCsv { .. } => {
                "write a header line, and as many cells in each row as the header has, in UTF-8"
                    .to_owned()
            }
            StudyError::NoRows { .. } => {
                "check the values of --where, and that the cells of the value column are not empty"
                    .to_owned()
            }
            StudyError::MissingColumn { role, present, .. } => format!(
                "name the column with --column {role}=NAME; the file has {}",
                present.join(", ")
            ),
            StudyError::DuplicateColumn { .. } => "rename one of the columns".to_owned(),
            StudyError::Cell(cell) => cell.help.clone(),
            StudyError::Options { help, .. } | StudyError::Setting { help, .. } => help.clone(),
        }
    }

    /// Whether options are wrong, whatever the table.
    pub fn is_of_options(&self) -> bool {
        matches!(self, StudyError::Options { .. })
    }
}
