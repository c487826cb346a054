//! The furniture of the hall: railings, pedestals with spheres, plants, pictures, benches.

use crate::noise::random;
use crate::ray::Bounds;
use crate::shape::Shape;
use crate::surface::Material;
use crate::vec3::{Vec3, vec3};

/// A shape with its material.
pub(crate) type Thing = (Shape, Material);

/// Something that holds back a share of the sunlight, with soft edges.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Occluder {
    pub(crate) shape: Shape,
    pub(crate) share: f64,
}

/// All furniture of the hall, and the shapes that throw shadows.
pub(crate) fn furniture(seed: u64) -> (Vec<Thing>, Vec<Occluder>) {
    let mut room = Room { things: Vec::new(), occluders: Vec::new(), seed };
    for side in [-1.0, 1.0] {
        room.railing(side * 1.75);
    }
    for (index, z) in [5.6, 8.6, 11.6, 14.6].into_iter().enumerate() {
        for (side, x) in [-2.75, 2.75].into_iter().enumerate() {
            room.pedestal(vec3(x, 0.0, z), (2 * index + side) as i64);
        }
    }
    for (index, z) in [4.1, 7.1, 10.1, 13.1, 16.1, 19.2].into_iter().enumerate() {
        for (side, x) in [-3.25, 3.25].into_iter().enumerate() {
            room.plant(vec3(x, 0.0, z), (2 * index + side) as i64);
        }
    }
    for (index, z) in [3.0, 5.0, 7.0, 9.0, 11.0, 13.0, 15.0, 17.0, 19.0].into_iter().enumerate() {
        room.picture(index, z);
    }
    for (index, z) in [5.4, 9.8, 14.2].into_iter().enumerate() {
        room.bench(vec3(-3.55, 0.0, z), index);
    }
    // The great sphere before the window.
    room.solid(
        Shape::Post { base: vec3(0.0, 0.0, 18.8), radius: 0.42, height: 0.8 },
        Material::Stone,
    );
    room.solid(Shape::Sphere { centre: vec3(0.0, 1.32, 18.8), radius: 0.52 }, Material::Chrome);
    (room.things, room.occluders)
}

struct Room {
    things: Vec<Thing>,
    occluders: Vec<Occluder>,
    seed: u64,
}

impl Room {
    fn random(&self, i: i64, j: i64, k: i64) -> f64 {
        random(i, j, k, self.seed ^ 0x5eed)
    }

    /// Adds a shape that throws a shadow.
    fn solid(&mut self, shape: Shape, material: Material) {
        self.things.push((shape, material));
        self.occluders.push(Occluder { shape, share: 1.0 });
    }

    fn railing(&mut self, x: f64) {
        const SPACING: f64 = 0.105;
        let (from, to) = (3.6, 17.2);
        let count = ((to - from) / SPACING) as i64;
        for index in 0..=count {
            let base = vec3(x, 0.06, from + index as f64 * SPACING);
            let thick = index % 12 == 0;
            let radius = if thick { 0.022 } else { 0.0075 };
            self.solid(Shape::Post { base, radius, height: 0.9 }, Material::Brass);
            if thick {
                let centre = vec3(x, 1.04, base.z);
                self.solid(Shape::Sphere { centre, radius: 0.045 }, Material::Brass);
            }
        }
        for (y, radius) in [(0.06, 0.016), (0.96, 0.026)] {
            let from = vec3(x, y, from);
            self.solid(Shape::Rail { from, radius, length: to - from.z }, Material::Brass);
        }
    }

    fn pedestal(&mut self, base: Vec3, index: i64) {
        let height = 0.85 + 0.25 * self.random(index, 0, 1);
        let radius = 0.24;
        self.solid(Shape::Post { base, radius, height }, Material::Stone);
        let foot = Shape::Post { base, radius: radius + 0.07, height: 0.09 };
        self.solid(foot, Material::Stone);
        let top = Shape::Post {
            base: base + vec3(0.0, height, 0.0),
            radius: radius + 0.04,
            height: 0.05,
        };
        self.solid(top, Material::Stone);
        let ball = 0.2 + 0.08 * self.random(index, 1, 1);
        let materials = [Material::Gold, Material::Red, Material::Chrome, Material::Black];
        let centre = base + vec3(0.0, height + 0.05 + ball, 0.0);
        self.solid(Shape::Sphere { centre, radius: ball }, materials[index as usize % 4]);
    }

    fn plant(&mut self, base: Vec3, index: i64) {
        const LEAVES: i64 = 320;
        self.solid(Shape::Post { base, radius: 0.24, height: 0.42 }, Material::Clay);
        let crown = base + vec3(0.0, 1.15, 0.0);
        for leaf in 0..LEAVES {
            let number = |k: i64| 2.0 * self.random(index * 1000 + leaf, k, 2) - 1.0;
            // On shells around the crown, denser towards its surface.
            let direction = vec3(number(0), number(1) * 1.1 + 0.1, number(2));
            let reach = 0.25 + 0.42 * self.random(index * 1000 + leaf, 3, 2);
            let centre = crown + direction.unit() * reach;
            let tilt = vec3(number(4), number(5) * 0.6, number(6));
            let along = tilt.unit() * (0.07 + 0.06 * self.random(index * 1000 + leaf, 7, 2));
            let across = along.cross(vec3(number(8), number(9), number(10))).unit() * 0.024;
            let shade = self.random(index * 1000 + leaf, 11, 2);
            self.things.push((Shape::Leaf { centre, along, across }, Material::Leaf(shade)));
        }
        self.occluders
            .push(Occluder { shape: Shape::Sphere { centre: crown, radius: 0.62 }, share: 0.7 });
    }

    fn picture(&mut self, index: usize, z: f64) {
        let half = [[0.72, 0.85], [0.62, 0.62], [0.8, 0.55]][index % 3];
        let y = 2.25;
        let bounds = Bounds {
            low: vec3(3.95, y - half[1], z - half[0]),
            high: vec3(4.0, y + half[1], z + half[0]),
        };
        // The texts hang where the walk begins.
        let material = Material::Picture { which: index + 5, centre: [z, y], half };
        self.things.push((Shape::Block(bounds), material));
    }

    fn bench(&mut self, at: Vec3, _index: usize) {
        let block = |low: Vec3, high: Vec3| Shape::Block(Bounds { low: at + low, high: at + high });
        self.solid(block(vec3(-0.22, 0.4, -0.75), vec3(0.22, 0.46, 0.75)), Material::Wood);
        for z in [-0.62, 0.55] {
            self.solid(block(vec3(-0.2, 0.0, z), vec3(0.2, 0.4, z + 0.07)), Material::Wood);
        }
    }
}
