//! The simplex method of Nelder and Mead (1965) within bounds, started again until it no longer
//! improves.

/// The most evaluations of one run.
const MOST_EVALUATIONS: usize = 2000;
/// The most runs.
const MOST_RUNS: usize = 12;

/// The lowest point that is found, and its value. Points beyond `limits` are moved onto them, and a
/// coordinate whose limits are equal is fixed. `steps` are the sizes of the first simplex. Values that
/// are not finite count as infinitely high.
pub(crate) fn minimise<const N: usize>(
    f: impl Fn(&[f64; N]) -> f64,
    start: [f64; N],
    steps: [f64; N],
    limits: [[f64; 2]; N],
) -> ([f64; N], f64) {
    let search = Search { f, limits };
    let free: Vec<usize> = (0..N).filter(|&i| limits[i][0] < limits[i][1]).collect();
    let mut best = search.vertex(start);
    let mut scale = 1.0;
    for _ in 0..MOST_RUNS {
        let next = search.run(best, &free, steps.map(|step| step * scale));
        let improved = best.1 - next.1 > 1e-11 * (1.0 + next.1.abs());
        best = next;
        if !improved {
            break;
        }
        scale = (scale * 0.5).max(0.05);
    }
    best
}

type Vertex<const N: usize> = ([f64; N], f64);

struct Search<F, const N: usize> {
    f: F,
    limits: [[f64; 2]; N],
}

impl<F: Fn(&[f64; N]) -> f64, const N: usize> Search<F, N> {
    fn vertex(&self, mut point: [f64; N]) -> Vertex<N> {
        for (value, [low, high]) in point.iter_mut().zip(self.limits) {
            *value = value.max(low).min(high);
        }
        let value = (self.f)(&point);
        (point, if value.is_finite() { value } else { f64::INFINITY })
    }

    /// The point from the centre towards `worst` (share 1), or away from it (negative shares).
    fn towards(&self, centre: &[f64; N], worst: &[f64; N], share: f64) -> Vertex<N> {
        let mut point = *centre;
        for (value, worst) in point.iter_mut().zip(worst) {
            *value += share * (worst - *value);
        }
        self.vertex(point)
    }

    fn run(&self, start: Vertex<N>, free: &[usize], steps: [f64; N]) -> Vertex<N> {
        let mut simplex = vec![start];
        for &i in free {
            let mut point = start.0;
            // Away from a limit, where the simplex would have no volume.
            let forward = point[i] + steps[i] <= self.limits[i][1];
            point[i] += if forward { steps[i] } else { -steps[i] };
            simplex.push(self.vertex(point));
        }
        let last = simplex.len() - 1;
        if last == 0 {
            return start;
        }
        let mut evaluations = simplex.len();
        while evaluations < MOST_EVALUATIONS {
            simplex.sort_by(|a, b| a.1.total_cmp(&b.1));
            if converged(&simplex, &steps) {
                break;
            }
            let centre = centre(&simplex[..last]);
            let worst = simplex[last];
            let reflected = self.towards(&centre, &worst.0, -1.0);
            evaluations += 1;
            if reflected.1 < simplex[0].1 {
                let expanded = self.towards(&centre, &worst.0, -2.0);
                evaluations += 1;
                simplex[last] = if expanded.1 < reflected.1 { expanded } else { reflected };
            } else if reflected.1 < simplex[last - 1].1 {
                simplex[last] = reflected;
            } else {
                let outside = reflected.1 < worst.1;
                let contracted = self.towards(&centre, &worst.0, if outside { -0.5 } else { 0.5 });
                evaluations += 1;
                if contracted.1 < reflected.1.min(worst.1) {
                    simplex[last] = contracted;
                } else {
                    let best = simplex[0].0;
                    for vertex in &mut simplex[1..] {
                        *vertex = self.towards(&best, &vertex.0, 0.5);
                    }
                    evaluations += last;
                }
            }
        }
        simplex.sort_by(|a, b| a.1.total_cmp(&b.1));
        simplex[0]
    }
}

fn centre<const N: usize>(vertices: &[Vertex<N>]) -> [f64; N] {
    let mut centre = [0.0; N];
    for (point, _) in vertices {
        for (sum, value) in centre.iter_mut().zip(point) {
            *sum += value / vertices.len() as f64;
        }
    }
    centre
}

/// True if neither the values nor the points of the simplex differ any more.
fn converged<const N: usize>(simplex: &[Vertex<N>], steps: &[f64; N]) -> bool {
    let (best, worst) = (simplex[0], simplex[simplex.len() - 1]);
    let flat = worst.1 - best.1 <= 1e-14 * (1.0 + best.1.abs());
    let small = simplex.iter().all(|(point, _)| {
        let near = |i: usize| (point[i] - best.0[i]).abs() <= 1e-8 * steps[i].abs();
        (0..N).all(near)
    });
    small || (flat && best.1.is_finite() && near_enough(simplex, steps))
}

/// Equal values end the search only in a small simplex: a large one may lie across a valley.
fn near_enough<const N: usize>(simplex: &[Vertex<N>], steps: &[f64; N]) -> bool {
    let best = simplex[0].0;
    simplex
        .iter()
        .all(|(point, _)| (0..N).all(|i| (point[i] - best[i]).abs() <= 1e-4 * steps[i].abs()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_valley_of_rosenbrock_is_followed() {
        let f = |p: &[f64; 2]| (1.0 - p[0]).powi(2) + 100.0 * (p[1] - p[0] * p[0]).powi(2);
        let (point, value) = minimise(f, [-1.2, 1.0], [0.5, 0.5], [[-5.0, 5.0]; 2]);
        assert!(value < 1e-12 && (point[0] - 1.0).abs() < 1e-5, "{point:?}");
    }

    #[test]
    fn limits_and_fixed_coordinates_hold() {
        let f = |p: &[f64; 3]| p.iter().map(|x| (x - 2.0) * (x - 2.0)).sum();
        let limits = [[0.0, 1.0], [0.5, 0.5], [-9.0, 9.0]];
        let (point, _) = minimise(f, [0.5, 0.5, 0.0], [0.3; 3], limits);
        assert_eq!((point[0], point[1]), (1.0, 0.5));
        assert!((point[2] - 2.0).abs() < 1e-6);
    }
}
