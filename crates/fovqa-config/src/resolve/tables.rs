//! The keys of `[[plot]]` that only tables have.

use fovqa_plan::{AveragePlace, Plot, PlotKind, SpreadOver};

use crate::fault::{Fault, Faults};
use crate::node::Node;

/// Adds the keys of a table to a plot of this many scenes. A key that does not apply is a mistake.
pub(super) fn with_table_keys(
    table: Node<'_>,
    plot: Plot,
    scenes: usize,
    faults: &mut Faults,
) -> Plot {
    let plot = Plot {
        layout: table.word("layout").unwrap_or_default(),
        average: table.word("average").unwrap_or_default(),
        spread: table.word("spread"),
        label: label(table, faults),
        name: table.text("name").map(str::to_owned),
        ..plot
    };
    let (keys, kinds): (&[&str], &str) = match plot.kind {
        PlotKind::Table => (&[], ""),
        PlotKind::Ratios => (&["average", "spread"], "kind = \"table\""),
        _ => (&["layout", "average", "spread", "label", "name"], "kind = \"table\" or \"ratios\""),
    };
    for key in keys.iter().filter(|key| table.has(key)) {
        let message = format!("{key} does not apply to kind = \"{}\"", table_kind(table));
        faults.push(Fault::new(table.span(key), message).help(format!("use it with {kinds}")));
    }
    needs_scenes(table, &plot, scenes, faults);
    plot
}

fn table_kind(table: Node<'_>) -> &str {
    table.text("kind").unwrap_or_default()
}

/// Checks that averages and their spread have several scenes, and a place.
fn needs_scenes(table: Node<'_>, plot: &Plot, scenes: usize, faults: &mut Faults) {
    let over_scenes = plot.spread == Some(SpreadOver::Scenes);
    let (key, message, help) = match plot.average {
        AveragePlace::Only if scenes < 2 => (
            "average",
            "the table shows only averages over scenes, but it has one scene",
            "leave out average, or add scenes",
        ),
        _ if over_scenes && scenes < 2 => (
            "spread",
            "a spread over scenes needs at least two of them",
            "use spread = \"frames\", or add scenes",
        ),
        AveragePlace::None if over_scenes => (
            "spread",
            "the spread over scenes is shown with the averages, but average is \"none\"",
            "use average = \"last\", \"first\" or \"only\"",
        ),
        AveragePlace::Only if plot.spread == Some(SpreadOver::Frames) => (
            "spread",
            "the spread over frames is shown with the value of each scene, but average is \"only\"",
            "use spread = \"scenes\", or average = \"last\" or \"first\"",
        ),
        _ => return,
    };
    faults.push(Fault::new(table.span(key), message).help(help));
}

/// The label, which LaTeX reads as it is.
fn label(table: Node<'_>, faults: &mut Faults) -> Option<String> {
    let label = table.text("label")?;
    let plain = |c: char| c.is_ascii_alphanumeric() || ":.-_+/".contains(c);
    if let Some(other) = label.chars().find(|c| !plain(*c)) {
        let message = format!("a label in LaTeX cannot contain '{other}'");
        let help = "use the letters A to Z, digits and : . - _ + /, as in \"tab:comparison\"";
        faults.push(Fault::new(table.span("label"), message).help(help));
    }
    Some(label.to_owned())
}
