//! The samples that are written for an emulated picture.

use fovqa_emulate::Picture;
use fovqa_engine::OutputError;
use fovqa_frame::{Frame, Samples, SignalParams, Transfer, half_floats};
use fovqa_io::{EncodeError, FrameFormat};
use fovqa_params::Words;

use super::destination::Destination;

/// What the samples of a picture depend on beside the picture.
pub(super) struct Written<'a> {
    /// How the input became a picture.
    pub(super) signal: &'a SignalParams,
    /// The input.
    pub(super) input: &'a Frame,
    /// Bits of the codes of a video.
    pub(super) code_bits: Option<u32>,
}

impl Written<'_> {
    /// The frame to be written for a picture. `before` is the picture of the input, if `picture` has the
    /// same pixels: samples that emulation did not change keep the values of an OpenEXR input.
    pub(super) fn frame(
        &self,
        picture: &Picture,
        before: Option<&Picture>,
        destination: &Destination,
    ) -> Result<Frame, OutputError> {
        match destination.format {
            FrameFormat::Jpeg if self.is_linear_file() => {
                let format = destination.format;
                let error = EncodeError::Samples { format, samples: "linear light in floats" };
                Err(OutputError::Encode { path: destination.path.clone(), error })
            }
            FrameFormat::Png | FrameFormat::Jpeg => Ok(self.codes(picture)),
            FrameFormat::Exr => {
                let floats = self.floats(picture, before, destination)?;
                let whole =
                    matches!(self.input.samples(), Samples::F32(_)) && self.is_linear_file();
                Ok(if whole { floats } else { half_floats(&floats) })
            }
        }
    }

    /// Whether the input holds floats as an OpenEXR file does.
    fn is_linear_file(&self) -> bool {
        !self.input.samples().is_integer() && self.code_bits.is_none()
    }

    /// Codes with the bits of the input; 8 bits if it has floats.
    fn codes(&self, picture: &Picture) -> Frame {
        let is_deep = match self.input.samples() {
            Samples::U16(_) => true,
            Samples::U8(_) => false,
            Samples::F16(_) | Samples::F32(_) => self.code_bits.is_some_and(|bits| bits > 8),
        };
        if is_deep { picture.to_codes16() } else { picture.to_codes8() }
    }

    /// Linear light. An OpenEXR input whose values are encoded stays encoded.
    fn floats(
        &self,
        picture: &Picture,
        before: Option<&Picture>,
        destination: &Destination,
    ) -> Result<Frame, OutputError> {
        let transfer = self.signal.transfer_of(self.input);
        let linear = match (transfer, self.is_linear_file()) {
            (Transfer::Linear, true) => match before {
                Some(before) => picture.to_linear_from(self.signal, before, self.input),
                None => picture.to_linear(self.signal),
            },
            (Transfer::Linear, false) => picture.to_linear(self.signal),
            (_, true) => return Ok(unmarked(&picture.to_signal())),
            // Exposure and tone map are not applied to codes.
            (Transfer::Srgb, false) => picture.to_linear(&SignalParams::default()),
            (Transfer::Pq | Transfer::Gamma22, false) => {
                let path = destination.path.clone();
                return Err(OutputError::Transfer { path, transfer: transfer.word() });
            }
        };
        linear.map_err(|error| OutputError::Convert { path: destination.path.clone(), error })
    }
}

/// The same samples, as a file holds them: without the mark that they are encoded.
fn unmarked(frame: &Frame) -> Frame {
    let samples = frame.samples().clone();
    Frame::new(frame.width(), frame.height(), frame.channels(), samples)
        .unwrap_or_else(|_| unreachable!("as many samples as before"))
}
