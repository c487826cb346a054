//! The looks of curves: a curve of the file has the same colour, dash and marker in every figure.

use fovqa_methods::curves::Curve;
use fovqa_plan::PanelOf;
use fovqa_plot::Look;

use super::Source;
use super::labels::Labels;

/// The looks of the curves of a figure.
pub(super) struct Looks {
    /// The names in the order of the file.
    names: Vec<String>,
    /// Name and label of each series of the figure, in its order.
    series: Vec<(String, String)>,
    /// Whether all series are of one curve of the file.
    alone: bool,
}

impl Looks {
    pub(super) fn of(
        source: &Source<'_>,
        shown: &[&Curve],
        labels: &Labels,
        panels: PanelOf,
    ) -> Self {
        let mut names: Vec<String> = Vec::new();
        for curve in source.curves {
            if !names.contains(&curve.spec.name) {
                names.push(curve.spec.name.clone());
            }
        }
        let mut series: Vec<(String, String)> = Vec::new();
        for curve in shown {
            let one = (curve.spec.name.clone(), labels.label(curve, panels));
            if !series.contains(&one) {
                series.push(one);
            }
        }
        let alone = series.iter().all(|(name, _)| *name == series[0].0);
        Self { names, series, alone }
    }

    /// The look of a series: that of its place in the file. If several settings of a method are in
    /// one panel, they have its colour with other dashes, or, without other methods, other colours.
    pub(super) fn look(&self, name: &str, label: &str) -> Look {
        let index = self.names.iter().position(|known| known == name).unwrap_or_default();
        let mut of_name = self.series.iter().filter(|(known, _)| known == name);
        let variant = of_name.position(|(_, known)| known == label).unwrap_or_default();
        if self.alone { Look::new(index + variant) } else { Look::new(index).with_variant(variant) }
    }

    /// The look of a curve of the file, whatever its setting.
    pub(super) fn of_name(&self, curve: &Curve) -> Look {
        let index = self.names.iter().position(|known| *known == curve.spec.name);
        Look::new(index.unwrap_or_default())
    }

    /// The look of what is drawn beside the curves.
    pub(super) fn beside(&self, i: usize) -> Look {
        Look::new(self.names.len().max(self.series.len()) + i)
    }
}
