//! The renderers whose motion and depth channels are known.

use fovqa_params::words;

words! {
    /// A renderer whose channels are known.
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
        Blender "blender" "As Blender writes them";
        /// Falcor: `mvec` and `linearZ`, `mvec.R` and `.G`, `linearZ.R`; each is usually a file of
        /// its own, with `R` and `G`.
        ///
        /// "Motion vector pointing from current to previous position expressed in screen space
        /// \[0,1\] with origin in the top-left corner" (`calcMotionVector` in NVIDIAGameWorks/Falcor,
        /// Source/Falcor/Utils/Helpers.slang; channel names in
        /// Source/RenderPasses/GBuffer/GBuffer/GBuffer.cpp and GBufferRaster.cpp). So the unit is
        /// the frame and the sign `[1, 1]`. `linearZ` holds the depth in R and its derivative in G;
        /// `depth` is that of the depth buffer, which is not linear, and is not looked for.
        Falcor "falcor" "As Falcor writes them";
        /// Unreal Engine, Movie Render Queue: `FinalImageMovieRenderQueue_MotionVectors.R` and `.G`,
        /// `FinalImageMovieRenderQueue_WorldDepth.R`; `R` and `G` where each pass is a file.
        ///
        /// "Motion Vectors are stored in the 0,1 coordinate space for X and Y, where 0.5, 0.5 is no
        /// motion", "normalized to the entire screen" (dev.epicgames.com, Cinematic Render Passes). So
        /// the offset is 0.5 and the unit the frame; scale and direction are not in that text. The
        /// engine's velocity is current minus previous in clip space, two units over the frame, y up
        /// (`PostProcessVelocityLookup` in MaterialTemplate.ush, what the material of this pass is
        /// given), and its texture holds `0.499 * 0.5` times that, plus 0.5 (`EncodeVelocityToTexture`
        /// in VelocityCommon.ush): 2 (v - 0.5) of the frame. A public script that turns these channels
        /// into optical flow computes 2 (v - 0.5) times the size with the sign `[-1, 1]`, too. What the
        /// material itself does stands in a binary asset, so a warning says to try a known motion. Half
        /// floats hold values near 0.5 in steps of 1/4096 to 1/2048, up to two pixels of a frame of
        /// 2048: 32 bits are better.
        ///
        /// Depth is in centimetres.
        Unreal "unreal" "As Unreal writes them";
        /// Mitsuba 3, integrator `aov`: depth as `<name>.T`, or, in versions that wrote the name
        /// alone, `dd.y`, the name its documentation gives. It is the distance from the pinhole, and
        /// 0 where there is nothing (src/integrators/aov.cpp in mitsuba-renderer/mitsuba3).
        ///
        /// It has no motion: `motion.X` and `motion.Y` in pixels are looked for.
        Mitsuba "mitsuba" "As Mitsuba writes them";
    }
}

impl GuidePreset {
    /// All, in the order in which they are tried.
    pub const ALL: [Self; 4] = [Self::Blender, Self::Falcor, Self::Unreal, Self::Mitsuba];
}
