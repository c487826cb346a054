//! The values of a column, numbered by first appearance or in a given order.

use std::collections::HashMap;

use super::table::Column;

/// Numbered names: participants, methods, or levels of a factor.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Levels {
    names: Vec<String>,
    indices: HashMap<String, usize>,
}

impl Levels {
    /// The values of a column in these rows, by first appearance.
    pub fn of_column(column: &Column, rows: &[usize]) -> Self {
        let mut levels = Self::default();
        let mut seen: Vec<bool> = Vec::new();
        for &row in rows {
            let code = column.code(row) as usize;
            if seen.get(code) != Some(&true) {
                seen.resize(seen.len().max(code + 1), false);
                seen[code] = true;
                levels.add(column.text(row));
            }
        }
        levels
    }

    /// The values of two columns in these rows, by first appearance; in a row, the first column
    /// comes first.
    pub fn of_columns(first: &Column, second: &Column, rows: &[usize]) -> Self {
        let mut levels = Self::default();
        let mut seen = std::collections::HashSet::new();
        for &row in rows {
            if seen.insert((first.code(row), second.code(row))) {
                levels.add(first.text(row));
                levels.add(second.text(row));
            }
        }
        levels
    }

    /// Adds a name unless it is known, and returns its number.
    pub fn add(&mut self, name: &str) -> usize {
        if let Some(&index) = self.indices.get(name) {
            return index;
        }
        self.names.push(name.to_owned());
        self.indices.insert(name.to_owned(), self.names.len() - 1);
        self.names.len() - 1
    }

    /// The same names: first those of `order`, as far as they occur, then the others.
    #[must_use]
    pub fn in_order(&self, order: &[String]) -> Self {
        let mut levels = Self::default();
        for name in order.iter().filter(|name| self.index(name).is_some()).chain(&self.names) {
            levels.add(name);
        }
        levels
    }

    /// The names, in their order.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The number of names.
    pub fn len(&self) -> usize {
        self.names.len()
    }

    /// Whether there is no name.
    pub fn is_empty(&self) -> bool {
        self.names.is_empty()
    }

    /// The number of a name.
    pub fn index(&self, name: &str) -> Option<usize> {
        self.indices.get(name).copied()
    }

    /// The number of each code of a column, for rows that the levels were made of.
    pub fn of_row(&self, column: &Column, row: usize) -> usize {
        // All names of the rows are known.
        self.index(column.text(row)).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::Table;

    #[test]
    fn names_are_numbered_by_appearance_or_order() {
        let table = Table::read("p.csv", b"a,b\nY,X\nX,Z\nY,X\n").unwrap();
        let [a, b] = ["a", "b"].map(|name| table.find(name).unwrap().unwrap());
        assert_eq!(Levels::of_column(a, &[1, 0, 2]).names(), ["X", "Y"]);
        let both = Levels::of_columns(a, b, &[0, 1, 2]);
        assert_eq!(both.names(), ["Y", "X", "Z"]);
        let order = ["Z".to_owned(), "none".to_owned(), "Y".to_owned()];
        assert_eq!(both.in_order(&order).names(), ["Z", "Y", "X"]);
        assert_eq!((both.of_row(b, 1), both.index("none"), both.len()), (2, None, 3));
    }
}
