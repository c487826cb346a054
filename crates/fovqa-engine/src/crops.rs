//! Cuts the regions out of a pair of frames that a figure shows side by side.

use fovqa_emulate::Picture;
use fovqa_frame::{Crop, Frame, SignalTables};
use fovqa_plan::{CropRegion, EyeView};
use fovqa_vision::Eccentricity;

use crate::events::Warnings;

/// A region of a pair, as codes of 8 bits for display.
#[derive(Debug, Clone, PartialEq)]
pub struct CropPair {
    /// Name of the region.
    pub region: String,
    /// The number of the frame.
    pub frame: i64,
    /// The region of the reference.
    pub reference: Frame,
    /// The region of the test.
    pub test: Frame,
    /// Position of the gaze in the frame; `None` without a view.
    pub gaze_px: Option<[f64; 2]>,
    /// Width and height of the frame.
    pub frame_px: [usize; 2],
    /// Left and upper edge of the region in the frame.
    pub corner_px: [usize; 2],
    /// Eccentricity of the region's centre in degrees; `None` without a view.
    pub eccentricity_deg: Option<f64>,
}

/// The pair that regions are cut out of.
pub(crate) struct CropSource<'a> {
    pub(crate) scene: &'a str,
    pub(crate) eye: &'a EyeView,
    /// The number of the frame, and whether it is the first one of its view.
    pub(crate) frame: (i64, bool),
    pub(crate) reference: &'a Frame,
    pub(crate) test: &'a Frame,
    pub(crate) gaze_px: Option<[f64; 2]>,
    pub(crate) tables: &'a SignalTables,
    /// Whether it was known before the frame was read which regions are within it.
    pub(crate) is_foreseen: &'a dyn Fn() -> bool,
}

impl CropSource<'_> {
    /// The regions that are in this frame.
    pub(crate) fn cut(&self, regions: &[CropRegion], warnings: &mut Warnings<'_>) -> Vec<CropPair> {
        let (number, is_first) = self.frame;
        let here = |region: &&CropRegion| {
            region.is_in(self.scene) && region.frame.map_or(is_first, |frame| frame == number)
        };
        regions.iter().filter(here).filter_map(|region| self.one(region, warnings)).collect()
    }

    fn one(&self, region: &CropRegion, warnings: &mut Warnings<'_>) -> Option<CropPair> {
        let size = (self.reference.width(), self.reference.height());
        let name = &region.name;
        let Some(corner_px) = region.corner(size) else {
            if !(self.is_foreseen)() {
                let message = format!(
                    "the region \"{name}\" is left out: it is not within the frame of {}x{}",
                    size.0, size.1
                );
                warnings.once(&format!("region {name}"), &message);
            }
            return None;
        };
        let [x, y] = corner_px;
        let crop = Crop { x, y, width: region.size[0], height: region.size[1] };
        let cut = |frame: &Frame| {
            let part = frame.part(crop).ok()?;
            Some(Picture::from_frame(&part, self.tables).to_codes8())
        };
        Some(CropPair {
            region: name.clone(),
            frame: self.frame.0,
            reference: cut(self.reference)?,
            test: cut(self.test)?,
            gaze_px: self.gaze_px,
            frame_px: [size.0, size.1],
            corner_px,
            eccentricity_deg: self.eccentricity_deg(region.at, size),
        })
    }

    fn eccentricity_deg(&self, [x, y]: [f64; 2], size: (usize, usize)) -> Option<f64> {
        let settings = &self.eye.settings;
        let view = settings.view.as_ref()?.resolve(size.0, size.1).ok()?.view;
        Some(Eccentricity::new(view, self.gaze_px?, settings.eccentricity).at_deg(x, y))
    }
}
