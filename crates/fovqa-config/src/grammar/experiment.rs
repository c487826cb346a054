//! The keys of an experiment file.

use fovqa_frame::{SignalChannels, ToneMap, Transfer};
use fovqa_gallery::BuiltinSpec;
use fovqa_io::{AlphaPolicy, CodeRange, ColourMatrix, GuidePreset, MotionUnit};
use fovqa_methods::BudgetSamples;
use fovqa_params::words_of;
use fovqa_vision::{BandEdges, EccentricityKind, Eotf};

use super::emulate::{BUDGET, SHARE};
use super::figures::FIGURES;
use super::gates::{BAND_EDGE, GATE_TABLE};
use super::keys::{joined, key, required};
use super::study::OPINIONS;
use super::tables::{METRICS, TABLE_KEYS};
use super::{Key, Kind};
use fovqa_plan::Nonfinite;
use fovqa_plan::TableFormat;
use fovqa_plan::{ErrorBars, FrameWord, PlotKind, SpreadShape};
use fovqa_plausibility::Plausibility;

/// A full angle of view in degrees.
const FOV: Kind = Kind::Above(0.0, 179.999);
/// The tangent of a half angle. It may be negative, as in OpenXR.
const TANGENT: Kind = Kind::Number(-6000.0, 6000.0);
/// A position in pixels, which may be far outside any frame.
const POSITION: Kind = Kind::Number(-1e6, 1e6);
pub(super) const POSITION_PAIR: Kind = Kind::List(&POSITION, 2, 2);
const LENGTH_M: Kind = Kind::Above(0.0, 1e4);
const PIXELS: Kind = Kind::Whole(0, 1_000_000);
const NAMES: Kind = Kind::List(&Kind::Name, 1, 10_000);

const FRUSTUM: &[Key] = &[
    required("left", TANGENT, "tangent of the half angle to the left of the axis"),
    required("right", TANGENT, "tangent of the half angle to the right of the axis"),
    required("up", TANGENT, "tangent of the half angle above the axis"),
    required("down", TANGENT, "tangent of the half angle below the axis"),
];

const TRACE: &[Key] = &[
    key("trace", Kind::Text, "CSV file with the columns frame,x_px,y_px (or time_s, with fps)"),
    key("hold", Kind::Bool, "frames beyond the trace keep its last gaze"),
    key("left", Kind::Either(&ONE_GAZE), "gaze of the left eye"),
    key("right", Kind::Either(&ONE_GAZE), "gaze of the right eye"),
];

const ONE_TRACE: &[Key] = &[
    required("trace", Kind::Text, "CSV file with the columns frame,x_px,y_px"),
    key("hold", Kind::Bool, "frames beyond the trace keep its last gaze"),
];

const ONE_GAZE: [Kind; 3] =
    [Kind::Word(&["center", "builtin"]), POSITION_PAIR, Kind::Table(ONE_TRACE)];

const SIDES: &[Key] = &[
    required("left", Kind::Text, "frames of the left eye"),
    required("right", Kind::Text, "frames of the right eye"),
];

const FILES: Kind = Kind::Either(&[Kind::Text, Kind::Table(SIDES)]);

/// The built-in scenes, in both spellings.
const BUILTIN: &[&str] = &[
    "gallery",
    "pattern_a",
    "pattern-a",
    "pattern_b",
    "pattern-b",
    "pattern_c",
    "pattern-c",
    "stripes",
    "csf_chart",
    "csf-chart",
];

const GAZE: &str = "where the eye looks: \"center\" (the principal point), \"builtin\" (as the viewer of a built-in scene), [x, y] in pixels, { trace = \"gaze.csv\" }, or { left = …, right = … }";

/// The gaze of one eye or, with a table for each, of both eyes.
const VIEW_GAZE: &[Key] = &[key(
    "gaze",
    Kind::Either(&[Kind::Word(&["center", "builtin"]), POSITION_PAIR, Kind::Table(TRACE)]),
    GAZE,
)];

/// The gaze of one eye.
const EYE_GAZE: &[Key] = &[key("gaze", Kind::Either(&ONE_GAZE), "where this eye looks")];

/// The ways to describe how a frame is viewed.
pub(super) const VIEW: &[Key] = &[
    key("display", Kind::Display, "display preset; the frame fills its whole field"),
    key(
        "fov_vertical_deg",
        FOV,
        "vertical field of view, °; without fov_horizontal_deg, pixels are square",
    ),
    key(
        "fov_horizontal_deg",
        FOV,
        "horizontal field of view, °; without fov_vertical_deg, pixels are square",
    ),
    key("fov_diagonal_deg", FOV, "diagonal field of view, °; pixels are square"),
    key("frustum", Kind::Table(FRUSTUM), "asymmetric frustum: tangents of its half angles"),
    key("distance_m", LENGTH_M, "distance of the eye from a flat screen, m"),
    key(
        "pixel_pitch_mm",
        Kind::Above(0.0, 1e3),
        "size of a pixel of a flat screen, mm; with distance_m",
    ),
    key(
        "screen_m",
        Kind::List(&LENGTH_M, 2, 2),
        "width and height of a flat screen that the frame fills, m; with distance_m",
    ),
];

/// The checks for mistakes.
const PLAUSIBILITY: Key = key(
    "plausibility",
    Kind::Words(words_of::<Plausibility>),
    "what to do about pairs that look like a mistake, such as another exposure, scene or gaze",
);

/// How frames are read.
const SIGNAL: &[Key] = &[
    key("channels", Kind::Words(words_of::<SignalChannels>), "channels to compare"),
    key("exposure_stops", Kind::Number(-100.0, 100.0), "exposure of linear input, stops"),
    key("tonemap", Kind::Words(words_of::<ToneMap>), "tone map of linear input"),
    key(
        "transfer",
        Kind::Words(words_of::<Option<Transfer>>),
        "how values in the files are encoded",
    ),
    key(
        "layer",
        Kind::Text,
        "colour layer of OpenEXR files that have several, of reference and tests alike",
    ),
    key("nonfinite", Kind::Words(words_of::<Nonfinite>), "treatment of NaN and infinity"),
    PLAUSIBILITY,
    key(
        "alpha",
        Kind::Words(words_of::<AlphaPolicy>),
        "treatment of alpha that is not 1 everywhere",
    ),
    key("range", Kind::Words(words_of::<Option<CodeRange>>), "code range of y4m video"),
    key(
        "matrix",
        Kind::Words(words_of::<Option<ColourMatrix>>),
        "matrix from Y', Cb and Cr of y4m video to R'G'B'",
    ),
    key("mask", Kind::Text, "mask image: white pixels are scored"),
    key(
        "crop",
        Kind::List(&PIXELS, 4, 4),
        "[x, y, width, height] to score, in pixels; the view describes this crop",
    ),
    key(
        "max_megapixels",
        Kind::Whole(1, 100_000),
        "largest number of pixels that a file may declare, in millions",
    ),
    key(
        "motion",
        Kind::Either(&[GUIDES, Kind::Table(MOTION)]),
        "backward motion vectors: \"auto\", \"none\", the renderer, or { channels = [\"Vector.X\", \"Vector.Y\"], sign = [1, -1] }",
    ),
    key(
        "depth",
        Kind::Either(&[GUIDES, Kind::Table(DEPTH)]),
        "depth: \"auto\", \"none\", the renderer, or { channel = \"Z\" }",
    ),
];

/// The presets for motion or depth: automatic detection, or the name of the renderer.
const GUIDES: Kind = Kind::Words(guides);
const PRESET: Kind = Kind::Words(words_of::<GuidePreset>);

fn guides() -> Vec<&'static str> {
    ["auto", "none"].into_iter().chain(words_of::<GuidePreset>()).collect()
}
const CHANNEL_SCALE: Kind = Kind::Number(-1e9, 1e9);

const MOTION: &[Key] = &[
    key("channels", Kind::List(&Kind::Text, 2, 2), "names of the channels for x and y"),
    key("preset", PRESET, "the renderer, instead of channels"),
    key(
        "encoding",
        PRESET,
        "a renderer whose encoding applies to channels, instead of sign, scale and unit",
    ),
    key(
        "sign",
        Kind::List(&Kind::Number(-1.0, 1.0), 2, 2),
        "1 or -1 for each channel, so that x points right, y points down, and both point back to the previous frame",
    ),
    key(
        "scale",
        Kind::Either(&[CHANNEL_SCALE, Kind::List(&CHANNEL_SCALE, 2, 2)]),
        "how many units a channel value of 1 stands for",
    ),
    key(
        "unit",
        Kind::Words(words_of::<MotionUnit>),
        "pixels, widths and heights of the frame, or halves of these (-1 to 1 across)",
    ),
    key("files", Kind::Text, "separate OpenEXR files, which pair with the reference frames"),
];

const DEPTH: &[Key] = &[
    key("channel", Kind::Text, "name of the channel"),
    key("preset", PRESET, "the renderer, instead of a channel"),
    key("files", Kind::Text, "separate OpenEXR files, which pair with the reference frames"),
];

/// The photometry of a display.
const LUMINANCE: &[Key] = &[
    required("peak_cd_m2", Kind::Number(0.01, 1e6), "luminance of white, cd/m²"),
    key(
        "contrast",
        Kind::Number(1.0, 1e12),
        "contrast: peak over black in the dark; default 500 if min_cd_m2 is not given",
    ),
    key(
        "min_cd_m2",
        Kind::Number(0.0, 1e6),
        "luminance of black in the dark, cd/m², instead of contrast",
    ),
    key("ambient_lux", Kind::Number(0.0, 1e6), "light falling on the screen, lux (default 0)"),
    key(
        "reflectivity",
        Kind::Number(0.0, 1.0),
        "share of this light that the screen reflects (default 0.005)",
    ),
    key(
        "eotf",
        Kind::Words(words_of::<Eotf>),
        "transfer function of the display's input; linear and absolute are in cd/m² (default srgb)",
    ),
    key("gamma", Kind::Number(0.1, 10.0), "exponent of eotf = \"gamma\" (default 2.2)"),
];

/// Keys that both eyes share.
const SHARED: &[Key] = &[
    key(
        "luminance",
        Kind::Either(&[Kind::Display, Kind::Table(LUMINANCE)]),
        "photometry of the display, for FovVideoVDP and PU-PSNR: the name of a preset, or { peak_cd_m2 = 100, contrast = 1000, … }; default: that of display",
    ),
    key("eccentricity", Kind::Words(words_of::<EccentricityKind>), "how eccentricity is measured"),
    key(
        "bands_deg",
        Kind::List(&BAND_EDGE, 2, BandEdges::MAX_BANDS + 1),
        "edges of the eccentricity bands, °",
    ),
];

static VIEW_EYE: [Key; VIEW.len() + 1] = joined(&[VIEW, EYE_GAZE]);
static SIGNAL_EYE: [Key; SIGNAL.len()] = joined(&[SIGNAL]);
static SCENE_EYE: [Key; VIEW.len() + 1 + SIGNAL.len()] = joined(&[VIEW, EYE_GAZE, SIGNAL]);

static VIEW_TABLE: [Key; VIEW.len() + 1 + SHARED.len() + 2] = joined(&[
    VIEW,
    VIEW_GAZE,
    SHARED,
    &[
        key("left", Kind::Table(&VIEW_EYE), "settings that differ for the left eye"),
        key("right", Kind::Table(&VIEW_EYE), "settings that differ for the right eye"),
    ],
]);

static SIGNAL_TABLE: [Key; SIGNAL.len() + 2] = joined(&[
    SIGNAL,
    &[
        key("left", Kind::Table(&SIGNAL_EYE), "settings that differ for the left eye"),
        key("right", Kind::Table(&SIGNAL_EYE), "settings that differ for the right eye"),
    ],
]);

static SCENE_TABLE: [Key; 11 + VIEW.len() + 1 + SHARED.len() + SIGNAL.len() + 2] = joined(&[
    &[
        required("name", Kind::Name, "its name in results, and what {scene} stands for"),
        key(
            "reference",
            FILES,
            "reference frames: file, folder, glob or pattern (%04d, ####), or { left, right }",
        ),
        key("builtin", Kind::Word(BUILTIN), "instead of reference: a scene that needs no files"),
        key(
            "resolution",
            Kind::Resolution(BuiltinSpec::MOST_SIDE),
            "size of the frames of a built-in scene; default: that of the display",
        ),
        key(
            "samples",
            Kind::Whole(1, 4096),
            "samples for each pixel of a built-in scene; default: 16",
        ),
        key("seed", Kind::Whole(0, u32::MAX as i64), "seed of a built-in scene; default: 1"),
        key(
            "ipd_mm",
            Kind::Number(0.0, 200.0),
            "distance between the pupils: gives a built-in scene two eyes",
        ),
        key("folder", Kind::Text, "what {folder} stands for in paths; default: the scene's name"),
        key("fps", Kind::Above(0.0, 1e6), "frames per second"),
        key(
            "frames",
            Kind::Either(&[Kind::Frames, Kind::Whole(1, 1_000_000)]),
            "only these frames; for a built-in scene, their number",
        ),
        key("allow_missing", Kind::Bool, "skip frames without a partner"),
    ],
    VIEW,
    VIEW_GAZE,
    SHARED,
    SIGNAL,
    &[
        key("left", Kind::Table(&SCENE_EYE), "settings that differ for the left eye"),
        key("right", Kind::Table(&SCENE_EYE), "settings that differ for the right eye"),
    ],
]);

/// The layers of a method's tests in scenes with two eyes.
const LAYER_SIDES: &[Key] = &[
    key("left", Kind::Text, "layer of the left eye's tests"),
    key("right", Kind::Text, "layer of the right eye's tests"),
];

static METHOD_TABLE: [Key; 5] = [
    required("name", Kind::Name, "its name in results, and what {method} stands for"),
    key("test", FILES, "test frames, with {scene}, {folder}, {method} and {eye} for what differs"),
    key(
        "emulate",
        Kind::Emulation,
        "instead of test: the method is emulated from the reference, { model = \"rmfr\", sigma = 2.6 }",
    ),
    key("scenes", NAMES, "only these scenes"),
    key(
        "layer",
        Kind::Either(&[Kind::Text, Kind::Table(LAYER_SIDES)]),
        "colour layer of its tests, if it differs from the reference's; or { left, right }",
    ),
];

static OUTPUT: [Key; 3] = [
    key(
        "tables",
        Kind::List(&Kind::Words(words_of::<TableFormat>), 1, 2),
        "files with the table of all values: [\"csv\"], [\"csv\", \"parquet\"] or [\"parquet\"]",
    ),
    key(
        "spreadsheet_safe",
        Kind::Bool,
        "an apostrophe before names in CSV files that a spreadsheet would take for a formula",
    ),
    key(
        "maps",
        Kind::List(&Kind::Metric, 1, 16),
        "metrics whose maps are written for every frame, into the folder maps of the results: [\"ssim\", \"fvvdp\"]",
    ),
];

static REPORT: [Key; 3] = [
    key(
        "size",
        Kind::Whole(64, 4096),
        "longer side of the pictures on the page, in pixels (default 512)",
    ),
    key(
        "frames",
        Kind::List(
            &Kind::Either(&[Kind::Words(words_of::<FrameWord>), Kind::Whole(0, 1_000_000_000)]),
            0,
            100,
        ),
        "frames of each scene with pictures (default [\"worst\", \"median\", \"first\"]): these words, or numbers of frames; [] for no pictures",
    ),
    key(
        "metric",
        Kind::Metric,
        "the metric that ranks frames (default: the first that is scored of fpsnr, fssim, psnr, ssim, ms_ssim, pu_psnr, gmsd, mse, then of the others that score frames)",
    ),
];

static PLOT_TABLE: [Key; PLOT.len() + TABLE_KEYS.len()] = joined(&[PLOT, TABLE_KEYS]);

/// A region of frames for a figure.
const REGION: &[Key] = &[
    required("name", Kind::Name, "its name in the figure"),
    required("at", POSITION_PAIR, "its centre in pixels, [x, y]"),
    required("size", Kind::List(&Kind::Whole(1, 4096), 2, 2), "its width and height in pixels"),
    key("scene", Kind::Name, "only in this scene; default: in each scene"),
    key("frame", Kind::Whole(0, 1_000_000_000), "number of the frame; default: the first one"),
];

const PLOT: &[Key] = &[
    required(
        "kind",
        Kind::Words(words_of::<PlotKind>),
        "table: methods against metrics in each scene; profile: a metric against eccentricity; bars: a metric per scene and method; frames: its spread over frames; sequence: frame by frame, saccades marked; ratio_profile: test / reference against eccentricity; crops: regions of the reference and all methods side by side; ratios: table of test / reference by eccentricity; sweep: a metric over the parameters of a sweep; optima: table of the best points of sweeps; budgets: table of budgets and how they were met",
    ),
    key("metric", Kind::Metric, "the metric; default: one figure per metric"),
    METRICS,
    key("scenes", NAMES, "only these scenes"),
    key("methods", NAMES, "only these methods"),
    key(
        "levels",
        Kind::List(&Kind::Whole(1, 8), 1, 8),
        "levels of the wavelet, with one panel or column each; default: all",
    ),
    key(
        "statistic",
        Kind::Word(&["mean_abs", "max_abs", "energy"]),
        "statistic of the wavelet; default: energy",
    ),
    key(
        "error_bars",
        Kind::Words(words_of::<ErrorBars>),
        "error bars over the frames of a scene, or over scenes where their mean is shown: se (standard error), ci95 (95 % confidence interval), sd (standard deviation); for bars and profile",
    ),
    key(
        "regions",
        Kind::Tables(REGION, 100),
        "regions to show: [{ name = \"…\", at = [x, y], size = [64, 64] }]; for crops",
    ),
    key("shape", Kind::Words(words_of::<SpreadShape>), "box or violin; for frames"),
    key("figure", Kind::Table(&FIGURES), "how its figures are printed; default: as [figures]"),
    key(
        "caption",
        Kind::Text,
        "caption of the table or figure, as plain text; default: a description of the content",
    ),
];

/// A range of values in a sweep.
pub(crate) const SWEEP_RANGE: &[Key] = &[
    required("from", FINITE, "the first value"),
    required("to", FINITE, "the last value"),
    required("steps", Kind::Whole(2, 100_000), "number of values, both ends included"),
    key("scale", Kind::Word(&["linear", "log"]), "equal differences (the default) or equal ratios"),
];

const FINITE: Kind = Kind::Number(-1e12, 1e12);

static EXPERIMENT_TABLE: [Key; 19] = [
    key("schema", Kind::Whole(1, 1), "version of this format"),
    required("name", Kind::Name, "name of the experiment, and of its folder below reports/"),
    key("about", Kind::Text, "description of what it shows, for its page"),
    key("view", Kind::Table(&VIEW_TABLE), "view of the frames"),
    key("signal", Kind::Table(&SIGNAL_TABLE), "how frames are read"),
    PLAUSIBILITY,
    required("scene", Kind::Tables(&SCENE_TABLE, 10_000), "the scenes"),
    required("method", Kind::Tables(&METHOD_TABLE, 1000), "the methods"),
    key(
        "metrics",
        Kind::Metrics,
        "the metrics with their parameters; default: the default metrics",
    ),
    key(
        BUDGET,
        SHARE,
        "samples of each emulated method that has a parameter to set, as a share of the frame's pixels",
    ),
    key("budget_of", Kind::Words(words_of::<BudgetSamples>), "which samples budget counts"),
    key(
        "sweep",
        Kind::Sweep,
        "values of keys of emulated methods, each point of the grid a run: \"RMFR.fx\" = [0.1, 0.2], or { from, to, steps, scale }; budget = […] is for all methods",
    ),
    key("output", Kind::Table(&OUTPUT), "how the results are written"),
    key("report", Kind::Table(&REPORT), "what the page of the run shows of the frames"),
    key(
        "plot",
        Kind::Tables(&PLOT_TABLE, 1000),
        "tables and figures; if none is given, all that fit",
    ),
    key("figures", Kind::Table(&FIGURES), "how figures are printed"),
    key(
        "study",
        Kind::Table(&OPINIONS),
        "mean opinion scores, which the scores of the metrics are compared with",
    ),
    key("gate", Kind::Tables(&GATE_TABLE, 1000), "the rules of `fovqa gate`"),
    key(
        "baseline",
        Kind::Either(&[Kind::Text, Kind::List(&Kind::Text, 1, 100)]),
        "baseline files of `fovqa gate`, such as one for each machine: the one that the run matches best counts",
    ),
];

/// The top-level keys of the file.
pub(crate) const EXPERIMENT: &[Key] = &EXPERIMENT_TABLE;
