//! Whether scores are finite.

/// Whether wins lead from every method to every other one, in both directions. `wins` has the cells
/// `winner · methods + loser`. Only then do finite scores of maximum likelihood exist (Ford 1957,
/// "Solution of a ranking problem from binary comparisons").
pub(super) fn is_linked(wins: &[f64], methods: usize) -> bool {
    let forwards = |from: usize, to: usize| wins[from * methods + to] > 0.0;
    let backwards = |from: usize, to: usize| wins[to * methods + from] > 0.0;
    reaches_all(methods, forwards) && reaches_all(methods, backwards)
}

fn reaches_all(methods: usize, is_edge: impl Fn(usize, usize) -> bool) -> bool {
    let mut seen = vec![false; methods];
    let mut open = vec![0];
    seen[0] = true;
    while let Some(from) = open.pop() {
        for (to, seen) in seen.iter_mut().enumerate() {
            if !*seen && is_edge(from, to) {
                *seen = true;
                open.push(to);
            }
        }
    }
    seen.into_iter().all(|seen| seen)
}

#[cfg(test)]
mod tests {
    use super::is_linked;

    #[test]
    fn wins_have_to_go_both_ways() {
        let circle = [0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0];
        assert!(is_linked(&circle, 3));
        let undefeated = [0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0];
        assert!(!is_linked(&undefeated, 3));
        assert!(is_linked(&[0.0, 1.0, 1.0, 0.0], 2) && !is_linked(&[0.0, 1.0, 0.0, 0.0], 2));
    }
}
