//! The order in which channel names are tried.

use super::choice::{DepthChoice, GuideFile, LayerScope, MotionChoice};
use super::options::{DepthChannels, MotionChannels};
use super::preset::GuidePreset;

impl MotionChannels {
    pub(crate) fn choices(&self, place: GuideFile) -> Vec<MotionChoice> {
        match self {
            MotionChannels::None => Vec::new(),
            MotionChannels::Auto => auto_motion(place),
            MotionChannels::Preset(preset) => preset.motion(place),
            MotionChannels::NamedAs(preset, [x, y]) => {
                vec![MotionChoice::of(*preset, &[x, y], LayerScope::Named)]
            }
            MotionChannels::Named(named) => vec![named.into()],
        }
    }
}

impl DepthChannels {
    pub(crate) fn choices(&self, place: GuideFile) -> Vec<DepthChoice> {
        match self {
            DepthChannels::None => Vec::new(),
            DepthChannels::Auto => auto_depth(place),
            DepthChannels::Preset(preset) => preset.depth(place),
            DepthChannels::Named(name) => vec![DepthChoice::new(name, LayerScope::Named)],
        }
    }
}

fn auto_motion(place: GuideFile) -> Vec<MotionChoice> {
    let ours = MotionChoice::pixels(&["motion.X", "motion.Y"], LayerScope::Any);
    // Bare names come last: a separate file may still have layers whose names identify them.
    let presets = GuidePreset::ALL.iter().flat_map(|p| p.motion(GuideFile::Colour));
    let mut choices = vec![ours];
    choices.extend(presets.filter(|choice| choice.channels[0] != "motion.X"));
    if place == GuideFile::Separate {
        choices.push(MotionChoice::of(
            GuidePreset::Blender,
            &["X", "Y", "Z", "W"],
            LayerScope::Own,
        ));
        choices.push(MotionChoice::pixels(&["X", "Y"], LayerScope::Own));
        choices.push(MotionChoice::of(GuidePreset::Falcor, &["R", "G"], LayerScope::Own));
    }
    choices
}

fn auto_depth(place: GuideFile) -> Vec<DepthChoice> {
    let vector = if place == GuideFile::Separate { "W" } else { "X" };
    let mut choices = vec![DepthChoice::new("Z", LayerScope::OwnWithout(vector))];
    choices.extend(GuidePreset::ALL.iter().flat_map(|p| p.depth(GuideFile::Colour)));
    if place == GuideFile::Separate {
        choices.push(DepthChoice::new("Y", LayerScope::OwnWithout("X")));
        choices.push(DepthChoice::new("R", LayerScope::Own));
        choices.push(DepthChoice::Only);
    }
    choices
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn automatic_names_in_their_order() {
        let names = |place| -> Vec<String> {
            let choices = MotionChannels::Auto.choices(place);
            choices.iter().map(|choice| choice.channels[0].clone()).collect()
        };
        let beside =
            ["motion.X", "Vector.X", "mvec.R", "FinalImageMovieRenderQueue_MotionVectors.R"];
        assert_eq!(names(GuideFile::Colour), beside);
        assert_eq!(names(GuideFile::Separate), [&beside[..], &["X", "X", "R"]].concat());
    }
}
