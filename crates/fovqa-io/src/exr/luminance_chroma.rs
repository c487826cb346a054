//! Converts luminance and chroma to colour.
//!
//! RY = (R - Y) / Y, BY = (B - Y) / Y, and Y is the luminance of R, G and B in the primaries of the
//! file (OpenEXR, "Technical Introduction to OpenEXR", section "Luminance/Chroma Images"). So R =
//! (RY + 1) Y, B = (BY + 1) Y, G = (Y - w_r R - w_b B) / w_g.

/// Converts three consecutive planes Y, RY and BY to R, G and B. `weights` are the luminance
/// weights of the primaries.
pub(super) fn to_rgb(mut values: Vec<f32>, weights: [f64; 3]) -> Vec<f32> {
    let plane = values.len() / 3;
    let (first, rest) = values.split_at_mut(plane);
    let (second, third) = rest.split_at_mut(plane);
    let [red_weight, green_weight, blue_weight] = weights;
    for ((first, second), third) in first.iter_mut().zip(second).zip(third) {
        let luminance = f64::from(*first);
        let red = (f64::from(*second) + 1.0) * luminance;
        let blue = (f64::from(*third) + 1.0) * luminance;
        let green = (luminance - red_weight * red - blue_weight * blue) / green_weight;
        (*first, *second, *third) = (red as f32, green as f32, blue as f32);
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_come_back() {
        let weights = [0.25, 0.5, 0.25];
        let colours = [[0.5, 0.25, 1.0], [0.0, 0.0, 0.0], [2.0, 2.0, 2.0]];
        let mut planes = [const { Vec::new() }; 3];
        for [r, g, b] in colours {
            let y: f32 = 0.25 * r + 0.5 * g + 0.25 * b;
            let chroma = |c: f32| if y == 0.0 { 0.0 } else { (c - y) / y };
            for (plane, value) in planes.iter_mut().zip([y, chroma(r), chroma(b)]) {
                plane.push(value);
            }
        }
        let expected: Vec<f32> = (0..3).flat_map(|c| colours.map(|colour| colour[c])).collect();
        assert_eq!(to_rgb(planes.concat(), weights), expected);
    }
}
