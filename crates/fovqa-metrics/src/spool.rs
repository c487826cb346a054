//! The values of frames in a temporary file: a long run has more of them than memory should hold. The file has
//! no name, is shared by the whole process, and is removed by the system when nothing in it is needed any more.

use std::fs::File;
use std::io;
use std::panic::panic_any;
use std::sync::{Arc, Mutex, PoisonError, Weak};

/// Bytes that are held in memory before anything is written to the file.
const HELD_BYTES: usize = 1 << 17;

/// Takes numbers in, and keeps the first in memory and the others in the file.
#[derive(Debug, Clone, Default)]
pub(crate) struct Spool {
    /// Bytes in memory.
    held: usize,
    /// Whether the file could not be written: all is held in memory then.
    is_refused: bool,
}

/// The file, and its length in bytes.
#[derive(Debug)]
pub(crate) struct Shared {
    file: File,
    length: Mutex<u64>,
}

/// The values in the temporary file cannot be read again. All functions that return values of a frame panic with
/// this payload, because a disk that loses data is too rare for a result of each. A program that wants to
/// report it finds it with `catch_unwind`.
#[derive(Debug, thiserror::Error)]
#[error("the values in the temporary file cannot be read again: {0}")]
pub struct ReadBackError(io::Error);

/// The present file, as long as somebody needs it.
static PRESENT: Mutex<Weak<Shared>> = Mutex::new(Weak::new());

/// Numbers that can be read again.
#[derive(Debug, Clone)]
pub(crate) enum Numbers {
    Held(Arc<[u64]>),
    InFile {
        shared: Arc<Shared>,
        /// The first byte.
        at: u64,
        /// How many numbers.
        count: u32,
    },
}

impl Shared {
    fn present() -> io::Result<Arc<Self>> {
        let mut present = PRESENT.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(shared) = present.upgrade() {
            return Ok(shared);
        }
        let shared = Arc::new(Self { file: tempfile::tempfile()?, length: Mutex::new(0) });
        *present = Arc::downgrade(&shared);
        Ok(shared)
    }

    /// Appends bytes; where they begin.
    fn append(&self, bytes: &[u8]) -> io::Result<u64> {
        let mut length = self.length.lock().unwrap_or_else(PoisonError::into_inner);
        let at = *length;
        write_at(&self.file, bytes, at)?;
        *length += bytes.len() as u64;
        Ok(at)
    }

    /// Reads what was written.
    ///
    /// # Panics
    /// With a [`ReadBackError`] if the system does not return what was written.
    fn read(&self, at: u64, count: usize) -> impl Iterator<Item = u64> + use<> {
        let mut bytes = vec![0; 8 * count];
        if let Err(error) = read_at(&self.file, &mut bytes, at) {
            panic_any(ReadBackError(error));
        }
        (0..count).map(move |index| {
            let mut number = [0; 8];
            number.copy_from_slice(&bytes[8 * index..8 * index + 8]);
            u64::from_le_bytes(number)
        })
    }
}

impl Spool {
    /// Keeps some numbers. What no file takes, because the disk is full or there is none, stays in memory.
    pub(crate) fn keep(&mut self, numbers: Vec<u64>) -> Numbers {
        let bytes = size_of_val(numbers.as_slice());
        if self.held + bytes > HELD_BYTES && !self.is_refused {
            let bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
            let written = Shared::present().and_then(|shared| {
                let at = shared.append(&bytes)?;
                Ok(Numbers::InFile { shared, at, count: numbers.len() as u32 })
            });
            match written {
                Ok(numbers) => return numbers,
                Err(_) => self.is_refused = true,
            }
        }
        self.held += bytes;
        Numbers::Held(numbers.into())
    }
}

impl Numbers {
    /// All of them.
    pub(crate) fn all(&self) -> Arc<[u64]> {
        match self {
            Self::Held(numbers) => Arc::clone(numbers),
            Self::InFile { shared, at, count } => shared.read(*at, *count as usize).collect(),
        }
    }

    /// `N` of them from a place on. Behind the last, there are zeros.
    pub(crate) fn some<const N: usize>(&self, from: usize) -> [u64; N] {
        let mut some = [0; N];
        let put = |(to, number): (&mut u64, u64)| *to = number;
        match self {
            Self::Held(numbers) => {
                some.iter_mut().zip(numbers[from..].iter().copied()).for_each(put);
            }
            Self::InFile { shared, at, count } => {
                let count = N.min(*count as usize - from);
                some.iter_mut().zip(shared.read(at + from as u64 * 8, count)).for_each(put);
            }
        }
        some
    }
}

impl Default for Numbers {
    fn default() -> Self {
        Self::Held(Arc::default())
    }
}

/// Numbers are the same wherever they are.
impl PartialEq for Numbers {
    fn eq(&self, other: &Self) -> bool {
        self.all() == other.all()
    }
}

impl Eq for Numbers {}

#[cfg(unix)]
fn write_at(file: &File, bytes: &[u8], at: u64) -> io::Result<()> {
    std::os::unix::fs::FileExt::write_all_at(file, bytes, at)
}

#[cfg(unix)]
fn read_at(file: &File, bytes: &mut [u8], at: u64) -> io::Result<()> {
    std::os::unix::fs::FileExt::read_exact_at(file, bytes, at)
}

#[cfg(windows)]
fn write_at(file: &File, mut bytes: &[u8], mut at: u64) -> io::Result<()> {
    while !bytes.is_empty() {
        let written = std::os::windows::fs::FileExt::seek_write(file, bytes, at)?;
        if written == 0 {
            return Err(io::ErrorKind::WriteZero.into());
        }
        bytes = &bytes[written..];
        at += written as u64;
    }
    Ok(())
}

#[cfg(windows)]
fn read_at(file: &File, mut bytes: &mut [u8], mut at: u64) -> io::Result<()> {
    while !bytes.is_empty() {
        let read = std::os::windows::fs::FileExt::seek_read(file, bytes, at)?;
        if read == 0 {
            return Err(io::ErrorKind::UnexpectedEof.into());
        }
        bytes = &mut bytes[read..];
        at += read as u64;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_the_same_in_memory_and_in_a_file() {
        let mut spool = Spool::default();
        let numbers = |seed: u64| -> Vec<u64> {
            (0..1000 + seed).map(|n| (n + seed).wrapping_mul(0x9e37_79b9_7f4a_7c15)).collect()
        };
        let kept: Vec<Numbers> = (0..300).map(|seed| spool.keep(numbers(seed))).collect();
        let in_file = |kept: &&Numbers| matches!(kept, Numbers::InFile { .. });
        let first = kept.iter().position(|kept| in_file(&kept)).unwrap();
        assert!(first > 0 && kept[first..].iter().all(|kept| in_file(&kept)));
        for (seed, kept) in (0..).zip(&kept) {
            let wanted = numbers(seed);
            assert_eq!(*kept.all(), *wanted);
            assert_eq!(kept.some::<4>(17), wanted[17..21]);
            assert_eq!(kept.some::<4>(wanted.len() - 1), [wanted[wanted.len() - 1], 0, 0, 0]);
            assert_eq!(*kept, Numbers::Held(wanted.into()));
        }
        assert_ne!(kept[298], kept[299]);
    }

    #[test]
    fn without_a_file_all_is_held() {
        let mut spool = Spool { is_refused: true, ..Spool::default() };
        let kept: Vec<Numbers> = (0..3).map(|seed| spool.keep(vec![seed; 100_000])).collect();
        assert!(kept.iter().all(|kept| matches!(kept, Numbers::Held(_))));
        assert_eq!(kept[2].some::<1>(99_999), [2]);
    }

    #[test]
    fn a_file_that_cannot_be_read_again_is_an_error_of_its_own() {
        let shared =
            Arc::new(Shared { file: tempfile::tempfile().unwrap(), length: Mutex::new(0) });
        let at = shared.append(&[1; 16]).unwrap();
        let numbers = Numbers::InFile { shared: Arc::clone(&shared), at, count: 2 };
        assert_eq!(numbers.all().len(), 2);
        shared.file.set_len(8).unwrap();
        let read = std::panic::catch_unwind(|| numbers.all());
        let error = read.unwrap_err().downcast::<ReadBackError>().unwrap();
        assert!(error.to_string().starts_with("the values in the temporary file"), "{error}");
    }
}
