//! Converts squared errors to decibels and back.

/// PSNR in dB of a mean squared error with peak 1; infinite for 0.
pub(crate) fn psnr_db(mse: f64) -> f64 {
    // The term is subtracted from 0, so that an error of 1 gives 0 dB and not -0.
    if mse == 0.0 { f64::INFINITY } else { 0.0 - 10.0 * libm::log10(mse) }
}

/// The mean squared error, with peak 1, that has a PSNR.
pub(crate) fn mse_of_db(psnr_db: f64) -> f64 {
    libm::pow(10.0, -psnr_db / 10.0)
}
