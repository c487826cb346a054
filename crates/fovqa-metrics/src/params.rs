//! Parameters of all metrics, set by name.

use fovqa_params::{ParamError, ParamValue, find};

use crate::fidelity::{fpsnr, fvvdp, ssim};
use crate::profile::{haar, rms_contrast};
use crate::registry::Metric;
use crate::temporal::atd;

/// Parameters of all metrics.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Params {
    /// SSIM's window and constants; MS-SSIM and FSSIM use them too.
    pub ssim: ssim::Params,
    /// The foveal weight of FPSNR and FSSIM.
    pub fpsnr: fpsnr::Params,
    /// FovVideoVDP; PU-PSNR sees light as it does.
    pub fvvdp: fvvdp::Params,
    /// RMS contrast.
    pub rms_contrast: rms_contrast::Params,
    /// The Haar wavelet.
    pub haar: haar::Params,
    /// Average temporal difference.
    pub atd: atd::Params,
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
        let set = match metric {
            Metric::Ssim => self.ssim.set(known.name, &value),
            Metric::Fpsnr => self.fpsnr.set(known.name, &value),
            Metric::Fvvdp => self.fvvdp.set(known.name, &value),
            Metric::RmsContrast => self.rms_contrast.set(known.name, &value),
            Metric::Haar => self.haar.set(known.name, &value),
            Metric::Atd => self.atd.set(known.name, &value),
            Metric::Mse | Metric::Psnr | Metric::MsSsim | Metric::Fssim | Metric::PuPsnr => None,
        };
        set.ok_or_else(|| known.refuses(info.key, &value))
    }

    /// Checks what only all parameters together can tell.
    ///
    /// # Errors
    /// When the acuity knots are not a curve.
    pub fn check(&self) -> Result<(), ParamError> {
        self.fpsnr.check().map_err(|expected| ParamError::Value {
            owner: Metric::Fpsnr.key(),
            param: "knots_cpd",
            value: format!("{:?} at {:?}", self.fpsnr.knots_cpd, self.fpsnr.knots_deg),
            expected,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
