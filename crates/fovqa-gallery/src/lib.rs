//! The built-in scenes: a hall to walk through, patterns, and a contrast-sensitivity chart. They need no
//! file, and colour, depth and motion can be asked for at any position of a frame, so that a foveation
//! method can sample the scene itself, as a foveated ray caster does.
//!
//! [`BuiltinSpec`] says which scene it is, [`Builtin`] prepares it for a view and an eye. A frame is a
//! [`FrameScene`], a function of position; [`Builtin::ground_truth`] is its picture.
//!
//! The same numbers come out on every machine: only sums, products, quotients and square roots are
//! used, and `libm` for everything else.

mod builtin;
mod camera;
mod chart;
mod frame_scene;
mod furniture;
mod gaze;
mod hall;
mod noise;
mod path;
mod patterns;
mod place;
mod ray;
mod scene;
mod shape;
mod source;
mod spec;
mod surface;
mod text;
mod tree;
mod vec3;
mod walk;

pub use builtin::{Builtin, CameraPose};
pub use frame_scene::{FrameScene, Surface};
pub use scene::SceneName;
pub use source::BuiltinSource;
pub use spec::{BuiltinSpec, GalleryError, IPD_M};
