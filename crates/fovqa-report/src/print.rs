//! What an experiment says about figures, applied to a figure: its style, axes and files.

use fovqa_plan::{
    AxisScale, AxisSettings, Colour, FigureFormat, FigureSettings, PaletteChoice, PaletteName,
};
use fovqa_plot::{Axis, Figure, Height, Palette, Style};

/// Pixels of a PNG per inch.
pub(crate) const PNG_DPI: f32 = 300.0;

/// The files of a figure if nothing else was asked for.
const ALL: [FigureFormat; 3] = [FigureFormat::Svg, FigureFormat::Pdf, FigureFormat::Png];

/// The files of a figure, in a fixed order.
pub(crate) fn formats(settings: &FigureSettings) -> Vec<FigureFormat> {
    let wanted = |format: &FigureFormat| {
        settings.formats.as_ref().is_none_or(|formats| formats.contains(format))
    };
    ALL.into_iter().filter(wanted).collect()
}

/// The style of a figure.
pub(crate) fn style(settings: &FigureSettings) -> Style {
    let usual = Style::default();
    let height = match (settings.height_in, settings.aspect) {
        (Some(inches), _) => Height::Inches(inches),
        (None, Some(aspect)) => Height::Aspect(aspect),
        (None, None) => Height::Suited,
    };
    Style {
        width_in: settings.width_in,
        height,
        font_pt: settings.font_pt.unwrap_or(usual.font_pt),
        title: settings.title.unwrap_or(usual.title),
        markers: settings.markers.unwrap_or(usual.markers),
        line_styles: settings.line_styles.unwrap_or(usual.line_styles),
        palette: settings.palette.as_ref().and_then(palette).unwrap_or(usual.palette),
    }
}

/// The style of a figure. The height of pictures follows from their width, so that one that is meant
/// for other figures does not apply to them.
pub(crate) fn style_of(figure: &Figure, settings: &FigureSettings) -> Style {
    let style = style(settings);
    match figure {
        Figure::Montage(_) | Figure::Raster(_) => Style { height: Height::Suited, ..style },
        Figure::Line(_) | Figure::Bar(_) | Figure::Spread(_) | Figure::Panels(_) => style,
    }
}

fn palette(choice: &PaletteChoice) -> Option<Palette> {
    match choice {
        PaletteChoice::Named(PaletteName::OkabeIto) => Some(Palette::OKABE_ITO),
        PaletteChoice::Named(PaletteName::TolBright) => Some(Palette::TOL_BRIGHT),
        PaletteChoice::Named(PaletteName::Gray) => Some(Palette::GRAY),
        PaletteChoice::Colours(colours) => {
            Palette::new(&colours.iter().map(|Colour(rgb)| *rgb).collect::<Vec<_>>())
        }
    }
}

/// Gives the axes of a figure their settings.
pub(crate) fn set_axes(figure: &mut Figure, settings: &FigureSettings) {
    let FigureSettings { x, y, .. } = settings;
    match figure {
        Figure::Line(chart) => {
            set(&mut chart.x, x);
            set(&mut chart.y, y);
        }
        Figure::Panels(chart) => {
            for panel in &mut chart.panels {
                set(&mut panel.x, x);
                set(&mut panel.y, y);
            }
        }
        Figure::Bar(chart) => set(&mut chart.y, y),
        Figure::Spread(chart) => set(&mut chart.y, y),
        Figure::Montage(_) => {}
        Figure::Raster(chart) => {
            for panel in &mut chart.panels {
                set(&mut panel.x, &title_of(x));
                set(&mut panel.y, &title_of(y));
            }
        }
    }
}

fn set(axis: &mut Axis, settings: &AxisSettings) {
    if let Some(scale) = settings.scale {
        axis.log = scale == AxisScale::Log;
    }
    axis.min = settings.min.or(axis.min);
    axis.max = settings.max.or(axis.max);
    if let Some(label) = &settings.label {
        axis.title.clone_from(label);
    }
}

/// The title alone: the axes of a picture are those of its plane.
fn title_of(settings: &AxisSettings) -> AxisSettings {
    AxisSettings { label: settings.label.clone(), ..AxisSettings::default() }
}

#[cfg(test)]
mod tests {
    use fovqa_plot::LineChart;

    use super::*;

    #[test]
    fn settings_reach_the_axes_and_keep_the_rest() {
        let y = AxisSettings {
            scale: Some(AxisScale::Log),
            max: Some(9.0),
            label: Some("dB".to_owned()),
            ..AxisSettings::default()
        };
        let settings = FigureSettings { y, ..FigureSettings::default() };
        let limited = Axis { min: Some(1.0), max: Some(2.0), ..Axis::new("PSNR") };
        let mut figure = Figure::Line(LineChart { y: limited, ..LineChart::default() });
        set_axes(&mut figure, &settings);
        let Figure::Line(chart) = figure else { unreachable!() };
        let want = Axis { log: true, min: Some(1.0), max: Some(9.0), ..Axis::new("dB") };
        assert_eq!((chart.y, chart.x), (want, Axis::default()));
    }

    #[test]
    fn the_largest_side_of_a_png_is_one_that_can_be_written() {
        let most = FigureSettings::MOST_PNG_IN;
        let side = |inches: f64| {
            let settings = FigureSettings { width_in: Some(inches), ..FigureSettings::default() };
            let figure = Figure::Line(LineChart::default());
            figure.print(&style(&settings)).unwrap().check_png(PNG_DPI)
        };
        assert!(side(most).is_ok() && side(most + 0.1).is_err());
    }

    #[test]
    fn files_are_written_in_one_order() {
        let wanted = vec![FigureFormat::Png, FigureFormat::Svg];
        let some = FigureSettings { formats: Some(wanted), ..FigureSettings::default() };
        assert_eq!(formats(&some), [FigureFormat::Svg, FigureFormat::Png]);
        assert_eq!(formats(&FigureSettings::default()), ALL);
    }
}
