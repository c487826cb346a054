//! A tree of boxes around the shapes: a ray meets only those whose boxes it passes.

use crate::ray::{Bounds, Ray};
use crate::shape::{Meeting, Shape};
use crate::vec3::{Vec3, gray};

/// Shapes in a tree of boxes.
#[derive(Debug)]
pub(crate) struct Tree {
    nodes: Vec<Node>,
    /// The shapes in the order of the leaves, each with its index in the order they were given.
    shapes: Vec<(Shape, u32)>,
}

#[derive(Debug, Clone, Copy)]
struct Node {
    bounds: Bounds,
    /// Of a leaf: its first shape. Otherwise: the second child; the first one follows this node.
    at: u32,
    /// Number of shapes; 0 if it is not a leaf.
    shapes: u32,
}

/// Most shapes of a leaf.
const LEAF: usize = 2;

/// Ways to divide a node that are compared along each axis.
const BINS: usize = 16;

/// The depth of the stack: a tree of 2^48 shapes.
const STACK: usize = 48;

impl Tree {
    pub(crate) fn new(shapes: &[Shape]) -> Self {
        let mut order: Vec<(Shape, u32)> = shapes.iter().copied().zip(0..).collect();
        let mut nodes = Vec::new();
        build(&mut nodes, &mut order, 0, 0);
        Self { nodes, shapes: order }
    }

    /// The shape that a ray meets first, nearer than `limit`, by its index.
    pub(crate) fn first(&self, ray: &Ray, limit: f64) -> Option<(u32, Meeting)> {
        let mut nearest: Option<(u32, Meeting)> = None;
        self.pass(ray, limit, |shape, index, limit| {
            let Some(meeting) = shape.meet(ray, limit) else { return limit };
            nearest = Some((index, meeting));
            meeting.t
        });
        nearest
    }

    /// Calls `visit` for the index of every shape whose box the ray passes, until it returns false.
    pub(crate) fn pass_all(&self, ray: &Ray, mut visit: impl FnMut(u32) -> bool) {
        self.pass(ray, f64::INFINITY, |_, index, limit| if visit(index) { limit } else { -1.0 });
    }

    /// Calls `visit` for the index of every shape whose box is at most `reach` away from a point.
    pub(crate) fn near(&self, at: Vec3, reach: f64, mut visit: impl FnMut(u32)) {
        let mut stack = [0u32; STACK];
        let mut height = 1;
        while height > 0 {
            height -= 1;
            let Some(node) = self.nodes.get(stack[height] as usize) else { return };
            let gap = (node.bounds.low - at).max(at - node.bounds.high).max(gray(0.0));
            if gap.dot(gap) > reach * reach {
                continue;
            }
            if node.shapes == 0 {
                stack[height] += 1;
                stack[height + 1] = node.at;
                height += 2;
                continue;
            }
            let from = node.at as usize;
            for (shape, index) in &self.shapes[from..from + node.shapes as usize] {
                let bounds = shape.bounds();
                let gap = (bounds.low - at).max(at - bounds.high).max(gray(0.0));
                if gap.dot(gap) <= reach * reach {
                    visit(*index);
                }
            }
        }
    }

    /// Calls `visit` for the shapes whose boxes the ray passes within a limit, which `visit` may make
    /// smaller. Nearer boxes come first.
    fn pass(&self, ray: &Ray, mut limit: f64, mut visit: impl FnMut(&Shape, u32, f64) -> f64) {
        let mut stack = [(0u32, 0.0f64); STACK];
        let mut height = 0;
        let enters = |node: u32, limit: f64| {
            let (near, far) = self.nodes[node as usize].bounds.span(ray);
            (near <= far && far > 0.0 && near < limit).then_some(near)
        };
        if self.nodes.is_empty() || enters(0, limit).is_none() {
            return;
        }
        let mut at = 0u32;
        loop {
            let node = &self.nodes[at as usize];
            if node.shapes > 0 {
                let from = node.at as usize;
                for (shape, index) in &self.shapes[from..from + node.shapes as usize] {
                    limit = visit(shape, *index, limit);
                }
            } else {
                let [left, right] = [at + 1, node.at];
                match (enters(left, limit), enters(right, limit)) {
                    (Some(a), Some(b)) => {
                        let (near, far) =
                            if a <= b { (left, (right, b)) } else { (right, (left, a)) };
                        stack[height] = far;
                        height += 1;
                        at = near;
                        continue;
                    }
                    (Some(_), None) => {
                        at = left;
                        continue;
                    }
                    (None, Some(_)) => {
                        at = right;
                        continue;
                    }
                    (None, None) => {}
                }
            }
            loop {
                if height == 0 {
                    return;
                }
                height -= 1;
                let (next, near) = stack[height];
                if near < limit {
                    at = next;
                    break;
                }
            }
        }
    }
}

fn bounds_of(shapes: &[(Shape, u32)]) -> Bounds {
    shapes.iter().fold(Bounds::NONE, |all, (shape, _)| all.joined(shape.bounds()))
}

/// Builds the node of some shapes and everything below it; `first` is the index of the first shape.
fn build(nodes: &mut Vec<Node>, shapes: &mut [(Shape, u32)], first: usize, depth: usize) {
    let index = nodes.len();
    let bounds = bounds_of(shapes);
    nodes.push(Node { bounds, at: first as u32, shapes: shapes.len() as u32 });
    if shapes.len() <= LEAF || depth + 2 >= STACK {
        return;
    }
    let middle = divide(shapes, &bounds);
    let (left, right) = shapes.split_at_mut(middle);
    build(nodes, left, first, depth + 1);
    nodes[index] = Node { bounds, at: nodes.len() as u32, shapes: 0 };
    build(nodes, right, first + middle, depth + 1);
}

/// Orders shapes so that those before the returned index are one child and those behind it the
/// other: the division with the smallest expected work (surface-area heuristic, binned).
fn divide(shapes: &mut [(Shape, u32)], bounds: &Bounds) -> usize {
    let centres = shapes.iter().fold(Bounds::NONE, |all, (shape, _)| {
        let centre = shape.bounds().centre();
        all.joined(Bounds { low: centre, high: centre })
    });
    let bin_of = |shape: &Shape, axis: usize| {
        let (low, high) = (centres.low.axis(axis), centres.high.axis(axis));
        let share = (shape.bounds().centre().axis(axis) - low) / (high - low);
        ((share * BINS as f64) as usize).min(BINS - 1)
    };
    let mut best: Option<(f64, usize, usize)> = None;
    for axis in 0..3 {
        if centres.high.axis(axis) <= centres.low.axis(axis) {
            continue;
        }
        let mut bins = [(Bounds::NONE, 0usize); BINS];
        for (shape, _) in shapes.iter() {
            let bin = &mut bins[bin_of(shape, axis)];
            *bin = (bin.0.joined(shape.bounds()), bin.1 + 1);
        }
        for cut in 1..BINS {
            let side = |bins: &[(Bounds, usize)]| {
                let joined = bins
                    .iter()
                    .fold((Bounds::NONE, 0), |all, bin| (all.0.joined(bin.0), all.1 + bin.1));
                (joined.0.area() * joined.1 as f64, joined.1)
            };
            let ((left, some), (right, others)) = (side(&bins[..cut]), side(&bins[cut..]));
            let cost = left + right;
            if some > 0 && others > 0 && best.is_none_or(|best| cost < best.0) {
                best = Some((cost, axis, cut));
            }
        }
    }
    let _ = bounds;
    match best {
        None => shapes.len() / 2,
        Some((_, axis, cut)) => {
            // Stable: the same order on every machine.
            shapes.sort_by_key(|(shape, _)| bin_of(shape, axis) >= cut);
            shapes.partition_point(|(shape, _)| bin_of(shape, axis) < cut)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vec3::vec3;

    #[test]
    fn the_tree_finds_what_a_search_of_all_finds() {
        let part = |i: u32, k: u32| {
            f64::from((i.wrapping_mul(2_654_435_761) ^ (i * k)) % 1009) / 504.5 - 1.0
        };
        let shapes: Vec<Shape> = (1..400)
            .map(|i| Shape::Sphere {
                centre: vec3(part(i, 31), part(i, 57), part(i, 89)) * 3.0,
                radius: 0.05 + 0.1 * part(i, 7).abs(),
            })
            .collect();
        let tree = Tree::new(&shapes);
        let mut hits = 0;
        for i in 1..2000 {
            let origin = vec3(part(i, 3), part(i, 5), -1.5) * 3.0;
            let ray = Ray::new(origin, (vec3(part(i, 11), part(i, 13), 0.0) - origin).unit());
            let all = shapes.iter().enumerate();
            let all =
                all.filter_map(|(index, shape)| Some((shape.meet(&ray, 1e9)?.t, index as u32)));
            let wanted = all.reduce(|a, b| if b.0 < a.0 { b } else { a });
            let found = tree.first(&ray, 1e9).map(|(index, meeting)| (meeting.t, index));
            assert_eq!(found, wanted);
            hits += usize::from(found.is_some());
        }
        assert!(hits > 300, "{hits}");
    }
}
