//! What surfaces look like: colour, gloss and grain as functions of position.

use crate::hall::{END, HALL, SIDE};
use crate::noise::{octaves, random, rise, smooth};
use crate::text;
use crate::vec3::{Vec3, gray, vec3};

/// A surface at a point.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Surface {
    /// The share of light that it scatters.
    pub(crate) colour: Vec3,
    /// The share of light that it mirrors when seen straight on; `None` if it does not mirror.
    pub(crate) mirror: Option<Vec3>,
}

const fn matt(colour: Vec3) -> Surface {
    Surface { colour, mirror: None }
}

const fn glossy(colour: Vec3, mirror: Vec3) -> Surface {
    Surface { colour, mirror: Some(mirror) }
}

/// A material of a shape in the hall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Material {
    Brass,
    Chrome,
    Gold,
    Black,
    Red,
    Stone,
    Clay,
    Wood,
    /// A leaf with its own shade, from 0 to 1.
    Leaf(f64),
    /// A picture on the right wall: which, its centre along z and upwards, and its half sides.
    Picture {
        which: usize,
        centre: [f64; 2],
        half: [f64; 2],
    },
}

impl Material {
    pub(crate) fn surface(self, at: Vec3, normal: Vec3) -> Surface {
        match self {
            Self::Brass => glossy(vec3(0.42, 0.3, 0.1), vec3(0.45, 0.36, 0.18)),
            Self::Chrome => glossy(gray(0.02), vec3(0.86, 0.87, 0.88)),
            Self::Gold => glossy(vec3(0.12, 0.08, 0.02), vec3(0.85, 0.64, 0.27)),
            Self::Black => glossy(gray(0.015), gray(0.05)),
            Self::Red => glossy(vec3(0.62, 0.05, 0.04), gray(0.05)),
            Self::Stone => {
                let vein = octaves(at.x * 6.0 + at.y * 3.0, at.z * 6.0 - at.y * 4.0, 4, 31);
                let dust = smooth(at.x * 400.0 + at.z * 90.0, at.y * 400.0, 32);
                matt(gray(0.62 + 0.16 * rise(0.4, 0.7, vein) + 0.05 * dust))
            }
            Self::Clay => {
                matt(vec3(0.45, 0.2, 0.12) * (0.8 + 0.4 * smooth(at.y * 30.0, at.x * 9.0, 33)))
            }
            Self::Wood => {
                let grain = octaves(at.z * 5.0, (at.x + at.y) * 90.0, 3, 34);
                matt(vec3(0.3, 0.17, 0.08) * (0.6 + 0.8 * grain))
            }
            Self::Leaf(shade) => matt(vec3(0.1, 0.3, 0.07).mix(vec3(0.32, 0.48, 0.12), shade)),
            Self::Picture { which, centre, half } => {
                let frame = glossy(vec3(0.3, 0.2, 0.07), gray(0.06));
                if normal.x > -0.5 {
                    return frame;
                }
                // From the front, z runs to the left.
                let (u, v) = ((centre[0] - at.z) / half[0], (centre[1] - at.y) / half[1]);
                if u.abs() > 0.9 || v.abs() > 0.9 {
                    return frame;
                }
                matt(picture(which, u / 0.9, v / 0.9, half[0] / half[1]))
            }
        }
    }
}

/// Lines of the texts on the wall, each smaller than the one before it.
const LINES: [&str; 10] = [
    "FOVEA",
    "THE EYE SEES LITTLE",
    "OF WHAT IT DOES NOT LOOK AT",
    "ACUITY FALLS WITH ECCENTRICITY, 1 OVER 1 PLUS E OVER E2",
    "A CONE IN THE FOVEA IS HALF AN ARC MINUTE WIDE",
    "TEN DEGREES AWAY ONE SAMPLE OUT OF TWENTY WOULD DO",
    "THESE LINES ARE TOO SMALL TO BE READ FROM THE DOOR",
    "WHOEVER READS THIS STANDS CLOSE OR HAS A LONG LENS",
    "0123456789 ABCDEFGHIJKLMNOPQRSTUVWXYZ 0123456789 ABCDEFG",
    "THE QUICK BROWN FOX JUMPS OVER THE LAZY DOG 1 2 3 4 5 6 7 8 9",
];

/// A picture: u from left to right and v from top to bottom, each from -1 to 1.
fn picture(which: usize, u: f64, v: f64, aspect: f64) -> Vec3 {
    let paper = vec3(0.82, 0.8, 0.74);
    let ink = gray(0.03);
    let on = |inked: bool| if inked { ink } else { paper };
    let (x, y) = (u * aspect, v);
    match which % 6 {
        // Text of several sizes.
        0 => {
            let mut top = -0.88;
            for line in LINES {
                let height = (1.84 * aspect / text::width(line)).min(0.3);
                if top <= y && y < top + height {
                    return on(text::is_inked(
                        line,
                        (x + 0.92 * aspect) / height,
                        (y - top) / height,
                    ));
                }
                top += height * 1.45;
            }
            paper
        }
        // Rings that become finer outwards.
        1 => {
            let square = x * x + y * y;
            gray(0.42 + 0.38 * libm::cos(90.0 * square))
        }
        // Bars, each row finer.
        2 => {
            let row = ((v + 1.0) * 3.5).floor();
            let width = 0.16 / libm::exp2(row * 0.75);
            on((u / width).floor() as i64 % 2 == 0)
        }
        // A landscape.
        3 => {
            let hills = 0.1 + 0.5 * octaves(u * 2.0 + 5.0, 1.0, 4, 41);
            let field = octaves(x * 14.0, y * 40.0, 4, 42);
            let sky = vec3(0.35, 0.5, 0.75).mix(vec3(0.85, 0.65, 0.5), rise(-0.8, 0.4, v));
            let land = vec3(0.2, 0.24, 0.08).mix(vec3(0.62, 0.5, 0.16), field);
            if v > hills {
                land
            } else {
                sky.mix(gray(0.9), 0.5 * rise(0.5, 0.8, octaves(u * 3.0, v * 7.0, 4, 43)))
            }
        }
        // A star of 36 spokes.
        4 => {
            let turn = libm::atan2(y, x) / (2.0 * std::f64::consts::PI) + 0.5;
            let inked = (turn * 72.0).floor() as i64 % 2 == 0;
            if x * x + y * y < 0.9 { on(inked) } else { vec3(0.7, 0.16, 0.1) }
        }
        // Coloured squares, some with a fine pattern.
        _ => {
            let (i, j) = ((u * 3.5 + 50.0).floor() as i64, (v * 4.5 + 50.0).floor() as i64);
            let tone = |k: i64| 0.08 + 0.7 * random(i, j, k, 44);
            let colour = vec3(tone(0), tone(1), tone(2));
            if random(i, j, 3, 44) < 0.35
                && ((x * 90.0).floor() as i64 + (y * 90.0).floor() as i64) % 2 == 0
            {
                colour * 0.35
            } else {
                colour
            }
        }
    }
}

/// The surface of the hall at a point of its floor, ceiling or walls, by the inward normal.
pub(crate) fn hall(at: Vec3, normal: Vec3) -> Surface {
    if normal.y > 0.5 {
        floor(at.x, at.z)
    } else if normal.y < -0.5 {
        ceiling(at.x, at.z)
    } else if normal.x.abs() > 0.5 {
        let framed = normal.x > 0.0 && SIDE.iter().any(|window| window.frames(at.z, at.y));
        if framed { matt(gray(0.6)) } else { wall(at.z, at.y, if normal.x > 0.0 { 1 } else { 2 }) }
    } else {
        end_wall(at, normal)
    }
}

fn floor(x: f64, z: f64) -> Surface {
    const WIDTH: f64 = 0.13;
    const LENGTH: f64 = 1.7;
    // A runner of carpet in the aisle.
    if x.abs() < 0.95 {
        return carpet(x, z);
    }
    let row = (x / WIDTH).floor();
    let shift = LENGTH * random(row as i64, 0, 0, 51);
    let plank = ((z + shift) / LENGTH).floor();
    let (u, v) = (x / WIDTH - row, (z + shift) / LENGTH - plank);
    let gap = (u.min(1.0 - u) * WIDTH).min(v.min(1.0 - v) * LENGTH);
    let tone = random(row as i64, plank as i64, 1, 51);
    let seed = 60 + (tone * 1000.0) as u64;
    let grain = octaves(x * 55.0, z * 2.2 + tone * 40.0, 3, seed);
    let fibre = smooth(x * 420.0, z * 9.0, 52);
    let wood = vec3(0.3, 0.17, 0.085).mix(vec3(0.52, 0.33, 0.17), tone);
    let shade = (0.62 + 0.5 * grain + 0.16 * fibre) * (0.25 + 0.75 * rise(0.0008, 0.003, gap));
    glossy(wood * shade, gray(0.045))
}

fn carpet(x: f64, z: f64) -> Surface {
    let red = vec3(0.42, 0.045, 0.05);
    let gold = vec3(0.6, 0.42, 0.12);
    let knot = 0.72 + 0.5 * random((x * 330.0).floor() as i64, (z * 330.0).floor() as i64, 0, 53);
    let border = x.abs();
    let colour = if border > 0.9 {
        vec3(0.1, 0.02, 0.03)
    } else if border > 0.78 {
        // Triangles along the border.
        let place = (z * 9.0) - (z * 9.0).floor();
        if (place - 0.5).abs() * 2.0 < (border - 0.78) / 0.12 { gold } else { red }
    } else {
        // Diamonds of three sizes.
        let (u, v) = (x * 4.2, z * 4.2);
        let (i, j) = ((u + 0.5).floor(), (v + 0.5).floor());
        let ring = (u - i).abs() + (v - j).abs();
        if (0.3..0.38).contains(&ring) || ring < 0.12 {
            gold
        } else if ring < 0.3 {
            red * 0.55
        } else {
            red
        }
    };
    matt(colour * knot)
}

fn ceiling(x: f64, z: f64) -> Surface {
    let (u, v) = (x / 1.6 - (x / 1.6).floor(), z / 1.6 - (z / 1.6).floor());
    let edge = u.min(1.0 - u).min(v.min(1.0 - v)) * 1.6;
    // Coffers with stepped edges.
    let step = 0.55 + 0.13 * rise(0.1, 0.11, edge) + 0.08 * rise(0.22, 0.225, edge)
        - 0.1 * rise(0.3, 0.31, edge);
    let plaster = smooth(x * 70.0, z * 70.0, 54);
    matt(vec3(1.0, 0.97, 0.9) * (step + 0.04 * plaster))
}

fn wall(along: f64, up: f64, seed: u64) -> Surface {
    if up < 0.12 {
        return matt(vec3(0.16, 0.1, 0.06));
    }
    if up < 0.98 {
        // Panels of painted boards.
        let board = along / 0.11 - (along / 0.11).floor();
        let groove = rise(0.0, 0.06, board.min(1.0 - board));
        let paint = 0.85 + 0.3 * octaves(along * 8.0, up * 60.0, 3, 55 + seed);
        return matt(vec3(0.1, 0.19, 0.17) * (paint * (0.35 + 0.65 * groove)));
    }
    if up < 1.06 {
        return matt(vec3(0.5, 0.46, 0.38));
    }
    if up > 3.95 && up < 4.2 {
        // A frieze of fine bars.
        let dark = (along * 22.0).floor() as i64 % 2 == 0;
        let waves = (along * 5.5 + 2.0 * ((up - 3.95) * 12.0).floor()).floor() as i64 % 2 == 0;
        return matt(if dark == waves { vec3(0.62, 0.5, 0.22) } else { vec3(0.22, 0.1, 0.08) });
    }
    let plaster = octaves(along * 22.0, up * 22.0, 4, 56 + seed);
    let speck = smooth(along * 300.0, up * 300.0, 57 + seed);
    matt(vec3(0.68, 0.62, 0.52) * (0.84 + 0.2 * plaster + 0.1 * speck))
}

fn end_wall(at: Vec3, normal: Vec3) -> Surface {
    if normal.z < 0.0 {
        if END.frames(at.x, at.y) {
            return matt(gray(0.55));
        }
        let title = "MUSEUM OF THE VISUAL FIELD";
        let height = 0.2;
        let begin = -text::width(title) * height / 2.0;
        if text::is_inked(title, (at.x - begin) / height, (4.12 - at.y) / height) {
            return matt(vec3(0.55, 0.38, 0.1));
        }
    }
    // Bricks.
    let row = (at.y / 0.085).floor();
    let column = at.x / 0.25 + if row as i64 % 2 == 0 { 0.0 } else { 0.5 };
    let (u, v) = (column - column.floor(), at.y / 0.085 - row);
    let joint = (u.min(1.0 - u) * 0.25).min(v.min(1.0 - v) * 0.085);
    let tone = random(column.floor() as i64, row as i64, 0, 58);
    let rough = octaves(at.x * 60.0, at.y * 60.0, 3, 59);
    let brick = vec3(0.42, 0.2, 0.14).mix(vec3(0.6, 0.34, 0.22), tone) * (0.7 + 0.5 * rough);
    debug_assert!(at.z <= HALL.high.z + 1e-6);
    matt(vec3(0.6, 0.57, 0.5).mix(brick, rise(0.004, 0.008, joint)))
}
