//! Smoothing of edges in a polar buffer: FXAA of Lottes's first kind, as in its WebGL ports. Neighbours
//! in the next columns are taken in the same direction, one row of the sample's own column off.

use crate::fetch::lerp;
use crate::ragged::Ragged;
use crate::texel::Texel;
use crate::values::Values;

/// Parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Fxaa {
    /// Most samples to either side of an edge.
    pub(crate) span: f64,
    /// Share of the mean luma that is added to the gradient.
    pub(crate) reduce: f64,
    /// The least that is added.
    pub(crate) minimum: f64,
}

impl Fxaa {
    /// The buffer, smoothed.
    pub(crate) fn apply(&self, buffer: &Ragged, values: &Values) -> Values {
        let last = buffer.columns().len() - 1;
        buffer.fill(|column, out| {
            let (c, step) = (column.index, 1.0 / column.rows as f32);
            let beside = [c.saturating_sub(1), (c + 1).min(last)];
            for (j, out) in out.iter_mut().enumerate() {
                let turn = (j as f32 + 0.5) * step;
                let corner = |c: usize, turn: f32| luma(buffer.along(values, c, wrapped(turn)));
                let [nw, ne] = beside.map(|c| corner(c, turn - step));
                let [sw, se] = beside.map(|c| corner(c, turn + step));
                let [x, z] = self.direction([nw, ne, sw, se]);
                let tap =
                    |q: f32| buffer.read(values, c as f32 + q * x, wrapped(turn + q * z * step));
                let inner = mean(tap(-1.0 / 6.0), tap(1.0 / 6.0));
                let outer = mean(inner, mean(tap(-0.5), tap(0.5)));
                let lumas = [nw, ne, sw, se, luma(values.sample(column, j))];
                let least = lumas.iter().copied().fold(f32::INFINITY, f32::min);
                let largest = lumas.iter().copied().fold(f32::NEG_INFINITY, f32::max);
                let inside = (least..=largest).contains(&luma(outer));
                *out = if inside { outer } else { inner };
            }
        })
    }

    /// Along the edge, in columns and rows.
    fn direction(&self, [nw, ne, sw, se]: [f32; 4]) -> [f32; 2] {
        let x = (sw + se) - (nw + ne);
        let z = (nw + sw) - (ne + se);
        let quarter = (nw + ne + sw + se) / 4.0;
        let added = (quarter * self.reduce as f32).max(self.minimum as f32);
        let scale = 1.0 / (x.abs().min(z.abs()) + added);
        let span = self.span as f32;
        [x, z].map(|along| (along * scale).clamp(-span, span))
    }
}

/// A direction in [0, 1), in turns.
fn wrapped(turn: f32) -> f32 {
    turn - turn.floor()
}

fn mean(a: Texel, b: Texel) -> Texel {
    lerp(a, b, 0.5)
}

/// 0.299 R + 0.587 G + 0.114 B of the values as they are; of gray, whose values are all the same, that.
fn luma([r, g, b, _]: Texel) -> f32 {
    0.299 * r + 0.587 * g + 0.114 * b
}
