use fovqa_frame::PlaneSamples;

use super::*;

const SIZE: [usize; 2] = [40, 20];

/// Every pixel differs from all others.
fn picture(of: impl Fn(usize, usize) -> f32 + Sync + Send) -> Picture {
    Picture::Gray(Image::by_rows(SIZE[0], SIZE[1], |y, row| {
        for (x, pixel) in row.iter_mut().enumerate() {
            *pixel = [of(x, y)];
        }
    }))
}

fn depth(of: impl Fn(usize, usize) -> f32) -> Plane {
    let pixels = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y)));
    let samples = pixels.map(|(x, y)| of(x, y)).collect();
    Plane::new(SIZE[0], SIZE[1], PlaneSamples::F32(samples)).unwrap()
}

fn view() -> View {
    let [width, height] = SIZE;
    View { width, height, focal_px: [20.0; 2], principal_px: [20.0, 10.0] }
}

/// What the left eye takes from the right one, `baseline` to its right, or, with a negative one, the
/// other way round. Values of the eye that is filled begin at 1000.
fn taken(from: &Plane, to: &Plane, baseline: f64) -> Reprojected {
    let [theirs, own] = [0.0, 1000.0].map(|first| picture(move |x, y| first + (x + 40 * y) as f32));
    let view = view();
    let eye = |picture, depth| EyeFrame { picture, depth, view: &view };
    reproject(&eye(&theirs, from), &eye(&own, to), baseline).unwrap()
}

fn value(reprojected: &Reprojected, x: usize, y: usize) -> f32 {
    reprojected.picture.values()[x + SIZE[0] * y]
}

/// Pixels of row 10 that are shaded again.
fn reshaded(reprojected: &Reprojected) -> Vec<usize> {
    (0..SIZE[0]).filter(|x| reprojected.reshaded.row(10)[*x]).collect()
}

/// 20 px · 0.5 / 2 = 5 px: a plane is there, five pixels farther left in the eye on the right.
#[test]
fn a_plane_is_shifted_and_only_its_edge_is_shaded_again() {
    let plane = depth(|_, _| 2.0);
    let left = taken(&plane, &plane, 0.5);
    assert_eq!(reshaded(&left), [0, 1, 2, 3, 4]);
    assert_eq!((value(&left, 4, 10), value(&left, 5, 10)), (1404.0, 400.0));
    assert_eq!(value(&left, 39, 19), 34.0 + 19.0 * 40.0);
    let right = taken(&plane, &plane, -0.5);
    assert_eq!(reshaded(&right), [35, 36, 37, 38, 39]);
    assert_eq!((value(&right, 34, 10), value(&right, 35, 10)), (439.0, 1435.0));
    // 20 px · 0.45 / 2 = 4.5 px: between two pixels. The first centre that is inside is that of pixel 4.
    let between = taken(&plane, &plane, 0.45);
    assert_eq!(reshaded(&between), [0, 1, 2, 3]);
    assert_eq!((value(&between, 4, 10), value(&between, 10, 10)), (400.0, 405.5));
}

/// A square at depth 1 before a wall at 4: 10 px and 2.5 px. What is beside the square in the left eye is
/// behind it in the right one.
#[test]
fn what_the_other_eye_does_not_see_is_shaded_again() {
    // Columns 20 to 25 of the left eye, 10 to 15 of the right one.
    let of = |first: usize| {
        depth(move |x, y| if (first..first + 6).contains(&x) && y > 4 { 1.0 } else { 4.0 })
    };
    let left = taken(&of(10), &of(20), 0.5);
    // The wall at x - 2.5 is behind columns 10 to 15 of the right eye: columns 12.5 to 18.5 here.
    assert_eq!(reshaded(&left), [0, 1, 12, 13, 14, 15, 16, 17]);
    assert_eq!(value(&left, 20, 10), 410.0);
    assert!(left.reshaded.row(2)[..2].iter().all(|own| *own));
    assert!(!left.reshaded.row(2)[2..].iter().any(|own| *own));
}

#[test]
fn depths_that_differ_by_more_than_a_twentieth_are_other_surfaces() {
    let near = depth(|_, _| 2.0);
    for (there, same) in [(2.0, true), (2.099, true), (1.901, true), (2.101, false), (1.899, false)]
    {
        let taken = taken(&depth(|_, _| there), &near, 0.5);
        assert_eq!(!taken.reshaded.row(10)[20], same, "{there}");
    }
    // A twentieth of the depth of the pixel that is filled, not of the other one.
    assert!(
        taken(&depth(|_, _| 19.0), &depth(|_, _| 20.0), 0.5).reshaded.row(0)[20..]
            .iter()
            .all(|own| !own)
    );
    assert!(
        taken(&depth(|_, _| 20.0), &depth(|_, _| 19.0), 0.5).reshaded.row(0)[20..]
            .iter()
            .all(|own| *own)
    );
}

#[test]
fn the_sky_is_infinitely_far() {
    let plane = depth(|_, _| 2.0);
    for sky in [f32::INFINITY, f32::NAN, 0.0, -1.0] {
        let all_sky = depth(|_, _| sky);
        let taken_sky = taken(&all_sky, &depth(|_, _| f32::INFINITY), 0.5);
        assert_eq!(reshaded(&taken_sky), Vec::<usize>::new());
        assert_eq!(value(&taken_sky, 7, 10), 407.0, "without parallax");
        assert_eq!(taken(&plane, &all_sky, 0.5).reshaded.left_out(), 0, "{sky}");
        assert_eq!(taken(&all_sky, &plane, 0.5).reshaded.left_out(), 0, "{sky}");
    }
}

/// Each eye may have its own field of view, as in most headsets.
#[test]
fn views_may_differ() {
    let plane = depth(|_, _| 2.0);
    let (own, theirs) = (picture(|_, _| 9.0), picture(|x, _| x as f32));
    let to = View { principal_px: [15.0, 10.0], ..view() };
    let from = View { principal_px: [25.0, 10.0], focal_px: [40.0, 20.0], ..view() };
    let taken = reproject(
        &EyeFrame { picture: &theirs, depth: &plane, view: &from },
        &EyeFrame { picture: &own, depth: &plane, view: &to },
        0.5,
    );
    // x = 15.5 is 0.5 px / 20 px to the right of its axis: 1 px of the other eye, less 40 px · 0.5 / 2,
    // from 25 on: 16, between pixels 15 and 16.
    assert_eq!(value(&taken.unwrap(), 15, 3), 15.5);
}

#[test]
fn frames_that_do_not_fit_are_refused() {
    let (plane, gray, view) = (depth(|_, _| 2.0), picture(|_, _| 0.5), view());
    let good = EyeFrame { picture: &gray, depth: &plane, view: &view };
    let colour = Picture::Rgb(Image::by_rows(SIZE[0], SIZE[1], |_, row| row.fill([0.5; 3])));
    let other = EyeFrame { picture: &colour, ..good };
    assert_eq!(reproject(&other, &good, 0.5), Err(EmulateError::Channels));
    let small = Plane::new(2, 1, PlaneSamples::F32(vec![1.0; 2])).unwrap();
    let bad = EyeFrame { depth: &small, ..good };
    for (from, to) in [(bad, good), (good, bad)] {
        let error = reproject(&from, &to, 0.5).unwrap_err().to_string();
        assert_eq!(error, "a depth of 2x1 in an emulation of 40x20");
    }
}
