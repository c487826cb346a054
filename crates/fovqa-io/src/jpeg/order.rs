//! The order of blocks in a scan (ITU-T T.81, A.2).

use super::frame_header::FrameHeader;
use super::scan_header::ScanHeader;

/// One component's part in each unit of a scan.
#[derive(Debug, Clone, Copy)]
pub(super) struct Share {
    /// The component's place in the frame.
    pub(super) component: usize,
    /// Blocks of a unit across and down.
    pub(super) blocks: (usize, usize),
    /// Blocks of the component across and down; units at the edges reach beyond them.
    pub(super) within: (usize, usize),
}

/// How a scan goes over its blocks: row by row of units, each with blocks of all its components.
#[derive(Debug, Clone)]
pub(super) struct Order {
    /// Units across and down.
    pub(super) units: (usize, usize),
    /// In the order of the scan.
    pub(super) shares: Vec<Share>,
}

impl Order {
    /// Of a scan: a component alone goes block by block, several go by units of the frame.
    pub(super) fn new(frame: &FrameHeader, scan: &ScanHeader) -> Self {
        let alone = scan.components.len() == 1;
        let share = |index: usize| {
            let component = &frame.components[index];
            let blocks = if alone { (1, 1) } else { component.factors };
            Share { component: index, blocks, within: component.blocks }
        };
        let shares: Vec<Share> = scan.components.iter().map(|c| share(c.index)).collect();
        let units = if alone { shares[0].within } else { frame.units() };
        Self { units, shares }
    }
}
