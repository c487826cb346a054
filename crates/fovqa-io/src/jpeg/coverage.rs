//! Which coefficients the scans of a file have brought.

use super::error::{Result, damaged};
use super::frame_header::{Coding, FrameHeader};
use super::quantisation::COEFFICIENTS;
use super::scan_header::ScanHeader;

/// For each component and coefficient, the lowest bit that is known.
#[derive(Debug)]
pub(super) struct Coverage(Vec<[Option<u8>; COEFFICIENTS]>);

impl Coverage {
    /// Of a frame without scans.
    pub(super) fn new(frame: &FrameHeader) -> Self {
        Self(vec![[None; COEFFICIENTS]; frame.components.len()])
    }

    /// Whether a component has had a scan.
    pub(super) fn has_begun(&self, component: usize) -> bool {
        self.0[component].iter().any(Option::is_some)
    }

    /// Adds what a scan brings.
    ///
    /// # Errors
    /// When it does not go on where the scans before it have ended.
    pub(super) fn add(&mut self, coding: Coding, scan: &ScanHeader) -> Result<()> {
        let wrong = |what: &str| Err(damaged(format!("its scans are out of order: {what}")));
        let before = if scan.high == 0 { None } else { Some(scan.high) };
        for component in &scan.components {
            let known = &mut self.0[component.index];
            if coding == Coding::Progressive && scan.from > 0 && known[0].is_none() {
                return wrong("a component has coefficients before it has means");
            }
            for bit in &mut known[scan.from..=scan.to] {
                if *bit != before {
                    return wrong(match bit {
                        None => "one refines coefficients that are not there yet",
                        Some(_) => "one repeats what another has brought",
                    });
                }
                *bit = Some(scan.low);
            }
        }
        Ok(())
    }

    /// # Errors
    /// When a bit of a coefficient has not come. A file may be written without its last scans, but
    /// it cannot be told from one that was cut there; decoders make up what is missing.
    pub(super) fn check_complete(&self) -> Result<()> {
        if self.0.iter().any(|known| known[0].is_none()) {
            return Err(damaged("the scan of a component is missing"));
        }
        if self.0.as_flattened().iter().any(|bit| *bit != Some(0)) {
            return Err(damaged("its last scans are missing, which bring the finest detail"));
        }
        Ok(())
    }
}
