//! The first line of a video: size, frame rate, colour and other declarations.

use super::colour::Colour;
use super::options::CodeRange;

/// The first bytes of a video.
pub(super) const MAGIC: &[u8] = b"YUV4MPEG2";

/// The largest length of a line in bytes, including its end: of the header, and in front of a
/// frame.
pub(super) const MAX_LINE: usize = 4096;

/// The content of the first line.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Header {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) colour: Colour,
    /// The range that XCOLORRANGE declares.
    pub(super) range: Option<CodeRange>,
    /// Frames per second, if known.
    pub(super) fps: Option<f64>,
    /// Ratio of a pixel's width to its height; 1 if it is not known.
    pub(super) pixel_aspect: f32,
}

/// The reason why a header is refused, and how to correct it.
pub(super) type Refused = (String, &'static str);

const REWRITE: &str = "write it again, such as with ffmpeg -i FILE -f yuv4mpegpipe";

impl Header {
    /// Reads the first line, without its end. `megapixels` is the largest allowed size of a frame.
    pub(super) fn parse(line: &[u8], megapixels: u64) -> Result<Self, Refused> {
        let damaged = |what: String| (what, REWRITE);
        if line.split(|byte| *byte == b' ').next() != Some(MAGIC) {
            return Err(damaged("it does not begin with YUV4MPEG2".to_owned()));
        }
        let Ok(line) = str::from_utf8(line) else {
            return Err(damaged("its header is not text".to_owned()));
        };
        let fields = line.split(' ').skip(1).filter(|field| !field.is_empty());
        let mut seen = Fields::default();
        for field in fields {
            let (key, value) = field.split_at(field.chars().next().map_or(0, char::len_utf8));
            let place = match key {
                "W" => &mut seen.width,
                "H" => &mut seen.height,
                "C" => &mut seen.colour,
                "F" => &mut seen.rate,
                "I" => &mut seen.interlacing,
                "A" => &mut seen.aspect,
                "X" => match value.strip_prefix("COLORRANGE=") {
                    Some(range) => {
                        check_new(seen.range, "XCOLORRANGE")?;
                        seen.range = Some(range);
                        continue;
                    }
                    // Comments of other programs are ignored.
                    None => continue,
                },
                _ => {
                    return Err(damaged(format!(
                        "its header has {field:?}, which is not a field of y4m"
                    )));
                }
            };
            let before = place.replace(value);
            check_new(before, key)?;
        }
        seen.header(megapixels)
    }

    /// The number of samples of Y', and of each of Cb and Cr.
    pub(super) fn samples(&self) -> [usize; 2] {
        let chroma = self.chroma_size().map_or(0, |(width, height)| width * height);
        [self.width * self.height, chroma]
    }

    /// Width and height of the planes of Cb and Cr.
    pub(super) fn chroma_size(&self) -> Option<(usize, usize)> {
        let chroma = self.colour.chroma?;
        Some((chroma.across.count(self.width), chroma.down.count(self.height)))
    }

    /// Bytes of a frame, without the line in front of it.
    pub(super) fn frame_bytes(&self) -> usize {
        let [luma, chroma] = self.samples();
        (luma + 2 * chroma) * self.colour.sample_bytes()
    }
}

/// The fields of a header, before they are parsed.
#[derive(Debug, Default)]
struct Fields<'a> {
    width: Option<&'a str>,
    height: Option<&'a str>,
    colour: Option<&'a str>,
    rate: Option<&'a str>,
    interlacing: Option<&'a str>,
    aspect: Option<&'a str>,
    range: Option<&'a str>,
}

impl Fields<'_> {
    fn header(&self, megapixels: u64) -> Result<Header, Refused> {
        let (width, height) = (side(self.width, 'W')?, side(self.height, 'H')?);
        if width
            .checked_mul(height)
            .is_none_or(|pixels| pixels > megapixels.saturating_mul(1_000_000))
        {
            let message = format!(
                "it declares {width}x{height} pixels, more than the limit of {megapixels} megapixels"
            );
            return Err((message, "raise {max_megapixels} if the size is correct"));
        }
        let too_large = || ("a frame does not fit into memory".to_owned(), REWRITE);
        let width = usize::try_from(width).map_err(|_| too_large())?;
        let height = usize::try_from(height).map_err(|_| too_large())?;
        let convert =
            "convert it to one of these, such as with ffmpeg's -pix_fmt yuv444p12 -strict -1";
        let colour = match self.colour {
            None => Colour::untagged(),
            Some(tag) => Colour::of_tag(tag).map_err(|message| (message, convert))?,
        };
        match self.interlacing {
            None | Some("" | "p" | "?") => {}
            Some("t" | "b" | "m") => {
                let message = "it is interlaced: each frame contains two points in time".to_owned();
                return Err((message, "deinterlace it first, such as with ffmpeg's -vf bwdif"));
            }
            Some(other) => {
                let message =
                    format!("its interlacing is {:?}, which is not p, t, b or m", short(other));
                return Err((message, REWRITE));
            }
        }
        let range = match self.range {
            None => None,
            Some("LIMITED") => Some(CodeRange::Limited),
            Some("FULL") => Some(CodeRange::Full),
            Some(other) => {
                let message = format!(
                    "its XCOLORRANGE is {:?}, which is neither LIMITED nor FULL",
                    short(other)
                );
                return Err((message, "write it again with one of them"));
            }
        };
        Ok(Header {
            width,
            height,
            colour,
            range,
            fps: ratio(self.rate, 'F')?,
            pixel_aspect: ratio(self.aspect, 'A')?.map_or(1.0, |aspect| aspect as f32),
        })
    }
}

/// Refuses a field that has occurred before.
fn check_new(before: Option<&str>, key: &str) -> Result<(), Refused> {
    match before {
        None => Ok(()),
        Some(value) => {
            let message = format!("its header has {key} twice, {value:.32} first");
            Err((message, REWRITE))
        }
    }
}

fn short(value: &str) -> String {
    value.chars().take(32).collect()
}

fn side(value: Option<&str>, key: char) -> Result<u64, Refused> {
    let what = if key == 'W' { "width" } else { "height" };
    let Some(value) = value else {
        return Err((format!("its header has no {what} ({key})"), REWRITE));
    };
    match digits(value) {
        Some(pixels) if pixels > 0 => Ok(pixels),
        _ => Err((
            format!("its {what} is {:?}, which is not a number of pixels", short(value)),
            REWRITE,
        )),
    }
}

/// A number of digits only, without a sign.
fn digits(text: &str) -> Option<u64> {
    text.bytes().all(|byte| byte.is_ascii_digit()).then(|| text.parse().ok()).flatten()
}

/// A ratio of whole numbers; `0:0` means that it is not known.
fn ratio(value: Option<&str>, key: char) -> Result<Option<f64>, Refused> {
    let Some(value) = value else { return Ok(None) };
    let parts =
        value.split_once(':').and_then(|(over, under)| Some((digits(over)?, digits(under)?)));
    match parts {
        Some((0, 0)) => Ok(None),
        Some((over, under)) if over > 0 && under > 0 => Ok(Some(over as f64 / under as f64)),
        _ => {
            let what = if key == 'F' { "frame rate" } else { "pixel aspect" };
            let message = format!(
                "its {what} is {:?}, which is not a ratio such as {key}30000:1001",
                short(value)
            );
            Err((message, REWRITE))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(line: &str) -> Result<Header, String> {
        Header::parse(line.as_bytes(), 256).map_err(|(message, _)| message)
    }

    #[test]
    fn what_ffmpeg_writes() {
        let line =
            "YUV4MPEG2 W641 H361 F30000:1001 Ip A4:3 C420mpeg2 XYSCSS=420MPEG2 XCOLORRANGE=FULL";
        let header = parse(line).unwrap();
        assert_eq!((header.width, header.height), (641, 361));
        assert_eq!(header.fps, Some(30000.0 / 1001.0));
        assert_eq!(header.range, Some(CodeRange::Full));
        assert!((header.pixel_aspect - 4.0 / 3.0).abs() < 1e-6);
        assert_eq!(header.chroma_size(), Some((321, 181)));
        assert_eq!(header.frame_bytes(), 641 * 361 + 2 * 321 * 181);
        let header = parse("YUV4MPEG2 H2 W3 C444p12 F0:0 A0:0 I?").unwrap();
        assert_eq!((header.fps, header.pixel_aspect.to_bits()), (None, 1f32.to_bits()));
        assert_eq!(header.frame_bytes(), 3 * 2 * 3 * 2);
        let header = parse("YUV4MPEG2 W3 H2").unwrap();
        assert_eq!((header.colour, header.range, header.fps), (Colour::untagged(), None, None));
    }

    #[test]
    fn what_is_wrong_is_said() {
        for (line, said) in [
            ("YUV4MPEG W2 H2", "does not begin with YUV4MPEG2"),
            ("YUV4MPEG2 H2", "no width (W)"),
            ("YUV4MPEG2 W2", "no height (H)"),
            ("YUV4MPEG2 W0 H2", "width is \"0\", which is not a number of pixels"),
            ("YUV4MPEG2 W+2 H2", "width is \"+2\""),
            ("YUV4MPEG2 W2 H99999999999999999999", "height is \"99999999999999999999\""),
            (
                "YUV4MPEG2 W16001 H16000",
                "16001x16000 pixels, more than the limit of 256 megapixels",
            ),
            ("YUV4MPEG2 W4294967296 H4294967296", "more than the limit"),
            ("YUV4MPEG2 W2 H2 W3", "has W twice, 2 first"),
            ("YUV4MPEG2 W2 H2 XCOLORRANGE=FULL XCOLORRANGE=LIMITED", "has XCOLORRANGE twice"),
            ("YUV4MPEG2 W2 H2 XCOLORRANGE=TV", "XCOLORRANGE is \"TV\""),
            ("YUV4MPEG2 W2 H2 It", "it is interlaced"),
            ("YUV4MPEG2 W2 H2 Im", "it is interlaced"),
            ("YUV4MPEG2 W2 H2 Ix", "interlacing is \"x\""),
            ("YUV4MPEG2 W2 H2 F30", "frame rate is \"30\""),
            ("YUV4MPEG2 W2 H2 F30:0", "frame rate is \"30:0\""),
            ("YUV4MPEG2 W2 H2 A1:-1", "pixel aspect is \"1:-1\""),
            ("YUV4MPEG2 W2 H2 C411", "colour tag is C411"),
            ("YUV4MPEG2 W2 H2 Q1", "\"Q1\", which is not a field of y4m"),
        ] {
            let error = parse(line).unwrap_err();
            assert!(error.contains(said), "{line}: {error}");
        }
    }
}
