//! The eyes of a scene.

use fovqa_params::{Words, words};

words! {
    /// One eye of a scene with two.
    pub enum Eye {
        /// The left eye.
        Left "left" "The left eye";
        /// The right eye.
        Right "right" "The right eye";
    }
}

impl Eye {
    /// Both eyes.
    pub const BOTH: [Eye; 2] = [Eye::Left, Eye::Right];

    /// The name of the eye in paths, which replaces `{eye}`.
    pub fn name(self) -> &'static str {
        self.word()
    }
}
