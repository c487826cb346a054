//! What a user may set.

use fovqa_params::ParamValue;

use super::color_space::ColorSpace;

/// Parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Params {
    /// Whether sensitivity falls off with eccentricity; if not, every pixel is looked at directly.
    pub foveated: bool,
    /// What stands before the first frame.
    pub temp_padding: Padding,
    /// cd/m² of a linear sample of 1; `None`: 1 on displays that take light, while others show what
    /// exposure, tone map and encoding make of it.
    pub cd_m2_per_unit: Option<f64>,
    /// Primaries of the files.
    pub color_space: ColorSpace,
    /// Whether the right edge of coarser levels is weighed as it should be, and not as FovVideoVDP
    /// does.
    pub exact_edges: bool,
    /// What heat maps are laid over.
    pub map_context: MapContext,
}

/// What stands before the first frame of a sequence.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Padding {
    /// The first frame.
    #[default]
    Replicate,
    /// The sequence itself, as in a loop.
    Circular,
    /// The sequence backwards.
    Pingpong,
}

/// The picture below a heat map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum MapContext {
    /// The test.
    #[default]
    Test,
    /// The reference.
    Reference,
}

impl Default for Params {
    fn default() -> Self {
        Self {
            foveated: true,
            temp_padding: Padding::default(),
            cd_m2_per_unit: None,
            color_space: ColorSpace::default(),
            exact_edges: false,
            map_context: MapContext::default(),
        }
    }
}

impl Params {
    /// Sets what the registry has found to be one of its values.
    pub(crate) fn set(&mut self, name: &str, value: &ParamValue) -> Option<()> {
        match name {
            "foveated" => self.foveated = value.flag()?,
            "temp_padding" => {
                self.temp_padding = match value.text()? {
                    "replicate" => Padding::Replicate,
                    "circular" => Padding::Circular,
                    "pingpong" => Padding::Pingpong,
                    _ => return None,
                }
            }
            "cd_m2_per_unit" => self.cd_m2_per_unit = value.number(),
            "color_space" => self.color_space = ColorSpace::find(value.text()?)?,
            "exact_edges" => self.exact_edges = value.flag()?,
            "map_context" => {
                self.map_context = match value.text()? {
                    "test" => MapContext::Test,
                    "reference" => MapContext::Reference,
                    _ => return None,
                }
            }
            _ => return None,
        }
        Some(())
    }
}
