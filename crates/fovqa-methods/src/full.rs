//! Full shading: every pixel of the display is shaded once. Other methods are compared with it.

use crate::foveation::{Counts, Foveation, Mapping, Rates};
use crate::info::MethodInfo;
use crate::setting::{Place, Setting};

/// The entry in the list of methods.
pub(crate) const INFO: MethodInfo = MethodInfo {
    key: "full",
    label: "Full",
    about: "every pixel is shaded, at the display's own rate",
    source: "reference for the other methods",
    params: &[],
};

/// Full shading, applied to a frame.
#[derive(Debug, Clone, Copy)]
pub struct Full {
    setting: Setting,
}

impl Full {
    /// Applies full shading to a frame.
    pub fn new(setting: &Setting) -> Self {
        Self { setting: *setting }
    }
}

impl Mapping for Full {
    fn buffer(&self, _layer: usize) -> [f64; 2] {
        self.setting.size_px()
    }

    fn to_buffer(&self, _layer: usize, place: Place) -> [f64; 2] {
        let ([x, y], [gx, gy]) = (place.offset_px(), self.setting.gaze_px());
        [x + gx, y + gy]
    }

    fn to_screen(&self, _layer: usize, [x, y]: [f64; 2]) -> Place {
        let [gx, gy] = self.setting.gaze_px();
        Place::at([x - gx, y - gy])
    }

    fn is_polar(&self) -> bool {
        false
    }
}

impl Foveation for Full {
    fn rates(&self, _place: Place) -> Option<Rates> {
        Some(Rates::both(1.0))
    }

    fn counts(&self) -> Counts {
        Counts::of(self.setting.size_px(), self.setting.pixels())
    }

    fn mapping(&self) -> Option<&dyn Mapping> {
        Some(self)
    }
}
