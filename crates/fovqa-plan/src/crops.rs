//! Regions of frames that a figure shows side by side.

use serde::{Deserialize, Serialize};

/// A region of the frames of a scene, for all of its methods.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CropRegion {
    /// Its name.
    pub name: String,
    /// Its centre in pixels from the left and the top.
    pub at: [f64; 2],
    /// Its width and height in pixels.
    pub size: [usize; 2],
    /// The only scene that it is in; `None` for all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scene: Option<String>,
    /// The number of its frame; `None` for the first one of a scene.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frame: Option<i64>,
}

impl CropRegion {
    /// Whether it is in a scene.
    pub fn is_in(&self, scene: &str) -> bool {
        self.scene.as_deref().is_none_or(|of| of == scene)
    }

    /// Its left and upper edge in a frame; `None` if it is not within the frame.
    pub fn corner(&self, (width, height): (usize, usize)) -> Option<[usize; 2]> {
        let edge = |at: f64, side: usize, most: usize| {
            let edge = (at - side as f64 / 2.0).round();
            (edge >= 0.0 && edge + side as f64 <= most as f64).then_some(edge as usize)
        };
        Some([edge(self.at[0], self.size[0], width)?, edge(self.at[1], self.size[1], height)?])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_region_lies_around_its_centre_and_within_the_frame() {
        let region = |at| CropRegion {
            name: "a".to_owned(),
            at,
            size: [10, 6],
            scene: Some("room".to_owned()),
            frame: None,
        };
        assert_eq!(region([20.0, 10.0]).corner((40, 30)), Some([15, 7]));
        assert_eq!(region([5.0, 3.0]).corner((40, 30)), Some([0, 0]));
        assert_eq!(region([35.0, 27.0]).corner((40, 30)), Some([30, 24]));
        for outside in [[4.0, 10.0], [36.0, 10.0], [20.0, 2.0], [20.0, 28.0], [f64::NAN, 9.0]] {
            assert_eq!(region(outside).corner((40, 30)), None, "{outside:?}");
        }
        assert!(region([0.0; 2]).is_in("room") && !region([0.0; 2]).is_in("hall"));
    }
}
