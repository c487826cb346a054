//! `[figures]`, and `figure` of a single plot.

use fovqa_params::Words;
use fovqa_plan::{
    AxisScale, AxisSettings, Colour, FigureForm, FigureFormat, FigureSettings, PaletteChoice,
    PaletteName,
};

use crate::fault::{Fault, Faults};
use crate::node::Node;

/// The settings of a table, and those of `all` where it has none.
pub(super) fn figure(
    table: Option<Node<'_>>,
    all: &FigureSettings,
    faults: &mut Faults,
) -> FigureSettings {
    let Some(table) = table else { return all.clone() };
    if table.has("height_in") && table.has("aspect") {
        let fault = Fault::new(table.span("aspect"), "height_in and aspect both set the height");
        faults.push(fault.help("remove one of them"));
    }
    let formats = table.names("formats").map(|names| {
        let mut formats: Vec<FigureFormat> = Vec::new();
        for format in names.iter().filter_map(|(name, _)| FigureFormat::find(name)) {
            if !formats.contains(&format) {
                formats.push(format);
            }
        }
        formats
    });
    let own = FigureSettings {
        width_in: table.number("width_in"),
        height_in: table.number("height_in"),
        aspect: table.number("aspect"),
        font_pt: table.number("font_pt"),
        title: table.flag("title"),
        markers: table.flag("markers"),
        line_styles: table.flag("line_styles"),
        palette: palette(table, faults),
        formats,
        x: axis(table, "x"),
        y: axis(table, "y"),
    };
    let settings = own.over(all);
    check_png(table, &settings, faults);
    for (name, axis) in [("x", &settings.x), ("y", &settings.y)] {
        check_axis(table, name, axis, faults);
    }
    settings
}

/// Checks that the settings in `figure` of a plot have an effect. `form` is what its figures are made
/// of; `None` if it is a table.
pub(super) fn has_effect(
    plot: Node<'_>,
    form: Option<FigureForm>,
    kind: &str,
    settings: impl FnOnce() -> FigureSettings,
    faults: &mut Faults,
) {
    let Some(table) = plot.table("figure") else { return };
    let Some(form) = form else {
        let message = format!("figure has no effect on {kind}, which is a table");
        faults.push(Fault::new(plot.span("figure"), message).help("remove it"));
        return;
    };
    for key in form.without_effect(&settings()) {
        let span = match key.split_once('.') {
            Some((axis, key)) => table.table(axis).map(|axis| axis.span(key)).unwrap_or_default(),
            None => table.span(&key),
        };
        let help = match (form, key.as_str()) {
            (FigureForm::Maps | FigureForm::Photos, "height_in" | "aspect") => {
                "remove it: the height of pictures follows from their width; set width_in"
            }
            _ => "remove it",
        };
        faults.push(Fault::new(span, format!("{key} has no effect on {kind}")).help(help));
    }
}

/// Checks that a figure is not too large for PNG, as far as its settings say how large it is.
fn check_png(table: Node<'_>, settings: &FigureSettings, faults: &mut Faults) {
    const MOST: f64 = FigureSettings::MOST_PNG_IN;
    let FigureSettings { width_in, height_in, aspect, .. } = *settings;
    let of_aspect = width_in.zip(aspect).map(|(width, aspect)| ("aspect", width / aspect));
    let sides = [width_in.map(|width| ("width_in", width)), height_in.map(|h| ("height_in", h))];
    let mut sides = sides.into_iter().chain([of_aspect]).flatten();
    let Some((key, inches)) = sides.find(|(_, inches)| *inches > MOST) else { return };
    if settings.has_png() {
        let span = [key, "width_in", "formats"].into_iter().find(|key| table.has(key));
        let span = span.map_or(0..0, |key| table.span(key));
        let message = format!(
            "a side of {inches:.1} in is too long for PNG, which can have at most {MOST} in"
        );
        let help = format!("write at most {MOST} in, or formats = [\"pdf\", \"svg\"]");
        faults.push(Fault::new(span, message).help(help));
    }
}

fn palette(table: Node<'_>, faults: &mut Faults) -> Option<PaletteChoice> {
    let Some(colours) = table.names("palette") else {
        return table.word::<PaletteName>("palette").map(PaletteChoice::Named);
    };
    let mut found = Vec::new();
    for (text, span) in colours {
        if let Some(colour) = Colour::of(text) {
            found.push(colour);
        } else {
            let fault = Fault::new(span, format!("\"{text}\" is not a colour"));
            faults.push(fault.help("write colours as \"#0072b2\": red, green and blue"));
        }
    }
    Some(PaletteChoice::Colours(found))
}

fn axis(table: Node<'_>, name: &str) -> AxisSettings {
    let Some(table) = table.table(name) else { return AxisSettings::default() };
    AxisSettings {
        scale: table.word("scale"),
        min: table.number("min"),
        max: table.number("max"),
        label: table.text("label").map(str::to_owned),
    }
}

/// Checks that an axis can have its ends.
fn check_axis(table: Node<'_>, name: &str, axis: &AxisSettings, faults: &mut Faults) {
    let Some(own) = table.table(name) else { return };
    let place = |key: &str| if own.has(key) { own.span(key) } else { table.span(name) };
    if let (Some(min), Some(max)) = (axis.min, axis.max)
        && min >= max
    {
        let message = format!("the {name} axis would end at {max}, before it begins at {min}");
        faults.push(Fault::new(place("max"), message).help("max must be above min"));
    }
    if axis.scale == Some(AxisScale::Log) {
        for (key, end) in [("min", axis.min), ("max", axis.max)] {
            if let Some(end) = end.filter(|end| *end <= 0.0) {
                let message = format!("a logarithmic axis has no place for {end}");
                faults.push(Fault::new(place(key), message).help(format!("{key} must be above 0")));
            }
        }
    }
}
