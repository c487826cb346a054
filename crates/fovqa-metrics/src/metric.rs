//! The list of all metrics: one line per metric. Everything else about a metric is in its own file.

use serde::{Deserialize, Serialize};

// A metric with a pass of its own is declared as a module here, so that no other file needs a line
// for it. Its source stays in `fidelity/`.
#[path = "fidelity/flip/mod.rs"]
pub(crate) mod flip;
#[path = "fidelity/fwqi/mod.rs"]
pub(crate) mod fwqi;
#[path = "fidelity/gmsd/mod.rs"]
pub(crate) mod gmsd;
#[path = "fidelity/hdr_flip/mod.rs"]
pub(crate) mod hdr_flip;

/// Passes the list to another macro: the metric, the name of its parameters, and its file. Metrics
/// are in the order of tables.
macro_rules! for_all_metrics {
    ($then:ident) => {
        $then! {
            /// Mean squared error.
            Mse, mse: fidelity::mse;
            /// Peak signal-to-noise ratio.
            Psnr, psnr: fidelity::psnr;
            /// Structural similarity; MS-SSIM and FSSIM use its window and constants.
            Ssim, ssim: fidelity::ssim;
            /// Multi-scale structural similarity.
            MsSsim, ms_ssim: fidelity::ms_ssim;
            /// Foveal peak signal-to-noise ratio; FSSIM uses its weight.
            Fpsnr, fpsnr: fidelity::fpsnr;
            /// Structural similarity with the foveal weight.
            Fssim, fssim: fidelity::fssim;
            /// Gradient magnitude similarity deviation.
            Gmsd, gmsd: metric::gmsd;
            /// FLIP; HDR-FLIP uses its pixels per degree.
            Flip, flip: metric::flip;
            /// FLIP over a range of exposures.
            HdrFlip, hdr_flip: metric::hdr_flip;
            /// Foveated wavelet image quality index.
            Fwqi, fwqi: metric::fwqi;
            /// FovVideoVDP; PU-PSNR uses the same luminance.
            Fvvdp, fvvdp: fidelity::fvvdp;
            /// Peak signal-to-noise ratio of perceptually uniform luminance.
            PuPsnr, pu_psnr: fidelity::pu_psnr;
            /// RMS contrast by eccentricity.
            RmsContrast, rms_contrast: profile::rms_contrast;
            /// Haar wavelet coefficients by level and eccentricity.
            Haar, haar: profile::haar;
            /// Power spectrum by eccentricity.
            Spectrum, spectrum: profile::spectrum;
            /// Average temporal difference.
            Atd, atd: temporal::atd;
            /// Change of luma over several frames.
            Flicker, flicker: temporal::flicker;
        }
    };
}
pub(crate) use for_all_metrics;

macro_rules! declare {
    ($($(#[$about:meta])* $metric:ident, $params:ident: $($file:ident)::+;)*) => {
        /// A metric. In JSON it is written as its key.
        #[derive(
            Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize,
        )]
        #[serde(try_from = "String", into = "&'static str")]
        pub enum Metric {
            $($(#[$about])* $metric,)*
        }

        impl Metric {
            /// All metrics, in the order of tables.
            pub const ALL: [Metric; [$(stringify!($metric)),*].len()] = [$(Metric::$metric),*];
        }
    };
}

for_all_metrics!(declare);
