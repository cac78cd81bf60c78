//! Triangles inside a simple polygon, by cutting ears (Meisters 1975).

type Point = [f32; 2];

/// Splits a simple polygon, counter-clockwise, into `corners − 2` triangles, counter-clockwise.
///
/// Of all ears the best-shaped is cut first, so that slivers are rare. Cubic in the number of corners;
/// a leaf has at most 35.
pub(crate) fn triangulate(outline: &[Point]) -> Vec<[u32; 3]> {
    let mut left: Vec<u32> = (0..outline.len() as u32).collect();
    let mut triangles = Vec::new();
    while left.len() > 3 {
        let n = left.len();
        let at = |i: usize| left[i % n];
        let best = (0..n)
            .filter(|&i| is_ear(outline, &left, [at(i + n - 1), at(i), at(i + 1)]))
            .map(|i| (i, quality(outline, [at(i + n - 1), at(i), at(i + 1)])))
            // The first of equals wins, on every platform.
            .fold(None, |best: Option<(usize, f32)>, ear| match best {
                Some(b) if b.1 >= ear.1 => Some(b),
                _ => Some(ear),
            });
        let i = best.map_or(0, |b| b.0);
        triangles.push([at(i + n - 1), at(i), at(i + 1)]);
        left.remove(i);
    }
    if let [a, b, c] = left[..] {
        triangles.push([a, b, c]);
    }
    triangles
}

fn cross(o: Point, a: Point, b: Point) -> f32 {
    (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])
}

fn is_ear(outline: &[Point], left: &[u32], ear: [u32; 3]) -> bool {
    let [a, b, c] = ear.map(|i| outline[i as usize]);
    if cross(a, b, c) <= 0.0 {
        return false;
    }
    left.iter().filter(|i| !ear.contains(i)).all(|&i| {
        let p = outline[i as usize];
        cross(a, b, p) < 0.0 || cross(b, c, p) < 0.0 || cross(c, a, p) < 0.0
    })
}

/// Area over the sum of squared edges: largest for an equilateral triangle.
fn quality(outline: &[Point], ear: [u32; 3]) -> f32 {
    let [a, b, c] = ear.map(|i| outline[i as usize]);
    let square = |p: Point, q: Point| {
        let (x, y) = (p[0] - q[0], p[1] - q[1]);
        x * x + y * y
    };
    cross(a, b, c) / (square(a, b) + square(b, c) + square(c, a))
}

#[cfg(test)]
mod tests {
    use super::*;
    use pleach_plant::leaf_shape::LeafShape;

    #[test]
    fn triangles_fill_every_leaf_exactly() {
        for shape in LeafShape::ALL {
            let outline = shape.outline().corners();
            let triangles = triangulate(outline);
            assert_eq!(triangles.len(), outline.len() - 2, "{shape:?}");
            let areas: Vec<f32> = triangles.iter().map(|t| cross_of(outline, *t) / 2.0).collect();
            assert!(areas.iter().all(|a| *a > 0.0), "{shape:?}: {areas:?}");
            let total: f32 = areas.iter().sum();
            assert!((total - shape.outline().area()).abs() < 1e-5, "{shape:?}: {total}");
        }
    }

    fn cross_of(outline: &[Point], t: [u32; 3]) -> f32 {
        let [a, b, c] = t.map(|i| outline[i as usize]);
        cross(a, b, c)
    }
}
