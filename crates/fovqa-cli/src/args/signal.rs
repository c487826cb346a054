//! `--channels`, `--exposure`, `--tonemap`, `--transfer`, `--layer`, `--test-layer`, `--alpha`, `--nonfinite`,
//! `--range`, `--matrix`, `--mask`, `--crop`.

use std::path::PathBuf;

use clap::Args;
use fovqa_frame::{Crop, SignalChannels, SignalParams, ToneMap, Transfer};
use fovqa_io::{AlphaPolicy, CodeRange, ColourMatrix, FormatOptions, ReadOptions, Y4mOptions};
use fovqa_params::Words;
use fovqa_plan::Nonfinite;
use fovqa_plausibility::Plausibility;

use super::values::{crop, finite, words};

/// With this alias, clap does not read the `Option` as an argument that may be omitted.
type TransferOrAuto = Option<Transfer>;
type RangeOrAuto = Option<CodeRange>;
type MatrixOrAuto = Option<ColourMatrix>;

/// How the values in files become the signal.
#[derive(Debug, Args)]
#[command(next_help_heading = "Signal")]
pub(crate) struct EncodingArgs {
    /// Exposure of linear input, stops
    #[arg(long, value_name = "STOPS", default_value = "0", allow_negative_numbers = true, value_parser = finite)]
    exposure: f64,
    /// Tone map of linear input
    #[arg(long, value_name = "NAME", default_value = ToneMap::default().word(), value_parser = words::<ToneMap>())]
    tonemap: ToneMap,
    /// How values in the files are encoded
    #[arg(long, value_name = "NAME", default_value = TransferOrAuto::default().word(), value_parser = words::<TransferOrAuto>())]
    transfer: TransferOrAuto,
}

impl EncodingArgs {
    pub(crate) fn signal(&self, channels: SignalChannels) -> SignalParams {
        SignalParams {
            transfer: self.transfer,
            exposure_stops: self.exposure,
            tonemap: self.tonemap,
            channels,
        }
    }
}

/// How y4m video is read.
#[derive(Debug, Args)]
#[command(next_help_heading = "Signal")]
pub(crate) struct VideoArgs {
    /// Code range of y4m video
    #[arg(long, value_name = "NAME", default_value = RangeOrAuto::default().word(), value_parser = words::<RangeOrAuto>())]
    range: RangeOrAuto,
    /// Matrix from Y', Cb and Cr of y4m video to R'G'B'
    #[arg(long, value_name = "NAME", default_value = MatrixOrAuto::default().word(), value_parser = words::<MatrixOrAuto>())]
    matrix: MatrixOrAuto,
}

impl VideoArgs {
    pub(crate) fn formats(&self) -> FormatOptions {
        FormatOptions { y4m: Y4mOptions { range: self.range, matrix: self.matrix } }
    }
}

#[derive(Debug, Args)]
#[command(next_help_heading = "Signal")]
pub(crate) struct SignalArgs {
    /// Channels to compare
    #[arg(long, value_name = "WHAT", default_value = SignalChannels::default().word(), value_parser = words::<SignalChannels>())]
    channels: SignalChannels,
    #[command(flatten)]
    encoding: EncodingArgs,
    /// Colour layer of OpenEXR files that have several, in reference and test; "root" for R, G, B without
    /// a prefix
    #[arg(long, value_name = "NAME")]
    layer: Option<String>,
    /// Colour layer of the test, if it differs from the reference's
    #[arg(long, value_name = "NAME")]
    test_layer: Option<String>,
    /// Treatment of NaN and infinity
    #[arg(long, value_name = "POLICY", default_value = Nonfinite::default().word(), value_parser = words::<Nonfinite>())]
    nonfinite: Nonfinite,
    /// What to do about pairs that look like a mistake, such as another exposure, scene or gaze
    #[arg(long, value_name = "POLICY", default_value = Plausibility::default().word(), value_parser = words::<Plausibility>())]
    plausibility: Plausibility,
    /// Treatment of alpha that is not 1 everywhere
    #[arg(long, value_name = "POLICY", default_value = AlphaPolicy::default().word(), value_parser = words::<AlphaPolicy>())]
    alpha: AlphaPolicy,
    #[command(flatten)]
    video: VideoArgs,
    /// Mask image: white pixels are scored, for example the visible area of a lens
    #[arg(long, value_name = "FILE")]
    mask: Option<PathBuf>,
    /// Rectangle to score, such as one eye of a side-by-side picture; the view options describe this
    /// rectangle
    #[arg(long, value_name = "X,Y,W,H", value_parser = crop)]
    crop: Option<Crop>,
    /// Largest number of pixels that a file may declare, in millions
    #[arg(long, value_name = "N", default_value_t = ReadOptions::default().max_megapixels)]
    max_megapixels: u64,
}

impl SignalArgs {
    pub(crate) fn signal(&self) -> SignalParams {
        self.encoding.signal(self.channels)
    }

    pub(crate) fn read(&self) -> ReadOptions {
        ReadOptions {
            layer: self.layer.clone(),
            alpha: self.alpha,
            max_megapixels: self.max_megapixels,
            formats: self.video.formats(),
            ..ReadOptions::default()
        }
    }

    pub(crate) fn test_layer(&self) -> Option<String> {
        self.test_layer.clone()
    }

    pub(crate) fn plausibility(&self) -> Plausibility {
        self.plausibility
    }

    pub(crate) fn nonfinite(&self) -> Nonfinite {
        self.nonfinite
    }

    pub(crate) fn mask(&self) -> Option<PathBuf> {
        self.mask.clone()
    }

    pub(crate) fn crop(&self) -> Option<Crop> {
        self.crop
    }
}
