//! The coefficients that the scans of a file have delivered.

use super::error::{Result, damaged};
use super::frame_header::{Coding, FrameHeader};
use super::quantisation::COEFFICIENTS;
use super::scan_header::ScanHeader;

/// The lowest known bit for each component and coefficient.
#[derive(Debug)]
pub(super) struct Coverage(Vec<[Option<u8>; COEFFICIENTS]>);

impl Coverage {
    /// The coverage of a frame before its first scan.
    pub(super) fn new(frame: &FrameHeader) -> Self {
        Self(vec![[None; COEFFICIENTS]; frame.components.len()])
    }

    /// Whether a scan has delivered data of a component.
    pub(super) fn has_begun(&self, component: usize) -> bool {
        self.0[component].iter().any(Option::is_some)
    }

    /// Adds the coefficients of a scan.
    ///
    /// # Errors
    /// When the scan does not continue where the scans before it have ended.
    pub(super) fn add(&mut self, coding: Coding, scan: &ScanHeader) -> Result<()> {
        let wrong = |what: &str| Err(damaged(format!("its scans are out of order: {what}")));
        let before = if scan.high == 0 { None } else { Some(scan.high) };
        for component in &scan.components {
            let known = &mut self.0[component.index];
            if coding == Coding::Progressive && scan.from > 0 && known[0].is_none() {
                return wrong("a component has AC coefficients before it has DC coefficients");
            }
            for bit in &mut known[scan.from..=scan.to] {
                if *bit != before {
                    return wrong(match bit {
                        None => "one refines coefficients that no earlier scan contains",
                        Some(_) => "one repeats what an earlier scan contains",
                    });
                }
                *bit = Some(scan.low);
            }
        }
        Ok(())
    }

    /// Checks that all coefficients are complete.
    ///
    /// # Errors
    /// When a bit of a coefficient is missing. A file may be written without its last scans, but it
    /// cannot be distinguished from a truncated one; other decoders fill in the missing bits.
    pub(super) fn check_complete(&self) -> Result<()> {
        if self.0.iter().any(|known| known[0].is_none()) {
            return Err(damaged("the scan of a component is missing"));
        }
        if self.0.as_flattened().iter().any(|bit| *bit != Some(0)) {
            return Err(damaged("its last scans, which contain the finest detail, are missing"));
        }
        Ok(())
    }
}
