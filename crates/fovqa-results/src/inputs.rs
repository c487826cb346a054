//! The files that a run has read, each recorded once.

use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

use serde::de::{Deserializer, SeqAccess, Visitor};
use serde::ser::Serializer;
use serde::{Deserialize, Serialize};

/// An input of a run.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Input {
    /// Path of the file, relative to the experiment's folder.
    pub path: String,
    /// Size of the file in bytes.
    pub bytes: u64,
    /// SHA-256 of the file, in hexadecimal digits.
    pub sha256: String,
}

/// Inputs by path. A long sequence has very many, so each takes little memory.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Inputs(BTreeMap<Arc<str>, Identity>);

/// The size and the hash of an input.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Identity {
    bytes: u64,
    hash: Hash,
}

#[derive(Debug, Clone, PartialEq, Eq)]
enum Hash {
    /// The bytes of 64 lower-case hexadecimal digits.
    Bytes([u8; 32]),
    /// Any other text.
    Text(Box<str>),
}

impl Identity {
    /// The identity with this size and SHA-256.
    pub fn new(bytes: u64, sha256: &str) -> Self {
        Self { bytes, hash: Hash::new(sha256) }
    }

    /// The size in bytes.
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    /// The SHA-256, in hexadecimal digits.
    pub fn sha256(&self) -> String {
        match &self.hash {
            Hash::Bytes(bytes) => {
                let digit = |four: u8| char::from(DIGITS[usize::from(four)]);
                bytes.iter().flat_map(|byte| [digit(byte >> 4), digit(byte & 15)]).collect()
            }
            Hash::Text(text) => text.to_string(),
        }
    }
}

const DIGITS: &[u8; 16] = b"0123456789abcdef";

impl Hash {
    fn new(text: &str) -> Self {
        Self::bytes(text).map_or_else(|| Self::Text(text.into()), Self::Bytes)
    }

    fn bytes(text: &str) -> Option<[u8; 32]> {
        let value = |digit: u8| DIGITS.iter().position(|known| *known == digit);
        let mut bytes = [0; 32];
        let (pairs, rest) = text.as_bytes().as_chunks::<2>();
        if pairs.len() != bytes.len() || !rest.is_empty() {
            return None;
        }
        for (byte, &[high, low]) in bytes.iter_mut().zip(pairs) {
            *byte = (value(high)? << 4 | value(low)?) as u8;
        }
        Some(bytes)
    }
}

impl Inputs {
    /// Records a file. Returns whether it is new.
    pub fn add(&mut self, path: Arc<str>, id: Identity) -> bool {
        if self.0.contains_key(&path) {
            return false;
        }
        self.0.insert(path, id);
        true
    }

    /// The identity of a file.
    pub fn get(&self, path: &str) -> Option<&Identity> {
        self.0.get(path)
    }

    /// The name of a file as it is kept here, so that others can share it.
    pub fn shared(&self, path: &str) -> Option<Arc<str>> {
        self.0.get_key_value(path).map(|(path, _)| Arc::clone(path))
    }

    /// Number of files.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there are no files.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// All files with their identities, ordered by path.
    pub fn iter(&self) -> impl Iterator<Item = (&Arc<str>, &Identity)> {
        self.0.iter()
    }

    /// All files as they are written, ordered by path.
    pub fn all(&self) -> impl Iterator<Item = Input> {
        let input = |(path, id): (&Arc<str>, &Identity)| Input {
            path: path.to_string(),
            bytes: id.bytes,
            sha256: id.sha256(),
        };
        self.0.iter().map(input)
    }
}

impl FromIterator<Input> for Inputs {
    fn from_iter<I: IntoIterator<Item = Input>>(all: I) -> Self {
        let mut inputs = Self::default();
        for Input { path, bytes, sha256 } in all {
            inputs.add(path.into(), Identity::new(bytes, &sha256));
        }
        inputs
    }
}

/// A list of [`Input`]s.
impl Serialize for Inputs {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.all())
    }
}

impl<'de> Deserialize<'de> for Inputs {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct ListVisitor;
        impl<'de> Visitor<'de> for ListVisitor {
            type Value = Inputs;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a sequence")
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Inputs, A::Error> {
                let mut inputs = Inputs::default();
                while let Some(Input { path, bytes, sha256 }) = list.next_element()? {
                    inputs.add(path.into(), Identity::new(bytes, &sha256));
                }
                Ok(inputs)
            }
        }
        deserializer.deserialize_seq(ListVisitor)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn input(path: &str, sha256: &str) -> Input {
        Input { path: path.to_owned(), bytes: 7, sha256: sha256.to_owned() }
    }

    #[test]
    fn a_file_is_recorded_once() {
        let mut inputs = Inputs::default();
        let id = Identity::new(1, "0");
        assert!(inputs.add("b".into(), id.clone()) && inputs.add("a".into(), id.clone()));
        assert!(!inputs.add("b".into(), Identity::new(2, "1")));
        assert_eq!((inputs.len(), inputs.get("b")), (2, Some(&id)));
        let paths: Vec<String> = inputs.all().map(|input| input.path).collect();
        assert_eq!(paths, ["a", "b"]);
    }

    #[test]
    fn a_hash_is_written_as_it_was_read() {
        let digits = "0123456789abcdef".repeat(4);
        let hashes =
            [&*digits, &digits.to_uppercase(), &digits[1..], &format!("{digits}0"), "", "é"];
        let list: Vec<Input> =
            (0..).zip(hashes).map(|(nth, hash)| input(&format!("{nth}"), hash)).collect();
        let inputs: Inputs = list.iter().cloned().collect();
        assert_eq!(inputs.all().collect::<Vec<_>>(), list);
        let json = serde_json::to_string(&inputs).unwrap();
        assert_eq!(json, serde_json::to_string(&list).unwrap());
        assert_eq!(serde_json::from_str::<Inputs>(&json).unwrap(), inputs);
        assert!(size_of::<Identity>() <= 48, "a long sequence has very many");
    }
}
