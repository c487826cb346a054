//! Reads a file up to its first scan, and the settings that segments make.

use super::application::Application;
use super::error::{Result, damaged};
use super::frame_header::{FrameHeader, starts_frame};
use super::huffman::Tables;
use super::intervals::Intervals;
use super::quantisation::{self, Steps};
use super::segments::{Segment, Segments, marker, u16_at};

/// The settings that segments have made so far.
#[derive(Debug, Default)]
pub(super) struct Settings {
    pub(super) application: Application,
    pub(super) quantisation: [Option<Steps>; 4],
    pub(super) huffman: Tables,
    /// The number of units in a restart interval; 0 for no restarts.
    pub(super) restart_interval: usize,
}

impl Settings {
    /// Applies the settings of a segment.
    ///
    /// # Errors
    /// When the segment is damaged, or not allowed here.
    pub(super) fn take(&mut self, segment: Segment<'_>) -> Result<()> {
        match segment.marker {
            marker::DQT => quantisation::parse(segment.data, &mut self.quantisation),
            marker::DHT => self.huffman.parse(segment.data),
            marker::DRI => match (u16_at(segment.data, 0), segment.data.len()) {
                (Some(units), 2) => {
                    self.restart_interval = units.into();
                    Ok(())
                }
                _ => Err(damaged("the segment of the restart interval has a wrong length")),
            },
            marker::APP0..=marker::APP15 => {
                self.application.take(segment);
                Ok(())
            }
            // The settings of arithmetic coding have no meaning here, and a restart marker after
            // the last interval does no harm.
            marker::COM | marker::DAC | marker::TEM | marker::RST0..=marker::RST7 => Ok(()),
            other => Err(damaged(format!("the marker 0xFF{other:02X} is in a wrong place"))),
        }
    }
}

/// A file up to the header of its first scan.
#[derive(Debug)]
pub(super) struct Head<'a> {
    /// The segments after the header of the first scan.
    pub(super) segments: Segments<'a>,
    pub(super) frame: FrameHeader,
    pub(super) settings: Settings,
    /// The header of the first scan.
    pub(super) scan: &'a [u8],
}

impl<'a> Head<'a> {
    /// Reads up to the first scan, or beyond it if the height follows there.
    ///
    /// # Errors
    /// When the file is damaged before that point, or of a kind that is not supported.
    pub(super) fn read(bytes: &'a [u8]) -> Result<Self> {
        let mut segments = Segments::new(bytes);
        let mut settings = Settings::default();
        let mut frame: Option<FrameHeader> = None;
        if segments.next()?.marker != marker::SOI {
            return Err(damaged("its start-of-image marker is missing"));
        }
        loop {
            let segment = segments.next()?;
            match segment.marker {
                marker if starts_frame(marker) => {
                    let header = FrameHeader::parse(marker, segment.data)?;
                    if frame.replace(header).is_some() {
                        return Err(damaged("it has two frame headers"));
                    }
                }
                marker::SOS => {
                    let missing = || damaged("a scan precedes the frame header");
                    let mut frame = frame.ok_or_else(missing)?;
                    if frame.height == 0 {
                        frame.set_height(height_behind_scan(segments.clone())?);
                    }
                    return Ok(Self { segments, frame, settings, scan: segment.data });
                }
                marker::EOI => return Err(damaged("it ends without a scan")),
                _ => settings.take(segment)?,
            }
        }
    }
}

/// The height of a file whose frame header does not give it (T.81, B.2.5).
fn height_behind_scan(mut segments: Segments<'_>) -> Result<usize> {
    let scan = Intervals::read(segments.rest())?;
    segments.skip(scan.length);
    let segment = segments.next()?;
    match declared_height(segment) {
        Some(height) if height > 0 => Ok(height),
        _ => Err(damaged(
            "its frame header declares a height of 0, and no segment after the first scan gives another",
        )),
    }
}

/// The height that a segment after the first scan declares.
pub(super) fn declared_height(segment: Segment<'_>) -> Option<usize> {
    match (segment.marker, segment.data) {
        (marker::DNL, &[high, low]) => Some(u16::from_be_bytes([high, low]).into()),
        _ => None,
    }
}
