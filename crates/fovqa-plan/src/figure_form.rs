//! Which settings of figures a kind of figure has.

use crate::curves::CurvePlotKind;
use crate::figures::FigureSettings;
use crate::plots::PlotKind;

/// What a figure is made of. It decides which settings have an effect.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FigureForm {
    /// Curves over an axis of numbers.
    Curves,
    /// Bars, boxes or violins in named groups, without an axis of numbers below them.
    Groups,
    /// Pictures of a quantity over the frame. Their axes are those of the frame.
    Maps,
    /// Regions of frames, without axes.
    Photos,
    /// Maps, curves or bars, whichever fits what was swept.
    Any,
}

/// The keys of an axis.
const AXIS: [&str; 4] = ["scale", "min", "max", "label"];

impl FigureForm {
    /// What figures of a kind of plot are made of; `None` for a table.
    pub fn of(kind: PlotKind) -> Option<Self> {
        match kind {
            PlotKind::Table | PlotKind::Ratios | PlotKind::Optima | PlotKind::Budgets => None,
            PlotKind::Profile | PlotKind::RatioProfile | PlotKind::Sequence => Some(Self::Curves),
            PlotKind::Bars | PlotKind::Frames => Some(Self::Groups),
            PlotKind::Crops => Some(Self::Photos),
            PlotKind::Sweep => Some(Self::Any),
        }
    }

    /// What figures of a kind of plot of curves are made of.
    pub fn of_curves(kind: CurvePlotKind) -> Self {
        match kind {
            CurvePlotKind::SamplesBars | CurvePlotKind::Values => Self::Groups,
            CurvePlotKind::Density | CurvePlotKind::Samples => Self::Maps,
            CurvePlotKind::Rates
            | CurvePlotKind::Accumulated
            | CurvePlotKind::HalfAxis
            | CurvePlotKind::Steps
            | CurvePlotKind::Outline
            | CurvePlotKind::Response => Self::Curves,
        }
    }

    /// Whether a key has an effect; keys of an axis are written as `x.min`.
    fn has(self, key: &str) -> bool {
        let keeps_sides = matches!(self, Self::Maps | Self::Photos);
        match key.split_once('.') {
            Some((_, "label")) if self == Self::Maps => true,
            Some(("x", _)) => matches!(self, Self::Curves | Self::Any),
            Some(_) => !keeps_sides,
            None => match key {
                "markers" => matches!(self, Self::Curves | Self::Any),
                "height_in" | "aspect" | "line_styles" | "palette" => !keeps_sides,
                _ => true,
            },
        }
    }

    /// The keys of settings that have no effect. An axis that has no effect at all is one key.
    pub fn without_effect(self, settings: &FigureSettings) -> Vec<String> {
        without_effect(settings, |key| self.has(key))
    }
}

/// The keys of `[figures]` that have no effect on any of the figures of a file.
pub fn without_effect_on_all(settings: &FigureSettings, forms: &[FigureForm]) -> Vec<String> {
    without_effect(settings, |key| forms.iter().any(|form| form.has(key)))
}

fn without_effect(settings: &FigureSettings, has: impl Fn(&str) -> bool) -> Vec<String> {
    let mut keys: Vec<String> = Vec::new();
    for key in settings.keys().into_iter().filter(|key| !has(key)) {
        let axis = key.split_once('.').map(|(axis, _)| axis);
        let has_axis = |axis: &str| AXIS.iter().any(|part| has(&format!("{axis}.{part}")));
        let key = axis.filter(|axis| !has_axis(axis)).map_or(key.clone(), str::to_owned);
        if !keys.contains(&key) {
            keys.push(key);
        }
    }
    keys
}

#[cfg(test)]
mod tests {
    use crate::figures::AxisSettings;

    use super::*;

    #[test]
    fn each_form_has_its_settings() {
        let axis = || AxisSettings {
            min: Some(1.0),
            max: Some(2.0),
            label: Some("a".to_owned()),
            ..AxisSettings::default()
        };
        let settings = FigureSettings {
            width_in: Some(3.0),
            aspect: Some(2.0),
            markers: Some(true),
            line_styles: Some(true),
            x: axis(),
            y: axis(),
            ..FigureSettings::default()
        };
        let of = |form: FigureForm| form.without_effect(&settings).join(" ");
        assert_eq!(of(FigureForm::Curves), "");
        assert_eq!(of(FigureForm::Groups), "markers x");
        assert_eq!(of(FigureForm::Maps), "aspect markers line_styles x.min x.max y.min y.max");
        assert_eq!(of(FigureForm::Photos), "aspect markers line_styles x y");
        let all = without_effect_on_all(&settings, &[FigureForm::Photos, FigureForm::Groups]);
        assert_eq!(all, ["markers", "x"]);
    }
}
