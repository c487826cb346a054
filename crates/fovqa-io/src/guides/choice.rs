//! Names to look for, the first choice first.

use super::options::{DepthChannels, MotionChannels, MotionUnit, NamedMotion};
use super::preset::GuidePreset;

/// Where guides are looked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Place {
    /// In the file of the colour.
    BesideColour,
    /// In a file of their own, where a bare `X` or `R` can be nothing else.
    Alone,
}

/// In which layers a name is looked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Reach {
    /// In all; a channel of exactly this name goes before those of a layer.
    Named,
    /// In all.
    Any,
    /// In the colour's layer and those it lies in; in a file without colour, where channels stand
    /// in no layer of their part.
    Own,
    /// The same, unless this channel is beside it: then it is one of a vector.
    OwnWithout(&'static str),
}

/// What the values of motion channels mean: the motion in pixels is
/// `(sample - offset) * sign * scale`, times the size of the unit in pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Encoding {
    pub(crate) sign: [f64; 2],
    pub(crate) scale: [f64; 2],
    pub(crate) unit: MotionUnit,
    /// The sample that stands for no motion.
    pub(crate) offset: f32,
}

impl Encoding {
    /// Pixels, x to the right and y down.
    pub(crate) const PIXELS: Self =
        Self { sign: [1.0; 2], scale: [1.0; 2], unit: MotionUnit::Pixels, offset: 0.0 };

    /// Pixels for one unit of a sample, in a display window of `size`.
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

/// Motion channels to look for.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct MotionChoice {
    /// Channels of one layer, all of which have to be there; the motion is in the first two.
    pub(crate) channels: Vec<String>,
    pub(crate) reach: Reach,
    pub(crate) encoding: Encoding,
    /// The renderer that writes them so.
    pub(crate) preset: Option<GuidePreset>,
}

impl MotionChoice {
    /// Channels in pixels, x to the right and y down.
    fn pixels(channels: &[&str], reach: Reach) -> Self {
        let channels = channels.iter().map(|&name| name.to_owned()).collect();
        Self { channels, reach, encoding: Encoding::PIXELS, preset: None }
    }

    /// Channels as a renderer encodes them.
    pub(crate) fn of(preset: GuidePreset, channels: &[&str], reach: Reach) -> Self {
        let encoding = preset.encoding();
        Self { encoding, preset: Some(preset), ..Self::pixels(channels, reach) }
    }
}

impl From<&NamedMotion> for MotionChoice {
    fn from(named: &NamedMotion) -> Self {
        let &NamedMotion { ref channels, sign, scale, unit } = named;
        let encoding = Encoding { sign, scale, unit, offset: 0.0 };
        Self { channels: channels.to_vec(), reach: Reach::Named, encoding, preset: None }
    }
}

/// A depth channel to look for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum DepthChoice {
    Channel(String, Reach),
    /// The only one of the file.
    Only,
}

impl DepthChoice {
    pub(crate) fn new(channel: &str, reach: Reach) -> Self {
        Self::Channel(channel.to_owned(), reach)
    }
}

impl MotionChannels {
    pub(crate) fn choices(&self, place: Place) -> Vec<MotionChoice> {
        match self {
            MotionChannels::None => Vec::new(),
            MotionChannels::Auto => auto_motion(place),
            MotionChannels::Preset(preset) => preset.motion(place),
            MotionChannels::NamedAs(preset, [x, y]) => {
                vec![MotionChoice::of(*preset, &[x, y], Reach::Named)]
            }
            MotionChannels::Named(named) => vec![named.into()],
        }
    }
}

impl DepthChannels {
    pub(crate) fn choices(&self, place: Place) -> Vec<DepthChoice> {
        match self {
            DepthChannels::None => Vec::new(),
            DepthChannels::Auto => auto_depth(place),
            DepthChannels::Preset(preset) => preset.depth(place),
            DepthChannels::Named(name) => vec![DepthChoice::new(name, Reach::Named)],
        }
    }
}

fn auto_motion(place: Place) -> Vec<MotionChoice> {
    let ours = MotionChoice::pixels(&["motion.X", "motion.Y"], Reach::Any);
    // Bare names come last: a file of its own may still have layers that say what they are.
    let presets = GuidePreset::ALL.iter().flat_map(|p| p.motion(Place::BesideColour));
    let mut choices = vec![ours];
    choices.extend(presets.filter(|choice| choice.channels[0] != "motion.X"));
    if place == Place::Alone {
        choices.push(MotionChoice::of(GuidePreset::Blender, &["X", "Y", "Z", "W"], Reach::Own));
        choices.push(MotionChoice::pixels(&["X", "Y"], Reach::Own));
        choices.push(MotionChoice::of(GuidePreset::Falcor, &["R", "G"], Reach::Own));
    }
    choices
}

fn auto_depth(place: Place) -> Vec<DepthChoice> {
    let vector = if place == Place::Alone { "W" } else { "X" };
    let mut choices = vec![DepthChoice::new("Z", Reach::OwnWithout(vector))];
    choices.extend(GuidePreset::ALL.iter().flat_map(|p| p.depth(Place::BesideColour)));
    if place == Place::Alone {
        choices.push(DepthChoice::new("Y", Reach::OwnWithout("X")));
        choices.push(DepthChoice::new("R", Reach::Own));
        choices.push(DepthChoice::Only);
    }
    choices
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

    #[test]
    fn automatic_names_in_their_order() {
        let names = |place| -> Vec<String> {
            let choices = MotionChannels::Auto.choices(place);
            choices.iter().map(|choice| choice.channels[0].clone()).collect()
        };
        let beside =
            ["motion.X", "Vector.X", "mvec.R", "FinalImageMovieRenderQueue_MotionVectors.R"];
        assert_eq!(names(Place::BesideColour), beside);
        assert_eq!(names(Place::Alone), [&beside[..], &["X", "X", "R"]].concat());
    }
}
