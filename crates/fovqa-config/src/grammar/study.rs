//! The keys of a study file.

use fovqa_params::words_of;
use fovqa_statistics::adjust::Adjustment;
use fovqa_study::options::{
    Alternative, Direction, LevelMean, PairwiseTest, Sigmoid, Smoothing, Ties,
};

use super::figures::FIGURES;
use super::keys::{key, required};
use super::{Key, Kind};

/// Maximum number of analyses.
const MOST_ANALYSES: usize = 200;
/// Maximum number of names in a list.
const MOST_NAMES: usize = 1000;

/// The analyses.
pub(crate) const ANALYSES: &[&str] =
    &["pairs", "ranks", "anova", "psychometric", "staircase", "ratings", "metrics", "plan"];
/// What can be planned.
pub(crate) const PLANS: &[&str] = &["pairs", "staircase"];

const NAMES: Kind = Kind::Either(&[Kind::List(&Kind::Text, 1, MOST_NAMES), Kind::Text]);
const ASSIGNMENTS: Kind = Kind::Either(&[Kind::Texts, Kind::List(&Kind::Text, 1, MOST_NAMES)]);
const SHARE: Kind = Kind::Above(0.0, 0.999_999);
const RATE: Kind = Kind::Number(0.0, 0.999_999);
/// The largest level; larger ones would overflow in squares.
const MOST: f64 = 1e50;
const LEVEL: Kind = Kind::Number(-MOST, MOST);
const POSITIVE: Kind = Kind::Above(0.0, MOST);
const SHARES: Kind = Kind::Either(&[Kind::List(&SHARE, 1, 100), SHARE]);
const STEPS: Kind = Kind::Either(&[Kind::List(&POSITIVE, 1, 1000), POSITIVE]);

/// A printed number.
static PRINTED: [Key; 6] = [
    required("quantity", Kind::Text, "what the number is"),
    required("value", Kind::Text, "the number as it is printed: \".637\", \"< .01\", \"14.8 %\""),
    required(
        "at",
        Kind::Text,
        "place of the result in the JSON of the analysis: \"/groups/0/pairs/0/p_two_sided\"",
    ),
    key("place", Kind::Text, "where it is printed, such as \"Table 2\""),
    key("note", Kind::Text, "why the numbers differ"),
    key(
        "independent",
        Kind::Bool,
        "false if the data were made from this number, which then proves nothing; default: true",
    ),
];

static ANALYSIS: [Key; 55] = [
    required("kind", Kind::Word(ANALYSES), "the analysis"),
    key("name", Kind::Name, "with which the names of its files begin; default: the kind"),
    key("title", Kind::Text, "heading on the page; default: the name"),
    key("file", Kind::Text, "the table of answers: a CSV file, relative to this file"),
    key("figure", Kind::Table(&FIGURES), "how its figures are printed; default: as [figures]"),
    key("printed", Kind::Tables(&PRINTED, MOST_NAMES), "a paper's numbers, to compare with"),
    key("by", NAMES, "columns that divide the rows into groups, with a result for each"),
    key(
        "where",
        ASSIGNMENTS,
        "only rows with these values: { scene = \"hall\" } or [\"scene=hall\"]",
    ),
    key(
        "column",
        ASSIGNMENTS,
        "names of columns in the file: { value = \"score\" } or [\"value=score\"]",
    ),
    key("confidence", SHARE, "coverage of intervals; default: 0.95"),
    key(
        "adjust",
        Kind::Words(words_of::<Adjustment>),
        "adjustment of p-values for several tests; default: holm",
    ),
    key("bootstrap", Kind::Whole(0, 1_000_000), "bootstrap replicates; default: 1000"),
    key("seed", Kind::Whole(0, 1 << 53), "seed of all random numbers; default: 1"),
    key("ties", Kind::Words(words_of::<Ties>), "pairs, ranks: how ties count; default: error"),
    key("order", NAMES, "pairs, ranks: order of the methods; default: by first appearance"),
    key("reference", Kind::Text, "pairs: the method whose score is 0; default: the mean is 0"),
    key("pseudo_votes", Kind::Number(0.0, 1e6), "pairs: votes added to both sides; default: 0"),
    key("unit", NAMES, "ranks: columns that make up a unit; default: participant"),
    key(
        "pairwise",
        Kind::Words(words_of::<PairwiseTest>),
        "ranks: the test of each pair; default: kruskal",
    ),
    key("within", NAMES, "anova: one or two factors within participants"),
    key(
        "sigmoid",
        Kind::Words(words_of::<Sigmoid>),
        "psychometric, plan: shape of the function; default: logistic",
    ),
    key(
        "direction",
        Kind::Words(words_of::<Direction>),
        "psychometric, plan: how performance depends on the level; default: increasing",
    ),
    key("guess", RATE, "psychometric, plan: share correct by guessing; default: 0.5"),
    key("performance", SHARES, "psychometric: where levels are reported; default: 0.75, 0.7071"),
    key("lapse", RATE, "psychometric: a fixed lapse rate; plan: the true one, default: 0"),
    key("lapse_max", RATE, "psychometric: largest lapse rate of the fit; default: 0.06"),
    key(
        "overdispersion",
        Kind::Either(&[Kind::Bool, Kind::Word(&["on", "off"])]),
        "psychometric: whether the posterior has overdispersion; default: true",
    ),
    key(
        "drop_reversals",
        Kind::Whole(0, 1_000_000),
        "staircase, plan: first reversals that are left out; default: 2",
    ),
    key(
        "mean",
        Kind::Words(words_of::<LevelMean>),
        "staircase, plan: mean of levels at reversals; default: arithmetic",
    ),
    key(
        "threshold",
        LEVEL,
        "ratings: mean score of an acceptable level; plan: mean true threshold",
    ),
    key("grid", NAMES, "ratings: two columns of parameters, instead of levels"),
    key(
        "smooth",
        Kind::Words(words_of::<Smoothing>),
        "ratings: smoothing of the grid; default: none",
    ),
    key("validation_expected", LEVEL, "ratings: the correct score of validation trials"),
    key(
        "max_errors",
        Kind::Whole(1, u32::MAX as i64),
        "ratings: wrong validation trials with which a participant is left out",
    ),
    key("scores", Kind::Text, "metrics: results.csv of a run, relative to this file"),
    key("metrics", NAMES, "metrics: the metrics to compare; default: all of the scores"),
    key("lower_is_better", NAMES, "metrics: those whose lower scores are better"),
    key("plan", Kind::Word(PLANS), "plan: what is planned"),
    key("share", SHARE, "plan: the true share of votes"),
    key("results", Kind::Text, "plan: or the results folder of a run, whose JODs predict shares"),
    key("methods", NAMES, "plan: only these methods of the results"),
    key("scene", Kind::Text, "plan: only this scene of the results"),
    key("alpha", SHARE, "plan: level of significance; default: 0.05"),
    key("power", SHARE, "plan: power that the study must have; default: 0.8"),
    key(
        "alternative",
        Kind::Words(words_of::<Alternative>),
        "plan: what the test looks for; default: two-sided",
    ),
    key("trials", Kind::Whole(1, 1_000_000), "plan: trials of a pair, or of a participant"),
    key("width", POSITIVE, "plan: width of the interval, or of the psychometric function"),
    key("participants", Kind::Whole(1, 10_000), "plan: participants of a study"),
    key("between_sd", Kind::Number(0.0, MOST), "plan: SD of true thresholds; default: 0"),
    key("start", LEVEL, "plan: first level"),
    key("steps", STEPS, "plan: sizes of steps, each until the next reversal"),
    key("lowest", LEVEL, "plan: lowest level"),
    key("highest", LEVEL, "plan: highest level"),
    key("down", Kind::Whole(1, 100), "plan: right answers before a harder level; default: 2"),
    key("studies", Kind::Whole(1, 1_000_000), "plan: simulated studies; default: 1000"),
];

static STUDY_TABLE: [Key; 5] = [
    key("schema", Kind::Whole(1, 1), "version of this format"),
    required("name", Kind::Name, "name of the study and of its folder below reports/"),
    key("about", Kind::Text, "what the study is, for its page"),
    key("figures", Kind::Table(&FIGURES), "how figures are printed"),
    required("analysis", Kind::Tables(&ANALYSIS, MOST_ANALYSES), "the analyses"),
];

/// What an option of an analysis is for.
pub(crate) fn about_option(name: &str) -> &'static str {
    ANALYSIS.iter().find(|key| key.name == name).map_or("", |key| key.about)
}

/// The top-level keys of the file.
pub(crate) const STUDY: &[Key] = &STUDY_TABLE;

/// `[study]` of an experiment.
pub(super) static OPINIONS: [Key; 10] = [
    required("file", Kind::Text, "mean opinion scores: a CSV file, relative to this file"),
    key("scene", Kind::Text, "name of its column of scenes; default: scene"),
    key("method", Kind::Text, "name of its column of methods; default: method"),
    key("value", Kind::Text, "name of its column of mean opinion scores; default: value"),
    key("se", Kind::Text, "name of its column of standard errors; default: se"),
    key("metrics", Kind::List(&Kind::Metric, 1, 200), "only these metrics; default: all scored"),
    key("confidence", SHARE, "coverage of intervals; default: 0.95"),
    key(
        "adjust",
        Kind::Words(words_of::<Adjustment>),
        "adjustment of p-values for several tests; default: holm",
    ),
    key("bootstrap", Kind::Whole(0, 1_000_000), "bootstrap replicates; default: 1000"),
    key("seed", Kind::Whole(0, 1 << 53), "seed of all random numbers; default: 1"),
];
