//! Reading an experiment file for a command; what is wrong with it is shown in its own lines.

use std::path::Path;

use fovqa_config::{Experiment, ExperimentError, Fault};
use miette::{
    Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, NamedSource, SourceCode,
};

use crate::diagnostic;
use crate::exit::Exit;

/// The experiment; what is wrong with it has been said otherwise.
pub(crate) fn read(path: &Path) -> Result<Experiment, Exit> {
    Experiment::read(path).map_err(|error| {
        match &error {
            ExperimentError::Unreadable { .. } => {
                diagnostic::error(&error.to_string(), "check the path");
            }
            ExperimentError::Faults { path, text, faults } => {
                let source = NamedSource::new(path.display().to_string(), text.clone());
                for fault in faults {
                    diagnostic::block(&rendered(&Shown { fault, source: &source }));
                }
                if faults.len() > 1 {
                    diagnostic::error(&error.to_string(), "");
                }
            }
        }
        Exit::Usage
    })
}

fn rendered(fault: &Shown<'_>) -> String {
    let mut text = String::new();
    let handler = GraphicalReportHandler::new_themed(GraphicalTheme::unicode());
    // Rendering to a string does not fail; without it the words are still there.
    if handler.with_width(100).with_context_lines(1).render_report(&mut text, fault).is_err() {
        text = fault.to_string();
    }
    text
}

/// A mistake with the text it is in.
#[derive(Debug)]
struct Shown<'a> {
    fault: &'a Fault,
    source: &'a NamedSource<String>,
}

impl std::fmt::Display for Shown<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&diagnostic::shown(&self.fault.message))
    }
}

impl std::error::Error for Shown<'_> {}

impl Diagnostic for Shown<'_> {
    fn help<'b>(&'b self) -> Option<Box<dyn std::fmt::Display + 'b>> {
        (!self.fault.help.is_empty()).then(|| Box::new(&self.fault.help) as _)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        Some(self.source)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let Fault { span, label, .. } = self.fault;
        // What is about the whole file has no place in it.
        if span.is_empty() && span.start == 0 {
            return None;
        }
        let label = (!label.is_empty()).then(|| label.clone());
        Some(Box::new(std::iter::once(LabeledSpan::new(label, span.start, span.len()))))
    }
}
