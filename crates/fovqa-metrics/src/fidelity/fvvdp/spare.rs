//! The memory of planes that are done with, for the next ones of their size.
//!
//! A sequence makes the same few dozen planes for every frame. Left to the allocator, each is new memory:
//! the kernel clears and maps it page by page and takes it back at once, which costs small frames more than
//! the metric itself, and most where several threads run.

use std::collections::VecDeque;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The most floats that are kept: 32 MiB. Larger planes cost their pages little beside their work.
const MOST: usize = 8 << 20;

/// Planes given back, the latest last.
struct Spare {
    planes: VecDeque<Vec<f32>>,
    floats: usize,
}

static SPARE: Mutex<Spare> = Mutex::new(Spare { planes: VecDeque::new(), floats: 0 });

/// Zeros, in memory given back before where there is some of this length.
pub(super) fn zeros(length: usize) -> Vec<f32> {
    let found = lock().take(length);
    let Some(mut plane) = found else { return vec![0.0; length] };
    plane.fill(0.0);
    plane
}

/// Keeps a plane's memory for [`zeros`]. Those that waited longest make room.
pub(super) fn give_back(plane: Vec<f32>) {
    if plane.is_empty() || plane.len() > MOST / 8 {
        return;
    }
    let dropped = lock().keep(plane);
    // The lock is free again when the memory goes.
    drop(dropped);
}

/// A thread that panicked has left whole vectors behind, whatever it did.
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
        // A length of this test alone: the others share the planes.
        let length = 7919;
        give_back(vec![1.5; length]);
        let plane = zeros(length);
        assert_eq!(plane, vec![0.0; length]);
    }

    #[test]
    fn a_plane_is_taken_by_its_length_and_once() {
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
    fn what_waited_longest_makes_room() {
        let mut spare = Spare { planes: VecDeque::new(), floats: 0 };
        for length in [MOST / 2, MOST / 4, MOST / 4] {
            assert!(spare.keep(vec![0.0; length]).is_empty());
        }
        let dropped = spare.keep(vec![0.0; 1]);
        assert_eq!(dropped.iter().map(Vec::len).collect::<Vec<_>>(), [MOST / 2]);
        assert_eq!((lengths(&spare), spare.floats), (vec![MOST / 4, MOST / 4, 1], MOST / 2 + 1));
    }
}
