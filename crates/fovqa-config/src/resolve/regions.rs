//! The regions of frames that a plot shows.

use fovqa_plan::{CropRegion, Plot};
use serde_spanned::Spanned;
use toml::de::DeValue;

use crate::fault::{Fault, Faults};
use crate::grammar::first_quoted;
use crate::node::Node;

/// Checks that a plot of regions has any.
pub(super) fn has_some(table: Node<'_>, faults: &mut Faults) {
    let is_empty = matches!(table.value("regions").map(Spanned::get_ref), Some(DeValue::Array(items)) if items.is_empty());
    if is_empty || !table.has("regions") {
        let key = if is_empty { "regions" } else { "kind" };
        let fault = Fault::new(table.span(key), "the plot has no regions to show");
        let help = "add regions = [{ name = \"door\", at = [400, 300], size = [64, 64] }]";
        faults.push(fault.help(help));
    }
}

/// The regions of one plot. `shown` are the scenes that it names.
pub(super) fn of_plot(
    table: Node<'_>,
    scenes: &[&str],
    shown: Option<&[String]>,
    faults: &mut Faults,
) -> Vec<CropRegion> {
    let tables = table.tables("regions");
    let region = |region: &Node<'_>| {
        Some(CropRegion {
            name: region.text("name")?.to_owned(),
            at: region.array("at")?,
            size: region.array::<2>("size")?.map(|side| side as usize),
            scene: region.text("scene").map(str::to_owned),
            frame: region.number("frame").map(|frame| frame as i64),
        })
    };
    for (of, _) in &tables {
        if let Some(scene) = of.text("scene").filter(|scene| !scenes.contains(scene)) {
            let fault = Fault::new(of.span("scene"), format!("there is no scene \"{scene}\""));
            let known = first_quoted(scenes.iter().copied());
            faults.push(fault.help(format!("the scenes are {known}")));
        } else if let (Some(scene), Some(shown)) = (of.text("scene"), shown)
            && !shown.iter().any(|name| name == scene)
        {
            let message = format!("the plot does not show the scene \"{scene}\"");
            let help = "add it to the plot's scenes, or remove the region";
            faults.push(Fault::new(of.span("scene"), message).help(help));
        }
    }
    tables.iter().filter_map(|(table, _)| region(table)).collect()
}

/// The regions of all plots. A region's pictures are in a folder of its name, so that a name stands
/// for one region only.
pub(super) fn of_all(root: Node<'_>, plots: &[Plot], faults: &mut Faults) -> Vec<CropRegion> {
    let mut all: Vec<CropRegion> = Vec::new();
    for region in plots.iter().flat_map(|plot| &plot.regions) {
        match all.iter().find(|other| other.name == region.name) {
            None => all.push(region.clone()),
            Some(other) if other == region => {}
            Some(_) => {
                let message = format!("two different regions are named \"{}\"", region.name);
                let fault = Fault::new(root.span("plot"), message);
                faults.push(fault.help("give each region its own name"));
            }
        }
    }
    all
}
