//! Reuses the memory of planes for later planes of the same size.
//!
//! A sequence needs the same few dozen planes for every frame. With a plain allocator each of them
//! is new memory: the kernel clears and maps it page by page and takes it back immediately. For
//! small frames this costs more than the metric itself, and most if several threads run.

use std::collections::VecDeque;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The largest number of floats that are kept: 32 MiB. For larger planes, the cost of their pages
/// is small compared with the computation.
const MOST: usize = 8 << 20;

/// Planes that were given back, the latest last.
struct Spare {
    planes: VecDeque<Vec<f32>>,
    floats: usize,
}

static SPARE: Mutex<Spare> = Mutex::new(Spare { planes: VecDeque::new(), floats: 0 });

/// A plane of zeros, in reused memory if there is some of this length.
pub(super) fn zeros(length: usize) -> Vec<f32> {
    let found = lock().take(length);
    let Some(mut plane) = found else { return vec![0.0; length] };
    plane.fill(0.0);
    plane
}

/// A plane whose values will all be overwritten: it may hold those of an earlier plane.
pub(super) fn stale(length: usize) -> Vec<f32> {
    let found = lock().take(length);
    found.unwrap_or_else(|| vec![0.0; length])
}

/// Keeps a plane's memory for later planes. The planes that were kept longest are dropped to make
/// room.
pub(super) fn give_back(plane: Vec<f32>) {
    if plane.is_empty() || plane.len() > MOST / 8 {
        return;
    }
    let dropped = lock().keep(plane);
    // The lock is released before the memory is freed.
    drop(dropped);
}

/// A thread that panicked leaves only complete vectors behind, so a poisoned lock does no harm.
fn lock() -> MutexGuard<'static, Spare> {
    SPARE.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Spare {
    fn take(&mut self, length: usize) -> Option<Vec<f32>> {
        let index = self.planes.iter().rposition(|plane| plane.len() == length)?;
        let plane = self.planes.remove(index)?;
        self.floats -= length;
        Some(plane)
    }

    fn keep(&mut self, plane: Vec<f32>) -> Vec<Vec<f32>> {
        self.floats += plane.len();
        self.planes.push_back(plane);
        let mut dropped = Vec::new();
        while self.floats > MOST
            && let Some(oldest) = self.planes.pop_front()
        {
            self.floats -= oldest.len();
            dropped.push(oldest);
        }
        dropped
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lengths(spare: &Spare) -> Vec<usize> {
        spare.planes.iter().map(Vec::len).collect()
    }

    #[test]
    fn memory_given_back_is_zeros_again() {
        // No other test uses this length; the planes are shared between tests.
        let length = 7919;
        give_back(vec![1.5; length]);
        let plane = zeros(length);
        assert_eq!(plane, vec![0.0; length]);
    }

    #[test]
    fn a_plane_is_reused_once_for_its_length() {
        let mut spare = Spare { planes: VecDeque::new(), floats: 0 };
        for length in [3, 5, 3] {
            assert!(spare.keep(vec![1.0; length]).is_empty());
        }
        assert!(spare.take(4).is_none());
        assert_eq!(spare.take(5).map(|plane| plane.len()), Some(5));
        assert!(spare.take(5).is_none());
        assert_eq!((lengths(&spare), spare.floats), (vec![3, 3], 6));
    }

    #[test]
    fn the_memory_kept_longest_makes_room() {
        let mut spare = Spare { planes: VecDeque::new(), floats: 0 };
        for length in [MOST / 2, MOST / 4, MOST / 4] {
            assert!(spare.keep(vec![0.0; length]).is_empty());
        }
        let dropped = spare.keep(vec![0.0; 1]);
        assert_eq!(dropped.iter().map(Vec::len).collect::<Vec<_>>(), [MOST / 2]);
        assert_eq!((lengths(&spare), spare.floats), (vec![MOST / 4, MOST / 4, 1], MOST / 2 + 1));
    }
}
