use super::number::Fill;
use super::{Cell, Column, Group, Head, Number, Section, Sheet, scaled, usual_label};

fn number(value: &str, spread: &str) -> Number {
    Number { value: value.to_owned(), spread: spread.to_owned(), ..Number::default() }
}

/// The texts of a column with these values.
fn column(numbers: &[Number]) -> Vec<String> {
    let fill = Fill::of(numbers.iter());
    numbers.iter().map(|number| fill.text(number)).collect()
}

#[test]
fn points_of_a_column_stand_below_each_other() {
    let values = ["24.70", "-3.5", "inf", "–", "7"].map(|value| number(value, ""));
    assert_eq!(
        column(&values),
        [
            "24.70",
            "$-$3.5\\phantom{0}",
            "$\\infty$\\phantom{.00}",
            "--\\phantom{.00}",
            "7\\phantom{.00}"
        ]
    );
    let counts = ["12", "606\u{202f}533"].map(|value| number(value, ""));
    assert_eq!(column(&counts), ["12", "606\\,533"]);
}

#[test]
fn bold_and_underlined_numbers_are_as_wide_as_others() {
    let best = |value: &str| Number { is_best: true, ..number(value, "") };
    let second = |value: &str| Number { is_second: true, ..number(value, "") };
    assert_eq!(
        column(&[best("24.70"), second("-3.50"), best("-1.50")]),
        ["\\fovqabest{24}{.70}", "\\underline{$-$3.50}", "\\fovqabest{\\boldmath$-$1}{.50}"]
    );
    assert_eq!(
        column(&[best("inf"), number("1.25", "")]),
        ["\\textbf{\\boldmath$\\infty$}\\phantom{.00}", "1.25"]
    );
}

#[test]
fn deviations_and_powers_take_the_same_space_in_each_row() {
    let values = [number("24.70", "0.12"), number("3.10", "10.50"), number("–", "")];
    assert_eq!(
        column(&values),
        [
            "24.70\\kern.65em{\\scriptsize$\\pm$\\phantom{0}0.12}",
            "3.10\\kern.65em{\\scriptsize$\\pm$10.50}",
            "--\\phantom{.00\\kern.65em{\\scriptsize$\\pm$00\\phantom{.00}}}"
        ]
    );
    let values = [number("3.39e-3", ""), number("3.39e-12", ""), number("0.00", "")];
    assert_eq!(
        column(&values),
        [
            "3.39$\\,\\cdot 10^{-3\\phantom{0}}$",
            "3.39$\\,\\cdot 10^{-12}$",
            "0.00\\phantom{$\\,\\cdot 10^{\\phantom{000}}$}"
        ]
    );
}

#[test]
fn one_power_of_ten_serves_values_that_are_alike() {
    assert_eq!(scaled([3.39e-3, 0.02, 0.0].into_iter()), Some(-3));
    assert_eq!(scaled([9.999e-4, 2e-3].into_iter()), Some(-3), "printed as 1.00e-3");
    assert_eq!(scaled([3.0e-6, 0.02].into_iter()), None);
    assert_eq!(scaled([0.0, f64::INFINITY].into_iter()), None);
}

#[test]
fn labels_are_plain() {
    assert_eq!(usual_label("demo", "table"), "tab:demo-table");
    assert_eq!(usual_label("zimmer-β", "ratios-atd"), "tab:zimmer--ratios-atd");
    assert_eq!(usual_label("β", "table"), "tab:table");
}

/// A sheet of so many methods and columns.
fn sheet(rows: usize, columns: usize) -> Sheet {
    let name = Column { head: Head::named("Method"), is_text: true, is_repeated: true };
    let of = |index: usize| Column { head: Head::named(format!("c{index}")), ..Column::default() };
    let row = |index: usize| {
        let label = [Cell::Text(format!("m{index}"))].into_iter();
        label.chain((0..columns).map(|_| Cell::Number(number("1.00", "")))).collect()
    };
    Sheet {
        caption: "About 100 %".to_owned(),
        label: "tab:x".to_owned(),
        columns: [name].into_iter().chain((0..columns).map(of)).collect(),
        sections: vec![Section { title: String::new(), rows: (0..rows).map(row).collect() }],
        ..Sheet::default()
    }
}

/// The numbers of columns of the tabulars of a text.
fn tabulars(text: &str) -> Vec<usize> {
    let lines = text.lines().filter_map(|line| line.strip_prefix("\\begin{tabular}{l"));
    lines.map(|line| line.matches('r').count()).collect()
}

#[test]
fn a_float_is_complete() {
    let text = sheet(2, 2).text();
    let from = text.find("\\begin{table}").unwrap();
    assert_eq!(
        &text[from..],
        "\\begin{table}\n\\centering\n\\caption{About 100 \\%}\\label{tab:x}\n\\smallskip\n\
         \\begin{tabular}{l r r}\n\\toprule\nMethod & c0 & c1 \\\\\n\\midrule\n\
         m0 & 1.00 & 1.00 \\\\\nm1 & 1.00 & 1.00 \\\\\n\\bottomrule\n\\end{tabular}\n\\end{table}\n"
    );
    assert!(text.starts_with("% Needs \\usepackage{booktabs}"), "{text}");
}

#[test]
fn a_table_of_over_ten_columns_is_divided_evenly() {
    assert_eq!(tabulars(&sheet(2, 10).text()), [10]);
    assert_eq!(tabulars(&sheet(2, 11).text()), [6, 5]);
    assert_eq!(tabulars(&sheet(2, 25).text()), [9, 9, 7]);
    let one_float = sheet(2, 25).text();
    assert_eq!(one_float.matches("\\begin{table").count(), 1, "{one_float}");
    assert_eq!(one_float.matches("\nMethod & ").count(), 3);
    // Wide headings leave less space.
    let mut wide = sheet(2, 10);
    for column in &mut wide.columns[1..] {
        column.head.unit = "% of the reference".to_owned();
    }
    assert_eq!(tabulars(&wide.text()), [4, 4, 2]);
}

#[test]
fn columns_of_one_heading_stay_together() {
    let mut grouped = sheet(2, 12);
    for (first, last) in [(1, 4), (5, 8), (9, 12)] {
        let head = Head { unit: "dB".to_owned(), ..Head::named(format!("g{first}")) };
        grouped.groups.push(Group { head, first, last });
    }
    let text = grouped.text();
    assert_eq!(tabulars(&text), [8, 4]);
    assert!(text.contains("& \\multicolumn{4}{c}{g1 (dB)} & \\multicolumn{4}{c}{g5 (dB)} \\\\\n\\cmidrule(lr){2-5}\\cmidrule(lr){6-9}\n"), "{text}");
    assert!(text.contains("{g9 (dB)} \\\\\n\\cmidrule(lr){2-5}\n"), "{text}");
    // A heading over more columns than a part has is repeated.
    let mut one = sheet(2, 12);
    one.groups = vec![Group { head: Head::named("g"), first: 1, last: 12 }];
    assert_eq!(one.text().matches("\\multicolumn{6}{c}{g}").count(), 2);
}

#[test]
fn a_long_table_becomes_several_floats_of_one_number() {
    let text = sheet(100, 3).text();
    assert_eq!(text.matches("\\begin{table}").count(), 3, "{text}");
    assert_eq!(text.matches("\\addtocounter{table}{-1}").count(), 2);
    assert_eq!(text.matches("(continued)}").count(), 2);
    assert_eq!(text.matches("\\label").count(), 1);
    for row in 0..100 {
        assert_eq!(text.matches(&format!("\nm{row} & ")).count(), 1);
    }
    // A section that fits on a page is not divided.
    let mut sections = sheet(20, 3);
    sections.sections[0].title = "room".to_owned();
    sections.sections.push(Section { title: "hall".to_owned(), ..sections.sections[0].clone() });
    let text = sections.text();
    let (first, second) = text.split_once("\\end{table}").unwrap();
    assert!(first.contains("\\multicolumn{4}{l}{\\emph{room}} \\\\\nm0 &"), "{first}");
    assert!(!first.contains("hall") && second.contains("\\emph{hall}"), "{second}");
    // A longer one is, and says so.
    let mut long = sheet(60, 3);
    long.sections[0].title = "room".to_owned();
    assert!(long.text().contains("\\emph{room (continued)}"));
}

#[test]
fn long_names_are_wrapped_and_broken() {
    let mut sheet = sheet(1, 1);
    let word = "W".repeat(20);
    sheet.sections[0].rows[0][0] = Cell::Text(format!("{word} and more"));
    sheet.columns[1].head.name = "a name of many words".to_owned();
    let text = sheet.text();
    let broken = ["WWWWWW", "WWWWWW", "WWWWWW", "WW"].join("\\allowbreak{}");
    let cell = format!("\\parbox[t]{{130pt}}{{\\raggedright\\strut {broken} and more\\strut}} & ");
    assert!(text.contains(&cell), "{text}");
    assert!(text.contains("\\parbox[b]{66pt}{\\raggedleft\\strut a name of many words\\strut}"));
}

#[test]
fn letters_that_pdflatex_does_not_have_are_named() {
    let mut sheet = sheet(1, 1);
    assert!(!sheet.text().contains("pdflatex"));
    sheet.caption = "部屋".to_owned();
    let text = sheet.text();
    assert!(text.contains("% pdflatex has no letters for 屋 部."), "{text}");
    assert!(text.contains("\\caption{部屋}"), "they stay");
}
