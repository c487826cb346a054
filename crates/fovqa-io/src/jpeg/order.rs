//! The order of blocks in a scan (ITU-T T.81, A.2).

use super::frame_header::FrameHeader;
use super::scan_header::ScanHeader;

/// The blocks of one component in each unit of a scan.
#[derive(Debug, Clone, Copy)]
pub(super) struct ComponentBlocks {
    /// The index of the component in the frame.
    pub(super) component: usize,
    /// The number of blocks in a unit, across and down.
    pub(super) blocks: (usize, usize),
    /// The number of blocks of the component, across and down; units at the edges reach beyond
    /// them.
    pub(super) within: (usize, usize),
}

/// The order of blocks in a scan: row by row of units, each of which has blocks of all components
/// of the scan.
#[derive(Debug, Clone)]
pub(super) struct Order {
    /// The number of units across and down.
    pub(super) units: (usize, usize),
    /// The components in the order of the scan.
    pub(super) shares: Vec<ComponentBlocks>,
}

impl Order {
    /// The order of a scan. A unit is one block if the scan has a single component, or else a unit
    /// of the frame.
    pub(super) fn new(frame: &FrameHeader, scan: &ScanHeader) -> Self {
        let alone = scan.components.len() == 1;
        let share = |index: usize| {
            let component = &frame.components[index];
            let blocks = if alone { (1, 1) } else { component.factors };
            ComponentBlocks { component: index, blocks, within: component.blocks }
        };
        let shares: Vec<ComponentBlocks> = scan.components.iter().map(|c| share(c.index)).collect();
        let units = if alone { shares[0].within } else { frame.units() };
        Self { units, shares }
    }
}
