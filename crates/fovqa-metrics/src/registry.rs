//! The registry of metrics: the description of each, and the parameters of all.

use fovqa_params::{ParamError, ParamValue, find};

use crate::fidelity::score_error::ScoreError;
use crate::fidelity::scored::Scored;
use crate::info::MetricInfo;
use crate::kinds::MetricKind;
use crate::metric::{Metric, for_all_metrics};
use crate::metric_params::MetricParams;
use crate::pair_input::PairInput;
use crate::pooling::Statistic;
use crate::profile::PictureInput;
use crate::row::Rows;
use crate::temporal::TimeInput;
use crate::{fidelity, metric, profile, temporal};

macro_rules! registry {
    ($($(#[$about:meta])* $metric:ident, $params:ident: $($file:ident)::+;)*) => {
        impl Metric {
            /// The description of this metric.
            pub fn info(self) -> &'static MetricInfo {
                match self {
                    $(Metric::$metric => &$($file)::+::INFO,)*
                }
            }

            /// Whether it measures pairs or pictures in a pass of its own.
            pub fn has_own_pass(self) -> bool {
                match self {
                    $(Metric::$metric => <$($file)::+::Params as MetricParams>::HAS_OWN_PASS,)*
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

            /// Checks conditions that involve several parameters of a metric.
            ///
            /// # Errors
            /// The first condition that does not hold.
            pub fn check(&self) -> Result<(), ParamError> {
                $(self.$params.check()?;)*
                Ok(())
            }

            /// Checks conditions that involve several parameters of one metric.
            ///
            /// # Errors
            /// The first condition that does not hold.
            pub fn check_of(&self, metric: Metric) -> Result<(), ParamError> {
                match metric {
                    $(Metric::$metric => self.$params.check(),)*
                }
            }

            /// The smallest side that a frame may have for a metric, in pixels.
            pub fn smallest_side(&self, metric: Metric) -> usize {
                let window = self.ssim.window_side();
                match metric {
                    $(Metric::$metric => self.$params.smallest_side(window),)*
                }
            }

            /// The number of block levels that need bands for a metric: level 1 has blocks of 2x2
            /// pixels, and each further level doubles their side.
            pub fn block_levels(&self, metric: Metric) -> usize {
                match metric {
                    $(Metric::$metric => self.$params.block_levels(),)*
                }
            }

            /// Measures a picture; `None` for a metric that is no profile with a pass of its own.
            pub(crate) fn profile(&self, metric: Metric, input: &PictureInput<'_>) -> Option<Rows> {
                match metric {
                    $(Metric::$metric => self.$params.profile(self, input),)*
                }
            }

            /// The number of frames that a temporal metric compares, the present one included. For
            /// other kinds it is 1.
            pub fn frames_needed(&self, metric: Metric) -> usize {
                match metric {
                    $(Metric::$metric => self.$params.frames_needed(),)*
                }
            }

            /// Measures the change of pictures over time, and returns the values of each; `None` for
            /// a metric that is not temporal.
            ///
            /// # Panics
            /// When planes or regions differ in size, or there are fewer frames than the metric
            /// needs.
            pub fn follow(&self, metric: Metric, input: &TimeInput<'_>) -> Option<Vec<Rows>> {
                match metric {
                    $(Metric::$metric => self.$params.follow(self, input),)*
                }
            }

            /// Measures a pair; `None` for a metric without a pass of its own.
            pub fn measure(
                &self,
                metric: Metric,
                input: &PairInput<'_>,
            ) -> Option<Result<Scored, ScoreError>> {
                match metric {
                    $(Metric::$metric => self.$params.measure(self, input),)*
                }
            }
        }
    };
}

for_all_metrics!(registry);

impl Metric {
    /// The metrics of a run that names none. Temporal ones apply only to sequences.
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

    /// Whether it is of a kind.
    pub fn is(self, kind: MetricKind) -> bool {
        self.info().kind == kind
    }

    /// Whether a sequence has a pooled value besides the mean of its frames, such as the PSNR of the mean
    /// squared error.
    pub fn pools_frames(self) -> bool {
        let own = |statistic: &&Statistic| statistic.name.is_empty();
        self.info().statistics.iter().find(own).is_some_and(Statistic::pools_frames)
    }

    /// Whether it compares each test with its reference by one number, so that frames can be ranked by it.
    pub fn scores_frames(self) -> bool {
        self.is(MetricKind::Fidelity) && self.info().statistics[0].name.is_empty()
    }

    /// All metrics that score frames: first the given ones, then the others in the order of tables.
    pub fn scoring_frames(first: &[Metric]) -> impl Iterator<Item = Metric> {
        let others = Self::ALL.into_iter().filter(|m| m.scores_frames() && !first.contains(m));
        first.iter().copied().chain(others)
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
    /// When the metric has no such parameter, or the parameter does not accept the value.
    pub fn set(
        &mut self,
        metric: Metric,
        param: &str,
        value: &ParamValue,
    ) -> Result<(), ParamError> {
        let info = metric.info();
        let (known, value) = find(info.key, info.params, param, value)?;
        let set = self.set_known(metric, known.name, &value);
        set.ok_or_else(|| known.value_error(info.key, &value))
    }
}

impl Params {
    /// The metrics that do not fit frames of a size, with the reasons.
    pub fn unfit(
        &self,
        metrics: &[Metric],
        (width, height): (usize, usize),
    ) -> Vec<(Metric, ScoreError)> {
        let too_small = metrics.iter().filter_map(|&metric| {
            let needed = self.smallest_side(metric);
            let error = ScoreError::TooSmall { metric, width, height, needed };
            (width.min(height) < needed).then_some((metric, error))
        });
        too_small.collect()
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
    fn refuses_unknown_names_and_values_out_of_range() {
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
