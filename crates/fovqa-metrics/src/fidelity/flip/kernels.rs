//! The kernels of FLIP: contrast sensitivity of each opponent channel, and edge and point detectors.

use std::f64::consts::PI;

/// Weights at one distance from the centre, in both directions.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Taps {
    /// The achromatic channel.
    pub(crate) y: f32,
    /// The red-green channel.
    pub(crate) cx: f32,
    /// The blue-yellow channel, which is the sum of two separable kernels.
    pub(crate) cz: [f32; 2],
    /// The Gaussian of the detectors.
    pub(crate) gaussian: f32,
    /// Its first derivative; the opposite direction has the opposite sign.
    pub(crate) edge: f32,
    /// Its second derivative. The weight of the centre is minus the sum of the others.
    pub(crate) point: f32,
}

/// The kernels for a number of pixels per degree, from the centre outwards.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Kernels {
    /// As far as the contrast sensitivity reaches.
    pub(crate) taps: Vec<Taps>,
    /// The radius of the detectors, which is not larger.
    pub(crate) detector_radius: usize,
}

/// The width b of the contrast sensitivity to luminance and to red-green, in square degrees.
const WIDTHS: [f64; 2] = [0.0047, 0.0053];
/// Weight a and width b of the two parts of the sensitivity to blue-yellow.
const BLUE_YELLOW: [(f64, f64); 2] = [(34.1, 0.04), (13.5, 0.025)];
/// The largest width, which determines the radius.
const WIDEST: f64 = 0.04;
/// The size of the features that the detectors find, in degrees.
const FEATURE_DEG: f64 = 0.082;

impl Kernels {
    /// Kernels for a number of pixels per degree above 0.
    pub(crate) fn new(pixels_per_degree: f64) -> Self {
        let p = pixels_per_degree;
        let radius = (3.0 * p * (WIDEST / (2.0 * PI * PI)).sqrt()).ceil().max(1.0) as usize;
        let falloff = |k: usize, width: f64| {
            let t = k as f64 / p;
            libm::exp(-PI * PI * t * t / width)
        };
        let mut taps = vec![Taps::default(); radius + 1];
        let [y, cx] = WIDTHS.map(|width| {
            let kernel: Vec<f64> = (0..=radius).map(|k| falloff(k, width)).collect();
            let total = both_sides(&kernel);
            kernel.into_iter().map(move |weight| weight / total)
        });
        for ((taps, y), cx) in taps.iter_mut().zip(y).zip(cx) {
            (taps.y, taps.cx) = (y as f32, cx as f32);
        }
        let parts = BLUE_YELLOW.map(|(a, width)| {
            let height = (a * (PI / width).sqrt()).sqrt();
            (0..=radius).map(|k| height * falloff(k, width)).collect::<Vec<f64>>()
        });
        let total = parts.iter().map(|part| both_sides(part).powi(2)).sum::<f64>().sqrt();
        for (k, taps) in taps.iter_mut().enumerate() {
            taps.cz = parts.each_ref().map(|part| (part[k] / total) as f32);
        }
        let detector_radius = detectors(p, &mut taps);
        Self { taps, detector_radius }
    }

    /// The radius of all kernels in pixels.
    pub(crate) fn radius(&self) -> usize {
        self.taps.len() - 1
    }
}

/// Adds the detectors, and returns their radius.
fn detectors(pixels_per_degree: f64, taps: &mut [Taps]) -> usize {
    let sigma = 0.5 * FEATURE_DEG * pixels_per_degree;
    let radius = (3.0 * sigma).ceil().max(1.0) as usize;
    debug_assert!(radius < taps.len(), "contrast sensitivity reaches farther");
    let gaussian = |k: usize| libm::exp(-((k * k) as f64) / (2.0 * sigma * sigma));
    let total = both_sides(&(0..=radius).map(gaussian).collect::<Vec<_>>());
    let second = |k: usize| ((k * k) as f64 / (sigma * sigma) - 1.0) * gaussian(k);
    let one_side = |weight: f64, k: usize| if k == 0 { weight } else { 2.0 * weight };
    let sum = |of: &dyn Fn(usize) -> f64| (0..=radius).map(of).sum::<f64>();
    // The weights of one sign are divided by their sum, so that a step or a spot of height 1 gives about 1.
    let edges = sum(&|k| k as f64 * gaussian(k));
    let above = sum(&|k| one_side(second(k).max(0.0), k));
    let below = sum(&|k| one_side((-second(k)).max(0.0), k));
    // Where the detectors are much smaller than a pixel, their outer weights vanish.
    let over = |weight: f64, sum: f64| if sum > 0.0 { (weight / sum) as f32 } else { 0.0 };
    for (k, taps) in taps.iter_mut().enumerate().take(radius + 1) {
        taps.gaussian = over(gaussian(k), total);
        taps.edge = over(k as f64 * gaussian(k), edges);
        taps.point = over(second(k), if second(k) > 0.0 { above } else { below });
    }
    radius
}

/// The sum of a kernel that is given from its centre outwards.
fn both_sides(kernel: &[f64]) -> f64 {
    2.0 * kernel.iter().sum::<f64>() - kernel[0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kernels_pass_flat_areas_and_detectors_do_not() {
        for p in [0.01, 0.5, 11.2, 35.0, 67.0206, 120.0] {
            let kernels = Kernels::new(p);
            let sum = |of: &dyn Fn(&Taps) -> f32| {
                let values: Vec<f64> =
                    kernels.taps.iter().map(|taps| f64::from(of(taps))).collect();
                both_sides(&values)
            };
            let near = |found: f64, wanted: f64| {
                assert!(
                    (found - wanted).abs() < 1e-6,
                    "{found} for {wanted} at {p} pixels per degree"
                );
            };
            near(sum(&|taps| taps.y), 1.0);
            near(sum(&|taps| taps.cx), 1.0);
            near(sum(&|taps| taps.cz[0]).powi(2) + sum(&|taps| taps.cz[1]).powi(2), 1.0);
            near(sum(&|taps| taps.gaussian), 1.0);
            if p > 1.0 {
                near(sum(&|taps| taps.point), 0.0);
                near(sum(&|taps| taps.edge), 2.0);
            }
        }
    }

    #[test]
    fn radii_are_those_of_the_definition() {
        let of = |p| {
            let kernels = Kernels::new(p);
            (kernels.radius(), kernels.detector_radius)
        };
        assert_eq!(of(67.0206), (10, 9));
        assert_eq!(of(35.0), (5, 5));
        assert_eq!(of(0.1), (1, 1));
    }
}
