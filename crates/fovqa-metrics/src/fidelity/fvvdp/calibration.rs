//! The calibrated constants of FovVideoVDP 1.2 (those of the paper, v1.0, differ).

/// Exponent of the contrast difference in the masking function.
pub(super) const MASK_P: f64 = 2.4;
/// log10 of the gain of the masking signal.
pub(super) const LOG10_MASK_C: f64 = -0.973_838;
/// Exponents of the masking signal, sustained and transient.
pub(super) const MASK_Q: [f64; 2] = [2.436_85, 4.946];
/// The largest masked difference.
pub(super) const MAX_DIFFERENCE: f64 = 1e4;

/// Weights of the sustained and the transient channel when they are pooled.
pub(super) const CHANNEL_WEIGHTS: [f64; 2] = [1.0, 0.25];
/// Exponent of pooling over pixels.
pub(super) const BETA: f64 = 1.521_34;
/// Exponent of pooling over temporal channels.
pub(super) const BETA_CHANNELS: f64 = 0.666_092;

/// a in the conversion of the pooled difference Q to just-objectionable differences: 10 - a Q^b.
pub(super) const JOD_A: f64 = 0.016_171_3;
/// log10 of b.
pub(super) const LOG10_JOD_B: f64 = -0.2280;

/// The sustained temporal filter: its width in log time, and the time of its peak in seconds.
pub(super) const SUSTAINED_SIGMA: f64 = 0.5;
pub(super) const SUSTAINED_PEAK_S: f64 = 0.06;
/// Gain of the transient temporal filter.
pub(super) const TRANSIENT_GAIN: f64 = 0.062_170_507_756_932;
/// The duration of both filters, in seconds.
pub(super) const FILTER_S: f64 = 0.25;

/// Correction of the sensitivity, in dB of amplitude.
pub(super) const SENSITIVITY_DB: f64 = 16.2596;

/// Frequency of the first band below the Nyquist frequency, as a share of the Nyquist frequency.
pub(super) const FIRST_BAND: f64 = 0.3228;
/// The pyramid ends with the first band at or below this frequency, in cycles per degree.
pub(super) const LOWEST_CPD: f64 = 0.5;
/// The largest number of bands.
pub(super) const MOST_BANDS: usize = 15;

/// The lowest background luminance, in cd/m².
pub(super) const DARKEST_BACKGROUND_CD_M2: f32 = 0.1;
/// The largest contrast, before the gain of its band.
pub(super) const MAX_CONTRAST: f32 = 1000.0;
/// Gain of the contrast of all bands except the finest.
pub(super) const COARSE_GAIN: f64 = 2.0;

/// The lowest luminance of displays whose input is luminance, in cd/m².
pub(super) const LOWEST_LIGHT_CD_M2: f64 = 0.005;

/// The largest angle from the display's centre at which the magnification is evaluated, in degrees.
pub(super) const FARTHEST_DEG: f64 = 89.9;
