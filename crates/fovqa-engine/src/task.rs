//! A unit of work for another process. The unit is written to JSON with its plan, and its findings
//! are written in the same way.

use fovqa_plan::Plan;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::error::EngineError;
use crate::events::Events;
use crate::find::find;
use crate::findings::Findings;
use crate::journal::{LineStep, ViewFiles, view_files};
use crate::run::score;
use crate::sources::Given;
use crate::unit::Unit;

/// Name and version of the format.
const SCHEMA: &str = "fovqa.task/1";

/// A unit of work with its plan. It can be passed as JSON to another process that sees the same
/// files under the same paths.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Task {
    schema: String,
    version: String,
    plan: Plan,
    unit: Unit,
    /// The files of the unit's view when the task was made. The other process must find the same
    /// files.
    files: ViewFiles,
}

/// Why a task cannot be run.
#[derive(Debug, Error)]
pub enum TaskError {
    /// A text that is not a task.
    #[error("this is not a unit of work: {0}")]
    Format(String),
    /// A task of another fovqa version.
    #[error("fovqa {version} wrote this unit of work, but this is fovqa {}", env!("CARGO_PKG_VERSION"))]
    Version {
        /// The version that wrote it.
        version: String,
    },
    /// Frames that do not exist, or differ from those that the task was made from.
    #[error("scene {0:?}: the frames found here differ from those in the unit of work")]
    OtherFrames(String),
    /// An error of the plan.
    #[error(transparent)]
    Engine(#[from] EngineError),
}

impl Task {
    /// Makes a task from a unit of a plan whose frames were found.
    pub fn new(plan: &Plan, found: &crate::found::FoundInputs, unit: Unit) -> Option<Self> {
        let files = view_files(plan, found, unit.scene, unit.eye)?;
        let (schema, version) = (SCHEMA.to_owned(), env!("CARGO_PKG_VERSION").to_owned());
        Some(Self { schema, version, plan: plan.clone(), unit, files })
    }

    /// Writes the task as JSON.
    ///
    /// # Errors
    /// If a path of the plan is not UTF-8.
    pub fn to_json(&self) -> Result<String, TaskError> {
        serde_json::to_string(self).map_err(|error| TaskError::Format(error.to_string()))
    }

    /// Reads a task from JSON.
    ///
    /// # Errors
    /// If the text is not a task, or the task has another version.
    pub fn from_json(json: &str) -> Result<Self, TaskError> {
        let task: Self =
            serde_json::from_str(json).map_err(|error| TaskError::Format(error.to_string()))?;
        let eyes = task.plan.scenes.get(task.unit.scene).map(|scene| scene.eyes.len());
        if task.schema != SCHEMA || eyes.is_none_or(|eyes| task.unit.eye >= eyes) {
            return Err(TaskError::Format("it has another format, or it is damaged".to_owned()));
        }
        if task.version != env!("CARGO_PKG_VERSION") {
            return Err(TaskError::Version { version: task.version });
        }
        Ok(task)
    }

    /// Finds the frames of the task and scores them.
    ///
    /// # Errors
    /// If the frames are not those that the task was made from, or the plan cannot be run. A frame
    /// that cannot be scored is a failure among the findings.
    pub fn run(&self, given: &Given, events: &dyn Events) -> Result<TaskFindings, TaskError> {
        let found = find(&self.plan, given);
        let files = view_files(&self.plan, &found, self.unit.scene, self.unit.eye);
        if files.as_ref() != Some(&self.files) {
            return Err(TaskError::OtherFrames(self.plan.scenes[self.unit.scene].name.clone()));
        }
        let units = std::slice::from_ref(&self.unit);
        // Problems of other views do not belong to this task.
        let found = crate::found::FoundInputs { problems: Vec::new(), ..found };
        let nothing = &mut |_: crate::findings::Entry<'_>| Ok(());
        let findings = score(&self.plan, &found, units, Findings::default(), events, nothing)?;
        Ok(TaskFindings(findings))
    }
}

/// The findings of a task.
#[derive(Debug, Clone, PartialEq)]
pub struct TaskFindings(Findings);

impl TaskFindings {
    /// The findings as lines of JSON, in the format of a journal.
    pub fn to_lines(&self, task: &Task) -> String {
        crate::journal::lines_of(&task.plan, &self.0)
    }

    /// Reads findings that were written as lines.
    ///
    /// # Errors
    /// If they are not the complete findings of the task.
    pub fn from_lines(task: &Task, lines: &str) -> Result<Self, TaskError> {
        let Unit { scene, eye, pairs } = &task.unit;
        let own = |place, step: Option<LineStep>| {
            place == (*scene, *eye) && step.is_none_or(|step| step.is_in(pairs, task.files.pairs))
        };
        let findings = crate::journal::findings_of(&task.plan, lines, &own);
        let findings = findings.filter(|findings| findings.has_all_of(&task.unit));
        let other =
            || TaskError::Format("these results do not belong to the unit of work".to_owned());
        findings.map(Self).ok_or_else(other)
    }

    /// Merges the findings of all tasks of a plan, in the order of their units. The result is the
    /// same as that of a single run.
    pub fn merge(tasks: impl IntoIterator<Item = Self>) -> Findings {
        let mut all = Findings::default();
        for Self(findings) in tasks {
            all.join(findings);
        }
        all
    }
}
