//! `index.html` of a run, which forwards to its report.

use askama::Template;
use fovqa_results::REPORT_HTML;

#[derive(Template)]
#[template(path = "forward.html")]
struct Forward<'a> {
    name: &'a str,
    report: &'static str,
}

/// A page that forwards to the report of a run with this name.
pub(crate) fn forward(name: &str) -> String {
    // Writing to memory does not fail.
    Forward { name, report: REPORT_HTML }.render().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_index_forwards_to_the_report() {
        let page = forward("a<b>\u{1b}");
        assert!(page.contains("<meta http-equiv=\"refresh\" content=\"0; url=report.html\">"));
        let link = "<a href=\"report.html\">The report of a&#60;b&#62;\\u{1b}</a>";
        assert!(page.contains(link), "{page}");
    }
}
