//! The verdict as JUnit XML, with one test case per check: rule, scene, method and eye.

use fovqa_results::{Check, RuleVerdict, State, Verdict};
use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};

use super::{outcome, place, sentence, where_lines};

/// The text of the file. Values that were not scored and incorrect rules are errors; violated rules
/// are failures.
///
/// # Errors
/// If the text cannot be written as XML.
pub fn junit(verdict: &Verdict) -> Result<String, String> {
    let mut suite = TestSuite::new(visible(&verdict.experiment));
    for rule in &verdict.rules {
        suite.add_test_cases(cases(verdict, rule));
    }
    if !verdict.errors.is_empty() {
        let mut status = TestCaseStatus::non_success(NonSuccessKind::Error);
        status.set_message(visible(&verdict.errors[0]));
        status.set_type("not scored");
        status.set_description(visible(&verdict.errors.join("\n")));
        let mut case = TestCase::new("everything is scored", status);
        case.set_classname(visible(&verdict.experiment));
        suite.add_test_case(case);
    }
    if let Some(baseline) = &verdict.baseline {
        suite.add_property(("baseline", visible(baseline).as_str()));
    }
    let mut report = Report::new(visible(&outcome(verdict)));
    report.add_test_suite(suite);
    report.to_string().map_err(|error| error.to_string())
}

/// The test cases of a rule: one for each check, and one if there is nothing to check.
fn cases(verdict: &Verdict, rule: &RuleVerdict) -> Vec<TestCase> {
    let class = visible(&verdict.experiment);
    let named = |name: &str, status: TestCaseStatus| {
        let mut case = TestCase::new(visible(name), status);
        case.set_classname(class.clone());
        case
    };
    let mut cases: Vec<TestCase> = Vec::new();
    for check in &rule.checks {
        let name = format!("{}: {}", rule.title(), place(check));
        let mut lines = vec![sentence(check)];
        lines.extend(where_lines(check));
        lines.extend(pictures(verdict, check));
        let state = check.outcome.state();
        let mut case = named(&name, status(state, &lines));
        case.set_system_out(visible(&format!("{}\n{}", rule.rule.limits(), lines.join("\n"))));
        cases.push(case);
    }
    if let Some(why) = &rule.failure {
        cases.push(named(&rule.title(), status(State::Failed, std::slice::from_ref(why))));
    }
    cases
}

/// The files of the pictures of a check.
fn pictures(verdict: &Verdict, check: &Check) -> Vec<String> {
    let Some(folder) = &verdict.shown_in else { return Vec::new() };
    let pictures = check.losses.iter().flat_map(|loss| &loss.pictures);
    pictures.map(|picture| format!("{}: {folder}/{}", picture.what, picture.path)).collect()
}

fn status(state: State, lines: &[String]) -> TestCaseStatus {
    let kind = match state {
        State::Passed => return TestCaseStatus::success(),
        State::Failed => NonSuccessKind::Failure,
        State::NotScored | State::Wrong => NonSuccessKind::Error,
    };
    let mut status = TestCaseStatus::non_success(kind);
    status.set_message(visible(lines.first().map_or("", String::as_str)));
    status.set_type(state.name());
    status.set_description(visible(&lines.join("\n")));
    status
}

/// Text without characters that XML does not allow.
fn visible(text: &str) -> String {
    let allowed = |c: &char| match c {
        '\n' | '\t' => true,
        '\u{fffe}' | '\u{ffff}' => false,
        c => !c.is_control(),
    };
    text.chars().filter(allowed).collect()
}
