//! The memory of samples: owned by a frame, or shared with somebody else.

use std::fmt;
use std::ops::Deref;
use std::sync::Arc;

/// Memory that a program shares with a frame.
type Shared<T> = Arc<dyn AsRef<[T]> + Send + Sync>;

/// Samples, which are read like a slice. A program that has a picture in memory already
/// [shares](Buffer::shared) it: a frame then refers to that memory, and nothing is copied.
#[derive(Clone)]
pub struct Buffer<T>(Memory<T>);

#[derive(Clone)]
enum Memory<T> {
    Owned(Vec<T>),
    Shared(Shared<T>),
}

impl<T> Buffer<T> {
    /// Samples in memory that belongs to `owner`, which is kept for as long as the buffer or a clone of it.
    pub fn shared(owner: impl AsRef<[T]> + Send + Sync + 'static) -> Self {
        Self(Memory::Shared(Arc::new(owner)))
    }
}

impl<T: Clone> Buffer<T> {
    /// The samples as a vector. They are copied only if they are shared.
    pub fn into_vec(self) -> Vec<T> {
        match self.0 {
            Memory::Owned(samples) => samples,
            Memory::Shared(owner) => (*owner).as_ref().to_vec(),
        }
    }
}

impl<T> Deref for Buffer<T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        match &self.0 {
            Memory::Owned(samples) => samples,
            Memory::Shared(owner) => (**owner).as_ref(),
        }
    }
}

impl<T> From<Vec<T>> for Buffer<T> {
    fn from(samples: Vec<T>) -> Self {
        Self(Memory::Owned(samples))
    }
}

impl<T> FromIterator<T> for Buffer<T> {
    fn from_iter<I: IntoIterator<Item = T>>(samples: I) -> Self {
        Vec::from_iter(samples).into()
    }
}

impl<'a, T> IntoIterator for &'a Buffer<T> {
    type Item = &'a T;
    type IntoIter = std::slice::Iter<'a, T>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl<T: PartialEq> PartialEq for Buffer<T> {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}

impl<T: fmt::Debug> fmt::Debug for Buffer<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Owner(Arc<Vec<u8>>);

    impl AsRef<[u8]> for Owner {
        fn as_ref(&self) -> &[u8] {
            &self.0
        }
    }

    #[test]
    fn shared_memory_is_not_copied_and_lives_as_long_as_its_readers() {
        let owner = Arc::new(vec![1u8, 2, 3]);
        let buffer = Buffer::shared(Owner(Arc::clone(&owner)));
        let second = buffer.clone();
        assert!(std::ptr::eq(&raw const second[0], &raw const owner[0]));
        drop(buffer);
        assert_eq!((second.len(), Arc::strong_count(&owner)), (3, 2));
        assert_eq!(second, Buffer::from(vec![1, 2, 3]));
        assert_eq!(second.into_vec(), [1, 2, 3]);
        assert_eq!(Arc::strong_count(&owner), 1);
    }
}
