//! What there is to measure.

use fovqa_params::{ParamInfo, ParamValues};

use crate::fidelity::fvvdp::ColorSpace;
use crate::fidelity::ssim;
use crate::profile::haar;

/// A metric.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Metric {
    /// Mean squared error.
    Mse,
    /// Peak signal-to-noise ratio.
    Psnr,
    /// Structural similarity.
    Ssim,
    /// Multi-scale structural similarity.
    MsSsim,
    /// Foveal peak signal-to-noise ratio.
    Fpsnr,
    /// Structural similarity under the foveal weight.
    Fssim,
    /// FovVideoVDP.
    Fvvdp,
    /// Peak signal-to-noise ratio of perceptually uniform luminance.
    PuPsnr,
    /// RMS contrast by eccentricity.
    RmsContrast,
    /// Haar wavelet coefficients by level and eccentricity.
    Haar,
    /// Average temporal difference.
    Atd,
}

/// What a metric is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MetricKind {
    /// A test against its reference: one number.
    Fidelity,
    /// One picture by eccentricity: of reference and test alike, and their ratio.
    Profile,
    /// One sequence over time: of reference and test alike, and their ratio.
    Temporal,
}

/// Which way a metric points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Better {
    /// Larger is better.
    Higher,
    /// Smaller is better.
    Lower,
    /// Neither: it is held against the reference's.
    Neither,
}

/// What there is to say about a metric.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MetricInfo {
    /// Its name in results and, with `-` for `_` if one likes, on the command line.
    pub key: &'static str,
    /// Its name in tables.
    pub label: &'static str,
    /// Version of its values: another one for whatever changes them.
    pub version: u32,
    /// Its unit; empty for a plain number.
    pub unit: &'static str,
    /// What it is of.
    pub kind: MetricKind,
    /// Its direction.
    pub better: Better,
    /// Whether it has a value per eccentricity band.
    pub per_band: bool,
    /// Whether it needs a view even without bands.
    pub needs_view: bool,
    /// Whether it is of light, and needs the display's photometry.
    pub needs_luminance: bool,
    /// One line on what it is.
    pub about: &'static str,
    /// Where it comes from.
    pub source: &'static str,
    /// Its parameters.
    pub params: &'static [ParamInfo],
}

impl Metric {
    /// All metrics, in the order of tables.
    pub const ALL: [Metric; 11] = [
        Metric::Mse,
        Metric::Psnr,
        Metric::Ssim,
        Metric::MsSsim,
        Metric::Fpsnr,
        Metric::Fssim,
        Metric::Fvvdp,
        Metric::PuPsnr,
        Metric::RmsContrast,
        Metric::Haar,
        Metric::Atd,
    ];

    /// The metrics of a run that names none; temporal ones are of sequences alone.
    pub const DEFAULT: [Metric; 7] = [
        Metric::Mse,
        Metric::Psnr,
        Metric::Ssim,
        Metric::Fpsnr,
        Metric::RmsContrast,
        Metric::Haar,
        Metric::Atd,
    ];

    /// The metric of a name; `-` and `_` are alike.
    pub fn find(name: &str) -> Option<Metric> {
        let name = name.replace('-', "_").to_lowercase();
        Self::ALL.into_iter().find(|metric| metric.info().key == name)
    }

    /// Its entry.
    pub fn info(self) -> &'static MetricInfo {
        match self {
            Metric::Mse => &MSE,
            Metric::Psnr => &PSNR,
            Metric::Ssim => &SSIM,
            Metric::MsSsim => &MS_SSIM,
            Metric::Fpsnr => &FPSNR,
            Metric::Fssim => &FSSIM,
            Metric::Fvvdp => &FVVDP,
            Metric::PuPsnr => &PU_PSNR,
            Metric::RmsContrast => &RMS_CONTRAST,
            Metric::Haar => &HAAR,
            Metric::Atd => &ATD,
        }
    }

    /// Its name in results.
    pub fn key(self) -> &'static str {
        self.info().key
    }

    /// Whether it is of one kind.
    pub fn is(self, kind: MetricKind) -> bool {
        self.info().kind == kind
    }

    /// Whether its value is a number of decibels, infinite for identical pictures.
    pub fn is_decibel(self) -> bool {
        self.info().unit == "dB"
    }
}

const MSE: MetricInfo = MetricInfo {
    key: "mse",
    label: "MSE",
    version: 1,
    unit: "",
    kind: MetricKind::Fidelity,
    better: Better::Lower,
    per_band: true,
    needs_view: false,
    needs_luminance: false,
    about: "mean squared error of the encoded signal, peak 1",
    source: "the squared error of all channels, pooled",
    params: &[],
};

const PSNR: MetricInfo = MetricInfo {
    key: "psnr",
    label: "PSNR",
    version: 1,
    unit: "dB",
    kind: MetricKind::Fidelity,
    better: Better::Higher,
    per_band: true,
    needs_view: false,
    needs_luminance: false,
    about: "peak signal-to-noise ratio, -10 log10 MSE",
    source: "as scikit-image's peak_signal_noise_ratio",
    params: &[],
};

const SSIM: MetricInfo = MetricInfo {
    key: "ssim",
    label: "SSIM",
    version: 1,
    unit: "",
    kind: MetricKind::Fidelity,
    better: Better::Higher,
    per_band: true,
    needs_view: false,
    needs_luminance: false,
    about: "structural similarity, the mean of its map where the window fits",
    source: "Wang, Bovik, Sheikh, Simoncelli 2004",
    params: &[
        ParamInfo {
            name: "sigma",
            default: "1.5",
            values: ParamValues::Number(ssim::MIN_SIGMA, ssim::MAX_SIGMA),
            about: "Gaussian window, px (MS-SSIM and FSSIM too)",
        },
        ParamInfo {
            name: "radius",
            default: "\"auto\"",
            values: ParamValues::WholeOr(1, ssim::MAX_RADIUS, "auto"),
            about: "window radius, px; auto is 3.5 sigma, rounded (5)",
        },
        ParamInfo {
            name: "k1",
            default: "0.01",
            values: ParamValues::Number(ssim::MIN_K1, 1.0),
            about: "stabiliser of the means",
        },
        ParamInfo {
            name: "k2",
            default: "0.03",
            values: ParamValues::Number(ssim::MIN_K2, 1.0),
            about: "stabiliser of the variances",
        },
    ],
};

const MS_SSIM: MetricInfo = MetricInfo {
    key: "ms_ssim",
    label: "MS-SSIM",
    version: 1,
    unit: "",
    kind: MetricKind::Fidelity,
    better: Better::Higher,
    per_band: false,
    needs_view: false,
    needs_luminance: false,
    about: "structural similarity over five scales; sides of 176 px or more",
    source: "Wang, Simoncelli, Bovik 2003; window and constants are ssim's",
    params: &[],
};

const FPSNR: MetricInfo = MetricInfo {
    key: "fpsnr",
    label: "FPSNR",
    version: 1,
    unit: "dB",
    kind: MetricKind::Fidelity,
    better: Better::Higher,
    per_band: false,
    needs_view: true,
    needs_luminance: false,
    about: "PSNR under the square of the visible cut-off frequency; compare methods, not papers",
    source: "Lee, Pattichis, Bovik 2002; weights after Geisler and Perry 1998",
    params: &[
        ParamInfo {
            name: "weight",
            default: "\"lee2002\"",
            values: ParamValues::Word(&["lee2002", "acuity"]),
            about: "the curve (FSSIM too)",
        },
        ParamInfo {
            name: "alpha",
            default: "0.106",
            values: ParamValues::Number(1e-3, 10.0),
            about: "lee2002: decay of contrast sensitivity",
        },
        ParamInfo {
            name: "e2_deg",
            default: "2.3",
            values: ParamValues::Number(0.01, 180.0),
            about: "lee2002: half-resolution eccentricity, °",
        },
        ParamInfo {
            name: "ct0",
            default: "0.015625",
            values: ParamValues::Number(1e-6, 0.99),
            about: "lee2002: smallest contrast threshold",
        },
        ParamInfo {
            name: "acuity",
            default: "\"piecewise\"",
            values: ParamValues::Word(&["piecewise", "linear_mar"]),
            about: "acuity: the model",
        },
        ParamInfo {
            name: "knots_deg",
            default: "[0, 10, 20, 30, 60]",
            values: ParamValues::Numbers,
            about: "piecewise: eccentricities, °, rising from 0",
        },
        ParamInfo {
            name: "knots_cpd",
            default: "[40, 10, 6, 5, 4]",
            values: ParamValues::Numbers,
            about: "piecewise: acuity there, cpd, 0.01 to 1000",
        },
        ParamInfo {
            name: "m",
            default: "0.0275",
            values: ParamValues::Number(0.0, 10.0),
            about: "linear_mar: slope, ° per °",
        },
        ParamInfo {
            name: "omega0_deg",
            default: "0.020833333333333332",
            values: ParamValues::Number(1e-4, 10.0),
            about: "linear_mar: one cycle at the fovea, °",
        },
    ],
};

const FSSIM: MetricInfo = MetricInfo {
    key: "fssim",
    label: "FSSIM",
    version: 1,
    unit: "",
    kind: MetricKind::Fidelity,
    better: Better::Higher,
    per_band: false,
    needs_view: true,
    needs_luminance: false,
    about: "the SSIM map under FPSNR's weight",
    source: "ours: the map of ssim under the weight of fpsnr",
    params: &[],
};

const FVVDP: MetricInfo = MetricInfo {
    key: "fvvdp",
    label: "FovVideoVDP",
    version: 1,
    unit: "JOD",
    kind: MetricKind::Fidelity,
    better: Better::Higher,
    per_band: true,
    needs_view: true,
    needs_luminance: true,
    about: "visible difference by eccentricity, over space and time: 10 for none, 1 less where 75 % prefer the reference; of bands, their share of the difference Q",
    source: "Mantiuk et al. 2021, version 1.2",
    params: &[
        ParamInfo {
            name: "foveated",
            default: "true",
            values: ParamValues::Flag,
            about: "sensitivity falls off from the gaze; else every pixel is looked at directly",
        },
        ParamInfo {
            name: "temp_padding",
            default: "\"replicate\"",
            values: ParamValues::Word(&["replicate", "circular", "pingpong"]),
            about: "what stands before the first frame of a sequence",
        },
        ParamInfo {
            name: "cd_m2_per_unit",
            default: "\"auto\"",
            values: ParamValues::NumberOr(1e-9, 1e9, "auto"),
            about: "cd/m² of a linear sample of 1 (PU-PSNR too); auto is 1 on linear and PQ displays, and the tone-mapped signal on others",
        },
        ParamInfo {
            name: "color_space",
            default: "\"srgb\"",
            values: ParamValues::Word(&ColorSpace::NAMES),
            about: "primaries of the files (PU-PSNR too)",
        },
        ParamInfo {
            name: "exact_edges",
            default: "false",
            values: ParamValues::Flag,
            about: "weigh the right edge of coarser levels by their columns; FovVideoVDP does it by their rows",
        },
        ParamInfo {
            name: "map_context",
            default: "\"test\"",
            values: ParamValues::Word(&["test", "reference"]),
            about: "the picture below coloured heat maps",
        },
    ],
};

const PU_PSNR: MetricInfo = MetricInfo {
    key: "pu_psnr",
    label: "PU-PSNR",
    version: 1,
    unit: "dB",
    kind: MetricKind::Fidelity,
    better: Better::Higher,
    per_band: false,
    needs_view: false,
    needs_luminance: true,
    about: "PSNR of the display's luminance in perceptually uniform units (PU21)",
    source: "Mantiuk, Azimi 2021, banding and glare; as in FovVideoVDP 1.2",
    params: &[],
};

const RMS_CONTRAST: MetricInfo = MetricInfo {
    key: "rms_contrast",
    label: "RMS contrast",
    version: 1,
    unit: "",
    kind: MetricKind::Profile,
    better: Better::Neither,
    per_band: true,
    needs_view: true,
    needs_luminance: false,
    about: "standard deviation of luma in each band, of reference and test, and their ratio",
    source: "Peli 1990; Patney et al. 2016, Fig. 4",
    params: &[
        ParamInfo {
            name: "signal",
            default: "\"luma\"",
            values: ParamValues::Word(&["luma", "luminance"]),
            about: "of the encoded signal, or of linear light after exposure",
        },
        ParamInfo {
            name: "normalise",
            default: "\"none\"",
            values: ParamValues::Word(&["none", "mean"]),
            about: "divided by the band's mean",
        },
    ],
};

const HAAR: MetricInfo = MetricInfo {
    key: "haar",
    label: "Haar wavelet",
    version: 1,
    unit: "",
    kind: MetricKind::Profile,
    better: Better::Neither,
    per_band: true,
    needs_view: true,
    needs_luminance: false,
    about: "wavelet coefficients of luma by level and band (mean_abs, max_abs, energy), of reference and test, and their ratios",
    source: "Patney et al. 2016, 4.4.2, Fig. 10",
    params: &[
        ParamInfo {
            name: "levels",
            default: "5",
            values: ParamValues::Whole(1, haar::MAX_LEVELS),
            about: "levels; level l is of blocks of 2^l px a side",
        },
        ParamInfo {
            name: "orientations",
            default: "false",
            values: ParamValues::Flag,
            about: "LH, HL and HH one by one too",
        },
    ],
};

const ATD: MetricInfo = MetricInfo {
    key: "atd",
    label: "ATD",
    version: 1,
    unit: "",
    kind: MetricKind::Temporal,
    better: Better::Lower,
    per_band: true,
    needs_view: false,
    needs_luminance: false,
    about: "average temporal difference of luma along the motion, of reference and test, and their ratio",
    source: "Patney et al. 2016, 4.4.3",
    params: &[ParamInfo {
        name: "depth_tolerance",
        default: "0.05",
        values: ParamValues::NumberOr(0.0, 1e6, "off"),
        about: "how much depth may differ along the motion, as a share; off leaves depth out",
    }],
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_find_their_metric() {
        for metric in Metric::ALL {
            assert_eq!(Metric::find(metric.key()), Some(metric));
            assert_eq!(Metric::find(&metric.key().replace('_', "-").to_uppercase()), Some(metric));
        }
        assert_eq!(Metric::find("pnsr"), None);
    }
}
