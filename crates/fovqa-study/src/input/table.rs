//! A CSV table in memory.

use std::collections::HashMap;

use csv::{ReaderBuilder, StringRecord, Trim};

use crate::StudyError;

/// A CSV table. Cells are plain text; equal cells of a column are kept once.
#[derive(Debug, Clone)]
pub struct Table {
    file: String,
    columns: Vec<Column>,
    lines: Vec<u64>,
}

/// A column of a table.
#[derive(Debug, Clone)]
pub struct Column {
    name: String,
    codes: Vec<u32>,
    texts: Vec<String>,
    numbers: Vec<Option<f64>>,
}

impl Table {
    /// Reads a table with a header line. White space around cells, a byte order mark and blank lines
    /// are ignored.
    ///
    /// # Errors
    ///
    /// If the bytes are not UTF-8, there is no header, or a row has another number of cells.
    pub fn read(file: &str, bytes: &[u8]) -> Result<Self, StudyError> {
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        let mut reader = ReaderBuilder::new().trim(Trim::All).from_reader(bytes);
        let mut counter = LineCounter { bytes, byte: 0, line: 1 };
        let header = reader.headers();
        let header = header.map_err(|error| not_csv(file, &error, &mut counter))?.clone();
        if header.iter().all(str::is_empty) {
            let (file, reason) = (file.to_owned(), "there is no header line".to_owned());
            return Err(StudyError::NotCsv { file, line: None, reason });
        }
        let mut columns: Vec<Reading> = header.iter().map(Reading::new).collect();
        let mut lines = Vec::new();
        let mut record = StringRecord::new();
        while reader
            .read_record(&mut record)
            .map_err(|error| not_csv(file, &error, &mut counter))?
        {
            lines.push(record.position().map_or(0, |position| counter.line_of(position)));
            for (column, cell) in columns.iter_mut().zip(&record) {
                column.push(cell);
            }
        }
        let columns = columns.into_iter().map(Reading::finish).collect();
        Ok(Self { file: file.to_owned(), columns, lines })
    }

    /// The name of the file, for messages.
    pub fn file(&self) -> &str {
        &self.file
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.lines.len()
    }

    /// The line of a row in the file, from 1.
    pub fn line(&self, row: usize) -> u64 {
        self.lines[row]
    }

    /// Rewrites the names in a column, if there is one. Different names must remain different.
    pub fn rewrite(&mut self, name: &str, cell: impl Fn(&str) -> String) {
        for column in self.columns.iter_mut().filter(|column| column.name == name) {
            for text in &mut column.texts {
                *text = cell(text);
            }
        }
    }

    /// The names of all columns.
    pub fn names(&self) -> Vec<String> {
        self.columns.iter().map(|column| column.name.clone()).collect()
    }

    /// The column of a name, if there is one.
    ///
    /// # Errors
    ///
    /// If there is more than one.
    pub fn find(&self, name: &str) -> Result<Option<&Column>, StudyError> {
        let mut found = self.columns.iter().filter(|column| column.name == name);
        let first = found.next();
        if found.next().is_some() {
            let (file, column) = (self.file.clone(), name.to_owned());
            return Err(StudyError::DuplicateColumn { file, column });
        }
        Ok(first)
    }
}

impl Column {
    /// The name in the file.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The text of a row's cell.
    pub fn text(&self, row: usize) -> &str {
        &self.texts[self.codes[row] as usize]
    }

    /// The finite number in a row's cell, if there is one; see [`Column::LARGEST`].
    pub fn number(&self, row: usize) -> Option<f64> {
        self.numbers[self.codes[row] as usize]
    }

    /// The code of a row's cell. Equal cells of a column have the same code.
    pub fn code(&self, row: usize) -> u32 {
        self.codes[row]
    }

    /// The largest magnitude of a number. Sums of fourth powers remain finite.
    pub const LARGEST: f64 = 1e50;
}

/// A column that is being read.
struct Reading {
    name: String,
    codes: Vec<u32>,
    known: HashMap<String, u32>,
    texts: Vec<String>,
}

impl Reading {
    fn new(name: &str) -> Self {
        Self { name: name.to_owned(), codes: Vec::new(), known: HashMap::new(), texts: Vec::new() }
    }

    fn push(&mut self, cell: &str) {
        let code = self.known.get(cell).copied().unwrap_or_else(|| {
            let code = self.texts.len() as u32;
            self.texts.push(cell.to_owned());
            self.known.insert(cell.to_owned(), code);
            code
        });
        self.codes.push(code);
    }

    fn finish(self) -> Column {
        let usable = |number: &f64| number.abs() <= Column::LARGEST;
        let number = |text: &String| text.parse::<f64>().ok().filter(usable);
        let numbers = self.texts.iter().map(number).collect();
        Column { name: self.name, codes: self.codes, texts: self.texts, numbers }
    }
}

/// Counts lines. A position of the crate csv may be before the line break of the previous row, and
/// before blank lines.
struct LineCounter<'b> {
    bytes: &'b [u8],
    byte: usize,
    line: u64,
}

impl LineCounter<'_> {
    /// The line of a row; rows have to come in order.
    fn line_of(&mut self, position: &csv::Position) -> u64 {
        let start = usize::try_from(position.byte()).unwrap_or(usize::MAX);
        while let Some(&byte) = self.bytes.get(self.byte) {
            if self.byte >= start && !matches!(byte, b'\r' | b'\n') {
                break;
            }
            self.line += u64::from(byte == b'\n');
            self.byte += 1;
        }
        self.line
    }
}

fn not_csv(file: &str, error: &csv::Error, counter: &mut LineCounter) -> StudyError {
    let line = error.position().map(|position| counter.line_of(position));
    let reason = match error.kind() {
        csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
            format!("it has {len} cells, but the header has {expected_len}")
        }
        csv::ErrorKind::Utf8 { .. } => "it is not UTF-8".to_owned(),
        _ => error.to_string(),
    };
    StudyError::NotCsv { file: file.to_owned(), line, reason }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn byte_order_marks_line_ends_and_formulas_are_read() {
        let table =
            Table::read("a.csv", b"\xef\xbb\xbfa, b\r\n=1+1,2\r\n\r\n\"x,y\",-3e2\r\n").unwrap();
        assert_eq!((table.rows(), table.names()), (2, vec!["a".to_owned(), "b".to_owned()]));
        let a = table.find("a").unwrap().unwrap();
        assert_eq!((a.text(0), a.text(1)), ("=1+1", "x,y"));
        assert_eq!(table.find("b").unwrap().unwrap().number(1), Some(-300.0));
        assert_eq!(table.line(1), 4);
        assert!(table.find("c").unwrap().is_none());
    }

    #[test]
    fn damaged_tables_name_the_line() {
        let error = |bytes: &[u8]| Table::read("a.csv", bytes).unwrap_err().to_string();
        assert!(error(b"").contains("no header"));
        assert!(error(b"a,b\n1,2\n3\n").contains("line 3"));
        assert!(error(b"a\n\xff\n").contains("UTF-8"));
        assert!(Table::read("a.csv", b"a,a\n1,2\n").unwrap().find("a").is_err());
    }

    #[test]
    fn numbers_are_finite() {
        let table = Table::read("a.csv", b"a\nnan\ninf\n1e400\n1e60\n1\n").unwrap();
        let a = table.find("a").unwrap().unwrap();
        let numbers: Vec<_> = (0..5).map(|row| a.number(row)).collect();
        assert_eq!(numbers, [None, None, None, None, Some(1.0)]);
    }
}
