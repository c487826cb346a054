//! Names in CSV files. A spreadsheet reads a cell as a formula if it begins with one of a few
//! characters, and a formula can run anything. An apostrophe before it marks the cell as text.

use std::borrow::Cow;

use fovqa_plan::{OutputSettings, Resolved};

use crate::table::row::TableRow;

/// How names are written in CSV files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum CsvNames {
    /// Names are written unchanged.
    #[default]
    Plain,
    /// Names that a spreadsheet would read as formulas get an apostrophe in front.
    SpreadsheetSafe,
}

impl From<&Resolved> for CsvNames {
    fn from(experiment: &Resolved) -> Self {
        Self::from(experiment.spreadsheet_safe)
    }
}

impl From<&OutputSettings> for CsvNames {
    fn from(output: &OutputSettings) -> Self {
        Self::from(output.spreadsheet_safe)
    }
}

impl From<bool> for CsvNames {
    fn from(spreadsheet_safe: bool) -> Self {
        if spreadsheet_safe { Self::SpreadsheetSafe } else { Self::Plain }
    }
}

/// Characters that a formula can begin with, and the apostrophe itself, so that each cell stands
/// for exactly one name.
const BEGINNINGS: [char; 7] = ['=', '+', '-', '@', '\t', '\r', '\''];

impl CsvNames {
    /// The cell for a name.
    pub fn written(self, name: &str) -> Cow<'_, str> {
        if self == Self::SpreadsheetSafe && name.starts_with(BEGINNINGS) {
            Cow::Owned(format!("'{name}"))
        } else {
            Cow::Borrowed(name)
        }
    }

    /// The name in a cell.
    pub fn read(self, cell: &str) -> &str {
        match self {
            Self::Plain => cell,
            Self::SpreadsheetSafe => cell.strip_prefix('\'').unwrap_or(cell),
        }
    }

    /// A table row with its names decoded.
    pub(crate) fn of_row(self, row: TableRow<'_>) -> TableRow<'_> {
        TableRow { scene: self.read(row.scene), method: self.read(row.method), ..row }
    }

    /// Protects the text of a CSV file in which any cell may be a name, unless it is a number.
    pub fn in_csv(self, text: String) -> String {
        if self == Self::Plain {
            return text;
        }
        let mut reader = csv::ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .from_reader(text.as_bytes());
        let mut writer = csv::WriterBuilder::new().flexible(true).from_writer(Vec::new());
        let cell = |cell: &str| match cell.parse::<f64>() {
            Ok(_) => cell.to_owned(),
            Err(_) => self.written(cell).into_owned(),
        };
        for record in reader.records().flatten() {
            // Writing to memory does not fail.
            let _ = writer.write_record(record.iter().map(cell));
        }
        String::from_utf8(writer.into_inner().unwrap_or_default()).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_as_they_were() {
        let names =
            ["=1+1", "+a", "-a", "@a", "'a", "'=a", "''", "\ta", "\ra", "a", "a=b", "", "−a"];
        for name in names {
            for of in [CsvNames::Plain, CsvNames::SpreadsheetSafe] {
                assert_eq!(of.read(&of.written(name)), name);
            }
            assert_eq!(CsvNames::Plain.written(name), name);
            let safe = CsvNames::SpreadsheetSafe.written(name);
            assert!(!safe.starts_with(['=', '+', '-', '@', '\t', '\r']), "{safe}");
        }
    }

    #[test]
    fn numbers_stay_numbers() {
        let text = "series,x,y\n=a,-1.5,-inf\n\"-b, c\",1e-7,\n@,-0.0,nan\n";
        let safe = "series,x,y\n'=a,-1.5,-inf\n\"'-b, c\",1e-7,\n'@,-0.0,nan\n";
        assert_eq!(CsvNames::SpreadsheetSafe.in_csv(text.to_owned()), safe);
        assert_eq!(CsvNames::Plain.in_csv(text.to_owned()), text);
    }
}
