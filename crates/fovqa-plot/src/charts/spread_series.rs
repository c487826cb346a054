//! The distributions of one series.

use crate::canvas::look::Look;
use crate::marks::legend::Key;
use crate::scales::scale::AxisPlace;

/// From this number of values on, a box shows more than single points.
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
    /// Its key in the legend: a box if the chart has one.
    pub(crate) fn key(&self) -> Key {
        let boxed = |values: &Vec<f64>| finite(values).len() >= BOX_FROM;
        let box_or_empty = self.values.iter().any(boxed) || self.values.iter().all(Vec::is_empty);
        if box_or_empty { Key::Box(self.look) } else { Key::Marker(self.look) }
    }
}

/// The values that the axis can show.
pub(crate) fn finite(values: &[f64]) -> Vec<f64> {
    values.iter().filter_map(|v| AxisPlace::of(*v).and_then(AxisPlace::finite)).collect()
}
