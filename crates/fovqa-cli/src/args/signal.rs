//! `--channels`, `--exposure`, `--tonemap`, `--transfer`, `--layer`, `--test-layer`, `--alpha`, `--nonfinite`,
//! `--mask`, `--crop`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use fovqa_config::Nonfinite;
use fovqa_frame::{Crop, SignalChannels, SignalParams, ToneMap, Transfer};
use fovqa_io::{AlphaPolicy, ReadOptions};

use super::values::{crop, finite};

#[derive(Debug, Clone, Copy, ValueEnum)]
pub(crate) enum ChannelsArg {
    /// Red, green and blue.
    Rgb,
    /// 0.2126 R + 0.7152 G + 0.0722 B of the encoded signal.
    Luma,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
pub(crate) enum ToneMapArg {
    /// min(max(x, 0), 1).
    Clamp,
    /// x / (1 + x).
    Reinhard,
    /// Narkowicz 2015.
    Aces,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
pub(crate) enum TransferArg {
    /// sRGB for PNG and JPEG, linear for OpenEXR.
    Auto,
    /// sRGB-encoded.
    Srgb,
    /// Linear light: exposure, tone map and sRGB encoding follow.
    Linear,
    /// SMPTE ST 2084 codes, used as they are.
    Pq,
    /// A power of 2.2, used as it is.
    #[value(name = "gamma2.2")]
    Gamma22,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
pub(crate) enum NonfiniteArg {
    /// An error that names the first such pixel.
    Error,
    /// Such pixels are left out of every number.
    Mask,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
pub(crate) enum AlphaArg {
    /// An error that names the first pixel that is not opaque.
    Error,
    /// Colours are taken as they are.
    Ignore,
    /// The picture is laid over black.
    OverBlack,
}

#[derive(Debug, Args)]
#[command(next_help_heading = "Signal")]
pub(crate) struct SignalArgs {
    /// What is compared
    #[arg(long, value_name = "WHAT", default_value = "rgb")]
    channels: ChannelsArg,
    /// Exposure of linear input, stops
    #[arg(long, value_name = "STOPS", default_value = "0", allow_negative_numbers = true, value_parser = finite)]
    exposure: f64,
    /// Tone map of linear input
    #[arg(long, value_name = "NAME", default_value = "clamp")]
    tonemap: ToneMapArg,
    /// How values in the files are encoded
    #[arg(long, value_name = "NAME", default_value = "auto")]
    transfer: TransferArg,
    /// Colour layer of OpenEXR files that have several, in reference and test; "root" for R, G, B without
    /// a prefix
    #[arg(long, value_name = "NAME")]
    layer: Option<String>,
    /// Colour layer of the test, where it is another than the reference's
    #[arg(long, value_name = "NAME")]
    test_layer: Option<String>,
    /// What to do about NaN and infinity
    #[arg(long, value_name = "POLICY", default_value = "error")]
    nonfinite: NonfiniteArg,
    /// What to do about alpha that is not 1 everywhere
    #[arg(long, value_name = "POLICY", default_value = "error")]
    alpha: AlphaArg,
    /// Picture that is white where pixels count, such as a lens's visible area
    #[arg(long, value_name = "FILE")]
    mask: Option<PathBuf>,
    /// Rectangle to score, such as one eye of a side-by-side picture; the view is of the crop
    #[arg(long, value_name = "X,Y,W,H", value_parser = crop)]
    crop: Option<Crop>,
    /// Most pixels a file may declare, millions
    #[arg(long, value_name = "N", default_value_t = ReadOptions::default().max_megapixels)]
    max_megapixels: u64,
}

impl SignalArgs {
    pub(crate) fn signal(&self) -> SignalParams {
        SignalParams {
            transfer: match self.transfer {
                TransferArg::Auto => None,
                TransferArg::Srgb => Some(Transfer::Srgb),
                TransferArg::Linear => Some(Transfer::Linear),
                TransferArg::Pq => Some(Transfer::Pq),
                TransferArg::Gamma22 => Some(Transfer::Gamma22),
            },
            exposure_stops: self.exposure,
            tonemap: match self.tonemap {
                ToneMapArg::Clamp => ToneMap::Clamp,
                ToneMapArg::Reinhard => ToneMap::Reinhard,
                ToneMapArg::Aces => ToneMap::Aces,
            },
            channels: match self.channels {
                ChannelsArg::Rgb => SignalChannels::Rgb,
                ChannelsArg::Luma => SignalChannels::Luma,
            },
        }
    }

    pub(crate) fn read(&self) -> ReadOptions {
        ReadOptions {
            layer: self.layer.clone(),
            alpha: match self.alpha {
                AlphaArg::Error => AlphaPolicy::Error,
                AlphaArg::Ignore => AlphaPolicy::Ignore,
                AlphaArg::OverBlack => AlphaPolicy::OverBlack,
            },
            max_megapixels: self.max_megapixels,
            ..ReadOptions::default()
        }
    }

    pub(crate) fn test_layer(&self) -> Option<String> {
        self.test_layer.clone()
    }

    pub(crate) fn nonfinite(&self) -> Nonfinite {
        match self.nonfinite {
            NonfiniteArg::Error => Nonfinite::Error,
            NonfiniteArg::Mask => Nonfinite::Mask,
        }
    }

    pub(crate) fn mask(&self) -> Option<PathBuf> {
        self.mask.clone()
    }

    pub(crate) fn crop(&self) -> Option<Crop> {
        self.crop
    }
}
