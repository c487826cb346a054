//! The weighted quartiles of a map: of its values in ascending order, the first one at which their running
//! sum exceeds a share of the total.

/// The extremes of a map, and its weighted quartiles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Quartiles {
    pub(crate) min: f32,
    pub(crate) max: f32,
    /// At 0.25, 0.5 and 0.75 of the sum.
    pub(crate) weighted: [f32; 3],
}

/// Values with the same upper bits are summed together; the quartile is then looked for among those of one
/// such group. A value from 0 to 1 has fewer than 2^30 patterns of bits.
const GROUP_BITS: u32 = 15;
const GROUPS: usize = 1 << (30 - GROUP_BITS);

fn group(value: f32) -> usize {
    ((value.to_bits() >> GROUP_BITS) as usize).min(GROUPS - 1)
}

impl Quartiles {
    /// The quartiles of values from 0 to 1; NaN is left out. `None` if there is no value.
    pub(crate) fn of(values: &[f32]) -> Option<Self> {
        let (mut min, mut max) = (f32::INFINITY, f32::NEG_INFINITY);
        let mut sums = vec![0.0f64; GROUPS];
        for &value in values.iter().filter(|value| !value.is_nan()) {
            (min, max) = (min.min(value), max.max(value));
            sums[group(value)] += f64::from(value);
        }
        if min > max {
            return None;
        }
        let total = sums.iter().sum::<f64>();
        let quartile = |share: f64| {
            let mut before = 0.0;
            let wanted = share * total;
            for (at, sum) in sums.iter().enumerate().filter(|(_, sum)| **sum > 0.0) {
                if before + sum > wanted {
                    return Self::within(values, at, wanted - before);
                }
                before += sum;
            }
            // The whole sum is 0, or it was reached only by rounding.
            if total > 0.0 { max } else { 0.0 }
        };
        Some(Self { min, max, weighted: [0.25, 0.5, 0.75].map(quartile) })
    }

    /// The first value of a group, in ascending order, at which their running sum exceeds `wanted`.
    fn within(values: &[f32], at: usize, wanted: f64) -> f32 {
        let mut found: Vec<f32> =
            values.iter().copied().filter(|value| !value.is_nan() && group(*value) == at).collect();
        found.sort_unstable_by(f32::total_cmp);
        let mut sum = 0.0;
        for &value in &found {
            sum += f64::from(value);
            if sum > wanted {
                return value;
            }
        }
        found.last().copied().unwrap_or_default()
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "a quartile is one of the values")]
mod tests {
    use super::*;

    #[test]
    fn quartiles_are_where_the_running_sum_exceeds_a_share() {
        let values: Vec<f32> = (0..5000).map(|i| ((i * 7919) % 5000) as f32 / 5000.0).collect();
        let mut sorted = values.clone();
        sorted.sort_by(f32::total_cmp);
        let total: f64 = sorted.iter().map(|v| f64::from(*v)).sum();
        let literal = |share: f64| {
            let mut sum = 0.0;
            let exceeds = |v: &&f32| {
                sum += f64::from(**v);
                sum > share * total
            };
            *sorted.iter().find(exceeds).unwrap()
        };
        let found = Quartiles::of(&values).unwrap();
        assert_eq!(found.weighted, [0.25, 0.5, 0.75].map(literal));
        assert_eq!((found.min, found.max), (sorted[0], sorted[4999]));
        let near_one = [1.0, f32::NAN, 1.0, 0.999_999, 0.0];
        let found = Quartiles::of(&near_one).unwrap();
        assert_eq!((found.min, found.max, found.weighted), (0.0, 1.0, [0.999_999, 1.0, 1.0]));
    }

    #[test]
    fn equal_pictures_have_none_but_0() {
        let found = Quartiles::of(&[0.0, 0.0]).unwrap();
        assert_eq!(found, Quartiles { min: 0.0, max: 0.0, weighted: [0.0; 3] });
        assert_eq!(Quartiles::of(&[f32::NAN]), None);
    }
}
