//! Writes and reads the table as Apache Parquet: results.parquet. It has the same columns as
//! results.csv. A cell that is empty in the CSV is null here.

use std::collections::HashMap;
use std::io::{self, Write};
use std::path::Path;
use std::sync::Arc;

use fovqa_io::contained;
use fovqa_metrics::Image;
use parquet::basic::Compression;
use parquet::column::reader::ColumnReader;
use parquet::column::writer::ColumnWriter;
use parquet::data_type::ByteArray;
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::reader::{FileReader, RowGroupReader, SerializedFileReader};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::parser::parse_message_type;

use super::part::Part;
use super::reading::{Which, not_results};
use super::row::{COLUMNS, ERROR, TableRow, Value};
use super::rows::rows_of_run;
use crate::files::{FileError, open_result_file};
use crate::report::RunResults;

/// The columns with their types, in the order of [`COLUMNS`].
const SCHEMA: &str = "message results {
    optional binary scene (STRING);
    optional binary method (STRING);
    optional binary parameters (STRING);
    optional binary eye (STRING);
    optional int64 frame;
    optional binary image (STRING);
    optional binary metric (STRING);
    optional binary statistic (STRING);
    optional int64 level;
    optional double from_deg;
    optional double to_deg;
    optional double value;
}";

/// Number of rows in a row group, all of which the writer keeps in memory.
const GROUP_ROWS: usize = 1 << 16;
/// Number of rows that the reader takes from each column at a time.
const BATCH_ROWS: usize = 1 << 12;

/// Writes a part of the values of a run as Parquet, in the order of results.csv.
///
/// # Errors
/// If the writer refuses.
pub fn write_results_parquet(
    results: &RunResults,
    part: Part,
    out: impl Write + Send,
) -> io::Result<()> {
    let properties = WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        .set_created_by(concat!("fovqa ", env!("CARGO_PKG_VERSION")).to_owned())
        .build();
    let schema = parse_message_type(SCHEMA).map_err(io_error)?;
    let mut writer =
        SerializedFileWriter::new(out, Arc::new(schema), Arc::new(properties)).map_err(io_error)?;
    let mut group = Group::default();
    rows_of_run(results, &mut |row| {
        if !part.has(row) {
            return Ok(());
        }
        group.push(row);
        if group.rows == GROUP_ROWS { group.write(&mut writer).map_err(io_error) } else { Ok(()) }
    })?;
    group.write(&mut writer).map_err(io_error)?;
    writer.close().map(drop).map_err(io_error)
}

/// The cells of a column: its values, and for each row whether it has one (1) or is null (0).
#[derive(Default)]
struct Column<T> {
    values: Vec<T>,
    levels: Vec<i16>,
}

impl<T> Column<T> {
    fn push(&mut self, value: Option<T>) {
        self.levels.push(i16::from(value.is_some()));
        self.values.extend(value);
    }

    fn clear(&mut self) {
        self.values.clear();
        self.levels.clear();
    }
}

/// Rows that are not written yet, stored by column.
#[derive(Default)]
struct Group {
    rows: usize,
    texts: [Column<ByteArray>; 7],
    whole: [Column<i64>; 2],
    numbers: [Column<f64>; 3],
    /// Texts that were used already: the same few texts occur in all rows.
    known: HashMap<String, ByteArray>,
}

impl Group {
    fn push(&mut self, row: &TableRow<'_>) {
        let TableRow { scene, method, parameters, eye, metric, statistic, .. } = *row;
        let texts = [scene, method, parameters, eye, row.image.name(), metric, statistic];
        for (column, text) in self.texts.iter_mut().zip(texts) {
            let value = (!text.is_empty()).then(|| {
                self.known.get(text).cloned().unwrap_or_else(|| {
                    let bytes = ByteArray::from(text.as_bytes().to_vec());
                    self.known.insert(text.to_owned(), bytes.clone());
                    bytes
                })
            });
            column.push(value);
        }
        let [frame, level] = &mut self.whole;
        frame.push(row.frame);
        level.push(row.level);
        let [from, to, value] = &mut self.numbers;
        from.push(row.band.map(|[from, _]| from));
        to.push(row.band.map(|[_, to]| to));
        value.push(row.value.map(Value::number));
        self.rows += 1;
    }

    /// Writes the rows as a row group.
    fn write<W: Write + Send>(
        &mut self,
        writer: &mut SerializedFileWriter<W>,
    ) -> Result<(), ParquetError> {
        if self.rows == 0 {
            return Ok(());
        }
        let mut texts = self.texts.iter();
        let mut whole = self.whole.iter();
        let mut numbers = self.numbers.iter();
        let mut group = writer.next_row_group()?;
        while let Some(mut column) = group.next_column()? {
            match column.untyped() {
                ColumnWriter::ByteArrayColumnWriter(out) => {
                    let Some(column) = texts.next() else { break };
                    out.write_batch(&column.values, Some(&column.levels), None)?
                }
                ColumnWriter::Int64ColumnWriter(out) => {
                    let Some(column) = whole.next() else { break };
                    out.write_batch(&column.values, Some(&column.levels), None)?
                }
                ColumnWriter::DoubleColumnWriter(out) => {
                    let Some(column) = numbers.next() else { break };
                    out.write_batch(&column.values, Some(&column.levels), None)?
                }
                _ => break,
            };
            column.close()?;
        }
        group.close()?;
        self.texts.iter_mut().for_each(Column::clear);
        self.whole.iter_mut().for_each(Column::clear);
        self.numbers.iter_mut().for_each(Column::clear);
        self.rows = 0;
        Ok(())
    }
}

/// Reads results.parquet, row by row.
pub(super) fn read_results_parquet(
    path: &Path,
    which: Which,
    take: &mut dyn FnMut(&TableRow<'_>) -> Result<(), String>,
) -> Result<(), FileError> {
    let file = open_result_file(path)?;
    read_groups(file, which, take).map_err(|detail| not_results(path, detail))
}

/// Runs a part of the Parquet reader, which may panic if the file is damaged.
fn guarded<T>(read: impl FnOnce() -> Result<T, ParquetError>) -> Result<T, String> {
    match contained(read) {
        Some(read) => read.map_err(|error| format!("the Parquet data is damaged: {error}")),
        None => Err("the Parquet data is damaged".to_owned()),
    }
}

fn read_groups(
    file: std::fs::File,
    which: Which,
    take: &mut dyn FnMut(&TableRow<'_>) -> Result<(), String>,
) -> Result<(), String> {
    let reader = guarded(|| SerializedFileReader::new(file))?;
    let schema = reader.metadata().file_metadata().schema_descr();
    let expected = guarded(|| parse_message_type(SCHEMA))?;
    let alike = |(found, expected): (&Arc<_>, &Arc<_>)| *found == *expected;
    let fields = schema.root_schema().get_fields();
    if fields.len() != COLUMNS.len() || !fields.iter().zip(expected.get_fields()).all(alike) {
        return Err(format!("its columns are not these: {}", COLUMNS.join(", ")));
    }
    let mut line = 0;
    for index in 0..reader.num_row_groups() {
        let group = guarded(|| reader.get_row_group(index))?;
        read_group(&*group, which, &mut line, take)?;
    }
    Ok(())
}

fn read_group(
    group: &dyn RowGroupReader,
    which: Which,
    line: &mut u64,
    take: &mut dyn FnMut(&TableRow<'_>) -> Result<(), String>,
) -> Result<(), String> {
    let columns = 0..group.num_columns();
    let mut columns: Vec<ColumnReader> =
        guarded(|| columns.map(|index| group.get_column_reader(index)).collect())?;
    loop {
        let mut batch = Batch::default();
        let rows: Vec<usize> =
            columns.iter_mut().map(|column| batch.read(column)).collect::<Result<_, _>>()?;
        if rows.windows(2).any(|pair| pair[0] != pair[1]) {
            return Err("its columns have different numbers of rows".to_owned());
        }
        let rows = rows.first().copied().unwrap_or(0);
        if rows == 0 {
            return Ok(());
        }
        for index in 0..rows {
            *line += 1;
            let row = batch.row(index).map_err(|detail| format!("row {line}: {detail}"))?;
            if which == Which::All || row.band.is_none() {
                take(&row).map_err(|detail| format!("row {line}: {detail}"))?;
            }
        }
    }
}

/// Rows that were read, stored by column.
#[derive(Default)]
struct Batch {
    texts: Vec<Vec<Option<ByteArray>>>,
    whole: Vec<Vec<Option<i64>>>,
    numbers: Vec<Vec<Option<f64>>>,
}

/// Assigns the values to the rows that have one; the other rows get `None`.
fn spread<T>(values: Vec<T>, levels: &[i16]) -> Vec<Option<T>> {
    let mut values = values.into_iter();
    levels.iter().map(|level| if *level > 0 { values.next() } else { None }).collect()
}

impl Batch {
    /// Reads the next cells of a column, and returns their number.
    fn read(&mut self, column: &mut ColumnReader) -> Result<usize, String> {
        macro_rules! cells {
            ($column:expr, $columns:expr) => {{
                let (mut values, mut levels) = (Vec::new(), Vec::new());
                guarded(|| $column.read_records(BATCH_ROWS, Some(&mut levels), None, &mut values))?;
                $columns.push(spread(values, &levels));
                Ok(levels.len())
            }};
        }
        match column {
            ColumnReader::ByteArrayColumnReader(column) => cells!(column, self.texts),
            ColumnReader::Int64ColumnReader(column) => cells!(column, self.whole),
            ColumnReader::DoubleColumnReader(column) => cells!(column, self.numbers),
            _ => Err("it has a column of another type".to_owned()),
        }
    }

    /// The text in a row. `column` counts only the columns with texts: all up to `eye`, then
    /// `image`, `metric` and `statistic`.
    fn text(&self, column: usize, row: usize) -> Result<&str, String> {
        match &self.texts[column][row] {
            None => Ok(""),
            Some(bytes) => std::str::from_utf8(bytes.data())
                .map_err(|_| "it has text that is not UTF-8".to_owned()),
        }
    }

    fn row(&self, row: usize) -> Result<TableRow<'_>, String> {
        let [scene, method, parameters, eye] = [0, 1, 2, 3].map(|column| self.text(column, row));
        let [image, metric, statistic] = [4, 5, 6].map(|column| self.text(column, row));
        let (image, metric) = (image?, metric?);
        let image = Image::find(image).ok_or_else(|| format!("there is no image {image:?}"))?;
        let value = self.numbers[2][row].filter(|_| metric != ERROR);
        if value.is_some_and(f64::is_nan) {
            return Err("its value is not a number".to_owned());
        }
        Ok(TableRow {
            scene: scene?,
            method: method?,
            parameters: parameters?,
            eye: eye?,
            frame: self.whole[0][row],
            image,
            metric,
            statistic: statistic?,
            level: self.whole[1][row],
            band: self.numbers[0][row].zip(self.numbers[1][row]).map(Into::into),
            value: value.map(Value::Measured),
        })
    }
}

fn io_error(error: ParquetError) -> io::Error {
    match error {
        ParquetError::External(error) => match error.downcast::<io::Error>() {
            Ok(error) => *error,
            Err(error) => io::Error::other(error.to_string()),
        },
        other => io::Error::other(other.to_string()),
    }
}
