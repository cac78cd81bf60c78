//! Bent strokes against the exact ones: rectangles along the pieces and a circle at each corner, point by point.

use glam::{DVec2, DVec3, dvec2, dvec3};
use pleach_silhouette::{Bitmap, Detail, Frame, Layer, LayerPainter, Projection, Rasterizer, Stack, View};
use pleach_tree::{Knot, Parts, Stem, StemKind, Tree};

const SIZE: u32 = 300;

/// A stem of one thickness through `points` of the picture's plane in pixels from its middle, x to the right and y
/// up, straight between them.
fn polyline(points: &[DVec2], radius: f64) -> Tree {
    let place = |p: DVec2| dvec3(p.x, 0.0, p.y);
    let toward = |from: DVec3, to: DVec3| from + (to - from) / 3.0;
    let knot = |i: usize| {
        let here = place(points[i]);
        let before = if i > 0 { place(points[i - 1]) } else { here };
        let after = points.get(i + 1).map_or(here, |p| place(*p));
        Knot { point: here, handle_in: toward(here, before), handle_out: toward(here, after), radius }
    };
    let stem = Stem {
        parent: None,
        level: 0,
        kind: StemKind::Trunk,
        number: 0,
        offset: 0.0,
        first_knot: 0,
        knot_count: points.len() as u32,
    };
    Tree { stems: vec![stem], knots: (0..points.len()).map(knot).collect(), ..Tree::default() }
}

/// One metre per pixel, the origin in the middle.
fn frame() -> Frame {
    let middle = f64::from(SIZE) / 2.0;
    Frame { width: SIZE, height: SIZE, meters_per_pixel: 1.0, axis_column: middle, ground_row: middle }
}

/// Whether `p` lies in the exact stroke: beside a piece, or in a circle around an inner point.
fn is_in_stroke(p: DVec2, points: &[DVec2], radius: f64) -> bool {
    let beside = |a: DVec2, b: DVec2| {
        let (along, length) = ((b - a).normalize(), a.distance(b));
        let ahead = (p - a).dot(along);
        (0.0..=length).contains(&ahead) && (p - a).perp_dot(along).abs() <= radius
    };
    points.windows(2).any(|w| beside(w[0], w[1]))
        || points[1..points.len() - 1].iter().any(|c| p.distance(*c) <= radius)
}

/// Area in pixels of the exact stroke, and its picture: black from half coverage.
fn exact(points: &[DVec2], radius: f64) -> (f64, Bitmap) {
    const FINE: u32 = 8;
    let middle = f64::from(SIZE) / 2.0;
    let mut area = 0.0;
    let bitmap = Bitmap::from_fn(SIZE, SIZE, |x, y| {
        let sample = |i: u32| {
            let at = |v: u32, k: u32| f64::from(v) + (f64::from(k) + 0.5) / f64::from(FINE);
            dvec2(at(x, i % FINE) - middle, middle - at(y, i / FINE))
        };
        let hits = (0..FINE * FINE).filter(|i| is_in_stroke(sample(*i), points, radius)).count();
        area += hits as f64 / f64::from(FINE * FINE);
        hits as u32 * 2 >= FINE * FINE
    });
    (area, bitmap)
}

/// The parts that are wrong: of the area, and of the picture.
fn compare(points: &[DVec2], radius: f64, detail: Detail) -> (f64, f64) {
    let tree = polyline(points, radius);
    let (mut rasterizer, mut ours, mut samples) =
        (Rasterizer::with_detail(detail), Bitmap::default(), Vec::new());
    rasterizer.draw(&tree, &View::FRONT, &frame(), Parts::LEAFY, &mut ours);
    rasterizer.coverage(&mut samples);
    let covered = samples.iter().map(|&s| f64::from(s)).sum::<f64>() / f64::from(rasterizer.samples());
    let (area, bitmap) = exact(points, radius);
    let both = ours.intersection(&bitmap) as f64;
    let union = (ours.ink() + bitmap.ink()) as f64 - both;
    (covered / area - 1.0, 1.0 - both / union)
}

#[track_caller]
fn assert_exact(name: &str, points: &[DVec2], radius: f64) {
    for detail in [Detail::Full, Detail::Half] {
        let (area, picture) = compare(points, radius, detail);
        assert!(area.abs() < 0.02, "{name} of radius {radius}, {detail:?}: {:.2} % of the ink", 100.0 * area);
        // A pixel's rounding along the rim, and more where there is little but rim.
        let most = 0.02 + 0.1 / radius;
        assert!(picture < most, "{name} of radius {radius}, {detail:?}: {picture:.4} of the picture");
    }
}

#[test]
fn two_equal_pieces_have_the_ink_of_the_exact_stroke() {
    for degrees in [10.0, 22.5, 25.0, 45.0, 60.0, 90.0, 120.0, 150.0, 179.0_f64] {
        for radius in [1.0, 5.0, 20.0] {
            let (sin, cos) = degrees.to_radians().sin_cos();
            for side in [-1.0, 1.0] {
                let points = [
                    dvec2(-20.0, -90.0),
                    dvec2(-20.0, 10.0),
                    dvec2(-20.0, 10.0) + 100.0 * dvec2(side * sin, cos),
                ];
                assert_exact(&format!("{degrees} degrees"), &points, radius);
            }
        }
    }
}

#[test]
fn zigzags_and_closed_curves_have_the_ink_of_the_exact_stroke() {
    let square =
        [dvec2(-60.0, -60.0), dvec2(60.0, -60.0), dvec2(60.0, 60.0), dvec2(-60.0, 60.0), dvec2(-60.0, -60.0)];
    let teeth: Vec<DVec2> =
        (0..9).map(|i| dvec2(f64::from(i) * 20.0 - 80.0, f64::from(i % 2) * 70.0)).collect();
    let back = [dvec2(0.0, -50.0), dvec2(0.0, 50.0), dvec2(0.0, -20.0), dvec2(40.0, -20.0)];
    for radius in [1.0, 4.0] {
        assert_exact("a square", &square, radius);
        assert_exact("teeth", &teeth, radius);
        assert_exact("there and back", &back, radius);
    }
}

#[test]
fn perspective_and_layers_join_alike() {
    let points = [dvec2(-20.0, -90.0), dvec2(-20.0, 10.0), dvec2(80.0, 10.0), dvec2(30.0, 60.0)];
    let tree = polyline(&points, 8.0);
    let (_, bitmap) = exact(&points, 8.0);
    let iou = |ours: &Bitmap| {
        let both = ours.intersection(&bitmap) as f64;
        both / ((ours.ink() + bitmap.ink()) as f64 - both)
    };
    let far = View { projection: Projection::Perspective { distance: 1e5 }, ..View::FRONT };
    let mut ours = Bitmap::default();
    Rasterizer::new().draw(&tree, &far, &frame(), Parts::LEAFY, &mut ours);
    assert!(iou(&ours) > 0.98, "perspective: {}", iou(&ours));
    let (mut layer, mut stack) = (Layer::default(), Stack::new(&frame(), Detail::Full));
    LayerPainter::new(&View::FRONT, &frame(), Detail::Full).draw(&tree, Parts::LEAFY, &mut layer);
    stack.add(&layer);
    stack.picture(&mut ours);
    assert!(iou(&ours) > 0.98, "layers: {}", iou(&ours));
}
