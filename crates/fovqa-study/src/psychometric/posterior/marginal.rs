//! Quantiles and means of marginal distributions.

/// A density that is given at points and linear between them.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Density {
    points: Vec<f64>,
    density: Vec<f64>,
    /// The mass below each point.
    below: Vec<f64>,
}

impl Density {
    /// The density through these values at ascending points, two or more. It need not have mass 1.
    pub(super) fn new(points: Vec<f64>, density: Vec<f64>) -> Self {
        let mut below = vec![0.0];
        let mut sum = 0.0;
        for (points, density) in points.windows(2).zip(density.windows(2)) {
            sum += 0.5 * (density[0] + density[1]) * (points[1] - points[0]);
            below.push(sum);
        }
        Self { points, density, below }
    }

    /// The whole mass.
    pub(super) fn mass(&self) -> f64 {
        self.below.last().copied().unwrap_or(0.0)
    }

    /// The mass below x.
    pub(super) fn mass_below(&self, x: f64) -> f64 {
        let after = self.points.partition_point(|&point| point <= x);
        if after == 0 {
            return 0.0;
        }
        if after == self.points.len() {
            return self.mass();
        }
        let (left, right) = (self.points[after - 1], self.points[after]);
        let (low, high) = (self.density[after - 1], self.density[after]);
        let step = x - left;
        let slope = (high - low) / (right - left);
        self.below[after - 1] + step * (low + 0.5 * slope * step)
    }

    /// The point below which a share of the mass lies.
    pub(super) fn quantile(&self, share: f64) -> f64 {
        let wanted = share * self.mass();
        let last = self.points.len() - 1;
        let cell = self.below.partition_point(|&mass| mass < wanted).clamp(1, last) - 1;
        let (left, right) = (self.points[cell], self.points[cell + 1]);
        bisect(left, right, |x| self.mass_below(x) >= wanted)
    }

    /// From the point before the first density above a share of the highest one to the point after the
    /// last; `None` if there is no mass.
    pub(super) fn occupied(&self, share: f64) -> Option<[f64; 2]> {
        let least = share * self.density.iter().copied().fold(0.0, f64::max);
        let first = self.density.iter().position(|&density| density > least)?;
        let last = self.density.iter().rposition(|&density| density > least)?;
        let after = (last + 1).min(self.points.len() - 1);
        Some([self.points[first.saturating_sub(1)], self.points[after]])
    }

    /// The mean, by the trapezoid rule.
    pub(super) fn mean(&self) -> f64 {
        let mut sum = 0.0;
        let mut mass = 0.0;
        for (points, density) in self.points.windows(2).zip(self.density.windows(2)) {
            let step = points[1] - points[0];
            sum += step * (points[0] * density[0] + points[1] * density[1]);
            mass += step * (density[0] + density[1]);
        }
        sum / mass
    }
}

/// The point from `low` to `high` at which a condition starts to hold.
pub(super) fn bisect(mut low: f64, mut high: f64, holds: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if holds(middle) { high = middle } else { low = middle }
    }
    0.5 * (low + high)
}

/// The masses at the nodes of a Gauss-Legendre rule.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct NodeMasses {
    /// The nodes, ascending.
    pub(super) nodes: Vec<f64>,
    /// The weights of the rule; between the sums of successive weights lies one node each.
    pub(super) weights: Vec<f64>,
    /// The lower end of the rule.
    pub(super) low: f64,
    /// The mass at each node.
    pub(super) masses: Vec<f64>,
}

impl NodeMasses {
    /// The mean.
    pub(super) fn mean(&self) -> f64 {
        let products = self.nodes.iter().zip(&self.masses).map(|(node, mass)| node * mass);
        products.sum::<f64>() / self.masses.iter().sum::<f64>()
    }

    /// From the node before the first density above a share of the highest one to the node after the
    /// last, or to the end of the range.
    pub(super) fn occupied(&self, share: f64, [low, high]: [f64; 2]) -> [f64; 2] {
        let density: Vec<f64> =
            self.masses.iter().zip(&self.weights).map(|(mass, weight)| mass / weight).collect();
        let least = share * density.iter().copied().fold(0.0, f64::max);
        let first = density.iter().position(|&density| density > least).unwrap_or(0);
        let last = density.iter().rposition(|&density| density > least);
        let after = last.map_or(self.nodes.len(), |last| last + 1);
        [
            if first > 0 { self.nodes[first - 1] } else { low },
            self.nodes.get(after).copied().unwrap_or(high),
        ]
    }

    /// The point below which a share of the mass lies, with the mass of a node spread over its part of
    /// the range.
    pub(super) fn quantile(&self, share: f64) -> f64 {
        if let [node] = self.nodes[..] {
            return node;
        }
        let wanted = share * self.masses.iter().sum::<f64>();
        let (mut left, mut below) = (self.low, 0.0);
        for (&weight, &mass) in self.weights.iter().zip(&self.masses) {
            if below + mass >= wanted && mass > 0.0 {
                return left + weight * ((wanted - below) / mass).clamp(0.0, 1.0);
            }
            left += weight;
            below += mass;
        }
        left
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_triangle_has_the_quantiles_of_its_parabolas() {
        let triangle = Density::new(vec![0.0, 1.0, 2.0], vec![0.0, 3.0, 0.0]);
        assert!((triangle.quantile(0.5) - 1.0).abs() < 1e-12);
        assert!((triangle.quantile(0.125) - 0.5).abs() < 1e-12);
        assert!((triangle.quantile(0.875) - 1.5).abs() < 1e-12);
        assert!((triangle.mean() - 1.0).abs() < 1e-12);
        assert_eq!((triangle.mass_below(-1.0), triangle.mass_below(5.0)), (0.0, 3.0));
    }

    #[test]
    fn node_masses_are_spread_over_their_parts() {
        let masses = NodeMasses {
            nodes: vec![1.0, 3.0],
            weights: vec![2.0, 2.0],
            low: 0.0,
            masses: vec![1.0, 3.0],
        };
        assert!((masses.quantile(0.125) - 1.0).abs() < 1e-12);
        assert!((masses.quantile(0.625) - 3.0).abs() < 1e-12);
        assert!((masses.mean() - 2.5).abs() < 1e-12);
    }
}
