//! Orthonormal contrasts.

/// A matrix as rows.
pub(super) type Matrix = Vec<Vec<f64>>;

/// Helmert's contrasts of `levels` levels: orthonormal rows, each orthogonal to a constant.
pub(super) fn helmert(levels: usize) -> Matrix {
    let row = |k: usize| {
        let scale = 1.0 / libm::sqrt((k * (k + 1)) as f64);
        let weight = |j: usize| match j {
            _ if j < k => scale,
            _ if j == k => -(k as f64) * scale,
            _ => 0.0,
        };
        (0..levels).map(weight).collect()
    };
    (1..levels).map(row).collect()
}

/// The normalised mean over `levels` levels, as one row.
pub(super) fn average(levels: usize) -> Matrix {
    vec![vec![1.0 / libm::sqrt(levels as f64); levels]]
}

/// The Kronecker product A ⊗ B.
pub(super) fn kronecker(a: &Matrix, b: &Matrix) -> Matrix {
    let row = |a: &Vec<f64>, b: &Vec<f64>| {
        a.iter().flat_map(|x| b.iter().map(move |y| x * y)).collect::<Vec<f64>>()
    };
    a.iter().flat_map(|a| b.iter().map(move |b| row(a, b))).collect()
}

/// Y Cᵀ: the contrasts of each row of values.
pub(super) fn apply(values: &Matrix, contrasts: &Matrix) -> Matrix {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum();
    let of = |row: &Vec<f64>| contrasts.iter().map(|contrast| dot(row, contrast)).collect();
    values.iter().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn contrasts_are_orthonormal() {
        let all = [
            kronecker(&helmert(3), &average(2)),
            kronecker(&average(3), &helmert(2)),
            kronecker(&helmert(3), &helmert(2)),
            kronecker(&average(3), &average(2)),
        ]
        .concat();
        assert_eq!(all.len(), 6);
        for (i, row) in apply(&all, &all).iter().enumerate() {
            for (j, product) in row.iter().enumerate() {
                let expected = if i == j { 1.0 } else { 0.0 };
                assert!((product - expected).abs() < 1e-15);
            }
        }
    }
}
