//! How renderers name and encode motion and depth.

use super::choice::{DepthChoice, Encoding, MotionChoice, Place, Reach};
use super::options::MotionUnit;

/// A renderer whose channels are known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GuidePreset {
    /// Blender: the Vector and Depth passes, `ViewLayer.Vector.X` and `.Y`, `ViewLayer.Depth.Z`.
    ///
    /// The Vector pass has X, Y, Z and W, in pixels. Cycles writes "pre - centre" to X and Y and
    /// "centre - post" to Z and W, in raster coordinates, whose y points up
    /// (`primitive_motion_vector` in blender/blender, intern/cycles/kernel/geom/primitive.h; the
    /// renders of blender.stackexchange.com/q/216368 agree: X is positive for motion to the left,
    /// Y for motion downwards). So X and Y are read, with the sign `[1, -1]`. Pixels without
    /// anything may hold 10000 (PASS_VECTOR_MAX), and the depth 10e10 or infinity
    /// (source/blender/render/intern/render_result.cc, where the channel letters `Z` and `XYZW`
    /// stand as well). `Depth.V` is accepted too; no source was found for that name.
    ///
    /// A Mist pass is `Mist.Z` and no depth: it is not taken.
    Blender,
    /// Falcor: `mvec` and `linearZ`, `mvec.R` and `.G`, `linearZ.R`; each is usually a file of
    /// its own, with `R` and `G`.
    ///
    /// "Motion vector pointing from current to previous position expressed in screen space
    /// \[0,1\] with origin in the top-left corner" (`calcMotionVector` in NVIDIAGameWorks/Falcor,
    /// Source/Falcor/Utils/Helpers.slang; channel names in
    /// Source/RenderPasses/GBuffer/GBuffer/GBuffer.cpp and GBufferRaster.cpp). So the unit is
    /// the frame and the sign `[1, 1]`. `linearZ` holds the depth in R and its derivative in G;
    /// `depth` is that of the depth buffer, which is not linear, and is not looked for.
    Falcor,
    /// Unreal Engine, Movie Render Queue: `FinalImageMovieRenderQueue_MotionVectors.R` and `.G`,
    /// `FinalImageMovieRenderQueue_WorldDepth.R`; `R` and `G` where each pass is a file.
    ///
    /// "Motion Vectors are stored in the 0,1 coordinate space for X and Y, where 0.5, 0.5 is no
    /// motion", "normalized to the entire screen", to be scaled by the width of the image
    /// (dev.epicgames.com, Cinematic Render Passes). So the offset is 0.5 and the unit the frame.
    /// The direction is not in that text. The engine's velocity is current minus previous
    /// (`PostProcessVelocityLookup` among its material shaders), taken here to be in clip space,
    /// whose y points up: the sign is `[-1, 1]`. A public script that turns these channels into
    /// optical flow has that sign too, but twice the scale; so the scale rests on the
    /// documentation alone. Check both on a known motion before trusting them. Half floats hold
    /// values near 0.5 in steps of 1/4096 to 1/2048 of the frame, up to a pixel: 32 bits are
    /// better.
    ///
    /// Depth is in centimetres.
    Unreal,
    /// Mitsuba 3, integrator `aov`: depth as `<name>.T`, or, in versions that wrote the name
    /// alone, `dd.y`, the name its documentation gives. It is the distance from the pinhole, and
    /// 0 where there is nothing (src/integrators/aov.cpp in mitsuba-renderer/mitsuba3).
    ///
    /// It has no motion: `motion.X` and `motion.Y` in pixels are looked for.
    Mitsuba,
}

impl GuidePreset {
    /// All, in the order in which they are tried.
    pub const ALL: [Self; 4] = [Self::Blender, Self::Falcor, Self::Unreal, Self::Mitsuba];

    /// Its name as settings give it: `blender`, `falcor`, `unreal` or `mitsuba`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Blender => "blender",
            Self::Falcor => "falcor",
            Self::Unreal => "unreal",
            Self::Mitsuba => "mitsuba",
        }
    }

    pub(crate) fn encoding(self) -> Encoding {
        let frame = Encoding { unit: MotionUnit::Frame, ..Encoding::PIXELS };
        match self {
            Self::Blender => Encoding { sign: [1.0, -1.0], ..Encoding::PIXELS },
            Self::Falcor => frame,
            Self::Unreal => Encoding { sign: [-1.0, 1.0], offset: 0.5, ..frame },
            Self::Mitsuba => Encoding::PIXELS,
        }
    }

    pub(crate) fn motion(self, place: Place) -> Vec<MotionChoice> {
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
        let mut choices = vec![MotionChoice::new(&names, Reach::Any, self.encoding())];
        if place == Place::Alone {
            choices.push(MotionChoice::new(&bare, Reach::Own, self.encoding()));
        }
        choices
    }

    pub(crate) fn depth(self, place: Place) -> Vec<DepthChoice> {
        let (names, bare): (&[&str], &[&str]) = match self {
            Self::Blender => (&["Depth.Z", "Depth.V"], &["Z", "V"]),
            Self::Falcor => (&["linearZ.R"], &["R"]),
            Self::Unreal => (&["FinalImageMovieRenderQueue_WorldDepth.R"], &["R"]),
            Self::Mitsuba => (&["T", "dd.y"], &["Y"]),
        };
        let mut choices: Vec<DepthChoice> =
            names.iter().map(|name| DepthChoice::new(name, Reach::Any)).collect();
        if place == Place::Alone {
            choices.extend(bare.iter().map(|name| DepthChoice::new(name, Reach::Own)));
        }
        choices
    }
}
