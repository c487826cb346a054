//! Mean opinion scores, and scores of metrics for the same conditions.

use std::fmt::Write;

use fovqa_study::moments::{mean, sd};
use fovqa_study::random::Replicate;

use crate::observers::rating;

const SCENES: [&str; 3] = ["hall", "garden", "street"];
/// Methods with their quality, on the scale of ratings from 1 to 5.
const METHODS: [(&str, f64); 6] =
    [("A", 4.4), ("B", 4.0), ("C", 3.5), ("D", 2.9), ("E", 2.2), ("F", 1.7)];
const PARTICIPANTS: usize = 24;
const FRAMES: usize = 2;

/// Opinions (mos.csv), and scores of metrics (results.csv), which do not have the last condition.
/// `fvvdp` follows quality closely, `ssim` less so, and `psnr` and `mse` depend on the scene as well.
pub(super) fn tables() -> [String; 2] {
    let mut opinions = "scene,method,value,se\n".to_owned();
    let header = "scene,method,parameters,eye,frame,image,metric,statistic,level,from_deg,to_deg";
    let mut results = format!("{header},value\n");
    for (index, scene) in SCENES.iter().enumerate() {
        for (number, (method, quality)) in METHODS.iter().enumerate() {
            let condition = (index * METHODS.len() + number) as u64;
            let mut random = Replicate::new(17, condition);
            let quality = quality + 0.25 * random.normal();
            let ratings: Vec<f64> = (0..PARTICIPANTS)
                .map(|_| rating(quality + 0.8 * random.normal(), 1.0, 5.0))
                .collect();
            let se = sd(&ratings).unwrap() / (PARTICIPANTS as f64).sqrt();
            writeln!(opinions, "{scene},{method},{:.3},{se:.3}", mean(&ratings).unwrap()).unwrap();
            if condition + 1 == (SCENES.len() * METHODS.len()) as u64 {
                continue;
            }
            let psnr = 20.0 + 2.5 * quality + [0.0, 2.5, -2.0][index] + 0.8 * random.normal();
            let ssim = 1.0 - 0.06 * (5.6 - quality + 0.5 * random.normal()).max(0.1);
            let fvvdp = 10.0 - 0.7 * (5.5 - quality + 0.2 * random.normal()).max(0.1);
            for frame in 0..FRAMES {
                let psnr = psnr + 0.2 * random.normal();
                let mse = libm::pow(10.0, -0.1 * psnr);
                let row = format!("{scene},{method},,,{frame},pair");
                writeln!(results, "{row},psnr,,,,,{psnr:.4}").unwrap();
                writeln!(results, "{row},ssim,,,,,{ssim:.5}").unwrap();
                writeln!(results, "{row},mse,,,,,{mse:.7}").unwrap();
            }
            writeln!(results, "{scene},{method},,,,pair,fvvdp,jod,,,,{fvvdp:.4}").unwrap();
        }
    }
    [opinions, results]
}
