//! The verdict as JUnit XML, with one test case per rule.

use fovqa_results::{RuleVerdict, State, Verdict};
use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};

use super::{outcome, sentence};

/// The text of the file. Values that were not scored and incorrect rules are errors; violated rules
/// are failures.
///
/// # Errors
/// If the text cannot be written as XML.
pub fn junit(verdict: &Verdict) -> Result<String, String> {
    let mut suite = TestSuite::new(visible(&verdict.experiment));
    for rule in &verdict.rules {
        suite.add_test_case(case(verdict, rule));
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
    let mut report = Report::new(visible(&outcome(verdict)));
    report.add_test_suite(suite);
    report.to_string().map_err(|error| error.to_string())
}

fn case(verdict: &Verdict, rule: &RuleVerdict) -> TestCase {
    let state = rule.state();
    let broken: Vec<String> = rule
        .checks
        .iter()
        .filter(|check| check.outcome.reason().is_some())
        .map(sentence)
        .chain(rule.failure.clone())
        .collect();
    let status = match state {
        State::Passed => TestCaseStatus::success(),
        State::Failed | State::NotScored | State::Wrong => {
            let kind = if state == State::Failed {
                NonSuccessKind::Failure
            } else {
                NonSuccessKind::Error
            };
            let mut status = TestCaseStatus::non_success(kind);
            status.set_message(visible(broken.first().map_or("", String::as_str)));
            status.set_type(state.name());
            status.set_description(visible(&broken.join("\n")));
            status
        }
    };
    let mut case = TestCase::new(visible(&rule.title()), status);
    case.set_classname(visible(&verdict.experiment));
    let all: Vec<String> = rule.checks.iter().map(sentence).collect();
    case.set_system_out(visible(&format!("{}\n{}", rule.rule.limits(), all.join("\n"))));
    case
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
