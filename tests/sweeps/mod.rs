//! Budgets, sweeps over parameters of emulated methods, and the search for limits.

mod budgets;
mod grids;
mod limits;
mod mistakes;

use std::collections::BTreeMap;

use fovqa_testkit::synthetic::codes;

use crate::fovqa::Folder;

/// Size of the frames.
const SIZE: (usize, usize) = (96, 80);

const HEAD: &str = "name = \"e\"\n[view]\nfov_vertical_deg = 90\n";
const SCENE: &str = "[[scene]]\nname = \"s\"\nreference = \"gt.png\"\n";
const RMFR: &str = "[[method]]\nname = \"R\"\nemulate = { model = \"rmfr\" }\n";
const METRICS: &str = "[metrics]\npsnr = {}\nssim = {}\n";

/// Smooth frames: the fewer samples, the worse a method shows them.
fn smooth(seed: u64) -> Vec<u8> {
    let (width, height) = SIZE;
    let noise = codes(width, height, 3, seed);
    let mut blurred = noise.clone();
    for y in 0..height {
        for x in 0..width {
            for c in 0..3 {
                let near = |dx: usize, dy: usize| {
                    let (x, y) = ((x + dx).min(width - 1), (y + dy).min(height - 1));
                    u32::from(noise[3 * (y * width + x) + c])
                };
                let sum: u32 = (0..9).map(|i| near(i % 3, i / 3)).sum();
                blurred[3 * (y * width + x) + c] = (sum / 9) as u8;
            }
        }
    }
    blurred
}

/// A folder with two frames, `gt.png` and `other.png`, and an experiment.
fn folder(experiment: &str) -> Folder {
    let folder = Folder::new();
    folder.png("gt.png", SIZE.0, SIZE.1, &smooth(1));
    folder.png("other.png", SIZE.0, SIZE.1, &smooth(2));
    folder.write("e.toml", experiment);
    folder
}

/// The rows of a CSV file, cells by column.
fn table(folder: &Folder, file: &str) -> Vec<BTreeMap<String, String>> {
    let mut reader = csv::Reader::from_path(folder.path(file)).unwrap();
    let headers = reader.headers().unwrap().clone();
    let cells = |record: csv::StringRecord| {
        headers.iter().zip(record.iter()).map(|(h, c)| (h.to_owned(), c.to_owned())).collect()
    };
    reader.records().map(|record| cells(record.unwrap())).collect()
}

fn number(row: &BTreeMap<String, String>, column: &str) -> f64 {
    row[column].parse().unwrap_or_else(|_| panic!("{column} of {row:?}"))
}
