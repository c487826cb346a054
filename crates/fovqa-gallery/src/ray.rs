//! Rays, and the boxes that enclose what they may hit.

use crate::vec3::{Vec3, gray, vec3};

/// A ray: points at `origin + t * direction`. The direction has length 1.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ray {
    pub(crate) origin: Vec3,
    pub(crate) direction: Vec3,
    /// 1 / direction, component by component; infinite where the direction is 0.
    inverse: Vec3,
}

impl Ray {
    pub(crate) fn new(origin: Vec3, direction: Vec3) -> Self {
        let inverse = vec3(1.0 / direction.x, 1.0 / direction.y, 1.0 / direction.z);
        Self { origin, direction, inverse }
    }

    pub(crate) fn at(&self, t: f64) -> Vec3 {
        self.origin + self.direction * t
    }
}

/// A box whose sides are parallel to the axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Bounds {
    pub(crate) low: Vec3,
    pub(crate) high: Vec3,
}

impl Bounds {
    /// The bounds of nothing.
    pub(crate) const NONE: Self = Self { low: gray(f64::INFINITY), high: gray(f64::NEG_INFINITY) };

    pub(crate) fn joined(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    pub(crate) fn centre(&self) -> Vec3 {
        (self.low + self.high) * 0.5
    }

    pub(crate) fn area(&self) -> f64 {
        let side = (self.high - self.low).max(gray(0.0));
        side.x * side.y + side.y * side.z + side.z * side.x
    }

    /// The distances at which a ray enters and leaves the box; it misses if the first is greater. A ray
    /// that runs exactly along a side misses.
    pub(crate) fn span(&self, ray: &Ray) -> (f64, f64) {
        let near = (self.low - ray.origin).times(ray.inverse);
        let far = (self.high - ray.origin).times(ray.inverse);
        let (low, high) = (near.min(far), near.max(far));
        (low.x.max(low.y).max(low.z), high.x.min(high.y).min(high.z))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rays_enter_and_leave() {
        let bounds = Bounds { low: gray(-1.0), high: vec3(1.0, 2.0, 3.0) };
        let ray = Ray::new(vec3(-3.0, 0.0, 0.0), vec3(1.0, 0.0, 0.0));
        assert_eq!(bounds.span(&ray), (2.0, 4.0));
        let (near, far) = bounds.span(&Ray::new(vec3(-3.0, 5.0, 0.0), vec3(1.0, 0.0, 0.0)));
        assert!(near > far);
        let (near, far) = bounds.span(&Ray::new(vec3(-3.0, 1.999, 0.0), vec3(1.0, 0.0, 0.0)));
        assert!(near <= far);
        assert!((bounds.area() - (2.0 * 3.0 + 3.0 * 4.0 + 4.0 * 2.0)).abs() < 1e-12);
    }
}
