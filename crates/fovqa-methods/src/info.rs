//! Metadata of a method: its names, its source and its parameters.

use fovqa_params::ParamInfo;

/// Metadata of a method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MethodInfo {
    /// The name in results and on the command line, where `-` may replace `_`.
    pub key: &'static str,
    /// The name in tables and figures.
    pub label: &'static str,
    /// A description in one line.
    pub about: &'static str,
    /// The publication that defines it.
    pub source: &'static str,
    /// The parameters it accepts.
    pub params: &'static [ParamInfo],
}
