//! Which parameters of the sandbox a method and enhancement have.

use fovqa_methods::sandbox::{F_MAX, FOVEAL, RATE, TRANSITION};
use fovqa_params::ParamInfo;

/// Parameters of `stable` and `aliased`.
pub(crate) const BLUR: &[ParamInfo] = &[RATE, FOVEAL];
/// Parameters of `perceptual-target`.
pub(crate) const TARGET: &[ParamInfo] = &[RATE, FOVEAL, F_MAX, TRANSITION];
/// Parameters of `--enhance`, beside its strength.
pub(crate) const ENHANCE: &[ParamInfo] = &[RATE, FOVEAL, TRANSITION];
