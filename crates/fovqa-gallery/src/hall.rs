//! The hall itself: its size, its windows, and the light that falls through them.

use crate::noise::{octaves, rise};
use crate::ray::{Bounds, Ray};
use crate::vec3::{Vec3, gray, vec3};

/// The inside of the hall, in metres.
pub(crate) const HALL: Bounds = Bounds { low: vec3(-4.0, 0.0, -2.0), high: vec3(4.0, 4.4, 22.0) };

/// Distance of what is seen through the windows, in metres.
pub(crate) const FAR_M: f64 = 1000.0;

/// Towards the sun.
pub(crate) fn to_sun() -> Vec3 {
    vec3(-0.66, 0.62, -0.42).unit()
}

/// The light of the sun on a surface that faces it.
pub(crate) const SUNLIGHT: Vec3 = vec3(4.6, 4.1, 3.3);

/// A window: an opening in a wall, as [low, high] along the wall and upwards, with its panes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Window {
    pub(crate) along: [f64; 2],
    pub(crate) up: [f64; 2],
    panes: [f64; 2],
}

/// The bright window at the end of the hall, along x.
pub(crate) const END: Window = Window { along: [-2.1, 2.1], up: [0.95, 3.75], panes: [6.0, 4.0] };

/// The windows of the left wall, along z.
pub(crate) const SIDE: [Window; 4] = [side(3.2), side(7.6), side(12.0), side(16.4)];

const fn side(z: f64) -> Window {
    Window { along: [z - 0.75, z + 0.75], up: [1.0, 3.6], panes: [3.0, 5.0] }
}

impl Window {
    /// The share of light that passes at a place of the wall, with edges as soft as `blur`.
    pub(crate) fn passes(&self, along: f64, up: f64, blur: f64) -> f64 {
        /// Half the width of a bar between panes.
        const BAR: f64 = 0.018;
        let inside = |at: f64, [low, high]: [f64; 2]| {
            rise(low - blur, low + blur, at) * (1.0 - rise(high - blur, high + blur, at))
        };
        let bars = |at: f64, [low, high]: [f64; 2], panes: f64| {
            let pane = (high - low) / panes;
            let place = (at - low) / pane;
            let nearest = place.round();
            let gap = (place - nearest).abs() * pane;
            // Where the blur is wider than the bar, the bar takes only a share of the light.
            let soft = rise(BAR - blur, BAR + blur, gap);
            let share = (BAR / blur.max(BAR)).min(1.0);
            1.0 - share * (1.0 - soft)
        };
        let opening = inside(along, self.along) * inside(up, self.up);
        if opening == 0.0 {
            return 0.0;
        }
        opening * bars(along, self.along, self.panes[0]) * bars(up, self.up, self.panes[1])
    }

    /// Whether a place of the wall is within the opening or its frame.
    pub(crate) fn frames(&self, along: f64, up: f64) -> bool {
        const FRAME: f64 = 0.07;
        let within = |at: f64, [low, high]: [f64; 2]| low - FRAME < at && at < high + FRAME;
        within(along, self.along) && within(up, self.up)
    }
}

/// How much sunlight reaches a point through the windows of the left wall. The furniture is ignored.
pub(crate) fn sun_through_windows(at: Vec3) -> f64 {
    let sun = to_sun();
    let t = (HALL.low.x - at.x) / sun.x;
    let (y, z) = (at.y + sun.y * t, at.z + sun.z * t);
    // The sun is 0.5° wide; hazy air makes it seem wider.
    let blur = 0.004 + 0.009 * t;
    SIDE.iter().map(|window| window.passes(z, y, blur)).sum()
}

/// Light from the sky through the windows on a point with a normal.
pub(crate) fn sky_through_windows(at: Vec3, normal: Vec3) -> Vec3 {
    let mut sum = gray(0.0);
    let (cx, cy) = (middle(END.along), middle(END.up));
    let area = (END.along[1] - END.along[0]) * (END.up[1] - END.up[0]);
    let end = vec3(cx, cy, HALL.high.z);
    sum += vec3(3.9, 4.2, 4.6) * from_patch(at, normal, end, vec3(0.0, 0.0, -1.0), area);
    for window in SIDE {
        let centre = vec3(HALL.low.x, middle(window.up), middle(window.along));
        let area = (window.along[1] - window.along[0]) * (window.up[1] - window.up[0]);
        sum += vec3(3.0, 3.3, 3.8) * from_patch(at, normal, centre, vec3(1.0, 0.0, 0.0), area);
    }
    sum
}

fn middle([low, high]: [f64; 2]) -> f64 {
    low.midpoint(high)
}

/// The share of the light of a flat patch that reaches a point, as if the patch were a disc.
fn from_patch(at: Vec3, normal: Vec3, centre: Vec3, faces: Vec3, area: f64) -> f64 {
    let to = centre - at;
    let square = to.dot(to);
    let length = square.sqrt();
    // A patch of some size is seen by surfaces that its centre does not quite face.
    let received = (normal.dot(to) / length * 0.85 + 0.15).max(0.0);
    let sent = (-faces.dot(to) / length).max(0.0);
    received * sent * area / (std::f64::consts::PI * square + area)
}

/// What is seen through a window along a ray: sky, clouds, and trees below.
pub(crate) fn outdoors(ray: &Ray) -> Vec3 {
    let d = ray.direction;
    let height = d.y / (d.x * d.x + d.z * d.z).sqrt();
    // Trees far away: a ragged line with leaves.
    let round = if d.z.abs() > d.x.abs() { d.x / d.z.abs() } else { 2.0 + d.z / d.x.abs() };
    let line = 0.03 + 0.07 * octaves(round * 9.0 + 40.0, 3.0, 4, 21);
    if height < line {
        let leaf = octaves(round * 60.0 + 90.0, height * 60.0, 3, 22);
        return vec3(0.32, 0.46, 0.2).mix(vec3(0.95, 1.15, 0.6), leaf) * 1.1;
    }
    let haze = rise(0.0, 0.6, height);
    let sky = vec3(3.6, 3.9, 4.1).mix(vec3(1.5, 2.3, 3.6), haze);
    let cloud = octaves(round * 3.0 + 7.0, height * 5.0 - 2.0, 5, 23);
    sky.mix(gray(5.2), rise(0.52, 0.78, cloud))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sun_falls_on_floor_and_wall_in_patches() {
        let mut lit = 0;
        for i in 0..4000 {
            let (x, z) = (f64::from(i % 80) * 0.1 - 4.0, f64::from(i / 80) * 0.4);
            let light = sun_through_windows(vec3(x, 0.0, z));
            assert!((0.0..=1.0).contains(&light));
            lit += usize::from(light > 0.5);
        }
        assert!((100..1200).contains(&lit), "{lit}");
    }

    #[test]
    fn bars_and_frames_hold_light_back() {
        let window = SIDE[0];
        assert!(window.passes(3.2 + 0.25, 2.3, 0.001) < 1e-12, "the bar between two panes");
        assert!((window.passes(3.2, 2.0, 0.001) - 1.0).abs() < 1e-9);
        assert!(window.passes(5.0, 2.0, 0.001) < 1e-12);
        assert!(window.frames(3.98, 2.0) && !window.frames(4.1, 2.0));
    }
}
