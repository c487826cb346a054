//! The figures of curves other than rates over eccentricity show what they say.

use std::fs;

use crate::fovqa::Folder;

const KINDS: &str = r#"
name = "k"
[view]
resolutions = ["1600x1600", "800x800"]
fov_vertical_deg = 90
[[curve]]
name = "KFR"
method = { model = "kfr", sigma = 2 }
[[curve]]
name = "VaFR"
method = { model = "vafr" }
[[curve]]
name = "4L"
method = { model = "deamp", sigmas = [2, 4], bounds_deg = [22.5, 45] }
resolutions = ["1600x1600"]
[[plot]]
kind = "rates"
name = "band"
curves = ["KFR", "VaFR"]
panels = "one"
band = true
beyond_display = true
[[plot]]
kind = "rates"
name = "own"
curves = ["4L"]
unit = "per_pixel"
acuity_scale = "own"
[[plot]]
kind = "steps"
[[plot]]
kind = "samples"
[[plot]]
kind = "samples_bars"
[[plot]]
kind = "outline"
[[plot]]
kind = "density"
curves = ["4L"]
style = "contours"
[[plot]]
kind = "half_axis"
f = [2]
dots = true
"#;

type Rows = Vec<Vec<String>>;

fn rows(folder: &Folder, name: &str) -> Rows {
    let text = fs::read_to_string(folder.path(&format!("reports/k/plots/{name}.csv"))).unwrap();
    let mut csv = csv::Reader::from_reader(text.as_bytes());
    csv.records().map(|row| row.unwrap().iter().map(str::to_owned).collect()).collect()
}

/// The numbers in two columns of the rows that begin with a name.
fn of(rows: &Rows, name: &str, columns: [usize; 2]) -> Vec<[f64; 2]> {
    let number = |text: &String| text.parse().unwrap_or(f64::NAN);
    let named = rows.iter().filter(|row| row[0] == name);
    named.map(|row| columns.map(|i| number(&row[i]))).collect()
}

#[test]
fn every_kind_shows_what_it_says() {
    let folder = Folder::new();
    folder.write("k.toml", KINDS);
    folder.run(&["curves", "k.toml"]).ok();
    let near = |found: f64, want: f64| assert!((found / want - 1.0).abs() < 1e-6, "{found} {want}");
    let at = |rows: &[[f64; 2]], x: f64| rows.iter().find(|r| (r[0] - x).abs() < 1e-9).unwrap()[1];

    // The band: KFR's rate is that of each frame, and VaFR's the same on both.
    let band = rows(&folder, "band");
    let edges = ["KFR, lowest", "KFR, highest"].map(|name| of(&band, name, [1, 2]));
    let rate = |side: f64| {
        // ½ α z^(α−1) w π / (180 ln L sin e cos e), α = 4.
        let (e, focal) = (20f64.to_radians(), side / 2.0);
        let ln_corner = (side / 2f64.sqrt()).ln();
        let z = (focal * e.tan()).ln() / ln_corner;
        let w = side / 2.0;
        0.5 * 4.0 * z.powi(3) * w * 1f64.to_radians() / (ln_corner * e.sin() * e.cos())
    };
    near(at(&edges[0], 20.0), rate(800.0));
    near(at(&edges[1], 20.0), rate(1600.0));
    assert!(of(&band, "VaFR, lowest", [1, 2]).is_empty());
    near(at(&of(&band, "VaFR", [1, 2]), 10.0), 10.0);
    let svg = fs::read_to_string(folder.path("reports/k/plots/band.svg")).unwrap();
    assert!(svg.contains("#B3D5E8"), "a tint of KFR's blue");

    // Acuity over its own 40 cpd at the gaze.
    let own = rows(&folder, "own");
    near(at(&of(&own, "Acuity (Piecewise MAR)", [1, 2]), 10.0), 0.25);

    let steps = of(&rows(&folder, "steps"), "4L", [1, 2]);
    assert_eq!(steps, [[0.0, 0.5], [22.5, 0.5], [22.5, 0.25], [45.0, 0.25]]);

    // Samples of a layered method lie in the frame; in each layer about as many as its density gives.
    let samples = rows(&folder, "samples");
    let places = |title: &str| {
        let named: Rows = samples.iter().filter(|r| r[0].starts_with(title)).cloned().collect();
        assert!(named.iter().all(|row| row[3].is_empty()), "dots have no value");
        let title = named[0][0].clone();
        of(&named, &title, [1, 2])
    };
    for title in ["KFR, 1600 × 1600", "VaFR, 1600 × 1600", "4L"] {
        let found = places(title);
        assert!((800..3000).contains(&found.len()), "{title}: {}", found.len());
        assert!(found.iter().flatten().all(|at| (0.0..=1600.0).contains(at)), "{title}");
        let near_gaze = |[x, y]: &&[f64; 2]| (x - 800.0).hypot(y - 800.0) < 400.0;
        let share = found.iter().filter(near_gaze).count() as f64 / found.len() as f64;
        assert!(share > 0.35, "{title}: {share} within a fifth of the area");
    }
    let sides = |[x, y]: &[f64; 2]| [x - 800.0, y - 800.0].map(f64::abs);
    let inner = places("4L").iter().filter(|at| sides(at).iter().all(|t| *t < 331.0)).count();
    // Of 1600²/2² samples over the frame, f (f + A) / (t + f) to the border of the inner layer.
    let along = 2.0 * (608.0 + 800.0) * 331.37 / (331.37 + 608.0) / 2.0;
    let title = &samples.iter().find(|row| row[0].starts_with("4L")).unwrap()[0];
    let each = title.split("every ").nth(1).unwrap();
    let each: f64 =
        each.chars().take_while(char::is_ascii_digit).collect::<String>().parse().unwrap();
    let want = (along / each).powi(2);
    assert!((inner as f64 / want - 1.0).abs() < 0.15, "{inner} {want}");

    // W H / σ² in thousands; VaFR's count does not depend on the frame.
    let bars = rows(&folder, "samples-bars");
    let bar = |group: &str, series: &str| -> f64 {
        bars.iter().find(|r| r[0] == group && r[1] == series).unwrap()[2].parse().unwrap()
    };
    near(bar("1600 × 1600", "KFR"), 640.0);
    near(bar("800 × 800", "KFR"), 160.0);
    near(bar("1600 × 1600", "VaFR"), bar("800 × 800", "VaFR"));

    // The paper's buffer: 900.1 columns, and 360 sin 2e f(e) rows.
    let outline = rows(&folder, "outline");
    let dots = of(&outline, "1600 × 1600, every 10°", [1, 2]);
    assert_eq!(dots.len(), 7);
    assert!((dots[6][0] - 900.1).abs() < 0.1, "{dots:?}");
    near(dots[1][1], 360.0 * 20f64.to_radians().sin() * 10.0);

    let density = fs::read_to_string(folder.path("reports/k/plots/density.svg")).unwrap();
    assert!(density.contains("aria-label=\"0.2\"") && !density.contains("10°"));

    let half = rows(&folder, "half-axis");
    let dots = of(&half, "f = 2, samples", [1, 2]);
    assert_eq!(dots.len(), 25);
    near(at(&dots, 0.5), 1.0 / 3.0);
}
