//! Draws a metric against eccentricity from values that a program has, without the files of a run.

use fovqa_metrics::Metric;
use fovqa_plan::{FigureFormat, FigureSettings};
use fovqa_plot::{Figure, LineChart, Look};

use crate::figures::{Band, chart};
use crate::print::{PNG_DPI, set_axes, style_of};
use crate::sheet::ReportError;

/// A line of a profile.
#[derive(Debug, Clone, PartialEq)]
pub struct ProfileLine {
    /// Its name in the legend.
    pub name: String,
    /// Whether it belongs to the reference, which is dashed.
    pub is_reference: bool,
    /// The values by eccentricity.
    pub bands: Vec<Band>,
}

/// The figure of a metric against eccentricity as a file; `None` if no line has a band.
///
/// # Errors
/// When the figure does not fit into the size that the settings ask for.
pub fn profile_picture(
    metric: Metric,
    lines: &[ProfileLine],
    title: Option<&str>,
    settings: &FigureSettings,
    format: FigureFormat,
) -> Result<Option<Vec<u8>>, ReportError> {
    let mut methods = 0;
    let series = lines.iter().map(|line| {
        let look = Look::new(methods);
        methods += usize::from(!line.is_reference);
        (line.name.as_str(), look, line.bands.clone())
    });
    let Some(mut chart) = chart(metric, series) else { return Ok(None) };
    for series in &mut chart.series {
        let line = lines.iter().find(|line| line.name == series.name);
        series.reference = line.is_some_and(|line| line.is_reference);
    }
    let mut figure = Figure::Line(LineChart { title: title.map(str::to_owned), ..chart });
    set_axes(&mut figure, settings);
    let name = || format!("profile of {}", metric.info().label);
    let failed = |error| ReportError::Plot { name: name(), error };
    let printed = figure.print(&style_of(&figure, settings)).map_err(failed)?;
    let bytes = match format {
        FigureFormat::Svg => printed.svg().map(String::into_bytes),
        FigureFormat::Pdf => printed.pdf(title.unwrap_or(&name())),
        FigureFormat::Png => printed.png(PNG_DPI),
    };
    bytes.map(Some).map_err(failed)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(name: &str, is_reference: bool, values: &[f64]) -> ProfileLine {
        let band = |(nth, value): (usize, &f64)| Band {
            from_deg: nth as f64 * 5.0,
            to_deg: nth as f64 * 5.0 + 5.0,
            value: Some(*value),
            error: None,
        };
        ProfileLine {
            name: name.to_owned(),
            is_reference,
            bands: values.iter().enumerate().map(band).collect(),
        }
    }

    #[test]
    fn each_line_is_in_the_picture_and_the_legend() {
        let lines = [line("first", false, &[30.0, 28.0]), line("second", false, &[31.0, 25.0])];
        let settings = FigureSettings::default();
        let draw = |lines: &[ProfileLine], format| {
            profile_picture(Metric::Psnr, lines, Some("hall"), &settings, format).unwrap()
        };
        let svg = String::from_utf8(draw(&lines, FigureFormat::Svg).unwrap()).unwrap();
        for text in ["first", "second", "hall", "PSNR in dB", "Eccentricity"] {
            assert!(svg.contains(text), "{text}");
        }
        assert!(draw(&lines, FigureFormat::Pdf).unwrap().starts_with(b"%PDF"));
        assert!(draw(&lines, FigureFormat::Png).unwrap().starts_with(b"\x89PNG"));
        let dashed = [line("first", true, &[30.0, 28.0]), line("second", false, &[31.0, 25.0])];
        assert_ne!(draw(&dashed, FigureFormat::Svg), draw(&lines, FigureFormat::Svg));
        assert!(draw(&[line("none", false, &[])], FigureFormat::Svg).is_none());
    }
}
