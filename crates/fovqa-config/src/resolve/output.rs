//! `[output]`: how the results are written.

use fovqa_params::Words;
use fovqa_plan::{OutputSettings, TableFormat};

use crate::fault::{Fault, Faults};
use crate::node::Node;

/// The settings. A format that appears twice is a mistake.
pub(super) fn output(root: Node<'_>, faults: &mut Faults) -> OutputSettings {
    let Some(table) = root.table("output") else { return OutputSettings::default() };
    let mut tables: Vec<TableFormat> = Vec::new();
    for (name, span) in table.names("tables").unwrap_or_default() {
        match TableFormat::find(name) {
            Some(format) if tables.contains(&format) => {
                faults.push(Fault::new(span, format!("\"{name}\" appears twice")));
            }
            Some(format) => tables.push(format),
            None => {}
        }
    }
    let mut settings = OutputSettings::default();
    if !tables.is_empty() {
        settings.tables = tables;
    }
    settings.spreadsheet_safe = table.flag("spreadsheet_safe").unwrap_or(false);
    settings
}
