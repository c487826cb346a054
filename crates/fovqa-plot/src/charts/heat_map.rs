//! Heat maps: a value for every pixel or block of pixels of a frame as a colour, rings of equal
//! eccentricity and the gaze over it, and the colours' values in a strip below. Away from the lines,
//! each pixel has exactly the colour of its value.

use std::sync::Arc;

use png::{BitDepth, ColorType, Compression, Encoder, EncodingError, Filter};
use rayon::prelude::*;

use crate::charts::heat_overlay::{HeatOverlay, HeatRing};
use crate::charts::heat_scale::{HeatColours, HeatScale};
use crate::charts::heat_strip::HeatStrip;
use crate::error::PlotError;

/// The width of a frame at which text has its smallest size. Wider frames have larger text, so that
/// it can be read when the picture is printed in a column.
const UNIT_WIDTH_PX: f64 = 480.0;

/// The largest width of a frame that counts, relative to its height.
const MOST_RATIO: f64 = 1.6;

/// The smallest width of a picture. Narrower frames have white beside them.
const LEAST_WIDTH_PX: usize = 160;

/// The longest side of a frame. Positions in a drawing are tenths of a pixel in 32 bits, and a
/// float still tells all of them apart.
const LARGEST_SIDE_PX: usize = 1_000_000;

/// The number of rows that are coloured together.
const BLOCK_ROWS: usize = 64;

/// What a heat map looks like, apart from its values.
#[derive(Debug, Clone, PartialEq)]
pub struct HeatMapLayout {
    /// Width and height of the frame in pixels.
    pub size: (usize, usize),
    /// Side of the block of pixels that each value describes, from 1. Pixels beyond the last whole
    /// block have no value.
    pub block: usize,
    /// What the values are, with the unit.
    pub label: String,
    /// What pixels of the brightest colour are, in a word such as worse.
    pub bright: &'static str,
    /// The scale of the colours.
    pub scale: HeatScale,
    /// Rings of equal eccentricity.
    pub rings: Vec<HeatRing>,
    /// The gaze in pixels of the frame.
    pub gaze: Option<[f64; 2]>,
}

/// A sheet for heat maps that differ only in their values. Its lines and its text are drawn once.
#[derive(Debug, Clone)]
pub struct HeatMap {
    size: (usize, usize),
    block: usize,
    colours: HeatColours,
    overlay: Arc<HeatOverlay>,
    strip: HeatStrip,
}

impl HeatMap {
    /// A sheet.
    ///
    /// # Errors
    /// When the frame has no pixels or more in a side than a drawing can have, or the drawing fails.
    pub fn new(layout: &HeatMapLayout) -> Result<Self, PlotError> {
        let unit = unit(layout.size)?;
        let overlay = HeatOverlay::new(layout.size, &layout.rings, layout.gaze, unit)?;
        Self::over(layout, Arc::new(overlay), unit)
    }

    /// A sheet for another kind of values of the same frames, with the rings and the gaze of this
    /// one; the size, the rings and the gaze of the layout do not matter.
    ///
    /// # Errors
    /// When the drawing fails.
    pub fn with_rings(&self, layout: &HeatMapLayout) -> Result<Self, PlotError> {
        let layout = HeatMapLayout { size: self.size, ..layout.clone() };
        Self::over(&layout, Arc::clone(&self.overlay), unit(self.size)?)
    }

    /// Width and height of the frame in pixels.
    pub fn frame_size(&self) -> (usize, usize) {
        self.size
    }

    fn over(
        layout: &HeatMapLayout,
        overlay: Arc<HeatOverlay>,
        unit: f64,
    ) -> Result<Self, PlotError> {
        let HeatMapLayout { size, block, ref label, bright, scale, .. } = *layout;
        let strip = HeatStrip::new(size.0.max(LEAST_WIDTH_PX), label, bright, scale, unit)?;
        let colours = HeatColours::new(scale);
        Ok(Self { size, block: block.max(1), colours, overlay, strip })
    }

    /// Width and height of the picture in pixels: the frame, with the strip below it.
    pub fn picture_size(&self) -> (usize, usize) {
        (self.size.0.max(LEAST_WIDTH_PX), self.size.1 + self.strip.height)
    }

    /// The picture as a PNG, for values row by row; NaN where there is no value. The bytes do not
    /// depend on the number of threads.
    ///
    /// # Errors
    /// When there is not one value per block of the frame, or the encoder fails.
    pub fn png(&self, values: &[f32]) -> Result<Vec<u8>, PlotError> {
        let codes = self.codes(values)?;
        encode(self.picture_size(), &codes).map_err(|error| PlotError::Encode(Box::new(error)))
    }

    /// Red, green and blue codes of the picture.
    fn codes(&self, values: &[f32]) -> Result<Vec<u8>, PlotError> {
        let (width, height) = self.size;
        let (columns, rows) = (width / self.block, height / self.block);
        if values.len() != columns * rows {
            let (panel, found) = ("heat map".to_owned(), values.len());
            return Err(PlotError::Cells { panel, found, columns, rows });
        }
        let (picture_width, picture_height) = self.picture_size();
        let row_bytes = 3 * picture_width;
        let mut codes = vec![255; row_bytes * picture_height];
        let (picture, strip) = codes.split_at_mut(row_bytes * height);
        picture.par_chunks_mut(BLOCK_ROWS * row_bytes).enumerate().for_each(
            |(block, block_rows)| {
                for (i, row) in block_rows.chunks_exact_mut(row_bytes).enumerate() {
                    let y = block * BLOCK_ROWS + i;
                    let start = y / self.block * columns;
                    // No values are left for the rows beyond the last whole block.
                    let of_row = values.get(start..start + columns).unwrap_or_default();
                    self.colours.fill(of_row, self.block, &mut row[..3 * width]);
                    self.overlay.blend(y, row);
                }
            },
        );
        strip.copy_from_slice(&self.strip.rgb);
        Ok(codes)
    }
}

/// The factor of text and lines, from 1.
fn unit((width, height): (usize, usize)) -> Result<f64, PlotError> {
    let sides = 1..=LARGEST_SIDE_PX;
    if !sides.contains(&width) || !sides.contains(&height) {
        return Err(PlotError::Frame { width, height, most: LARGEST_SIDE_PX });
    }
    let width = (width as f64).min(height as f64 * MOST_RATIO);
    Ok((width / UNIT_WIDTH_PX).max(1.0))
}

fn encode((width, height): (usize, usize), codes: &[u8]) -> Result<Vec<u8>, EncodingError> {
    let mut png = Vec::new();
    let mut encoder = Encoder::new(&mut png, width as u32, height as u32);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    // There is one for every frame and method: time matters more than the last bytes.
    encoder.set_compression(Compression::Fast);
    // Trying all filters on each row would take longer than everything else.
    encoder.set_filter(Filter::Up);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(codes)?;
    writer.finish()?;
    Ok(png)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::canvas::colour_map::{MAP_NO_VALUE, map_palette};

    fn layout(size: (usize, usize)) -> HeatMapLayout {
        HeatMapLayout {
            size,
            block: 1,
            bright: "worse",
            label: "SSIM".to_owned(),
            scale: HeatScale { none: 1.0, most: 0.0, log: false },
            rings: Vec::new(),
            gaze: None,
        }
    }

    /// A ring that is a square.
    fn square(centre: f64, half: f64) -> HeatRing {
        let (low, high) = (centre - half, centre + half);
        let line = vec![
            [high, centre],
            [high, high],
            [low, high],
            [low, low],
            [high, low],
            [high, centre],
        ];
        HeatRing { label: "10°".to_owned(), lines: vec![line] }
    }

    fn pixel(sheet: &HeatMap, codes: &[u8], (x, y): (usize, usize)) -> [u8; 3] {
        let at = 3 * (y * sheet.picture_size().0 + x);
        [codes[at], codes[at + 1], codes[at + 2]]
    }

    fn threads<T: Send>(count: usize, work: impl FnOnce() -> T + Send) -> T {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build().unwrap();
        pool.install(work)
    }

    #[test]
    fn pixels_have_their_colours_and_lines_are_over_them() {
        let size = (300, 200);
        let (rings, gaze) = (vec![square(100.5, 60.0)], Some([100.5, 100.5]));
        let sheet = HeatMap::new(&HeatMapLayout { rings, gaze, ..layout(size) }).unwrap();
        let values: Vec<f32> = (0..size.0 * size.1).map(|i| (i % 256) as f32 / 255.0).collect();
        let codes = sheet.codes(&values).unwrap();
        let palette = map_palette();
        let mut covered = 0;
        for (x, y) in (0..size.1).flat_map(|y| (0..size.0).map(move |x| (x, y))) {
            let of_value = palette[255 - (y * size.0 + x) % 256];
            if sheet.overlay.covers(x, y) {
                covered += 1;
            } else {
                assert_eq!(pixel(&sheet, &codes, (x, y)), of_value, "{x} {y}");
            }
        }
        // The lines are about 3 pixels wide, the label has about 30 x 12 pixels, the cross 16 x 3.
        assert!((1500..3500).contains(&covered), "{covered}");
        // A light line with dark edges, on the brightest and on the darkest colour.
        for value in [0.0, 1.0] {
            let codes = sheet.codes(&vec![value; size.0 * size.1]).unwrap();
            let luma = |x: usize| {
                pixel(&sheet, &codes, (x, 70)).iter().map(|c| i32::from(*c)).sum::<i32>()
            };
            let row: Vec<i32> = (36..=43).map(luma).collect();
            let (dark, light) = (row.iter().min().unwrap(), row.iter().max().unwrap());
            assert!(*light - *dark > 250, "{row:?} at {value}");
            let cross = pixel(&sheet, &codes, (100, 100));
            assert!(cross.iter().all(|code| *code > 200), "{cross:?}");
        }
    }

    #[test]
    fn the_strip_has_a_bar_with_every_colour_and_room_for_text() {
        for width in [160, 400, 1440] {
            let sheet = HeatMap::new(&layout((width, width))).unwrap();
            let (picture_width, height) = sheet.picture_size();
            let unit = (width as f64 / UNIT_WIDTH_PX).max(1.0);
            assert_eq!(picture_width, width);
            let strip = (height - width) as f64;
            // A line of title, the bar, and a line of labels.
            assert!((45.0 * unit..65.0 * unit).contains(&strip), "{strip} for {width}");
            let codes = sheet.codes(&vec![1.0; width * width]).unwrap();
            let row = |y: usize| (0..width).map(move |x| (x, y));
            let palette = map_palette();
            let has = |y: usize, colours: &[[u8; 3]]| {
                row(y).any(|at| colours.contains(&pixel(&sheet, &codes, at)))
            };
            let bar = |y: &usize| has(*y, &palette[1..4]) && has(*y, &palette[252..]);
            let bar = (width..height).filter(bar).count();
            assert!(bar as f64 >= 9.0 * unit, "{bar} rows of {width}");
            let dark =
                |y: usize| row(y).any(|at| pixel(&sheet, &codes, at).iter().all(|c| *c < 110));
            let text = (width..height).filter(|y| dark(*y)).count();
            assert!(text as f64 > 25.0 * unit, "{text} rows of {width}");
        }
    }

    #[test]
    fn long_titles_wrap_and_narrow_frames_have_white_beside_them() {
        let label = "Gradient magnitude similarity".to_owned();
        let sheet = HeatMap::new(&HeatMapLayout { label, ..layout((20, 10)) }).unwrap();
        let (width, height) = sheet.picture_size();
        assert!(width == LEAST_WIDTH_PX && height > 70, "{width} {height}");
        let codes = sheet.codes(&[0.0; 200]).unwrap();
        assert_eq!(pixel(&sheet, &codes, (19, 9)), map_palette()[255]);
        assert_eq!(pixel(&sheet, &codes, (20, 9)), [255; 3]);
    }

    #[test]
    fn blocks_are_enlarged_and_the_rest_has_no_value() {
        let sheet = HeatMap::new(&HeatMapLayout { block: 2, ..layout((161, 5)) }).unwrap();
        let values: Vec<f32> = (0..160).map(|i| if i % 3 == 0 { 0.0 } else { 1.0 }).collect();
        let codes = sheet.codes(&values).unwrap();
        for (x, y) in (0..5).flat_map(|y| (0..161).map(move |x| (x, y))) {
            let want = match (x / 2, y / 2) {
                (80, _) | (_, 2) => MAP_NO_VALUE,
                (column, row) if (row * 80 + column) % 3 == 0 => map_palette()[255],
                _ => map_palette()[0],
            };
            assert_eq!(pixel(&sheet, &codes, (x, y)), want, "{x} {y}");
        }
        assert!(sheet.codes(&values[1..]).is_err(), "one value is missing");
        assert!(matches!(HeatMap::new(&layout((0, 5))), Err(PlotError::Frame { .. })));
    }

    #[test]
    fn the_bytes_do_not_depend_on_threads() {
        let size = (500, 700);
        let rings = vec![square(250.0, 200.3), square(250.0, 340.0)];
        let layout = HeatMapLayout { rings, gaze: Some([250.0, 260.0]), ..layout(size) };
        let values: Vec<f32> = (0..size.0 * size.1).map(|i| (i % 977) as f32 / 977.0).collect();
        let made = || HeatMap::new(&layout).and_then(|sheet| sheet.png(&values)).unwrap();
        let [one, four] = [1, 4].map(|count| threads(count, made));
        assert!(one == four && one.starts_with(b"\x89PNG"));
        // The rings of another sheet are the same.
        let other = HeatMapLayout { label: "Other".to_owned(), block: 2, ..layout.clone() };
        let plain = HeatMapLayout { rings: Vec::new(), gaze: None, ..other.clone() };
        let shared = HeatMap::new(&layout).and_then(|sheet| sheet.with_rings(&plain)).unwrap();
        let values = vec![0.5; 250 * 350];
        assert_eq!(
            shared.png(&values).unwrap(),
            HeatMap::new(&other).unwrap().png(&values).unwrap()
        );
    }

    #[test]
    fn the_png_is_the_picture() {
        let sheet = HeatMap::new(&layout((200, 30))).unwrap();
        let values: Vec<f32> = (0..6000).map(|i| i as f32 / 6000.0).collect();
        let bytes = sheet.png(&values).unwrap();
        let picture = resvg::tiny_skia::Pixmap::decode_png(&bytes).unwrap();
        assert_eq!((picture.width() as usize, picture.height() as usize), sheet.picture_size());
        let codes: Vec<u8> =
            picture.pixels().iter().flat_map(|p| [p.red(), p.green(), p.blue()]).collect();
        assert!(codes == sheet.codes(&values).unwrap());
    }
}
