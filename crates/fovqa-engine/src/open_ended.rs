//! Sources whose length is unknown until they end. Frames without a partner are found while the
//! sources are read.

use fovqa_frame::source::{Length, Source, SourceError};
use fovqa_plan::{Plan, Scene};
use fovqa_results::Failure;

use crate::events::Warnings;
use crate::found::FoundView;
use crate::load::{LoadError, Loaded, Step};

/// How the user can allow frames without a partner.
const HELP: &str =
    "give both the same number of frames, or score those that have a partner with {allow_missing}";

/// Tracks which sources of a view have ended.
pub(crate) struct OpenEnded<'a> {
    plan: &'a Plan,
    scene: &'a Scene,
    view: &'a FoundView,
    /// Whether this was reported already.
    said: bool,
}

/// What happens to a step whose source has ended.
pub(crate) enum Ended {
    /// The step is ignored.
    PassedOver,
    /// The step fails, on behalf of all frames without a partner.
    Failed(Failure),
}

impl<'a> OpenEnded<'a> {
    pub(crate) fn new(plan: &'a Plan, scene: &'a Scene, view: &'a FoundView) -> Self {
        Self { plan, scene, view, said: false }
    }

    /// What happens to a step; `None` if its sources have not ended.
    pub(crate) fn of_step(
        &mut self,
        step: &Step<'_>,
        loaded: &Loaded,
        warnings: &mut Warnings<'_>,
    ) -> Option<Ended> {
        let end = loaded.errors().find(|error| error.has_ended)?;
        let frames = self.view.frames.len() - step.frame;
        let (frames, have) =
            if frames == 1 { ("1 frame", "has") } else { (&*format!("{frames} frames"), "have") };
        if self.scene.allow_missing {
            let message = format!("{end}: skipped {frames} without a partner");
            warnings.once_a_view("ended", &message);
            return Some(Ended::PassedOver);
        }
        if std::mem::replace(&mut self.said, true) {
            return Some(Ended::PassedOver);
        }
        let message = format!("{end}, and {frames} of the other sequence {have} no partner");
        Some(Ended::Failed(self.failure(Some(step.found.number), message)))
    }

    /// Frames that remain in a source although all of its expected frames were read.
    pub(crate) fn left(&self, warnings: &mut Warnings<'_>) -> Option<Failure> {
        if self.plan.frames.is_some() || self.scene.frames.is_some() {
            return None;
        }
        let mut open = self
            .view
            .sources
            .all()
            .filter(|source| source.listing().length() == Some(Length::Open));
        let source = open.find(|source| source.has_more() == Ok(true))?;
        let frames = self.view.frames.len();
        let message = format!(
            "{}: it continues after its first {frames} frames, but the other sequence ends there",
            source.listing().argument
        );
        if self.scene.allow_missing {
            warnings.once_a_view("goes on", &message);
            return None;
        }
        Some(self.failure(None, message))
    }

    fn failure(&self, frame: Option<i64>, message: String) -> Failure {
        let name = |source: &dyn Source| source.listing().argument.clone();
        let sources = &self.view.sources;
        let listing = sources.reference.listing();
        let test = sources.tests.values().next().map(|test| test.argument(listing));
        let (reference, test) = (name(&*sources.reference), test.unwrap_or_default());
        Failure { frame, reference, test, message, help: HELP.to_owned() }
    }
}

impl Loaded {
    /// The errors that sources returned in place of a frame.
    fn errors(&self) -> impl Iterator<Item = &SourceError> {
        let sides = self.reference.iter().chain(&self.test);
        sides.filter_map(|side| match side {
            Err(LoadError::Read(error)) => Some(error),
            _ => None,
        })
    }
}
