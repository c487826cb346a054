//! The meaning of the values of motion channels.

use super::options::MotionUnit;
use super::preset::GuidePreset;

/// The meaning of the values of motion channels: the motion in pixels is
/// `(sample - offset) * sign * scale`, multiplied by the size of the unit in pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Encoding {
    pub(crate) sign: [f64; 2],
    pub(crate) scale: [f64; 2],
    pub(crate) unit: MotionUnit,
    /// The sample that stands for no motion.
    pub(crate) offset: f32,
}

impl Encoding {
    /// Values are in pixels, x to the right and y down.
    pub(crate) const PIXELS: Self =
        Self { sign: [1.0; 2], scale: [1.0; 2], unit: MotionUnit::Pixels, offset: 0.0 };

    /// Pixels of motion per unit of a sample, in a display window of `size`.
    pub(crate) fn pixels(&self, size: [usize; 2]) -> [f64; 2] {
        std::array::from_fn(|i| {
            let unit = match self.unit {
                MotionUnit::Pixels => 1.0,
                MotionUnit::Frame => size[i] as f64,
                MotionUnit::Ndc => size[i] as f64 / 2.0,
            };
            self.sign[i] * self.scale[i] * unit
        })
    }
}

/// The motion in frame sizes for a difference of 1 from 0.5 in Unreal's encoding.
/// [`GuidePreset::Unreal`] names the source.
const UNREAL_FRAMES: f64 = 2.0;

impl GuidePreset {
    pub(crate) fn encoding(self) -> Encoding {
        let frame = Encoding { unit: MotionUnit::Frame, ..Encoding::PIXELS };
        match self {
            Self::Blender => Encoding { sign: [1.0, -1.0], ..Encoding::PIXELS },
            Self::Falcor => frame,
            Self::Unreal => {
                let scale = [UNREAL_FRAMES; 2];
                Encoding { sign: [-1.0, 1.0], scale, offset: 0.5, ..frame }
            }
            Self::Mitsuba => Encoding::PIXELS,
        }
    }

    /// Whether the motion is in pixels, x to the right and y down, which is also the default for
    /// channels that the user names.
    pub fn is_plain(self) -> bool {
        self.encoding() == Encoding::PIXELS
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "products of small whole numbers are exact")]
mod tests {
    use super::*;

    #[test]
    fn units_are_those_of_the_display_window() {
        let pixels = |unit| {
            let encoding = Encoding { sign: [1.0, -1.0], scale: [2.0, 3.0], unit, offset: 0.5 };
            encoding.pixels([640, 480])
        };
        assert_eq!(pixels(MotionUnit::Pixels), [2.0, -3.0]);
        assert_eq!(pixels(MotionUnit::Frame), [1280.0, -1440.0]);
        assert_eq!(pixels(MotionUnit::Ndc), [640.0, -720.0]);
    }
}
