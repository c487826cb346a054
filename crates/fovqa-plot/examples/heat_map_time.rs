//! Prints the processor time of heat maps of 1440x1600 pixels on one thread (Linux only):
//!
//! ```text
//! cargo run --release -p fovqa-plot --example heat_map_time
//! ```

#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "a program for developers")]

use std::fs;

use fovqa_plot::{HeatMap, HeatMapLayout, HeatRing, HeatScale};

const SIZE: (usize, usize) = (1440, 1600);
const TIMES: u32 = 20;

/// The processor time of this thread so far, in milliseconds.
fn cpu_ms() -> f64 {
    let text = fs::read_to_string("/proc/thread-self/schedstat").unwrap();
    text.split_whitespace().next().unwrap().parse::<f64>().unwrap() / 1e6
}

/// A circle around the middle of the frame.
fn ring(index: usize) -> HeatRing {
    let radius = 60.0 * (index + 1) as f64;
    let point = |i: u32| {
        let angle = f64::from(i) * std::f64::consts::TAU / 128.0;
        [720.0 + radius * angle.cos(), 800.0 + radius * angle.sin()]
    };
    HeatRing {
        label: format!("{}°", 5 * (index + 1)), lines: vec![(0..=128).map(point).collect()]
    }
}

/// Values like those of an error: smooth areas with noise.
fn values() -> Vec<f32> {
    let mut state = 1u32;
    let value = |i: usize| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let noise = (state >> 8) as f32 / 16_777_216.0;
        let (x, y) = ((i % SIZE.0) as f32, (i / SIZE.0) as f32);
        let smooth = 0.5 + 0.5 * (x / 97.0).sin() * (y / 131.0).cos();
        (1e-4 * smooth * (0.5 + noise)).max(0.0)
    };
    (0..SIZE.0 * SIZE.1).map(value).collect()
}

fn main() {
    // The work of a pool of one thread is done and measured in that thread.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    pool.install(|| {
        let values = values();
        for (name, log) in [("linear", false), ("logarithmic", true)] {
            let layout = HeatMapLayout {
                size: SIZE,
                block: 1,
                bright: "worse",
                label: "Squared error (peak 1)".to_owned(),
                scale: HeatScale { none: 1e-6, most: 1.0, log },
                rings: (0..12).map(ring).collect(),
                gaze: Some([720.0, 800.0]),
            };
            let start = cpu_ms();
            let sheet = HeatMap::new(&layout).unwrap();
            let drawn = cpu_ms();
            let bytes = (0..TIMES).map(|_| sheet.png(&values).unwrap().len()).max().unwrap();
            println!(
                "{name}: sheet {:.1} ms, each picture {:.1} ms, {bytes} bytes",
                drawn - start,
                (cpu_ms() - drawn) / f64::from(TIMES)
            );
        }
    });
}
