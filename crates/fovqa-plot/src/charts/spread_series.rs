//! The distributions of one series.

use crate::canvas::look::Look;
use crate::marks::legend::Key;
use crate::scales::scale::AxisPlace;

/// From so many values on a box says more than they do.
pub(crate) const BOX_FROM: usize = 10;

/// The distributions of one series.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SpreadSeries {
    /// Its name in the legend.
    pub name: String,
    /// Its look.
    pub look: Look,
    /// The values of each group, in the order of the frames. NaN is left out.
    pub values: Vec<Vec<f64>>,
}

impl SpreadSeries {
    /// A box in the legend where there is one in the chart.
    pub(crate) fn key(&self) -> Key {
        let boxed = |values: &Vec<f64>| finite(values).len() >= BOX_FROM;
        let box_or_empty = self.values.iter().any(boxed) || self.values.iter().all(Vec::is_empty);
        if box_or_empty { Key::Box(self.look) } else { Key::Marker(self.look) }
    }
}

/// Values that stand on the axis.
pub(crate) fn finite(values: &[f64]) -> Vec<f64> {
    values.iter().filter_map(|v| AxisPlace::of(*v).and_then(AxisPlace::finite)).collect()
}
