//! The keys of a `[[gate]]` rule.

use fovqa_params::words_of;
use fovqa_statistics::adjust::Adjustment;

use super::keys::{key, required};
use super::{Key, Kind};

/// An edge of an eccentricity band in degrees.
pub(super) const BAND_EDGE: Kind = Kind::Number(0.0, 180.0);

/// The allowed distance of a value from the baseline.
const ALLOWANCE: Kind = Kind::Either(&[Kind::Number(0.0, 1e12), Kind::Text]);
const LIMIT: Kind = Kind::Number(-1e12, 1e12);

/// A rule of the gate.
pub(super) static GATE_TABLE: [Key; 17] = [
    required("metric", Kind::Metric, "the metric"),
    key("name", Kind::Name, "name of the rule in verdicts"),
    key(
        "statistic",
        Kind::Text,
        "for haar: mean_abs, max_abs, energy; for spectrum: power, density, cutoff_cpd; for fvvdp: jod (of the sequence, the default), frame_jod, q, share, q_sustained, q_transient; for metrics that pool their frames, such as psnr: pooled (of the sequence)",
    ),
    key(
        "image",
        Kind::Word(&["pair", "test", "reference", "ratio"]),
        "image that the rule applies to",
    ),
    key(
        "level",
        Kind::Whole(-100, 100),
        "level of the wavelet or spatial band of fvvdp, from 1; half octave k of the spectrum, around 2^(k/2) cpd",
    ),
    key(
        "aggregate",
        Kind::Text,
        "how frames become one value: mean (the default), min, max, p01 to p99",
    ),
    key(
        "per_frame",
        Kind::Bool,
        "hold each frame against the limits, and against the same frame of the baseline; default: false",
    ),
    key("scene", Kind::Name, "only this scene; default: each scene"),
    key("method", Kind::Name, "only this method; default: each method"),
    key(
        "eye",
        Kind::Word(&["left", "right", "both"]),
        "eye, in scenes with two eyes; default: both",
    ),
    key(
        "band_deg",
        Kind::List(&BAND_EDGE, 2, 2),
        "[from, to], edges of scored eccentricity bands, °; default: the whole frame",
    ),
    key("at_least", LIMIT, "smallest value"),
    key("at_most", LIMIT, "largest value"),
    key(
        "max_drop",
        ALLOWANCE,
        "largest allowed drop below the baseline's value: a number, or \"2%\"",
    ),
    key(
        "max_rise",
        ALLOWANCE,
        "largest allowed rise above the baseline's value: a number, or \"2%\"",
    ),
    key(
        "alpha",
        Kind::Above(0.0, 0.5),
        "instead of limits: repeated runs are compared with those of the baseline (Welch's t-test), and an unchanged build fails with this probability",
    ),
    key(
        "adjust",
        Kind::Words(words_of::<Adjustment>),
        "with alpha: correction for the number of tests of the rule; default: holm",
    ),
];
