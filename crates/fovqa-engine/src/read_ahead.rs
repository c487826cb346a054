//! Loading the next item while this one is worked on.

use std::sync::mpsc::sync_channel;
use std::thread;

/// Loads each item on a thread of its own and hands it over in order. At most two loaded items
/// exist at any time: the one `consume` works on, and the one loaded meanwhile.
pub fn read_ahead<I: Sync, T: Send>(
    items: &[I],
    load: impl Fn(&I) -> T + Sync,
    mut consume: impl FnMut(usize, T),
) {
    thread::scope(|scope| {
        // Without a buffer: the loader waits with one item in hand until it is asked for.
        let (send, receive) = sync_channel(0);
        let load = &load;
        scope.spawn(move || {
            for item in items {
                // The other side is gone only when it panicked: nothing is left to do.
                if send.send(load(item)).is_err() {
                    break;
                }
            }
        });
        for (index, item) in receive.into_iter().enumerate() {
            consume(index, item);
        }
    });
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

    #[test]
    fn never_more_than_two_at_a_time_and_all_in_order() {
        let (alive, most) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let items: Vec<usize> = (0..200).collect();
        let mut seen = Vec::new();
        read_ahead(
            &items,
            |&item| {
                let now = alive.fetch_add(1, Ordering::SeqCst) + 1;
                most.fetch_max(now, Ordering::SeqCst);
                (item, Counted(&alive))
            },
            |index, (item, _counted)| {
                assert_eq!(index, item);
                seen.push(item);
            },
        );
        assert_eq!(seen, items);
        assert_eq!(alive.load(Ordering::SeqCst), 0);
        assert!(most.load(Ordering::SeqCst) <= 2, "{most:?}");
    }
}
