//! Runs of more methods than one figure or one page can show.

use std::fs;

use fovqa_testkit::png_files::write8;
use fovqa_testkit::synthetic::{codes, disturbed};

use crate::fovqa::Folder;

const SIDE: usize = 16;

/// A run of so many methods, each worse than the one before it.
fn run(methods: usize) -> Folder {
    let folder = Folder::new();
    let text = "name = \"e\"\n[view]\nfov_vertical_deg = 60\n[metrics]\npsnr = {}\nrms_contrast = {}\n[[scene]]\n\
                name = \"s\"\nreference = \"gt.png\"\n";
    let gt = codes(SIDE, SIDE, 3, 1);
    write8(&folder.path("gt.png"), SIDE, SIDE, &gt);
    let method = |nth: usize| {
        let worse = disturbed(&gt, 2.0 + nth as f64, 2);
        write8(&folder.path(&format!("m{nth}.png")), SIDE, SIDE, &worse);
        format!("[[method]]\nname = \"m{nth}\"\ntest = \"m{nth}.png\"\n")
    };
    let methods: String = (1..=methods).map(method).collect();
    folder.write(
        "e.toml",
        format!("{text}{methods}[[plot]]\nkind = \"table\"\n[[plot]]\nkind = \"profile\"\n"),
    );
    folder.run(&["run", "e.toml"]).ok();
    folder
}

fn read(folder: &Folder, name: &str) -> String {
    fs::read_to_string(folder.path(&format!("reports/e/{name}"))).unwrap()
}

/// The series of a figure, in the order of its data.
fn series(folder: &Folder, figure: &str) -> Vec<String> {
    let data = read(folder, &format!("plots/{figure}.csv"));
    let names = data.lines().skip(1).filter_map(|line| line.split(',').next());
    let mut names: Vec<String> = names.map(str::to_owned).collect();
    names.dedup();
    names
}

fn methods(range: std::ops::RangeInclusive<usize>) -> Vec<String> {
    range.map(|nth| format!("m{nth}")).collect()
}

#[test]
fn some_dozens_of_methods_are_split_over_several_figures() {
    let folder = run(45);
    for (first, last) in [(1, 20), (21, 40), (41, 45)] {
        let name = format!("profile-psnr-methods-{first}-{last}");
        assert_eq!(series(&folder, &name), methods(first..=last));
        let contrast = series(&folder, &format!("profile-rms-contrast-methods-{first}-{last}"));
        assert_eq!(contrast, [methods(first..=last), vec!["reference".to_owned()]].concat());
        let shown = format!("methods {first} to {last} of 45");
        assert!(read(&folder, &format!("plots/{name}.svg")).contains(&shown));
        assert!(read(&folder, "report.html").contains(&shown));
    }
    assert!(!folder.path("reports/e/plots/profile-psnr.svg").exists());
    let few = run(20);
    assert_eq!(series(&few, "profile-psnr"), methods(1..=20));
    assert!(!read(&few, "plots/profile-psnr.svg").contains("20 of 20"));
}

#[test]
fn of_very_many_methods_a_figure_shows_a_choice_and_the_tables_show_all() {
    let folder = run(101);
    // The ten best; of the 91 others the 1st, the 11th, ... and the last.
    let mut wanted = methods(1..=10);
    wanted.extend((11..=101).step_by(10).map(|nth| format!("m{nth}")));
    assert_eq!(series(&folder, "profile-psnr"), wanted);
    wanted.push("reference".to_owned());
    assert_eq!(series(&folder, "profile-rms-contrast"), wanted, "the best by PSNR");
    let shown = "20 of 101 methods: the 10 best by PSNR, and 10 spread evenly over the others down to the worst";
    let (page, svg) = (read(&folder, "report.html"), read(&folder, "plots/profile-psnr.svg"));
    assert!(page.contains(shown) && svg.contains("20 of 101 methods: the 10 best by PSNR"));
    let header = read(&folder, "table.csv");
    for method in methods(1..=101) {
        assert!(header.contains(&format!("psnr {method},")), "{method}");
        // On the page each method is a row.
        assert!(page.contains(&format!("<tr><th scope=\"row\">{method}</th><td")), "{method}");
    }
    assert!(page.contains("<a href=\"table.csv\">CSV</a>"));
}
