//! From linear red, green and blue to luminance: the Y row of each colour space's matrix to XYZ.

/// A colour space of the files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ColorSpace(usize);

/// The names, and the luminance of red, green and blue. They are those of FovVideoVDP 1.2, except
/// for DCI-P3 (computed from its primaries and D65) and BT.2020 (ITU-R BT.2020), which are wrong
/// there.
const SPACES: [(&str, [f64; 3]); 18] = [
    ("srgb", [0.212_672_9, 0.715_152_2, 0.072_175_0]),
    ("adobe_rgb", [0.297_376_9, 0.627_349_1, 0.075_274_1]),
    ("apple_rgb", [0.244_652_5, 0.672_028_3, 0.083_319_2]),
    ("best_rgb", [0.228_456_9, 0.737_352_3, 0.034_190_8]),
    ("beta_rgb", [0.303_272_6, 0.663_786_1, 0.032_941_3]),
    ("bruce_rgb", [0.241_011_5, 0.683_547_5, 0.075_441_0]),
    ("cie_rgb", [0.176_204_4, 0.812_984_7, 0.010_810_9]),
    ("colormatch_rgb", [0.274_884_0, 0.658_131_5, 0.066_984_5]),
    ("don_rgb_4", [0.278_349_6, 0.687_970_2, 0.033_680_2]),
    ("ekta_space_ps5", [0.260_628_6, 0.734_946_5, 0.004_424_9]),
    ("ntsc_rgb", [0.298_916_4, 0.586_599_0, 0.114_484_5]),
    ("pal_rgb", [0.222_037_9, 0.706_638_4, 0.071_323_6]),
    ("prophoto_rgb", [0.288_040_2, 0.711_874_1, 0.000_085_7]),
    ("smpte_c_rgb", [0.212_413_2, 0.701_043_7, 0.086_543_2]),
    ("wide_gamut_rgb", [0.258_187_4, 0.724_937_8, 0.016_874_8]),
    ("dci_p3", [0.2290, 0.6917, 0.0793]),
    ("bt_2020", [0.2627, 0.6780, 0.0593]),
    ("bt_2020_fovvideovdp", [0.292_030_0, 0.796_520_0, 0.045_880_0]),
];

impl ColorSpace {
    /// All names.
    pub const NAMES: [&'static str; SPACES.len()] = {
        let mut names = [""; SPACES.len()];
        let mut index = 0;
        while index < names.len() {
            names[index] = SPACES[index].0;
            index += 1;
        }
        names
    };

    /// The colour space of a name.
    pub fn find(name: &str) -> Option<Self> {
        SPACES.iter().position(|space| space.0 == name).map(Self)
    }

    /// The luminance of linear red, green and blue.
    pub fn luminance_weights(self) -> [f64; 3] {
        SPACES[self.0].1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_is_one_but_where_it_is_known_to_be_wrong() {
        for name in ColorSpace::NAMES {
            let sum: f64 = ColorSpace::find(name).unwrap().luminance_weights().iter().sum();
            let white = if name == "bt_2020_fovvideovdp" { 1.134_43 } else { 1.0 };
            assert!((sum - white).abs() < 2e-6, "{name}: {sum}");
        }
        assert_eq!(ColorSpace::find("srgb"), Some(ColorSpace::default()));
        assert_eq!(ColorSpace::find("rgb"), None);
    }
}
