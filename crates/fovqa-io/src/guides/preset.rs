//! The renderers whose motion and depth channels are known.

use fovqa_params::words;

words! {
    /// A renderer whose motion and depth channels are known.
    pub enum GuidePreset {
        /// Blender: the Vector and Depth passes, `ViewLayer.Vector.X` and `.Y`,
        /// `ViewLayer.Depth.Z`.
        ///
        /// The Vector pass has X, Y, Z and W, in pixels. Cycles writes "pre - centre" to X and Y
        /// and "centre - post" to Z and W, in raster coordinates, whose y points up
        /// (`primitive_motion_vector` in blender/blender, intern/cycles/kernel/geom/primitive.h;
        /// the renders of blender.stackexchange.com/q/216368 agree: X is positive for motion to the
        /// left, Y for motion downwards). So X and Y are read, with the sign `[1, -1]`. Pixels
        /// without an object may hold 10000 (PASS_VECTOR_MAX), and the depth 10e10 or infinity
        /// (source/blender/render/intern/render_result.cc, which has the channel letters `Z` and
        /// `XYZW` as well). `Depth.V` is accepted too; no source was found for that name.
        ///
        /// A Mist pass is called `Mist.Z`, but it is not a depth and is not read.
        Blender "blender" "As Blender writes them";
        /// Falcor: `mvec` and `linearZ`, `mvec.R` and `.G`, `linearZ.R`; each is usually a separate
        /// file with `R` and `G`.
        ///
        /// "Motion vector pointing from current to previous position expressed in screen space
        /// \[0,1\] with origin in the top-left corner" (`calcMotionVector` in
        /// NVIDIAGameWorks/Falcor, Source/Falcor/Utils/Helpers.slang; channel names in
        /// Source/RenderPasses/GBuffer/GBuffer/GBuffer.cpp and GBufferRaster.cpp). So the unit is
        /// the frame and the sign `[1, 1]`. `linearZ` holds the depth in R and its derivative in G.
        /// `depth` holds the values of the depth buffer, which are not linear, so it is not looked
        /// for.
        Falcor "falcor" "As Falcor writes them";
        /// Unreal Engine, Movie Render Queue: `FinalImageMovieRenderQueue_MotionVectors.R` and
        /// `.G`, `FinalImageMovieRenderQueue_WorldDepth.R`; `R` and `G` if each pass is a separate
        /// file.
        ///
        /// "Motion Vectors are stored in the 0,1 coordinate space for X and Y, where 0.5, 0.5 is no
        /// motion", "normalized to the entire screen" (dev.epicgames.com, Cinematic Render Passes).
        /// So the offset is 0.5 and the unit the frame; that text does not give the scale and the
        /// direction. The engine's velocity is the current minus the previous position in clip
        /// space, which is two units wide over the frame, with y up (`PostProcessVelocityLookup` in
        /// MaterialTemplate.ush, the input of this pass's material), and its texture holds
        /// `0.499 * 0.5` times that, plus 0.5 (`EncodeVelocityToTexture` in VelocityCommon.ush): so
        /// the motion is 2 (v - 0.5) frame sizes. A public script that turns these channels into
        /// optical flow computes 2 (v - 0.5) times the size with the sign `[-1, 1]`, too. The
        /// material itself is in a binary asset, so a warning advises to test with a known motion.
        /// Half floats hold values near 0.5 in steps of 1/4096 to 1/2048, which is up to two pixels
        /// in a frame of 2048 pixels: 32-bit floats are better.
        ///
        /// Depth is in centimetres.
        Unreal "unreal" "As Unreal writes them";
        /// Mitsuba 3, integrator `aov`: the depth is `<name>.T`, or, in versions that wrote only
        /// the name, `dd.y`, as in its documentation. It is the distance from the pinhole, and 0
        /// where no object is (src/integrators/aov.cpp in mitsuba-renderer/mitsuba3).
        ///
        /// Mitsuba writes no motion: `motion.X` and `motion.Y` in pixels are looked for.
        Mitsuba "mitsuba" "As Mitsuba writes them";
    }
}

impl GuidePreset {
    /// All presets, in the order in which they are tried.
    pub const ALL: [Self; 4] = [Self::Blender, Self::Falcor, Self::Unreal, Self::Mitsuba];
}
