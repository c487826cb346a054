//! The keys of a curves file.

use fovqa_methods::BudgetSamples;
use fovqa_methods::sandbox::{F_MAX, FOVEAL, RATE, TRANSITION};
use fovqa_params::words_of;
use fovqa_vision::{EccentricityKind, Tangential};

use super::experiment::{POSITION_PAIR, VIEW};
use super::figures::FIGURES;
use super::keys::{joined, key, required};
use super::{Key, Kind, parameter};
use fovqa_plan::{
    AcuityScale, CurvePlotKind, CurveTableKind, DensityStyle, PanelOf, RateKind, RateUnit,
    TableAcross,
};

/// Maximum number of curves. More could not be told apart.
pub(crate) const MOST_CURVES: usize = 200;

/// A gaze that all curves share: a point, or the centre.
const GAZE: Kind = Kind::Either(&[Kind::Word(&["center"]), POSITION_PAIR]);
const NAMES: Kind = Kind::List(&Kind::Name, 1, 1000);

/// Keys for screens, which each curve may override.
const SCREENS: &[Key] = &[
    key(
        "resolutions",
        Kind::List(&Kind::Resolution(100_000), 1, 100),
        "sizes of the frame, such as [\"2560x1440\"]; one curve for each",
    ),
    key(
        "gazes",
        Kind::List(&GAZE, 1, 100),
        "where the eye looks: \"center\" or [x, y] in pixels; one curve for each",
    ),
    key(
        "directions_deg",
        Kind::List(&Kind::Number(-360.0, 360.0), 1, 100),
        "directions from the gaze, ° from +x towards +y (0: right, 90: down); one curve for each",
    ),
    key(
        "tangential",
        Kind::Words(words_of::<Tangential>),
        "how a degree across the curve is defined: the same pixels as along it (paper), or visual angle",
    ),
    key("eccentricity", Kind::Words(words_of::<EccentricityKind>), "how eccentricity is measured"),
];

static VIEW_TABLE: [Key; VIEW.len() + SCREENS.len()] = joined(&[VIEW, SCREENS]);

static CURVE_TABLE: [Key; 5 + VIEW.len() + SCREENS.len()] = joined(&[
    &[
        required("name", Kind::Name, "its name in legends and tables"),
        key("method", Kind::Method, "the method: { model = \"kfr\", sigma = 1.8 }"),
        key("acuity", Kind::Acuity, "or an acuity model: { model = \"piecewise\", cap_cpd = 9 }"),
        key(
            "budget",
            Kind::Above(0.0, 1000.0),
            "samples as a share of the frame's pixels; sets the method's free parameter",
        ),
        key(
            "budget_of",
            Kind::Words(words_of::<BudgetSamples>),
            "which samples a budget counts: all, or those that fall into the frame",
        ),
    ],
    VIEW,
    SCREENS,
]);

/// A measured value that is shown among curves.
static MARK: [Key; 2] = [
    required("name", Kind::Name, "its name in the legend"),
    required(
        "at",
        Kind::List(&Kind::Number(0.0, 1e6), 2, 2),
        "[eccentricity in degrees, cycles per degree]",
    ),
];

/// Maximum number of groups of bars.
const MOST_GROUPS: usize = 48;

/// A series of given values.
static SERIES: [Key; 3] = [
    required("name", Kind::Name, "its name in the legend"),
    required("at", Kind::List(&Kind::Number(-1e12, 1e12), 1, MOST_GROUPS), "one value per group"),
    key(
        "error",
        Kind::List(&Kind::Number(0.0, 1e12), 1, MOST_GROUPS),
        "half the length of the error bar of each value; default: no error bars",
    ),
];

static PLOT_TABLE: [Key; 29] = [
    required(
        "kind",
        Kind::Words(words_of::<CurvePlotKind>),
        "rates: rates and acuity against eccentricity; density: picture of the samples per pixel over the field; accumulated: DEAMP's shaded pixels within an angle (Fig. 5b); half_axis: RMFR's mapping of a half axis (Fig. 3); steps: scales of the layers of DEAMP and Guenter; samples: positions of samples over the frame; samples_bars: numbers of samples over resolutions; outline: VaFR's buffer (Figs. 2 and 4); response: what the sandbox of Patney et al. leaves of gratings (Fig. 3); values: given values as bars",
    ),
    key("name", Kind::Name, "name of its files; default: the kind"),
    key("title", Kind::Text, "title above the figure"),
    key("curves", NAMES, "only these curves"),
    key(
        "rate",
        Kind::Words(words_of::<RateKind>),
        "along the line from the gaze, across it, or both side by side",
    ),
    key(
        "unit",
        Kind::Words(words_of::<RateUnit>),
        "cycles per degree, or samples per pixel, where the display's own rate is 1",
    ),
    key(
        "panels",
        Kind::Words(words_of::<PanelOf>),
        "what each panel shows; default: one curve with its settings, or of more than four curves with several settings each setting",
    ),
    key(
        "areas",
        Kind::Bool,
        "shade the areas where the rate is above and below acuity; default: only in panels of one curve",
    ),
    key("display", Kind::Bool, "also draw the display's own rate; default: in cycles per degree"),
    key(
        "beyond_display",
        Kind::Bool,
        "draw rates that exceed the display's own, which shows no more; default: false",
    ),
    key(
        "y_limits",
        Kind::List(&Kind::Number(0.0, 1e6), 2, 2),
        "ends of the vertical axis; curves are cut there",
    ),
    key("marks", Kind::Tables(&MARK, 1000), "measured values: [{ name = \"…\", at = [30, 5] }]"),
    key("log", Kind::Bool, "logarithmic axis (in a picture: logarithmic scale of colours)"),
    key(
        "rings_deg",
        Kind::List(&Kind::Above(0.0, 89.0), 1, 20),
        "eccentricities whose rings are drawn over a picture, °",
    ),
    key(
        "f",
        Kind::List(&Kind::Number(1.001, 1e6), 1, 20),
        "for half_axis: values of f, with one curve each",
    ),
    key("band", Kind::Bool, "for rates: one band per method, from its lowest to its highest rate"),
    key(
        "acuity_scale",
        Kind::Words(words_of::<AcuityScale>),
        "for per_pixel: acuity relative to the display's rate (display), or to acuity at 0° (own)",
    ),
    key("dots", Kind::Bool, "for half_axis: positions of samples as dots"),
    key(
        "style",
        Kind::Words(words_of::<DensityStyle>),
        "for density: lines of equal eccentricity (rings) or of equal density (contours)",
    ),
    key(
        "eccentricities_deg",
        Kind::List(&Kind::Number(0.0, 89.0), 1, 12),
        "for response: eccentricities, °; one panel for each",
    ),
    key(
        "rate_arcmin",
        parameter(RATE.values),
        "for response: growth of the blur, minutes of arc per degree; default: 2",
    ),
    key(
        "foveal_deg",
        parameter(FOVEAL.values),
        "for response: where the blur begins, °; default: 15 (7.5 on a desktop)",
    ),
    key(
        "transition_deg",
        parameter(TRANSITION.values),
        "for response: over which enhancement rises to its full strength, °; default: 20",
    ),
    key("f_max", parameter(F_MAX.values), "for response: strength of the enhancement; default: 1"),
    key("quantity", Kind::Text, "for values: title of the vertical axis, with the unit"),
    key("groups", Kind::List(&Kind::Name, 1, MOST_GROUPS), "for values: names of the groups"),
    key(
        "values",
        Kind::Tables(&SERIES, 12),
        "for values: series of bars: [{ name = \"…\", at = [1, 2], error = [0.1, 0.2] }]",
    ),
    key(
        "sum",
        Kind::Either(&[Kind::Bool, Kind::Name]),
        "for values: also draw the sum of the series; a text is its name",
    ),
    key("figure", Kind::Table(&FIGURES), "how it is printed; default: as [figures]"),
];

static TABLE_TABLE: [Key; 3] = [
    required(
        "kind",
        Kind::Words(words_of::<CurveTableKind>),
        "samples: samples and load, curves against resolutions; speed_up: buffer, samples, share of the pixels, theoretical speed-up; acuity: share of the field below acuity, samples spent above it",
    ),
    key("curves", NAMES, "only these curves"),
    key(
        "across",
        Kind::Words(words_of::<TableAcross>),
        "for samples: what the columns are; methods of one name up to a comma share a column if no resolution has two of them",
    ),
];

static CURVES_TABLE: [Key; 11] = [
    key("schema", Kind::Whole(1, 1), "version of this format"),
    required("name", Kind::Name, "name of the file and of its folder below reports/"),
    key("about", Kind::Text, "description of what it shows, for its page"),
    key("view", Kind::Table(&VIEW_TABLE), "frame sizes, view and gazes for all curves"),
    key("step_deg", Kind::Number(0.001, 60.0), "step between eccentricities, °; default 0.25"),
    key("to_deg", Kind::Above(0.0, 179.0), "last eccentricity, °; default 60"),
    key(
        "acuity",
        Kind::Acuity,
        "acuity model that rates are compared with; default { model = \"piecewise\" }",
    ),
    key("curve", Kind::Tables(&CURVE_TABLE, MOST_CURVES), "the curves"),
    key(
        "plot",
        Kind::Tables(&PLOT_TABLE, 200),
        "figures; if none and no table is given, all that fit",
    ),
    key("figures", Kind::Table(&FIGURES), "how figures are printed"),
    key(
        "table",
        Kind::Tables(&TABLE_TABLE, 200),
        "tables; if none and no figure is given, all that fit",
    ),
];

/// The top-level keys of the file.
pub(crate) const CURVES: &[Key] = &CURVES_TABLE;
