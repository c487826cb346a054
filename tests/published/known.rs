//! The numbers that are known to come out, and those that are known not to.

use std::fmt::Write;

use super::page::page;
use super::row::{PageRow, Paper};
use super::rows;
use super::tables::{DEAMP_TABLE, Format, RMFR_TABLE, Table, Tables};
use fovqa_report::PrintedVerdict as Verdict;
use fovqa_report::PrintedVerdict::{Close, NotChecked, NotIndependent, NotReproduced, Reproduced};

const KNOWN: [(Paper, &str, &str, Verdict); 51] = [
    (Paper::Vafr, "what the Pimax Crystal shows", "17.5 cpd", Reproduced),
    (Paper::Vafr, "what the Vive Pro Eye shows", "6.6 cpd", NotReproduced),
    (Paper::Vafr, "samples, f(60°) = 4", "1,061,733.7", Close),
    (Paper::Vafr, "samples, f(60°) = 5", "1,165,058.2", NotReproduced),
    (Paper::Vafr, "buffer, f(60°) = 5", "932.3 x 1800.0", Reproduced),
    (Paper::Vafr, "longest column, f(60°) = 5", "45.0°", Reproduced),
    (Paper::Vafr, "buffer, f(60°) = 4", "900.1 x 1637.9", NotReproduced),
    (Paper::Vafr, "longest column, f(60°) = 4", "38.7°", NotReproduced),
    (Paper::Vafr, "thousands of samples", "20 of 20", Reproduced),
    (Paper::Vafr, "thousands, VaFR_Rep", "5 of 5", NotIndependent),
    (Paper::Vafr, "samples saved at 9 / 18 cpd", "17.5 % / 4.1 %", NotReproduced),
    (Paper::Vafr, "buffer width saved at 9 / 18 cpd", "20.5 % / 7.1 %", NotReproduced),
    (Paper::Vafr, "retinal pixels", "76.8 M", NotIndependent),
    (Paper::Vafr, "pixels of 11520 x 6480", "74,649,600", Reproduced),
    (Paper::Rmfr, "share of samples at σ = 2.6", "14.79 %", Reproduced),
    (Paper::Rmfr, "trials of a comparison", "72", NotIndependent),
    (Paper::Rmfr, "votes of 72", "68.06 %", Reproduced),
    (Paper::Rmfr, "votes of 72", "65.28 %", Reproduced),
    (Paper::Rmfr, "votes of 72", "69.44 %", Reproduced),
    (Paper::Rmfr, "votes of 72", "48.61 %", Reproduced),
    (Paper::Rmfr, "p of 49 votes, two-sided", "0.0029", Reproduced),
    (Paper::Rmfr, "p of 47 votes, two-sided", "0.0128", NotReproduced),
    (Paper::Rmfr, "p of 50 votes, two-sided", "0.0013", NotReproduced),
    (Paper::Rmfr, "p of 35 votes, two-sided", "0.906", Reproduced),
    (Paper::Rmfr, "p of 47 votes, one-sided", "0.0064", Reproduced),
    (Paper::Rmfr, "p of 50 votes, one-sided", "0.0006", Reproduced),
    (Paper::Rmfr, "mean density at 110°, hyperbolic", "0.030", NotReproduced),
    (Paper::Rmfr, "mean density at 110°, discs", "0.034", NotReproduced),
    (Paper::Rmfr, "mean density at 110°, linear", "0.078", NotReproduced),
    (Paper::Rmfr, "hyperbolic / linear in one field", "0.112 / 0.183", NotReproduced),
    (Paper::Rmfr, "discs / linear in one field", "0.121 / 0.175", NotReproduced),
    (Paper::Rmfr, "speed-up", "1.83", Reproduced),
    (Paper::Rmfr, "frame time saved", "45.46 %", Reproduced),
    (Paper::Deamp, "outer layer's share, linear in angle", "75.0 %", Reproduced),
    (Paper::Deamp, "outer layer's share, by tangents", "82.8 %", NotReproduced),
    (Paper::Deamp, "speed-up, 48.82 / 14.74 ms", "3.31x", NotReproduced),
    (Paper::Deamp, "speed-up, 68 / 20 frames per second", "3.40x", Reproduced),
    (Paper::Deamp, "speed-up, 48.82 / 17.28 ms", "2.83x", NotReproduced),
    (Paper::Deamp, "speed-up, 58 / 20 frames per second", "2.90x", Reproduced),
    (Paper::Deamp, "p of F(1, 12) = 0.229", "0.641", NotReproduced),
    (Paper::Deamp, "p of F(1, 12) = 0.21", "0.655", NotReproduced),
    (Paper::Deamp, "p of F(2, 30) = 6.548", "0.0044", NotReproduced),
    (Paper::Deamp, "p of F(2, 30) = 3.817", "0.0334", NotReproduced),
    (Paper::Deamp, "p of F(1, 24) = 0.229", "0.637", NotIndependent),
    (Paper::Deamp, "p of F(1, 24) = 0.21", "0.651", NotIndependent),
    (Paper::Deamp, "p of F(2, 45) = 6.548", "0.0032", NotIndependent),
    (Paper::Deamp, "p of F(2, 285) = 3.817", "0.0231", NotIndependent),
    (Paper::Patney, "desktop pixel at 81 cm", "0.991 arcmin", Reproduced),
    (Paper::Patney, "quads saved, the most", "0.734", NotReproduced),
    (Paper::Patney, "quads saved, the most, of Guenter's", "45.0 %", Reproduced),
    (Paper::Patney, "quads saved, the most, of all", "73.4 %", NotReproduced),
];

#[test]
fn every_number_comes_out_as_it_is_known() {
    let rows = rows(None);
    let mut checked = rows.iter().filter(|row| row.verdict() != NotChecked);
    for (paper, quantity, computed, verdict) in KNOWN {
        let row = checked.next().unwrap();
        assert_eq!((row.paper, row.quantity.as_str()), (paper, quantity));
        assert_eq!((row.computed().as_str(), row.verdict()), (computed, verdict), "{quantity}");
    }
    assert!(checked.next().is_none());
    // What is printed was read as the number it is.
    for cell in rows.iter().flat_map(PageRow::cells) {
        assert!(cell.printed.value().is_finite() && cell.computed.is_finite(), "{cell:?}");
    }
}

#[test]
fn reasons_carry_what_was_found() {
    let rows = rows(None);
    let told = |quantity: &str, words: &[&str]| {
        let row = rows.iter().find(|row| row.quantity == quantity).unwrap();
        let text = format!("{} {}", row.why, row.more.as_deref().unwrap_or_default());
        for word in words {
            assert!(text.contains(word), "{word:?} is not in {text}");
        }
    };
    told("votes of 72", &["49 votes, no other number fits"]);
    told("desktop pixel at 81 cm", &["60.5 pixels per degree"]);
    told("quads saved, the most", &["61.9 to 73.4 %"]);
    told("mean density at 110°, hyperbolic", &["0.148", "60.7°"]);
    told("mean density at 110°, linear", &["0.148", "76.4°"]);
    told("p of F(1, 12) = 0.229", &["from 20 to 24"]);
    told("p of F(2, 30) = 3.817", &["from 215 to 635"]);
}

/// Numbers of no paper. `first` is the first scene's first number.
fn tables(first: &str) -> Tables {
    let mut rmfr = "metric,scene,hyperbolic,linear,kfr,rmfr\n".to_owned();
    for metric in ["FPSNR", "PSNR", "SSIM", "FovVideoVDP"] {
        // 1.005 is a tie: 1.00 and 1.01 are both right.
        let _ = write!(
            rmfr,
            "{metric},Average,1.50,1.00,1.01,7.33\n{metric},A,{first},1.00,1.00,7\n\
             {metric},B,2.00,1.01,1.01,7\n"
        );
        let more = if metric == "SSIM" { "7.66" } else { "8" };
        let _ = writeln!(rmfr, "{metric},C,1.50,1.005,1.005,{more}");
    }
    let columns = DEAMP_TABLE.numbers.join(",");
    let pairs = ["50.00", "50.00", "50.00", "45.00", "", "45.00", "", "45.00", "", "45.00", ""];
    let rates = ["20", "20", "20", "22", "", "22", "", "22", "", "22", ""];
    let total =
        ["25.00", "25.00", "25.00", "25.00,20.00", "25.00,20.00", "25.00,20.00", "25.00,20.00"];
    let passes = total.join(",").replace("25.00", "24.50").replace("20.00", "19.50");
    let deamp = format!(
        "pass_ms,{columns}\nOne,{passes}\nTwo{}\nNone,{}\nTotal GPU Time,{}\nBinocular Time,{}\n\
         Fps,{}\n",
        ",0.50".repeat(11),
        ",".repeat(10),
        total.join(","),
        pairs.join(","),
        rates.join(","),
    );
    let parse = |format: &Format, text: &str| Table::parse(format, text);
    Tables { rmfr: parse(&RMFR_TABLE, &rmfr), deamp: parse(&DEAMP_TABLE, &deamp) }
}

#[test]
fn tables_are_held_against_their_own_rows() {
    let of_tables = |first: &str| {
        let rows = rows(Some(&tables(first)));
        let tables = rows.into_iter().filter(|row| {
            ["means over the scenes", "GPU time, sums of passes", "binocular, sums of eyes"]
                .contains(&row.quantity.as_str())
                || row.quantity == "frame rates from times"
        });
        tables.collect::<Vec<_>>()
    };
    let found: Vec<(String, Verdict)> =
        of_tables("1.00").iter().map(|row| (row.computed(), row.verdict())).collect();
    assert_eq!(found[0], ("15 of 16".to_owned(), NotReproduced));
    assert_eq!(found[1], ("11 of 11".to_owned(), Reproduced));
    assert_eq!(found[2], ("7 of 7".to_owned(), Reproduced));
    assert_eq!(found[3], ("7 of 7".to_owned(), Reproduced));
    let wrong = &of_tables("1.10")[0];
    assert_eq!(wrong.computed(), "11 of 16");
    let names: Vec<&str> = wrong.exceptions().iter().map(|cell| cell.name.as_str()).collect();
    assert_eq!(names[0], "FPSNR of hyperbolic");
    let text = page(std::slice::from_ref(wrong));
    assert!(text.contains("without FPSNR of hyperbolic (1.533, not 1.50), "), "{text}");
}

#[test]
fn the_page_is_a_table_a_paper() {
    let text = page(&rows(None));
    let mut widths = Vec::new();
    for line in text.lines().filter(|line| line.starts_with('|')) {
        assert_eq!(line.matches('|').count(), 8, "{line}");
        widths.push(line.chars().count());
    }
    assert!(widths.iter().all(|width| *width <= 160), "{widths:?}");
    widths.dedup();
    assert_eq!(widths.len(), 4, "one width per table");
    let not_reproduced = KNOWN.iter().filter(|row| row.3 == NotReproduced).count();
    assert_eq!(text.matches("\n- **").count(), 5 + not_reproduced);
    assert_eq!(text.matches("the tables were not given").count(), 4 + 1);
    assert!(text.starts_with("<!-- Generated by `make published-numbers`."));
}
