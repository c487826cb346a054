//! What the two eyes of a scene take from each other's frames.

use fovqa_emulate::EmulationSpec;
use serde::{Deserialize, Serialize};

use crate::eye::Eye;

/// What an eye takes from the frames of the other one, or gives to it.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Reprojection {
    /// Nothing.
    #[default]
    None,
    /// The eye is the dominant one: the other eye takes what it can from its frames.
    Gives,
    /// The eye is the other one.
    Takes(Box<Reproject>),
}

/// How an eye takes what it can from the frames of the dominant one. The viewing axes are parallel.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Reproject {
    /// The dominant eye.
    pub dominant: Eye,
    /// What is emulated for the dominant eye.
    pub spec: EmulationSpec,
    /// Distance between both eyes in millimetres.
    pub ipd_mm: f64,
    /// Metres per unit of depth.
    pub depth_m: f64,
}

impl Reproject {
    /// From the eye that is filled to the dominant one, to the right, in the unit of depth.
    pub fn baseline(&self) -> f64 {
        let distance = self.ipd_mm / 1000.0 / self.depth_m;
        match self.dominant {
            Eye::Right => distance,
            Eye::Left => -distance,
        }
    }
}
