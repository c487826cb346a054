//! What there is to measure.

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
}

/// Which way a metric points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Better {
    /// Larger is better.
    Higher,
    /// Smaller is better.
    Lower,
}

/// A parameter of a metric.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ParamInfo {
    /// Its name in `--set METRIC.NAME=VALUE`.
    pub name: &'static str,
    /// Its default.
    pub default: &'static str,
    /// What it is, with unit and range.
    pub about: &'static str,
}

/// What there is to say about a metric.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MetricInfo {
    /// Its name in results and, with `-` for `_` if one likes, on the command line.
    pub key: &'static str,
    /// Its name in tables.
    pub label: &'static str,
    /// Its unit; empty for a plain number.
    pub unit: &'static str,
    /// Its direction.
    pub better: Better,
    /// Whether it has a value per eccentricity band.
    pub per_band: bool,
    /// Whether it needs a view even without bands.
    pub needs_view: bool,
    /// One line on what it is.
    pub about: &'static str,
    /// Where it comes from.
    pub source: &'static str,
    /// Its parameters.
    pub params: &'static [ParamInfo],
}

impl Metric {
    /// All metrics, in the order of tables.
    pub const ALL: [Metric; 6] =
        [Metric::Mse, Metric::Psnr, Metric::Ssim, Metric::MsSsim, Metric::Fpsnr, Metric::Fssim];

    /// The metrics of a run that names none.
    pub const DEFAULT: [Metric; 4] = [Metric::Mse, Metric::Psnr, Metric::Ssim, Metric::Fpsnr];

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
        }
    }

    /// Its name in results.
    pub fn key(self) -> &'static str {
        self.info().key
    }

    /// Whether its value is a number of decibels, infinite for identical pictures.
    pub fn is_decibel(self) -> bool {
        self.info().unit == "dB"
    }
}

const MSE: MetricInfo = MetricInfo {
    key: "mse",
    label: "MSE",
    unit: "",
    better: Better::Lower,
    per_band: true,
    needs_view: false,
    about: "mean squared error of the encoded signal, peak 1",
    source: "the squared error of all channels, pooled",
    params: &[],
};

const PSNR: MetricInfo = MetricInfo {
    key: "psnr",
    label: "PSNR",
    unit: "dB",
    better: Better::Higher,
    per_band: true,
    needs_view: false,
    about: "peak signal-to-noise ratio, -10 log10 MSE",
    source: "as scikit-image's peak_signal_noise_ratio",
    params: &[],
};

const SSIM: MetricInfo = MetricInfo {
    key: "ssim",
    label: "SSIM",
    unit: "",
    better: Better::Higher,
    per_band: true,
    needs_view: false,
    about: "structural similarity, the mean of its map where the window fits",
    source: "Wang, Bovik, Sheikh, Simoncelli 2004",
    params: &[
        ParamInfo {
            name: "sigma",
            default: "1.5",
            about: "Gaussian window, px, 0.1 to 64 (MS-SSIM and FSSIM too)",
        },
        ParamInfo {
            name: "radius",
            default: "auto",
            about: "window radius, px, 1 to 224; auto is 3.5 sigma, rounded (5)",
        },
        ParamInfo { name: "k1", default: "0.01", about: "stabiliser of the means, 0.001 to 1" },
        ParamInfo { name: "k2", default: "0.03", about: "stabiliser of the variances, 0.01 to 1" },
    ],
};

const MS_SSIM: MetricInfo = MetricInfo {
    key: "ms_ssim",
    label: "MS-SSIM",
    unit: "",
    better: Better::Higher,
    per_band: false,
    needs_view: false,
    about: "structural similarity over five scales; sides of 176 px or more",
    source: "Wang, Simoncelli, Bovik 2003; window and constants are ssim's",
    params: &[],
};

const FPSNR: MetricInfo = MetricInfo {
    key: "fpsnr",
    label: "FPSNR",
    unit: "dB",
    better: Better::Higher,
    per_band: false,
    needs_view: true,
    about: "PSNR under the square of the visible cut-off frequency; compare methods, not papers",
    source: "Lee, Pattichis, Bovik 2002; weights after Geisler and Perry 1998",
    params: &[
        ParamInfo {
            name: "weight",
            default: "\"lee2002\"",
            about: "lee2002 or acuity (FSSIM too)",
        },
        ParamInfo {
            name: "alpha",
            default: "0.106",
            about: "lee2002: decay of contrast sensitivity, 0.001 to 10",
        },
        ParamInfo {
            name: "e2_deg",
            default: "2.3",
            about: "lee2002: half-resolution eccentricity, °, 0.01 to 180",
        },
        ParamInfo {
            name: "ct0",
            default: "0.015625",
            about: "lee2002: smallest contrast threshold, 1e-6 to 0.99",
        },
        ParamInfo {
            name: "acuity",
            default: "\"piecewise\"",
            about: "acuity: piecewise or linear_mar",
        },
        ParamInfo {
            name: "knots_deg",
            default: "[0, 10, 20, 30, 60]",
            about: "piecewise: eccentricities, °, rising from 0",
        },
        ParamInfo {
            name: "knots_cpd",
            default: "[40, 10, 6, 5, 4]",
            about: "piecewise: acuity there, cpd, 0.01 to 1000",
        },
        ParamInfo { name: "m", default: "0.0275", about: "linear_mar: slope, ° per °, 0 to 10" },
        ParamInfo {
            name: "omega0_deg",
            default: "0.020833333333333332",
            about: "linear_mar: one cycle at the fovea, °, 0.0001 to 10",
        },
    ],
};

const FSSIM: MetricInfo = MetricInfo {
    key: "fssim",
    label: "FSSIM",
    unit: "",
    better: Better::Higher,
    per_band: false,
    needs_view: true,
    about: "the SSIM map under FPSNR's weight",
    source: "ours: the map of ssim under the weight of fpsnr",
    params: &[],
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
