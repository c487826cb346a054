//! The shapes that the place is built from, and where a ray meets them.

use crate::ray::{Bounds, Ray};
use crate::vec3::{Vec3, gray, vec3};

/// A shape.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Shape {
    Sphere {
        centre: Vec3,
        radius: f64,
    },
    /// A box whose sides are parallel to the axes.
    Block(Bounds),
    /// An upright cylinder with flat ends, from `base` upwards.
    Post {
        base: Vec3,
        radius: f64,
        height: f64,
    },
    /// A cylinder along z, without ends.
    Rail {
        from: Vec3,
        radius: f64,
        length: f64,
    },
    /// A flat ellipse: centre, and its half axes, which are perpendicular.
    Leaf {
        centre: Vec3,
        along: Vec3,
        across: Vec3,
    },
}

/// Where a ray meets a surface.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Meeting {
    /// Distance along the ray.
    pub(crate) t: f64,
    /// The normal, of length 1, on the side of the ray's origin.
    pub(crate) normal: Vec3,
}

/// Surfaces nearer than this are not hit: a ray that leaves a surface does not meet it again.
const NEAREST: f64 = 1e-6;

impl Shape {
    pub(crate) fn bounds(&self) -> Bounds {
        match *self {
            Self::Sphere { centre, radius } => {
                Bounds { low: centre - gray(radius), high: centre + gray(radius) }
            }
            Self::Block(bounds) => bounds,
            Self::Post { base, radius, height } => Bounds {
                low: base - vec3(radius, 0.0, radius),
                high: base + vec3(radius, height, radius),
            },
            Self::Rail { from, radius, length } => Bounds {
                low: from - vec3(radius, radius, 0.0),
                high: from + vec3(radius, radius, length),
            },
            Self::Leaf { centre, along, across } => {
                let side = |a: f64, b: f64| (a * a + b * b).sqrt();
                let half =
                    vec3(side(along.x, across.x), side(along.y, across.y), side(along.z, across.z));
                Bounds { low: centre - half, high: centre + half }
            }
        }
    }

    /// Where a ray meets the shape first, nearer than `limit`.
    pub(crate) fn meet(&self, ray: &Ray, limit: f64) -> Option<Meeting> {
        let (t, normal) = match *self {
            Self::Sphere { centre, radius } => {
                let to = centre - ray.origin;
                let along = to.dot(ray.direction);
                let square = radius * radius - (to.dot(to) - along * along);
                let t = first(along, square, limit)?;
                (t, (ray.at(t) - centre) / radius)
            }
            Self::Block(bounds) => {
                let (near, far) = bounds.span(ray);
                if near > far {
                    return None;
                }
                let t = if near > NEAREST { near } else { far };
                let t = within(t, limit)?;
                (t, side_of(&bounds, ray.at(t)))
            }
            Self::Post { base, radius, height } => {
                let ends = [base.y, base.y + height];
                return tube(
                    ray,
                    [ray.origin.x - base.x, ray.origin.z - base.z],
                    [ray.direction.x, ray.direction.z],
                    radius,
                    limit,
                )
                .map(|t| (t, ray.at(t)))
                .filter(|(_, at)| ends[0] <= at.y && at.y <= ends[1])
                .map(|(t, at)| Meeting {
                    t,
                    normal: vec3(at.x - base.x, 0.0, at.z - base.z) / radius,
                })
                .or_else(|| lid(ray, base, radius, ends[1], limit));
            }
            Self::Rail { from, radius, length } => {
                let t = tube(
                    ray,
                    [ray.origin.x - from.x, ray.origin.y - from.y],
                    [ray.direction.x, ray.direction.y],
                    radius,
                    limit,
                )?;
                let at = ray.at(t);
                if at.z < from.z || at.z > from.z + length {
                    return None;
                }
                (t, vec3(at.x - from.x, at.y - from.y, 0.0) / radius)
            }
            Self::Leaf { centre, along, across } => {
                let normal = along.cross(across);
                let t =
                    within((centre - ray.origin).dot(normal) / ray.direction.dot(normal), limit)?;
                let at = ray.at(t) - centre;
                let [u, v] = [along, across].map(|axis| at.dot(axis) / axis.dot(axis));
                if u * u + v * v > 1.0 {
                    return None;
                }
                (t, normal.unit())
            }
        };
        let faces = ray.direction.dot(normal) <= 0.0;
        Some(Meeting { t, normal: if faces { normal } else { -normal } })
    }
}

/// The first of the two distances `along ± √square` that is in range.
fn first(along: f64, square: f64, limit: f64) -> Option<f64> {
    if square < 0.0 {
        return None;
    }
    let half = square.sqrt();
    within(along - half, limit).or_else(|| within(along + half, limit))
}

fn within(t: f64, limit: f64) -> Option<f64> {
    (t > NEAREST && t < limit).then_some(t)
}

/// Where a ray meets an endless tube around an axis: origin and direction across the axis.
fn tube(_ray: &Ray, origin: [f64; 2], direction: [f64; 2], radius: f64, limit: f64) -> Option<f64> {
    let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
    let speed = dot(direction, direction);
    if speed == 0.0 {
        return None;
    }
    let along = -dot(origin, direction) / speed;
    let square = along * along - (dot(origin, origin) - radius * radius) / speed;
    first(along, square, limit)
}

/// Where a ray meets the upper end of a post.
fn lid(ray: &Ray, base: Vec3, radius: f64, height: f64, limit: f64) -> Option<Meeting> {
    let t = within((height - ray.origin.y) / ray.direction.y, limit)?;
    let at = ray.at(t);
    let (x, z) = (at.x - base.x, at.z - base.z);
    let up = if ray.direction.y < 0.0 { 1.0 } else { -1.0 };
    (x * x + z * z <= radius * radius).then_some(Meeting { t, normal: vec3(0.0, up, 0.0) })
}

/// The outward normal of the side of a box that a point is on.
pub(crate) fn side_of(bounds: &Bounds, at: Vec3) -> Vec3 {
    let gaps = [
        ((at.x - bounds.low.x).abs(), vec3(-1.0, 0.0, 0.0)),
        ((at.x - bounds.high.x).abs(), vec3(1.0, 0.0, 0.0)),
        ((at.y - bounds.low.y).abs(), vec3(0.0, -1.0, 0.0)),
        ((at.y - bounds.high.y).abs(), vec3(0.0, 1.0, 0.0)),
        ((at.z - bounds.low.z).abs(), vec3(0.0, 0.0, -1.0)),
        ((at.z - bounds.high.z).abs(), vec3(0.0, 0.0, 1.0)),
    ];
    let mut nearest = gaps[0];
    for gap in gaps {
        if gap.0 < nearest.0 {
            nearest = gap;
        }
    }
    nearest.1
}

#[cfg(test)]
mod tests {
    use super::*;

    const FORWARD: Vec3 = vec3(0.0, 0.0, 1.0);

    #[test]
    fn shapes_are_met_where_they_stand() {
        let ray = Ray::new(vec3(0.0, 0.5, -5.0), FORWARD);
        let met = |shape: Shape| shape.meet(&ray, 100.0).map(|meeting| meeting.t);
        assert_eq!(met(Shape::Sphere { centre: vec3(0.0, 0.5, 0.0), radius: 2.0 }), Some(3.0));
        assert_eq!(met(Shape::Block(Bounds { low: gray(-1.0), high: gray(1.0) })), Some(4.0));
        assert_eq!(
            met(Shape::Post { base: vec3(0.0, 0.0, 0.0), radius: 1.0, height: 1.0 }),
            Some(4.0)
        );
        assert_eq!(met(Shape::Post { base: vec3(0.0, 0.0, 0.0), radius: 1.0, height: 0.4 }), None);
        let leaf = |x: f64| Shape::Leaf {
            centre: vec3(x, 0.5, 1.0),
            along: vec3(0.3, 0.0, 0.0),
            across: vec3(0.0, 0.1, 0.0),
        };
        assert_eq!((met(leaf(0.2)), met(leaf(0.4))), (Some(6.0), None));
        let down = Ray::new(vec3(0.1, 5.0, 0.0), vec3(0.0, -1.0, 0.0));
        let post = Shape::Post { base: gray(0.0), radius: 1.0, height: 2.0 };
        let top = post.meet(&down, 100.0).unwrap();
        assert_eq!((top.t, top.normal), (3.0, vec3(0.0, 1.0, 0.0)));
        let rail = Shape::Rail { from: vec3(0.0, 1.0, -1.0), radius: 0.5, length: 2.0 };
        let t = rail.meet(&Ray::new(vec3(0.0, 5.0, 0.0), vec3(0.0, -1.0, 0.0)), 9.0).unwrap().t;
        assert!((t - 3.5).abs() < 1e-12);
        assert!(rail.meet(&Ray::new(vec3(0.0, 5.0, 1.5), vec3(0.0, -1.0, 0.0)), 9.0).is_none());
    }

    /// A shape lies within its bounds: rays that miss the bounds miss the shape.
    #[test]
    fn bounds_enclose_what_they_belong_to() {
        let shapes = [
            Shape::Sphere { centre: vec3(0.1, 0.2, 0.3), radius: 0.7 },
            Shape::Post { base: vec3(0.1, -0.5, 0.3), radius: 0.4, height: 1.1 },
            Shape::Rail { from: vec3(0.1, 0.5, -0.7), radius: 0.2, length: 1.3 },
            Shape::Leaf {
                centre: vec3(0.1, 0.2, 0.3),
                along: vec3(0.3, 0.4, 0.0),
                across: vec3(-0.08, 0.06, 0.1),
            },
        ];
        let mut hits = 0;
        for shape in shapes {
            for i in 0..4000 {
                let part = |k: u32| f64::from((i * k) % 997) / 498.5 - 1.0;
                let origin = vec3(part(31) * 3.0, part(57) * 3.0, -3.0);
                let target = vec3(part(89), part(131), part(7));
                let ray = Ray::new(origin, (target - origin).unit());
                if let Some(meeting) = shape.meet(&ray, 100.0) {
                    let (near, far) = shape.bounds().span(&ray);
                    assert!(near <= meeting.t + 1e-9 && meeting.t <= far + 1e-9, "{shape:?}");
                    assert!((meeting.normal.length() - 1.0).abs() < 1e-9);
                    assert!(meeting.normal.dot(ray.direction) <= 1e-12);
                    hits += 1;
                }
            }
        }
        assert!(hits > 300, "{hits}");
    }
}
