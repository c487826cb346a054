//! What there is to measure: a list. Everything about a metric stands in its own file.

use fovqa_params::{ParamError, ParamValue, find};
use serde::{Deserialize, Serialize};

use crate::info::{MetricInfo, MetricKind, MetricParams};
use crate::pooling::Statistic;
use crate::{fidelity, profile, temporal};

// A metric that shares a pass with no other is named in this file alone.
#[path = "fidelity/gmsd.rs"]
mod gmsd;

/// Metrics in the order of tables: the name here, the name of its parameters, its file.
macro_rules! metrics {
    ($($(#[$about:meta])* $metric:ident, $params:ident: $($file:ident)::+;)*) => {
        /// A metric; in JSON its key.
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

            /// Its entry.
            pub fn info(self) -> &'static MetricInfo {
                match self {
                    $(Metric::$metric => &$($file)::+::INFO,)*
                }
            }
        }

        /// Parameters of all metrics.
        #[derive(Debug, Clone, PartialEq, Default)]
        pub struct Params {
            $(
                $(#[$about])*
                pub $params: $($file)::+::Params,
            )*
        }

        impl Params {
            fn set_known(&mut self, metric: Metric, name: &str, value: &ParamValue) -> Option<()> {
                match metric {
                    $(Metric::$metric => self.$params.set(name, value),)*
                }
            }

            /// Checks what only all parameters of a metric together can tell.
            ///
            /// # Errors
            /// The first that cannot be.
            pub fn check(&self) -> Result<(), ParamError> {
                $(self.$params.check()?;)*
                Ok(())
            }
        }
    };
}

metrics! {
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
    /// Structural similarity under the foveal weight.
    Fssim, fssim: fidelity::fssim;
    /// Gradient magnitude similarity deviation.
    Gmsd, gmsd: gmsd;
    /// FovVideoVDP; PU-PSNR sees light as it does.
    Fvvdp, fvvdp: fidelity::fvvdp;
    /// Peak signal-to-noise ratio of perceptually uniform luminance.
    PuPsnr, pu_psnr: fidelity::pu_psnr;
    /// RMS contrast by eccentricity.
    RmsContrast, rms_contrast: profile::rms_contrast;
    /// Haar wavelet coefficients by level and eccentricity.
    Haar, haar: profile::haar;
    /// Average temporal difference.
    Atd, atd: temporal::atd;
}

impl Metric {
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

    /// Its name in results.
    pub fn key(self) -> &'static str {
        self.info().key
    }

    /// Whether it is of one kind.
    pub fn is(self, kind: MetricKind) -> bool {
        self.info().kind == kind
    }

    /// Whether a sequence has a pooled value besides the mean of its frames, such as the PSNR of the mean
    /// squared error.
    pub fn pools_frames(self) -> bool {
        let own = |statistic: &&Statistic| statistic.name.is_empty();
        self.info().statistics.iter().find(own).is_some_and(Statistic::pools_frames)
    }

    /// Whether its value is a number of decibels, infinite for identical pictures.
    pub fn is_decibel(self) -> bool {
        self.info().unit == "dB"
    }
}

impl TryFrom<String> for Metric {
    type Error = String;

    fn try_from(key: String) -> Result<Self, String> {
        Self::find(&key).ok_or_else(|| format!("there is no metric {key:?}"))
    }
}

impl From<Metric> for &'static str {
    fn from(metric: Metric) -> Self {
        metric.key()
    }
}

impl Params {
    /// Sets one parameter.
    ///
    /// # Errors
    /// When the metric has no such parameter, or the value is not one of its values.
    pub fn set(
        &mut self,
        metric: Metric,
        param: &str,
        value: &ParamValue,
    ) -> Result<(), ParamError> {
        let info = metric.info();
        let (known, value) = find(info.key, info.params, param, value)?;
        let set = self.set_known(metric, known.name, &value);
        set.ok_or_else(|| known.refuses(info.key, &value))
    }
}

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

    #[test]
    fn every_listed_parameter_can_be_set_to_its_default() {
        for metric in Metric::ALL {
            for info in metric.info().params {
                let mut params = Params::default();
                params.set(metric, info.name, &info.default_value()).unwrap();
                assert_eq!(params, Params::default(), "{}.{}", metric.key(), info.name);
            }
        }
    }

    #[test]
    fn refuses_what_is_not_there_or_out_of_range() {
        let mut params = Params::default();
        let number = ParamValue::Number;
        assert!(matches!(
            params.set(Metric::Psnr, "sigma", &number(1.0)),
            Err(ParamError::Unknown { .. })
        ));
        for (name, value) in [
            ("sigma", 0.0),
            ("sigma", f64::NAN),
            ("radius", 225.0),
            ("sigma", 65.0),
            ("k2", 1e160),
            ("radius", 2.5),
            ("k1", -1.0),
        ] {
            assert!(
                matches!(
                    params.set(Metric::Ssim, name, &number(value)),
                    Err(ParamError::Value { .. })
                ),
                "{name}"
            );
        }
        params.set(Metric::Fpsnr, "knots-cpd", &ParamValue::List(vec![1.0])).unwrap();
        assert!(params.check().is_err());
    }
}
