//! The keys of `[[plot]]` that only tables have.

use fovqa_metrics::Metric;
use fovqa_params::words_of;
use fovqa_plan::{AveragePlace, Plot, SpreadOver, TableLayout};

use super::keys::key;
use super::{Key, Kind};

/// What a list of metrics may contain.
fn columns() -> Vec<&'static str> {
    Metric::ALL.map(Metric::key).into_iter().chain([Plot::SAMPLES, Plot::QUADS]).collect()
}

pub(super) const METRICS: Key = key(
    "metrics",
    Kind::List(&Kind::Words(columns), 1, 14),
    "several metrics, in the order in which they are shown; in a table also \"samples\" and \"quads\", what emulated methods shade",
);

/// Keys of tables. `fovqa-config/src/resolve/tables.rs` refuses them for figures.
pub(super) const TABLE_KEYS: &[Key] = &[
    key(
        "layout",
        Kind::Words(words_of::<TableLayout>),
        "methods: one row per method, in a section for each scene (default); scenes: one row per scene, columns of metrics and methods; transposed: one row per metric, one column per method",
    ),
    key(
        "average",
        Kind::Words(words_of::<AveragePlace>),
        "averages over the scenes: after them (last, the default), before them (first), in place of them (only), or none",
    ),
    key(
        "spread",
        Kind::Words(words_of::<SpreadOver>),
        "± standard deviation: over scenes, beside the average; or over frames, beside the value of each scene",
    ),
    key("label", Kind::Text, "label in LaTeX; default: tab: and the names of experiment and table"),
    key("name", Kind::Name, "name of its files, after table- or ratios-"),
];
