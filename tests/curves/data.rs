//! Figures that need no curve: frequency responses, and values that the file gives.

use std::fs;

use crate::fovqa::{Folder, root, shared};

const DATA: &str = r#"
name = "d"
[view]
fov_vertical_deg = 90
resolutions = ["1440x1600"]
directions_deg = [0, 90]
[[plot]]
kind = "response"
eccentricities_deg = [20, 30, 30]
rate_arcmin = 1
foveal_deg = 10
f_max = 2
transition_deg = 10
[[plot]]
kind = "values"
quantity = "Time (ms)"
groups = ["A", "B"]
values = [
  { name = "One", at = [3, 2.5], error = [0.5, 0.25] },
  { name = "Two", at = [2, -1] },
]
sum = true
"#;

type Rows = Vec<Vec<String>>;

fn rows(folder: &Folder, name: &str) -> Rows {
    let text = fs::read_to_string(folder.path(name)).unwrap();
    let mut csv = csv::Reader::from_reader(text.as_bytes());
    csv.records().map(|row| row.unwrap().iter().map(str::to_owned).collect()).collect()
}

fn near(found: f64, want: f64) {
    assert!((found - want).abs() < 1e-9, "{found} {want}");
}

#[test]
fn responses_have_their_gains_and_thresholds() {
    let folder = Folder::new();
    folder.write("d.toml", DATA);
    folder.run(&["curves", "d.toml"]).ok();
    let rows = rows(&folder, "reports/d/plots/response.csv");
    let line = |panel: &str, series: &str| -> Vec<[f64; 2]> {
        let of = rows.iter().filter(|row| row[0].starts_with(panel) && row[1] == series);
        of.map(|row| [row[2].parse().unwrap(), row[3].parse().unwrap()]).collect()
    };
    // 800 pixels are 45°.
    let ppd = 800.0 * 1f64.to_radians();
    for (panel, sigma, f) in [("20°: σ = 0.167°, f = 2", 1.0 / 6.0, 2.0), ("30°:", 1.0 / 3.0, 2.0)]
    {
        let gauss =
            |sigma: f64, nu: f64| (-2.0 * (std::f64::consts::PI * sigma * nu).powi(2)).exp();
        for [nu, gain] in line(panel, "stable") {
            near(gain, gauss(sigma, nu));
        }
        for [nu, gain] in line(panel, "perceptual target") {
            near(gain, gauss(sigma, nu) * (1.0 + f * (1.0 - gauss(2.0 * sigma, nu))));
        }
        near(line(panel, "stable").last().unwrap()[0], ppd / 2.0);
        near(line(panel, "Display's Nyquist frequency")[0][0], ppd / 2.0);
        // σ is 2.3 and 4.7 pixels: grids of up to 4 and 8 pixels.
        let spacing = if sigma < 0.2 { 4.0 } else { 8.0 };
        near(line(panel, "aliased").last().unwrap()[0], ppd / (2.0 * spacing));
    }
    // Acuity is drawn where it is not the measured threshold.
    near(line("20°", "Resolution (Piecewise MAR)")[0][0], 6.0);
    assert!(line("30°", "Resolution (Piecewise MAR)").is_empty());
    near(line("30°", "Detection (Thibos et al. 1996)")[0][0], 30.0);
    near(line("30°", "Resolution (Thibos et al. 1996)")[1][0], 5.0);
    assert!(line("20°", "Detection (Thibos et al. 1996)").is_empty());
    let panels: std::collections::BTreeSet<&str> = rows.iter().map(|row| row[0].as_str()).collect();
    assert_eq!(panels.len(), 2, "an eccentricity is drawn once");
    let page = fs::read_to_string(folder.path("reports/d/index.html")).unwrap();
    assert!(page.contains("beyond which it shows aliases"));
}

#[test]
fn given_values_are_bars_with_errors_and_a_sum() {
    let folder = Folder::new();
    folder.write("d.toml", DATA);
    folder.run(&["curves", "d.toml"]).ok();
    let text = fs::read_to_string(folder.path("reports/d/plots/values.csv")).unwrap();
    let want = "group,series,value,error\nA,One,3.0,0.5\nB,One,2.5,0.25\nA,Two,2.0,\nB,Two,-1.0,\n\
                A,Sum,5.0,\nB,Sum,1.5,\n";
    assert_eq!(text, want);
    let svg = fs::read_to_string(folder.path("reports/d/plots/values.svg")).unwrap();
    assert!(svg.contains("Time (ms)"));
}

/// The numbers of a row of DEAMP's Table 2.
fn table_2(text: &str, name: &str) -> Vec<f64> {
    let row = text.lines().find(|line| line.starts_with(name)).unwrap();
    row.split(',').skip(1).map(|cell| cell.parse().unwrap_or(f64::NAN)).collect()
}

/// The columns of Table 2 of each group: for the dominant eye, and for the other one.
const EYES: [[usize; 2]; 7] = [[0, 0], [1, 1], [2, 2], [3, 4], [5, 6], [7, 8], [9, 10]];

fn drawn(file: &str, plot: &str, series: &str) -> Vec<f64> {
    let folder = Folder::new();
    let path = root().join(format!("configs/papers/{file}.toml"));
    folder.run(&["curves", path.to_str().unwrap(), "--output", "out"]).ok();
    let rows = rows(&folder, &format!("out/plots/{plot}.csv"));
    rows.iter().filter(|row| row[1] == series).map(|row| row[2].parse().unwrap()).collect()
}

#[test]
fn deamps_times_are_those_of_its_table() {
    let Some(papers) = shared("papers") else { return };
    let text = fs::read_to_string(papers.join("deamp-table-2.csv")).unwrap();
    let (total, both) = (table_2(&text, "Total GPU Time"), table_2(&text, "Binocular Time"));
    let rates = table_2(&text, "Fps");
    for (i, name) in ["Dominant eye", "Other eye"].iter().enumerate() {
        assert_eq!(drawn("deamp-fig-6a", "values", name), EYES.map(|eyes| total[eyes[i]]));
    }
    for (found, eyes) in drawn("deamp-fig-6a", "values", "Both eyes").iter().zip(EYES) {
        near(*found, both[eyes[0]]);
    }
    assert_eq!(drawn("deamp-fig-6b", "frame-rates", "Both eyes"), EYES.map(|eyes| rates[eyes[0]]));
}

#[test]
fn deamps_samples_are_the_computed_ones() {
    let folder = Folder::new();
    let path = root().join("configs/papers/deamp-fig-6b.toml");
    folder.run(&["curves", path.to_str().unwrap(), "--output", "out"]).ok();
    let samples: Vec<f64> =
        rows(&folder, "out/table-speed-up.csv").iter().map(|row| row[4].parse().unwrap()).collect();
    for (i, name) in ["Dominant eye", "Other eye"].iter().enumerate() {
        let given = drawn("deamp-fig-6b", "samples", name);
        let computed: Vec<f64> = samples.iter().skip(i).step_by(2).copied().collect();
        assert_eq!((given.len(), computed.len()), (3, 3));
        for (given, computed) in given.iter().zip(computed) {
            assert!((given - computed / 1000.0).abs() <= 0.05 + 1e-9, "{given} {computed}");
        }
    }
}
