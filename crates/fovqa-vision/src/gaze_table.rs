//! The table of a gaze trace: encoding, separator, columns and rows.

use std::io::Read;

use crate::gaze_error::{Export, GazeTraceError};

/// The column that orders the rows of a trace.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Clock {
    Frame,
    TimeS,
}

impl Clock {
    pub(crate) fn column(self) -> &'static str {
        match self {
            Clock::Frame => "frame",
            Clock::TimeS => "time_s",
        }
    }
}

/// A table as it was read.
#[derive(Debug)]
pub(crate) struct Table {
    pub(crate) clock: Clock,
    pub(crate) rows: Vec<GazeRow>,
    /// Headings of columns about the quality of samples, which are not applied.
    pub(crate) unused: Vec<String>,
}

/// One row. Depending on the table's clock, either `frame` or `time_s` is set and the other one is
/// 0.
#[derive(Debug, Clone, Copy)]
pub(crate) struct GazeRow {
    /// Line of the file, from 1.
    pub(crate) line: u64,
    pub(crate) frame: i64,
    pub(crate) time_s: f64,
    /// `None` for a blink.
    pub(crate) position_px: Option<[f64; 2]>,
}

/// No position of a recording is larger, in pixels.
const LARGEST_PX: f64 = 1e9;

/// The index of each column.
struct Columns {
    clock: (Clock, usize),
    x: usize,
    y: usize,
    valid: Option<usize>,
}

impl Table {
    pub(crate) fn read(mut source: impl Read) -> Result<Self, GazeTraceError> {
        let mut bytes = Vec::new();
        source.read_to_end(&mut bytes).map_err(csv::Error::from)?;
        let text = decoded(&bytes);
        let separator = separator(&text);
        let mut reader = csv::ReaderBuilder::new()
            .trim(csv::Trim::All)
            .delimiter(separator)
            .from_reader(text.as_bytes());
        let headings: Vec<String> = reader.headers()?.iter().map(str::to_owned).collect();
        let columns = columns(&headings)?;
        let mut rows = Vec::new();
        for record in reader.records() {
            rows.push(row(&columns, &record?)?);
        }
        let of_quality = |heading: &&String| {
            let heading = heading.to_lowercase();
            heading != "valid"
                && ["valid", "confidence", "blink"].iter().any(|word| heading.contains(word))
        };
        let unused = headings.iter().filter(of_quality).cloned().collect();
        Ok(Self { clock: columns.clock.0, rows, unused })
    }
}

/// The text of a file in UTF-8 or UTF-16. Other characters can only be in columns that are not
/// read.
fn decoded(bytes: &[u8]) -> String {
    let wide = |from: fn([u8; 2]) -> u16, bytes: &[u8]| {
        let units = bytes.chunks_exact(2).map(|unit| from([unit[0], unit[1]]));
        char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)).collect()
    };
    match bytes {
        [0xef, 0xbb, 0xbf, text @ ..] => String::from_utf8_lossy(text).into_owned(),
        [0xff, 0xfe, text @ ..] => wide(u16::from_le_bytes, text),
        [0xfe, 0xff, text @ ..] => wide(u16::from_be_bytes, text),
        // A heading begins with an ASCII character.
        [1..=0x7f, 0, ..] => wide(u16::from_le_bytes, bytes),
        [0, 1..=0x7f, ..] => wide(u16::from_be_bytes, bytes),
        _ => String::from_utf8_lossy(bytes).into_owned(),
    }
}

/// The separator that splits the heading into most columns.
fn separator(text: &str) -> u8 {
    let heading = text.lines().find(|line| !line.trim().is_empty()).unwrap_or_default();
    let count = |separator: u8| heading.bytes().filter(|byte| *byte == separator).count();
    // The comma is chosen if another one is equally frequent: `max_by_key` returns the last of
    // equal items.
    b";\t,".iter().copied().max_by_key(|separator| count(*separator)).unwrap_or(b',')
}

fn columns(headings: &[String]) -> Result<Columns, GazeTraceError> {
    let find = |name: &'static str| {
        let mut found = (0..headings.len()).filter(|i| headings[*i].eq_ignore_ascii_case(name));
        match (found.next(), found.next()) {
            (_, Some(_)) => Err(GazeTraceError::TwoColumns(name)),
            (found, None) => Ok(found),
        }
    };
    let needed = |wanted: &'static str, found: Option<usize>| {
        found.ok_or_else(|| GazeTraceError::Column {
            wanted,
            found: shown(headings),
            export: Export::of(headings),
        })
    };
    let clock = match find("frame")? {
        Some(column) => (Clock::Frame, column),
        None => (Clock::TimeS, needed("frame (or time_s)", find("time_s")?)?),
    };
    let (x, y) = (needed("x_px", find("x_px")?)?, needed("y_px", find("y_px")?)?);
    Ok(Columns { clock, x, y, valid: find("valid")? })
}

/// Headings as a message shows them.
fn shown(headings: &[String]) -> String {
    const SHOWN: usize = 24;
    let names: Vec<&str> = headings.iter().take(SHOWN).map(String::as_str).collect();
    let more = headings.len().saturating_sub(SHOWN);
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    format!("{}{more}", names.join(", "))
}

fn row(columns: &Columns, record: &csv::StringRecord) -> Result<GazeRow, GazeTraceError> {
    let line = record.position().map_or(0, csv::Position::line);
    let wrong = |index: usize, column: &'static str, wanted: &'static str| {
        let found = record[index].chars().take(40).collect();
        GazeTraceError::Number { line, column, found, wanted }
    };
    let number = |index: usize, column: &'static str| {
        let cell = &record[index];
        let value = if cell.is_empty() { Ok(f64::NAN) } else { cell.parse::<f64>() };
        value.map_err(|_| wrong(index, column, "a number"))
    };
    let pixels = |index: usize, column: &'static str| {
        let value = number(index, column)?;
        let near = value.is_nan() || value.abs() <= LARGEST_PX;
        if near { Ok(value) } else { Err(wrong(index, column, "a position in pixels")) }
    };
    let (clock, at) = columns.clock;
    let (frame, time_s) = match clock {
        Clock::Frame => {
            let frame = whole(&record[at]).ok_or_else(|| wrong(at, "frame", "a whole number"))?;
            (frame, 0.0)
        }
        Clock::TimeS => {
            let time = number(at, "time_s")?;
            if !time.is_finite() {
                return Err(wrong(at, "time_s", "a number"));
            }
            (0, time)
        }
    };
    let is_valid = match columns.valid.map(|column| (column, record[column].to_lowercase())) {
        None => true,
        Some((column, word)) => match word.as_str() {
            "1" | "true" | "1.0" => true,
            "0" | "false" | "0.0" | "" => false,
            _ => return Err(wrong(column, "valid", "0 or 1, true or false")),
        },
    };
    let position = [pixels(columns.x, "x_px")?, pixels(columns.y, "y_px")?];
    let is_open = is_valid && position.iter().all(|value| !value.is_nan());
    Ok(GazeRow { line, frame, time_s, position_px: is_open.then_some(position) })
}

/// A whole number, even if a program has written it as 12.0 or 1.2e1.
fn whole(cell: &str) -> Option<i64> {
    /// Up to this number, a 64-bit float represents every whole number.
    const EXACT: f64 = 9_007_199_254_740_992.0;
    let float = || cell.parse::<f64>().ok();
    let exact = |value: &f64| value.fract() == 0.0 && value.abs() <= EXACT;
    cell.parse().ok().or_else(|| float().filter(exact).map(|value| value as i64))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(bytes: &[u8]) -> Vec<(i64, Option<[f64; 2]>)> {
        let table = Table::read(bytes).unwrap();
        table.rows.iter().map(|row| (row.frame, row.position_px)).collect()
    }

    #[test]
    fn separators_and_encodings() {
        let text = "frame,x_px,y_px\n-1,10.5,20\n0,nan,\n";
        let want = vec![(-1, Some([10.5, 20.0])), (0, None)];
        assert_eq!(rows(text.as_bytes()), want);
        for separator in [";", "\t"] {
            assert_eq!(rows(text.replace(',', separator).as_bytes()), want, "{separator:?}");
        }
        assert_eq!(rows(format!("\u{feff}{}", text.replace('\n', "\r\n")).as_bytes()), want);
        let wide = |text: &str, bytes: fn(u16) -> [u8; 2]| -> Vec<u8> {
            text.encode_utf16().flat_map(bytes).collect()
        };
        for text in [text.to_owned(), format!("\u{feff}{text}")] {
            assert_eq!(rows(&wide(&text, u16::to_le_bytes)), want);
            assert_eq!(rows(&wide(&text, u16::to_be_bytes)), want);
        }
        // The text that is not UTF-8 is in a column that nobody reads.
        assert_eq!(rows(b"frame,size \xb5m,x_px,y_px\n3,9,1,20\n"), [(3, Some([1.0, 20.0]))]);
    }

    #[test]
    fn numbers_of_frames() {
        assert_eq!(whole("1699999999990"), Some(1_699_999_999_990));
        assert_eq!([whole("12.0"), whole("1.2e1"), whole("-3")], [Some(12), Some(12), Some(-3)]);
        assert_eq!([whole("0.5"), whole("1e300"), whole(""), whole("nan")], [None; 4]);
        assert_eq!(whole("9007199254740993"), Some(9_007_199_254_740_993));
    }

    #[test]
    fn a_row_that_is_not_valid_is_a_blink() {
        let text = b"frame,x_px,y_px,valid\n0,9,9,1\n1,9,9,0\n2,9,9,TRUE\n3,9,9,false\n";
        let open: Vec<bool> = rows(text).iter().map(|(_, at)| at.is_some()).collect();
        assert_eq!(open, [true, false, true, false]);
        let unused = |text: &str| Table::read(text.as_bytes()).unwrap().unused;
        assert_eq!(unused("frame,x_px,y_px,Validity left,valid\n"), ["Validity left"]);
        assert!(unused("frame,x_px,y_px,note\n").is_empty());
        let odd = Table::read(&b"frame,x_px,y_px,valid\n0,9,9,4\n"[..]);
        assert!(matches!(odd, Err(GazeTraceError::Number { column: "valid", .. })));
    }

    #[test]
    fn exports_are_recognised_by_their_headings() {
        let export = |heading: &str| match Table::read(heading.as_bytes()) {
            Err(GazeTraceError::Column { export, .. }) => export,
            other => panic!("{other:?}"),
        };
        let tobii = "Recording timestamp\tGaze point X\tGaze point Y\tValidity left";
        assert_eq!(export(tobii), Some(Export::Tobii));
        let pupil = "gaze_timestamp,world_index,confidence,norm_pos_x,norm_pos_y";
        assert_eq!(export(pupil), Some(Export::Pupil));
        let varjo = "raw_timestamp,combined_gaze_forward_x,combined_gaze_forward_y";
        assert_eq!(export(varjo), Some(Export::Varjo));
        assert_eq!(export("a,b"), None);
    }
}
