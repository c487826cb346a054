//! Settings that take one of a few words. The words are written once, beside the type they belong
//! to; the command line, the experiment file, its schema and `run.json` take them from there.

/// A type whose values are a few words. [`words!`](crate::words!) defines such a type.
pub trait Words: Copy + PartialEq + Send + Sync + 'static {
    /// All values, in the order in which help shows them.
    fn all() -> Vec<Self>;

    /// The word of this value, as it is written everywhere.
    fn word(self) -> &'static str;

    /// What it means, in one line of help.
    fn about(self) -> &'static str;

    /// The value of a word, if there is one.
    fn find(word: &str) -> Option<Self> {
        Self::all().into_iter().find(|value| value.word() == word)
    }
}

/// A setting that may also be left to the input, with the word `auto`.
pub trait OrAuto: Words {
    /// What `auto` means, in one line of help.
    const AUTO: &'static str;
}

impl<T: OrAuto> Words for Option<T> {
    fn all() -> Vec<Self> {
        [None].into_iter().chain(T::all().into_iter().map(Some)).collect()
    }

    fn word(self) -> &'static str {
        self.map_or("auto", T::word)
    }

    fn about(self) -> &'static str {
        self.map_or(T::AUTO, T::about)
    }
}

/// The words of a type, in the order of help.
pub fn words_of<T: Words>() -> Vec<&'static str> {
    T::all().into_iter().map(T::word).collect()
}

/// Defines an enum whose values are words: `Variant "word" "what it means";`. It is written and read as its
/// word by serde as well.
#[macro_export]
macro_rules! words {
    (
        $(#[$meta:meta])*
        pub enum $name:ident {
            $($(#[$about_variant:meta])* $variant:ident $word:literal $about:literal;)+
        }
    ) => {
        $(#[$meta])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum $name {
            $($(#[$about_variant])* $variant,)+
        }

        impl $crate::Words for $name {
            fn all() -> ::std::vec::Vec<Self> {
                ::std::vec![$(Self::$variant),+]
            }

            fn word(self) -> &'static str {
                match self {
                    $(Self::$variant => $word,)+
                }
            }

            fn about(self) -> &'static str {
                match self {
                    $(Self::$variant => $about,)+
                }
            }
        }

        impl $crate::serde::Serialize for $name {
            fn serialize<S: $crate::serde::Serializer>(
                &self,
                serializer: S,
            ) -> ::std::result::Result<S::Ok, S::Error> {
                serializer.serialize_str($crate::Words::word(*self))
            }
        }

        impl<'de> $crate::serde::Deserialize<'de> for $name {
            fn deserialize<D: $crate::serde::Deserializer<'de>>(
                deserializer: D,
            ) -> ::std::result::Result<Self, D::Error> {
                let word: ::std::string::String = $crate::serde::Deserialize::deserialize(deserializer)?;
                <Self as $crate::Words>::find(&word).ok_or_else(|| {
                    let known = $crate::words_of::<Self>().join(", ");
                    $crate::serde::de::Error::custom(::std::format!("{word:?} is not one of {known}"))
                })
            }
        }
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    words! {
        /// Test words.
        #[expect(unreachable_pub, reason = "all of these are public")]
        pub enum Side {
            /// Left.
            Left "left" "the left one";
            /// Right.
            Right "right-hand" "the right one";
        }
    }

    impl OrAuto for Side {
        const AUTO: &'static str = "whichever is nearer";
    }

    #[test]
    fn words_are_found_written_and_read() {
        assert_eq!(words_of::<Side>(), ["left", "right-hand"]);
        assert_eq!(Side::find("right-hand"), Some(Side::Right));
        assert_eq!((Side::find("Right"), Side::Left.about()), (None, "the left one"));
        assert_eq!(words_of::<Option<Side>>(), ["auto", "left", "right-hand"]);
        assert_eq!(<Option<Side>>::find("auto"), Some(None));
        assert_eq!(<Option<Side>>::None.about(), "whichever is nearer");
        assert_eq!(serde_json::to_string(&Side::Right).unwrap(), "\"right-hand\"");
        assert_eq!(serde_json::from_str::<Side>("\"left\"").unwrap(), Side::Left);
        let error = serde_json::from_str::<Side>("\"up\"").unwrap_err().to_string();
        assert!(error.contains("\"up\" is not one of left, right-hand"), "{error}");
    }
}
