//! The keys of `[figures]`, and of `figure` of a single plot.

use fovqa_params::words_of;
use fovqa_plan::{AxisScale, FigureFormat, PaletteName};

use super::keys::key;
use super::{Key, Kind};

/// Palettes have at most this number of colours.
const MOST_COLOURS: usize = 12;

const AXIS: &[Key] = &[
    key("scale", Kind::Words(words_of::<AxisScale>), "linear or log"),
    key("min", Kind::Number(-1e300, 1e300), "first value of the axis"),
    key("max", Kind::Number(-1e300, 1e300), "last value of the axis"),
    key("label", Kind::Text, "title of the axis"),
];

const FORMATS: Kind = Kind::Words(words_of::<FigureFormat>);

const PALETTE: [Kind; 2] =
    [Kind::Words(words_of::<PaletteName>), Kind::List(&Kind::Text, 1, MOST_COLOURS)];

/// How figures are printed.
pub(super) static FIGURES: [Key; 11] = [
    key("width_in", Kind::Number(0.5, 100.0), "width in print, in; columns have 3.3, pages 7"),
    key("height_in", Kind::Number(0.5, 100.0), "height in print, in"),
    key("aspect", Kind::Number(0.1, 10.0), "width divided by height, instead of height_in"),
    key("font_pt", Kind::Number(6.0, 40.0), "size of the smallest text in print, pt; default: 7"),
    key("title", Kind::Bool, "whether the title is shown; captions of papers make it needless"),
    key("markers", Kind::Bool, "whether curves have markers"),
    key(
        "line_styles",
        Kind::Bool,
        "whether dashes and hatches tell series apart, and not only colours and markers",
    ),
    key(
        "palette",
        Kind::Either(&PALETTE),
        "colours of series: a name, or a list such as [\"#0072b2\"]",
    ),
    key(
        "formats",
        Kind::List(&FORMATS, 1, 3),
        "files of each figure beside its data; default: all",
    ),
    key("x", Kind::Table(AXIS), "the horizontal axis"),
    key("y", Kind::Table(AXIS), "the vertical axis"),
];
