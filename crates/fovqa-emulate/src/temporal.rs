//! Temporal filter (Patney et al. 2016, section 4.2): C ← α' C + (1 - α') h, h the last output where the
//! pixel was, clamped to M1 ± kσ of this frame around it. After a saccade, where the rate of shading rose,
//! α' goes from α towards α_max.

use std::sync::Arc;

use fovqa_frame::Motion;
use fovqa_params::{ParamInfo, ParamValue, ParamValues};

use crate::fetch::lerp;
use crate::image::Image;
use crate::moments::{COARSEST, Chain, Moment};
use crate::picture::Picture;

/// Parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TaaParams {
    /// Weight of this frame. Default 0.1.
    pub alpha: f64,
    /// How many standard deviations history may be off. Default 1.
    pub k: f64,
    /// Weight of this frame after a saccade. Default 1/3.
    pub alpha_max: f64,
    /// The fall of S that is a whole saccade. Default 1/4.
    pub beta: f64,
}

impl Default for TaaParams {
    fn default() -> Self {
        Self { alpha: 0.1, k: 1.0, alpha_max: 1.0 / 3.0, beta: 0.25 }
    }
}

impl TaaParams {
    pub(crate) const INFO: &'static [ParamInfo] = &[
        ParamInfo {
            name: "alpha",
            default: "0.1",
            values: ParamValues::Number(0.0, 1.0),
            about: "weight of the present frame",
        },
        ParamInfo {
            name: "k",
            default: "1",
            values: ParamValues::Number(0.0, 1000.0),
            about: "standard deviations that history may be off the present frame",
        },
        ParamInfo {
            name: "alpha_max",
            default: "0.3333333333333333",
            values: ParamValues::Number(0.0, 1.0),
            about: "weight of the present frame after a saccade",
        },
        ParamInfo {
            name: "beta",
            default: "0.25",
            values: ParamValues::Number(1e-6, 1000.0),
            about: "fall of the normalised rate S that counts as a whole saccade",
        },
    ];

    pub(crate) fn set(&mut self, name: &str, value: &ParamValue) -> Option<()> {
        match name {
            "alpha" => self.alpha = value.number()?,
            "k" => self.k = value.number()?,
            "alpha_max" => self.alpha_max = value.number()?,
            "beta" => self.beta = value.number()?,
            _ => return None,
        }
        Some(())
    }

    /// α', where S was `before` in the last frame and is `now`.
    pub fn weight(&self, before: f64, now: f64) -> f64 {
        let omega = ((before - now) / self.beta).clamp(0.0, 1.0);
        omega * self.alpha_max + (1.0 - omega) * self.alpha
    }
}

/// What the temporal filter keeps from frame to frame: its last output, and the normalised rate S of the
/// frame it was for. Empty before the first frame.
#[derive(Debug, Clone, Default)]
pub struct History {
    pub(crate) last: Option<Picture>,
    pub(crate) rates: Option<Arc<Image<1>>>,
}

/// What a step of the filter works on.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Step<'a, const C: usize> {
    pub(crate) current: &'a Image<C>,
    pub(crate) last: &'a Image<C>,
    /// Where pixels were; `None`: where they are.
    pub(crate) motion: Option<&'a Motion>,
    /// S of this frame and of the last one; `None`: 0.
    pub(crate) rates: Option<&'a Image<1>>,
    pub(crate) last_rates: Option<&'a Image<1>>,
}

impl<const C: usize> Step<'_, C> {
    /// The filtered frame.
    pub(crate) fn filter(&self, params: &TaaParams) -> Image<C> {
        let (width, height) = (self.current.width(), self.current.height());
        let chains = self.rates.map(|_| {
            [Moment::First, Moment::Second].map(|moment| Chain::new(moment, self.current))
        });
        Image::by_blocks(width, height, |rows, pixels| {
            let (mut m1, mut m2) = (vec![[0.0; C]; width], vec![[0.0; C]; width]);
            let (mut dx, mut dy) = (vec![0.0; width], vec![0.0; width]);
            for (y, out) in rows.zip(pixels.chunks_exact_mut(width)) {
                Moment::First.row(self.current, y, &mut m1);
                Moment::Second.row(self.current, y, &mut m2);
                if let Some(motion) = self.motion {
                    motion.fill_row(y, 0..width, &mut dx, &mut dy);
                }
                let scale = self.motion.map_or([0.0; 2], Motion::scale);
                for (x, out) in out.iter_mut().enumerate() {
                    let current = self.current.row(y)[x];
                    let from_x = x as f64 + 0.5 + f64::from(dx[x]) * scale[0];
                    let from_y = y as f64 + 0.5 + f64::from(dy[x]) * scale[1];
                    let inside = (0.0..width as f64).contains(&from_x)
                        && (0.0..height as f64).contains(&from_y);
                    if !inside {
                        *out = current;
                        continue;
                    }
                    let now = self.rates.map_or(0.0, |rates| rates.row(y)[x][0]);
                    let before = self.last_rates.map_or(0.0, |rates| rates.at(from_x, from_y)[0]);
                    let (mut mean, mut square) = (m1[x], m2[x]);
                    if let Some([first, second]) = &chains {
                        let level = now * COARSEST as f32;
                        mean = first.at(level, x, y, mean);
                        square = second.at(level, x, y, square);
                    }
                    let last = self.last.at(from_x, from_y);
                    let kept = within(last, mean, square, params.k as f32);
                    let weight = params.weight(f64::from(before), f64::from(now));
                    *out = lerp(kept, current, weight as f32);
                }
            }
        })
    }
}

/// A value within so many standard deviations of a mean; a variance below 0 counts as 0.
#[inline(always)]
fn within<const C: usize>(value: [f32; C], mean: [f32; C], square: [f32; C], k: f32) -> [f32; C] {
    std::array::from_fn(|c| {
        let reach = k * (square[c] - mean[c] * mean[c]).max(0.0).sqrt();
        value[c].max(mean[c] - reach).min(mean[c] + reach)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_papers_weights() {
        let params = TaaParams::default();
        assert!((params.weight(1.0, 0.0) - 1.0 / 3.0).abs() < 1e-12);
        assert!((params.weight(0.125, 0.0) - 0.216_666_666_667).abs() < 1e-9);
        assert!((params.weight(0.0, 1.0) - 0.1).abs() < 1e-12);
    }
}
