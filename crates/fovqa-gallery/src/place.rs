//! The place: what a ray meets in the hall, and the light that comes back along it.

use crate::furniture::{Occluder, furniture};
use crate::hall::{
    END, FAR_M, HALL, SIDE, SUNLIGHT, outdoors, sky_through_windows, sun_through_windows, to_sun,
};
use crate::noise::rise;
use crate::ray::Ray;
use crate::shape::{Shape, side_of};
use crate::surface::{Material, Surface, hall};
use crate::tree::Tree;
use crate::vec3::{Vec3, gray};

/// The hall with everything in it.
#[derive(Debug)]
pub(crate) struct Place {
    tree: Tree,
    materials: Vec<Material>,
    shadows: Shadows,
}

/// What a ray meets.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Hit {
    /// Distance along the ray in metres.
    pub(crate) t: f64,
    /// Whether it is outdoors, so far away that it moves with the direction alone.
    pub(crate) outdoors: bool,
    normal: Vec3,
    surface: Option<Surface>,
}

impl Place {
    pub(crate) fn new(seed: u64) -> Self {
        let (things, occluders) = furniture(seed);
        let (shapes, materials): (Vec<Shape>, Vec<Material>) = things.into_iter().unzip();
        Self { tree: Tree::new(&shapes), materials, shadows: Shadows::new(occluders) }
    }

    /// What a ray from within the hall meets.
    pub(crate) fn meet(&self, ray: &Ray) -> Hit {
        let (_, exit) = HALL.span(ray);
        if let Some((index, meeting)) = self.tree.first(ray, exit) {
            let at = ray.at(meeting.t);
            let surface = self.materials[index as usize].surface(at, meeting.normal);
            return Hit {
                t: meeting.t,
                outdoors: false,
                normal: meeting.normal,
                surface: Some(surface),
            };
        }
        let at = ray.at(exit);
        let normal = -side_of(&HALL, at);
        let open = |share: f64| share > 0.5;
        let window = if normal.z < -0.5 {
            open(END.passes(at.x, at.y, 1e-5))
        } else {
            normal.x > 0.5 && SIDE.iter().any(|window| open(window.passes(at.z, at.y, 1e-5)))
        };
        if window {
            return Hit { t: FAR_M, outdoors: true, normal, surface: None };
        }
        Hit { t: exit, outdoors: false, normal, surface: Some(hall(at, normal)) }
    }

    /// The light that comes back along a ray; 1 is white paper in good light.
    pub(crate) fn light(&self, ray: &Ray) -> Vec3 {
        let hit = self.meet(ray);
        let Some(surface) = hit.surface else { return outdoors(ray) };
        let at = ray.at(hit.t);
        let light = self.scattered(&surface, at, hit.normal);
        let Some(mirror) = surface.mirror else { return light };
        let cosine = -ray.direction.dot(hit.normal);
        // Schlick's approximation of Fresnel's reflection.
        let slant = 1.0 - cosine.clamp(0.0, 1.0);
        let share = mirror + (gray(1.0) - mirror) * (slant * slant * slant * slant * slant);
        let direction = ray.direction + hit.normal * (2.0 * cosine);
        let reflected = Ray::new(at + hit.normal * 1e-5, direction.unit());
        let seen = self.meet(&reflected);
        let behind = match seen.surface {
            None => outdoors(&reflected),
            Some(surface) => self.scattered(&surface, reflected.at(seen.t), seen.normal),
        };
        light.times(gray(1.0) - share) + behind.times(share)
    }

    /// The light that a surface scatters.
    fn scattered(&self, surface: &Surface, at: Vec3, normal: Vec3) -> Vec3 {
        let sun = normal.dot(to_sun()).max(0.0);
        let direct = if sun > 0.0 {
            let through = sun_through_windows(at);
            if through > 0.0 { sun * through * self.shadows.left(at + normal * 1e-4) } else { 0.0 }
        } else {
            0.0
        };
        let near = self.shadows.nearness(at, normal) * corners(at);
        let sky = sky_through_windows(at, normal) * (0.4 + 0.6 * near);
        // Light that walls and floor have scattered before.
        let ambient = Vec3 { x: 0.34, y: 0.315, z: 0.28 } * ((0.8 + 0.2 * normal.y) * near);
        surface.colour.times(SUNLIGHT * direct + sky + ambient)
    }
}

/// How open the hall is at a point: less light reaches corners and edges.
fn corners(at: Vec3) -> f64 {
    let open = |gap: f64| 1.0 - 0.4 / (1.0 + gap * gap * 9.0);
    let side = (at.x - HALL.low.x).min(HALL.high.x - at.x);
    let ends = (at.z - HALL.low.z).min(HALL.high.z - at.z);
    let (down, up) = (at.y - HALL.low.y, HALL.high.y - at.y);
    // The nearest surface is the one that the point is on.
    let mut gaps = [side, ends, down, up];
    gaps.sort_by(f64::total_cmp);
    open(gaps[1]) * open(gaps[2])
}

/// The shadows that things throw.
#[derive(Debug)]
struct Shadows {
    occluders: Vec<Occluder>,
    tree: Tree,
}

/// Shadows are soft up to this distance from a thing, in metres.
const SOFT_M: f64 = 0.12;

impl Shadows {
    fn new(occluders: Vec<Occluder>) -> Self {
        let wide: Vec<Shape> = occluders.iter().map(|occluder| widened(&occluder.shape)).collect();
        Self { occluders, tree: Tree::new(&wide) }
    }

    /// The share of sunlight that is left at a point.
    fn left(&self, at: Vec3) -> f64 {
        let ray = Ray::new(at, to_sun());
        let mut left = 1.0;
        self.tree.pass_all(&ray, |index| {
            let Occluder { shape, share } = &self.occluders[index as usize];
            left *= 1.0 - share * held_back(shape, &ray);
            left > 1e-3
        });
        left
    }

    /// How open the place is at a point, as far as round things are near: 1 where none is.
    fn nearness(&self, at: Vec3, normal: Vec3) -> f64 {
        let mut open = 1.0;
        self.tree.near(at, 0.9, |index| {
            let (centre, radius) = match self.occluders[index as usize].shape {
                Shape::Sphere { centre, radius } if radius > 0.1 => (centre, radius),
                Shape::Post { base, radius, height } if radius > 0.1 => {
                    let y = at.y.clamp(base.y, base.y + height);
                    (Vec3 { y, ..base }, radius)
                }
                _ => return,
            };
            let to = centre - at;
            let square = to.dot(to);
            if square <= radius * radius * 1.0001 {
                return;
            }
            let faces = (0.4 + 0.6 * normal.dot(to) / square.sqrt()).max(0.0);
            open *= 1.0 - 0.75 * faces * radius * radius / square;
        });
        open
    }
}

/// A shape with the space in which its shadow is soft.
fn widened(shape: &Shape) -> Shape {
    match *shape {
        Shape::Sphere { centre, radius } => Shape::Sphere { centre, radius: radius + SOFT_M },
        Shape::Post { base, radius, height } => Shape::Post {
            base: base - Vec3 { x: 0.0, y: SOFT_M, z: 0.0 },
            radius: radius + SOFT_M,
            height: height + 2.0 * SOFT_M,
        },
        Shape::Rail { from, radius, length } => {
            Shape::Rail { from, radius: radius + SOFT_M, length }
        }
        other => other,
    }
}

/// The share of a source of light with some width that a shape hides, seen along a ray.
fn held_back(shape: &Shape, ray: &Ray) -> f64 {
    let blur_at = |t: f64| (0.002 + 0.009 * t).min(SOFT_M);
    let hidden = |gap: f64, radius: f64, t: f64| {
        if t <= 0.0 {
            return 0.0;
        }
        let blur = blur_at(t);
        // A thing thinner than the blur hides only a part of the light.
        (1.0 - rise(-blur, blur, gap - radius)) * (radius / blur).min(1.0)
    };
    match *shape {
        Shape::Sphere { centre, radius } => {
            let to = centre - ray.origin;
            let t = to.dot(ray.direction);
            hidden((to.dot(to) - t * t).max(0.0).sqrt(), radius, t)
        }
        Shape::Post { base, radius, height } => {
            let (to, d) = (base - ray.origin, ray.direction);
            let (t, gap) = nearest([to.x, to.z], [d.x, d.z]);
            let at = ray.origin.y + d.y * t - base.y;
            hidden(gap, radius, t) * between(at, height, blur_at(t.max(0.0)))
        }
        Shape::Rail { from, radius, length } => {
            let (to, d) = (from - ray.origin, ray.direction);
            let (t, gap) = nearest([to.x, to.y], [d.x, d.y]);
            let at = ray.origin.z + d.z * t - from.z;
            hidden(gap, radius, t) * between(at, length, blur_at(t.max(0.0)))
        }
        shape => f64::from(u8::from(shape.meet(ray, 1e9).is_some())),
    }
}

/// Where a ray is nearest to an axis that is a point across it, and how far from it.
fn nearest([x, y]: [f64; 2], [dx, dy]: [f64; 2]) -> (f64, f64) {
    let speed = dx * dx + dy * dy;
    ((x * dx + y * dy) / speed, (x * dy - y * dx).abs() / speed.sqrt())
}

/// Whether a place is from 0 to `length`, with edges as soft as `blur`.
fn between(at: f64, length: f64, blur: f64) -> f64 {
    rise(-blur, blur, length - at) * rise(-blur, blur, at)
}
