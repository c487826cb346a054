//! Writes the table as CSV, which programs read: its columns do not depend on the layout.

use fovqa_metrics::Better;

use super::ComparisonTable;
use super::marks::Mark;
use super::values::{Cell, ItemEye};

impl ComparisonTable {
    /// CSV with one row per scene. A scene with two eyes has further rows for the left and the right
    /// eye, and the last column, `eye`, tells them apart. There is one column per measure and method (`psnr RMFR`), and
    /// one column per measure with the best methods of the row (`psnr best`), if there is a best.
    /// Equally good methods are separated by ` = `. If the table shows a spread, one column per
    /// measure and method has it (`psnr RMFR sd`). Numbers have full precision.
    pub fn csv(&self) -> String {
        let values = &self.values;
        let mut writer = csv::Writer::from_writer(Vec::new());
        let has_spread = |index: usize| {
            let cells = values.items.iter().flat_map(|item| &item.cells[index]);
            cells.into_iter().any(|cell| cell.spread.is_some())
        };
        let has_spread: Vec<bool> = (0..values.measures.len()).map(has_spread).collect();
        let mut header = vec![values.items_are.heading().to_owned()];
        for (measure, &has_spread) in values.measures.iter().zip(&has_spread) {
            header.extend(values.methods.iter().map(|method| format!("{} {method}", measure.key)));
            if measure.better != Better::Neither {
                header.push(format!("{} best", measure.key));
            }
            if has_spread {
                let column = |method: &String| format!("{} {method} sd", measure.key);
                header.extend(values.methods.iter().map(column));
            }
        }
        let has_eyes = values.items.iter().any(|item| item.eye.is_some());
        header.extend(has_eyes.then(|| "eye".to_owned()));
        // Writing to memory does not fail, and all rows have the same length.
        let _ = writer.write_record(&header);
        let text = |value: Option<f64>| value.map(|v| format!("{v:?}")).unwrap_or_default();
        for item in &values.items {
            let mut record = vec![item.name.clone()];
            for (index, (measure, cells)) in values.measures.iter().zip(&item.cells).enumerate() {
                record.extend(cells.iter().map(|cell| text(cell.value)));
                if measure.better != Better::Neither {
                    record.push(best(&values.methods, cells));
                }
                if has_spread[index] {
                    record.extend(cells.iter().map(|cell| text(cell.spread)));
                }
            }
            let eye = item.eye.map_or("", ItemEye::name);
            record.extend(has_eyes.then(|| eye.to_owned()));
            let _ = writer.write_record(&record);
        }
        String::from_utf8(writer.into_inner().unwrap_or_default()).unwrap_or_default()
    }
}

fn best(methods: &[String], cells: &[Cell]) -> String {
    let best = methods.iter().zip(cells).filter(|(_, cell)| cell.mark == Mark::Best);
    best.map(|(method, _)| method.as_str()).collect::<Vec<_>>().join(" = ")
}
