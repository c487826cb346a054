//! Writes the table as CSV.

use fovqa_metrics::Better;

use super::{Cell, ComparisonTable};

impl ComparisonTable {
    /// CSV with one column per measure and method (`psnr RMFR`), and one column per measure with
    /// the best methods of the row (`psnr best`), if there is a best. Equally good methods are
    /// separated by ` = `. Numbers have full precision.
    pub fn csv(&self) -> String {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let mut header = vec![self.corner.to_owned()];
        for group in &self.groups {
            header.extend(self.methods.iter().map(|method| format!("{} {method}", group.key)));
            if group.better != Better::Neither {
                header.push(format!("{} best", group.key));
            }
        }
        // Writing to memory does not fail, and all rows have the same length.
        let _ = writer.write_record(&header);
        for row in &self.rows {
            let mut record = vec![row.label.clone()];
            for (group, cells) in self.groups.iter().zip(&row.cells) {
                let text = |cell: &Cell| cell.value.map(|v| format!("{v:?}")).unwrap_or_default();
                record.extend(cells.iter().map(text));
                if group.better == Better::Neither {
                    continue;
                }
                let best = self.methods.iter().zip(cells).filter(|(_, cell)| cell.best);
                let best: Vec<&str> = best.map(|(method, _)| method.as_str()).collect();
                record.push(best.join(" = "));
            }
            let _ = writer.write_record(&record);
        }
        String::from_utf8(writer.into_inner().unwrap_or_default()).unwrap_or_default()
    }
}
