//! Keeps the sheets of heat maps, because all methods and most frames have the size and the gaze of
//! others.

use std::io;
use std::sync::{Arc, Mutex, PoisonError};

use fovqa_metrics::{Map, MapInfo};
use fovqa_report::MapSheet;
use fovqa_vision::Seen;

/// The number of sheets that are kept: those of all maps for four gaze positions.
const MOST_SHEETS: usize = 16;

/// The sheets that were used last, the latest at the end.
#[derive(Debug, Default)]
pub(crate) struct MapSheets(Mutex<Vec<Kept>>);

#[derive(Debug)]
struct Kept {
    info: &'static MapInfo,
    frame_size: (usize, usize),
    seen: Option<Seen>,
    sheet: Arc<MapSheet>,
}

impl MapSheets {
    /// The sheet for a map of a frame that is seen in this way.
    pub(crate) fn sheet(&self, map: &Map, seen: Option<&Seen>) -> io::Result<Arc<MapSheet>> {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let has_lines = |of: &Kept| of.frame_size == map.frame_size && of.seen.as_ref() == seen;
        let place = kept.iter().position(|of| of.info == map.info && has_lines(of));
        let found = if let Some(place) = place {
            kept.remove(place)
        } else {
            let sheet = match kept.iter().find(|of| has_lines(of)) {
                Some(of) => of.sheet.with_map(map.info),
                None => MapSheet::new(map.info, map.frame_size, seen),
            };
            let sheet = Arc::new(sheet.map_err(io::Error::other)?);
            Kept { info: map.info, frame_size: map.frame_size, seen: seen.cloned(), sheet }
        };
        let sheet = Arc::clone(&found.sheet);
        if kept.len() >= MOST_SHEETS {
            kept.remove(0);
        }
        kept.push(found);
        Ok(sheet)
    }
}
