//! PQ (SMPTE ST 2084, Rec. ITU-R BT.2100): encoded absolute luminance.

/// Luminance of code 1, in cd/m².
pub const PEAK_CD_M2: f64 = 10_000.0;

const M1: f64 = 2610.0 / 16384.0;
const M2: f64 = 2523.0 / 4096.0 * 128.0;
const C1: f64 = 3424.0 / 4096.0;
const C2: f64 = 2413.0 / 4096.0 * 32.0;
const C3: f64 = 2392.0 / 4096.0 * 32.0;

/// Converts a code in `[0, 1]` to luminance in cd/m², 0 to 10,000 (BT.2100, Table 4).
pub fn decode(code: f64) -> f64 {
    let power = libm::pow(code, 1.0 / M2);
    let linear = (power - C1).max(0.0) / (C2 - C3 * power);
    PEAK_CD_M2 * libm::pow(linear, 1.0 / M1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_values() {
        // BT.2408: 100 cd/m² is the code 0.508, 1,000 cd/m² 0.752.
        assert!(decode(0.0).abs() < 1e-12);
        assert!((decode(0.508_078_4) - 100.0).abs() < 0.01, "{}", decode(0.508_078_4));
        assert!((decode(0.751_827_1) - 1000.0).abs() < 0.1, "{}", decode(0.751_827_1));
        assert!((decode(1.0) - PEAK_CD_M2).abs() < 1e-6);
    }
}
