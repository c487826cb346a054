//! Loads the next items while the present one is processed.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;

/// Maximum size in bytes of loaded items that wait, however small each item is.
const WAITING_BYTES: usize = 256 << 20;

/// Loads `items` items by their index, on up to `loaders` threads, and passes them to `consume` in order.
/// `size` returns the bytes of a loaded item. The number of items loaded ahead is limited to 256 MiB, estimated from
/// the largest item so far, but is at least one. The memory use is this limit plus the item in
/// `consume`, however many items there are. If `consume` stops early, nothing more is loaded.
pub(crate) fn read_ahead<T: Send>(
    items: usize,
    loaders: usize,
    load: impl Fn(usize) -> T + Sync,
    size: impl Fn(&T) -> usize + Sync,
    mut consume: impl FnMut(usize, T) -> ControlFlow<()>,
) {
    let queue = Queue {
        state: Mutex::new(State { next: 0, handed_over: 0, largest: 0, ready: BTreeMap::new() }),
        changed: Condvar::new(),
        items,
        loaders: loaders.max(1),
    };
    thread::scope(|scope| {
        for _ in 0..queue.loaders.min(items) {
            scope.spawn(|| {
                while let Some(index) = queue.start() {
                    // A load that panics must not leave the others waiting for it.
                    let abandon = Abandon(&queue);
                    let item = load(index);
                    std::mem::forget(abandon);
                    let bytes = size(&item);
                    queue.loaded(index, item, bytes);
                }
            });
        }
        let abandon = Abandon(&queue);
        for index in 0..items {
            let Some(item) = queue.take(index) else { break };
            if consume(index, item).is_break() {
                break;
            }
        }
        drop(abandon);
    });
}

/// The queue that loaders and consumer share.
struct Queue<T> {
    state: Mutex<State<T>>,
    changed: Condvar,
    items: usize,
    loaders: usize,
}

struct State<T> {
    /// Index of the next item to be loaded.
    next: usize,
    /// Number of items that the consumer has taken.
    handed_over: usize,
    /// Bytes of the largest item so far; 0 before the first.
    largest: usize,
    ready: BTreeMap<usize, T>,
}

impl<T> Queue<T> {
    fn lock(&self) -> MutexGuard<'_, State<T>> {
        // No work is done under the lock that could leave the state half changed.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Index of the next item to load, as soon as there is room for it; `None` if no items are
    /// left.
    fn start(&self) -> Option<usize> {
        let mut state = self.lock();
        loop {
            if state.next >= self.items {
                return None;
            }
            let room = match state.largest {
                0 => 1,
                bytes => (WAITING_BYTES / bytes).clamp(1, self.loaders),
            };
            if state.next - state.handed_over < room {
                state.next += 1;
                return Some(state.next - 1);
            }
            state = self.changed.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
    }

    fn loaded(&self, index: usize, item: T, bytes: usize) {
        let mut state = self.lock();
        state.largest = state.largest.max(bytes).max(1);
        state.ready.insert(index, item);
        self.changed.notify_all();
    }

    /// Waits for an item; `None` if it will never arrive.
    fn take(&self, index: usize) -> Option<T> {
        let mut state = self.lock();
        loop {
            if let Some(item) = state.ready.remove(&index) {
                state.handed_over = index + 1;
                self.changed.notify_all();
                return Some(item);
            }
            if state.next == usize::MAX {
                return None;
            }
            state = self.changed.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
    }
}

/// Ends all waiting when it is dropped: after a panic on either side, and at the normal end.
struct Abandon<'a, T>(&'a Queue<T>);

impl<T> Drop for Abandon<'_, T> {
    fn drop(&mut self) {
        self.0.lock().next = usize::MAX;
        self.0.changed.notify_all();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};

    struct Counted<'a>(&'a AtomicUsize);

    impl Drop for Counted<'_> {
        fn drop(&mut self) {
            self.0.fetch_sub(1, Ordering::SeqCst);
        }
    }

    /// The largest number of items of `bytes` bytes that existed at the same time. The order of the
    /// items is checked as well.
    fn most_alive(loaders: usize, bytes: usize) -> usize {
        let (alive, most) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let items: Vec<usize> = (0..300).collect();
        let mut seen = Vec::new();
        read_ahead(
            items.len(),
            loaders,
            |item| {
                let now = alive.fetch_add(1, Ordering::SeqCst) + 1;
                most.fetch_max(now, Ordering::SeqCst);
                // Some items load more slowly than those after them.
                if item % 7 == 0 {
                    thread::sleep(std::time::Duration::from_micros(200));
                }
                (item, Counted(&alive))
            },
            |_| bytes,
            |index, (item, _counted)| {
                assert_eq!(index, item);
                seen.push(item);
                ControlFlow::Continue(())
            },
        );
        assert_eq!(seen, items);
        assert_eq!(alive.load(Ordering::SeqCst), 0);
        most.load(Ordering::SeqCst)
    }

    #[test]
    fn large_items_wait_one_at_a_time_and_all_come_in_order() {
        for loaders in [1, 8] {
            let most = most_alive(loaders, WAITING_BYTES);
            assert!(most <= 2, "{loaders} loaders: {most}");
        }
    }

    #[test]
    fn small_items_are_loaded_side_by_side_within_bounds() {
        let most = most_alive(4, 1000);
        assert!(most <= 5, "{most}");
        let some = most_alive(8, WAITING_BYTES / 3);
        assert!(some <= 4, "{some}");
    }

    #[test]
    fn a_panic_on_either_side_ends_all() {
        let panics = |load: bool| {
            std::panic::catch_unwind(|| {
                read_ahead(
                    50,
                    4,
                    |_| assert!(!load, "on purpose"),
                    |()| 1,
                    |index, ()| {
                        assert!(load || index < 3, "on purpose");
                        ControlFlow::Continue(())
                    },
                );
            })
            .is_err()
        };
        assert!(panics(true) && panics(false));
    }

    #[test]
    fn breaking_off_stops_the_loading() {
        let loaded = AtomicUsize::new(0);
        let mut consumed = 0;
        read_ahead(
            1000,
            3,
            |_| loaded.fetch_add(1, Ordering::SeqCst),
            |_| 1,
            |index, _| {
                consumed += 1;
                if index == 4 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            },
        );
        assert_eq!(consumed, 5);
        assert!(loaded.load(Ordering::SeqCst) <= 5 + 3);
    }

    #[test]
    fn nothing_to_do() {
        read_ahead(0, 4, |_| (), |()| 1, |_, ()| panic!("there is no item"));
    }
}
