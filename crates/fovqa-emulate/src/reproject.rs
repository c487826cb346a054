//! Reprojection between two eyes: what one of them can take from the frame of the other, and what it has
//! to shade again (VaFR_Rep; Zhang, Gai, Li, section 5.1).
//!
//! The paper prints only the counts of this variant. The picture is our choice: a pixel p of an eye with
//! depth Z takes the other eye's frame, read bilinearly, at q = p ± (focal · ipd / Z, 0), if q is in that
//! frame and its depth there, at the pixel that holds q, differs from Z by no more than 5 % of Z.

use fovqa_frame::{Mask, Plane};
use fovqa_vision::View;

use crate::error::EmulateError;
use crate::image::Image;
use crate::picture::Picture;

/// The largest difference of both depths, as a share of the depth of the pixel that is filled.
const TOLERANCE: f64 = 0.05;

/// A frame of one eye with its depth. All three have one size.
#[derive(Debug, Clone, Copy)]
pub struct EyeFrame<'a> {
    /// What is shown to the eye.
    pub picture: &'a Picture,
    /// Distances along the viewing axis, in any unit that both eyes share. A distance that is not finite
    /// or not above 0 stands for the sky, which is infinitely far.
    pub depth: &'a Plane,
    /// The view. The viewing axes of both eyes are parallel.
    pub view: &'a View,
}

/// A frame of which a part was taken from the other eye.
#[derive(Debug, Clone, PartialEq)]
pub struct Reprojected {
    /// The frame.
    pub picture: Picture,
    /// The pixels that are the eye's own: they could not be taken, and are shaded again.
    pub reshaded: Mask,
}

/// Fills the frame of an eye, `to`, from that of the other one, `from`, and leaves its own pixels where
/// that is not possible. `baseline` leads from the eye `to` to the eye `from`, to the right, in the unit of
/// the depth; it is negative if that eye is on the left.
///
/// Sky is taken only from sky. The result is the same for any number of threads.
///
/// # Errors
/// When picture, depth and view of an eye differ in size, or one eye is gray and the other in colour.
pub fn reproject(
    from: &EyeFrame<'_>,
    to: &EyeFrame<'_>,
    baseline: f64,
) -> Result<Reprojected, EmulateError> {
    from.check()?;
    to.check()?;
    let places = Places::new(from, to, baseline);
    match (from.picture, to.picture) {
        (Picture::Gray(from), Picture::Gray(to)) => Ok(places.fill(from, to, Picture::Gray)),
        (Picture::Rgb(from), Picture::Rgb(to)) => Ok(places.fill(from, to, Picture::Rgb)),
        _ => Err(EmulateError::Channels),
    }
}

impl EyeFrame<'_> {
    fn check(&self) -> Result<(), EmulateError> {
        let expected = [self.picture.width(), self.picture.height()];
        let (depth, view) = (self.depth, self.view);
        let sizes =
            [("a depth", [depth.width(), depth.height()]), ("a view", [view.width, view.height])];
        match sizes.into_iter().find(|(_, found)| *found != expected) {
            Some((what, found)) => Err(EmulateError::Size { what, found, expected }),
            None => Ok(()),
        }
    }

    /// The distance at a pixel; infinite for the sky.
    fn distance(&self, x: usize, y: usize) -> f64 {
        let z = f64::from(self.depth.at(x, y));
        if z.is_finite() && z > 0.0 { z } else { f64::INFINITY }
    }
}

/// Where the pixels of an eye are in the frame of the other one.
struct Places<'a> {
    from: &'a EyeFrame<'a>,
    to: &'a EyeFrame<'a>,
    /// Along both axes: pixels of the other eye for a pixel of this one, and where they begin. 1 and 0 for
    /// eyes with the same view.
    scale: [f64; 2],
    offset: [f64; 2],
    /// Pixels by which a point at distance 1 is farther left in the other eye.
    shift: f64,
}

impl<'a> Places<'a> {
    fn new(from: &'a EyeFrame<'a>, to: &'a EyeFrame<'a>, baseline: f64) -> Self {
        let scale = [0, 1].map(|axis| from.view.focal_px[axis] / to.view.focal_px[axis]);
        let offset = [0, 1]
            .map(|axis| from.view.principal_px[axis] - scale[axis] * to.view.principal_px[axis]);
        Self { from, to, scale, offset, shift: from.view.focal_px[0] * baseline }
    }

    /// Where the other eye sees what is at a pixel, in its pixels; `None` if it does not see it.
    fn source(&self, x: usize, y: usize) -> Option<[f64; 2]> {
        let z = self.to.distance(x, y);
        let at = |axis: usize, i: usize| (i as f64 + 0.5) * self.scale[axis] + self.offset[axis];
        let q = [at(0, x) - self.shift / z, at(1, y)];
        let View { width, height, .. } = *self.from.view;
        let is_inside = (0.0..width as f64).contains(&q[0]) && (0.0..height as f64).contains(&q[1]);
        let is_same = || {
            let seen = self.from.distance(q[0] as usize, q[1] as usize);
            match (z.is_finite(), seen.is_finite()) {
                (true, true) => (seen - z).abs() <= TOLERANCE * z,
                (sky, sky_too) => sky == sky_too,
            }
        };
        (is_inside && is_same()).then_some(q)
    }

    fn fill<const C: usize>(
        &self,
        from: &Image<C>,
        to: &Image<C>,
        picture: impl Fn(Image<C>) -> Picture,
    ) -> Reprojected {
        let (width, height) = (to.width(), to.height());
        // The mask is a channel of an image until all rows are there: rows are filled in parallel.
        let own = Image::<1>::by_rows(width, height, |y, row| {
            for (x, own) in row.iter_mut().enumerate() {
                *own = [if self.source(x, y).is_some() { 0.0 } else { 1.0 }];
            }
        });
        let filled = Image::by_rows(width, height, |y, row| {
            for (x, (out, own)) in row.iter_mut().zip(to.row(y)).enumerate() {
                *out = self.source(x, y).map_or(*own, |[qx, qy]| from.at(qx, qy));
            }
        });
        let flags = own.pixels().iter().map(|[own]| *own > 0.0).collect();
        let reshaded = Mask::new(width, height, flags);
        let reshaded = reshaded.unwrap_or_else(|| unreachable!("a flag for each pixel"));
        Reprojected { picture: picture(filled), reshaded }
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "values are whole or half numbers")]
mod tests;
