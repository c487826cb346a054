//! Patney et al. 2016: the desktop display, and the share of pixel quads that is not shaded.

use fovqa_vision::find_display;

use super::row::{Cell, PageRow, Paper};
use fovqa_report::Printed;

/// Table 1, in per cent of the frame's quads: Guenter's, and the paper's.
const GUENTER_QUADS: [f64; 3] = [48.4, 49.9, 50.7];
const QUADS: [f64; 3] = [26.6, 31.8, 38.1];
const DESKTOP: &str = "desktop-27-qhd";

/// The rows of Patney et al.: section 3's display, Table 1.
pub(super) fn patney() -> Vec<PageRow> {
    [vec![desktop_pixel()], quads()].concat()
}

fn one(place: &'static str, quantity: impl Into<String>, cell: Cell) -> PageRow {
    PageRow::one(Paper::Patney, place, quantity, cell)
}

fn desktop_pixel() -> PageRow {
    let display = find_display(DESKTOP);
    let ppd = display.map_or(f64::NAN, fovqa_vision::Display::central_pixels_per_degree);
    one("text", "desktop pixel at 81 cm", Cell::new("", Printed::new("1 arcmin"), 60.0 / ppd, 3))
        .because(format!("{ppd:.1} pixels per degree"))
}

fn quads() -> Vec<PageRow> {
    let saved_of_all = QUADS.map(|quads| 100.0 - quads);
    let least = saved_of_all.into_iter().fold(f64::INFINITY, f64::min);
    let most = saved_of_all.into_iter().fold(0.0, f64::max);
    let saved = |of: f64, quads: f64| 100.0 * (1.0 - quads / of);
    let of_guenter = GUENTER_QUADS.iter().zip(QUADS).map(|(of, quads)| saved(*of, quads));
    let most_of_guenter = of_guenter.fold(0.0, f64::max);
    let taking = "Taking Table 1's shares as shares of the frame's quads";
    let most_row = |quantity: &str, printed: &str, computed: f64, decimals| {
        one("text", quantity, Cell::new("", Printed::new(printed), computed, decimals))
    };
    vec![
        most_row("quads saved, the most", "3/4", most / 100.0, 3)
            .because("less in its Table 1")
            .more(format!("{taking}: {least:.1} to {most:.1} % are saved.")),
        most_row("quads saved, the most, of Guenter's", "up to 50 %", most_of_guenter, 1)
            .because("from its Table 1")
            .more(format!(
                "{taking}, at most {most_of_guenter:.1} % of the quads that Guenter's method shades are saved, \
                 which is within the bound.",
            )),
        most_row("quads saved, the most, of all", "up to 70 %", most, 1)
            .because("more in its Table 1")
            .more(format!(
                "{taking}, {least:.1} to {most:.1} % are saved, which exceeds the printed limit.",
            )),
    ]
}
