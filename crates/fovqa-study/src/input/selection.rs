//! Which rows of a table enter an analysis, and what its columns are called.

/// The options `--by`, `--where` and `--column`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Selection {
    /// Columns whose values divide the rows into groups.
    pub by: Vec<String>,
    /// Columns and the values that rows must have there. Several values of one column are
    /// conditions that must all hold.
    pub filters: Vec<(String, String)>,
    /// Roles and the names of their columns in the file.
    pub columns: Vec<(String, String)>,
}

impl Selection {
    /// The name of a role's column in the file: the role itself unless it is renamed.
    pub fn name<'a>(&'a self, role: &'a str) -> &'a str {
        self.columns.iter().rev().find(|(of, _)| of == role).map_or(role, |(_, name)| name)
    }
}
