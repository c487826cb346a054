//! The primaries of a linear RGB space, and its conversion to Rec.709.

/// The CIE 1931 xy coordinates of the primaries and of white.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Chromaticities {
    /// Red.
    pub red: [f64; 2],
    /// Green.
    pub green: [f64; 2],
    /// Blue.
    pub blue: [f64; 2],
    /// White.
    pub white: [f64; 2],
}

type Matrix = [[f64; 3]; 3];

/// Bradford's sharpened cone responses (Lam 1985; ICC.1, Annex E).
const BRADFORD: Matrix =
    [[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]];

impl Chromaticities {
    /// Rec. ITU-R BT.709, white D65.
    pub const REC709: Self = Self {
        red: [0.64, 0.33],
        green: [0.30, 0.60],
        blue: [0.15, 0.06],
        white: [0.3127, 0.3290],
    };

    /// Whether these are the primaries of Rec.709, to the precision with which files write them.
    pub fn is_rec709(&self) -> bool {
        let all = |c: &Self| [c.red, c.green, c.blue, c.white];
        all(self)
            .iter()
            .flatten()
            .zip(all(&Self::REC709).iter().flatten())
            .all(|(a, b)| (a - b).abs() < 5e-4)
    }

    /// The matrix from linear RGB of these primaries to linear Rec.709, white to white (Bradford
    /// adaptation). `None` when the primaries do not span a colour space.
    pub fn to_rec709(&self) -> Option<Matrix> {
        let to_xyz = self.rgb_to_xyz()?;
        let back = inverse(&Self::REC709.rgb_to_xyz()?)?;
        let from_white = apply(&BRADFORD, &white_xyz(self.white)?);
        let to_white = apply(&BRADFORD, &white_xyz(Self::REC709.white)?);
        if from_white.contains(&0.0) {
            return None;
        }
        let mut scale = [[0.0; 3]; 3];
        for i in 0..3 {
            scale[i][i] = to_white[i] / from_white[i];
        }
        let adapt = multiply(&inverse(&BRADFORD)?, &multiply(&scale, &BRADFORD));
        let matrix = multiply(&back, &multiply(&adapt, &to_xyz));
        matrix.iter().flatten().all(|v| v.is_finite()).then_some(matrix)
    }

    /// The contributions of linear R, G and B of these primaries to the luminance, which is 1 for
    /// white. `None` when the primaries do not span a colour space, or green has no luminance.
    pub fn luminance_weights(&self) -> Option<[f64; 3]> {
        let [_, weights, _] = self.rgb_to_xyz()?;
        (weights.iter().all(|weight| weight.is_finite()) && weights[1].abs() > 1e-6)
            .then_some(weights)
    }

    /// SMPTE RP 177: the primaries are scaled so that they add up to white.
    fn rgb_to_xyz(&self) -> Option<Matrix> {
        let column = |[x, y]: [f64; 2]| [x, y, 1.0 - x - y];
        let [r, g, b] = [column(self.red), column(self.green), column(self.blue)];
        let primaries = [[r[0], g[0], b[0]], [r[1], g[1], b[1]], [r[2], g[2], b[2]]];
        let weights = apply(&inverse(&primaries)?, &white_xyz(self.white)?);
        Some(primaries.map(|row| [row[0] * weights[0], row[1] * weights[1], row[2] * weights[2]]))
    }
}

fn white_xyz([x, y]: [f64; 2]) -> Option<[f64; 3]> {
    (y > 0.0).then(|| [x / y, 1.0, (1.0 - x - y) / y])
}

fn apply(m: &Matrix, v: &[f64; 3]) -> [f64; 3] {
    m.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

fn multiply(a: &Matrix, b: &Matrix) -> Matrix {
    a.map(|row| {
        let mut out = [0.0; 3];
        for (j, out) in out.iter_mut().enumerate() {
            *out = row[0] * b[0][j] + row[1] * b[1][j] + row[2] * b[2][j];
        }
        out
    })
}

fn inverse(m: &Matrix) -> Option<Matrix> {
    let cofactor = |r: usize, c: usize| {
        let at = |i: usize, j: usize| m[(r + i) % 3][(c + j) % 3];
        at(1, 1) * at(2, 2) - at(1, 2) * at(2, 1)
    };
    let determinant = (0..3).map(|c| m[0][c] * cofactor(0, c)).sum::<f64>();
    if !determinant.is_finite() || determinant.abs() < 1e-12 {
        return None;
    }
    let mut out = [[0.0; 3]; 3];
    for (r, row) in out.iter_mut().enumerate() {
        for (c, out) in row.iter_mut().enumerate() {
            *out = cofactor(c, r) / determinant;
        }
    }
    Some(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rec709_is_its_own_and_white_stays_white() {
        let own = Chromaticities::REC709.to_rec709().unwrap();
        for (i, row) in own.iter().enumerate() {
            for (j, v) in row.iter().enumerate() {
                assert!((v - f64::from(u8::from(i == j))).abs() < 1e-12);
            }
        }
        let aces_cg = Chromaticities {
            red: [0.713, 0.293],
            green: [0.165, 0.830],
            blue: [0.128, 0.044],
            white: [0.32168, 0.33767],
        };
        let m = aces_cg.to_rec709().unwrap();
        for row in &m {
            assert!((row.iter().sum::<f64>() - 1.0).abs() < 1e-9);
        }
        // The AP1 to Rec.709 matrix with Bradford adaptation, as published with ACES.
        assert!((m[0][0] - 1.705_05).abs() < 1e-3 && (m[1][1] - 1.140_8).abs() < 1e-3, "{m:?}");
    }

    #[test]
    fn luminance_weights_are_those_of_the_standard() {
        let weights = Chromaticities::REC709.luminance_weights().unwrap();
        for (weight, expected) in weights.into_iter().zip([0.2126, 0.7152, 0.0722]) {
            assert!((weight - expected).abs() < 1e-4, "{weights:?}");
        }
    }

    #[test]
    fn primaries_on_a_line_do_not_make_a_space() {
        let flat = Chromaticities {
            green: [0.3, 0.3],
            red: [0.2, 0.2],
            blue: [0.1, 0.1],
            ..Chromaticities::REC709
        };
        assert!(flat.to_rec709().is_none());
    }
}
