//! Notices mistakes in what is compared: a number that was computed from the wrong pair is worse than
//! none.
//!
//! [`look`] reads a sparse sample of a pair, a fraction of its rows, and returns what cannot be
//! intended: a constant picture, another scene, a mirrored or shifted picture, another exposure or
//! transfer function, swapped folders, and a gaze that is not where the test is sharpest. The checks are
//! choices of ours. Their thresholds leave a margin to every correct pair that we have, true foveated
//! renders among them, because a false alarm costs more trust than a missed mistake: a mistake that
//! changes little is not noticed.
//!
//! | check | what it compares |
//! | --- | --- |
//! | constant | pixels of one picture |
//! | scene, mirrored | correlation of the means of windows, and with the other picture mirrored |
//! | shifted | squared difference at whole pixels of shift, in windows that agree best |
//! | channels | red less blue, at single pixels |
//! | exposure | median ratio of linear light in stops, and its spread |
//! | transfer | slope of the logarithm of light against that of the other picture |
//! | swapped | fine detail of the test by that of the reference, near the sharpest place and far away |
//! | gaze | blur in pixels of windows, as a rising function of the distance from a place |

mod brightness;
mod channels;
mod constant;
mod file_kind;
mod pair;
mod plane;
mod radial;
mod sample;
mod scene;
mod sharpness;
mod shift;
mod suspicion;

pub use file_kind::FileKind;
pub use pair::{Looked, glance, look};
pub use suspicion::{Check, Plausibility, Suspicion};
