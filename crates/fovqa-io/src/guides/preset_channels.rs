//! The channel names that each renderer writes.

use super::choice::{DepthChoice, GuideFile, LayerScope, MotionChoice};
use super::preset::GuidePreset;

impl GuidePreset {
    pub(crate) fn motion(self, place: GuideFile) -> Vec<MotionChoice> {
        let (names, bare) = match self {
            Self::Blender => (["Vector.X", "Vector.Y"], ["X", "Y"]),
            Self::Falcor => (["mvec.R", "mvec.G"], ["R", "G"]),
            Self::Unreal => (
                [
                    "FinalImageMovieRenderQueue_MotionVectors.R",
                    "FinalImageMovieRenderQueue_MotionVectors.G",
                ],
                ["R", "G"],
            ),
            Self::Mitsuba => (["motion.X", "motion.Y"], ["X", "Y"]),
        };
        let mut choices = vec![MotionChoice::of(self, &names, LayerScope::Any)];
        if place == GuideFile::Separate {
            choices.push(MotionChoice::of(self, &bare, LayerScope::Own));
        }
        choices
    }

    /// The names of the layers that hold motion or depth.
    pub(crate) fn layers() -> Vec<String> {
        let layer = |channel: &str| channel.rsplit_once('.').map(|(layer, _)| layer.to_owned());
        let presets = || Self::ALL.iter();
        let motion = presets().flat_map(|p| p.motion(GuideFile::Colour));
        let motion = motion.flat_map(|choice| choice.channels);
        let depth = presets().flat_map(|p| p.depth(GuideFile::Colour));
        let depth = depth.filter_map(|choice| match choice {
            DepthChoice::Channel(name, _) => Some(name),
            DepthChoice::Only => None,
        });
        let mut layers: Vec<String> = motion.chain(depth).filter_map(|name| layer(&name)).collect();
        layers.sort_unstable();
        layers.dedup();
        layers
    }

    /// The renderer that writes motion under these names within a layer, across and down, without
    /// regard to case.
    pub fn of_motion(channels: &[String; 2]) -> Option<Self> {
        let ends = |whole: &str, name: &str| {
            let (whole, name) = (whole.to_ascii_lowercase(), name.to_ascii_lowercase());
            whole.strip_suffix(&name).is_some_and(|rest| rest.is_empty() || rest.ends_with('.'))
        };
        Self::ALL.into_iter().find(|preset| {
            let names = preset.motion(GuideFile::Colour).into_iter().flat_map(|c| c.channels);
            channels.iter().zip(names).all(|(whole, name)| ends(whole, &name))
        })
    }

    pub(crate) fn depth(self, place: GuideFile) -> Vec<DepthChoice> {
        let (names, bare): (&[&str], &[&str]) = match self {
            Self::Blender => (&["Depth.Z", "Depth.V"], &["Z", "V"]),
            Self::Falcor => (&["linearZ.R"], &["R"]),
            Self::Unreal => (&["FinalImageMovieRenderQueue_WorldDepth.R"], &["R"]),
            Self::Mitsuba => (&["T", "dd.y"], &["Y"]),
        };
        let mut choices: Vec<DepthChoice> =
            names.iter().map(|name| DepthChoice::new(name, LayerScope::Any)).collect();
        if place == GuideFile::Separate {
            choices.extend(bare.iter().map(|name| DepthChoice::new(name, LayerScope::Own)));
        }
        choices
    }
}
