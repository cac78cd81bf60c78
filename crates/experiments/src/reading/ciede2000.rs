//! The difference of two colours, as CIEDE2000 has it.
//!
//! Sharma, Wu, Dalal: "The CIEDE2000 color-difference formula: implementation notes, supplementary test data, and
//! mathematical observations" (Color Research and Application 30, 2005), with weights of 1. sRGB is seen in D65.

use pleach_tree::{Color, math};

/// CIE L*a*b*.
type Lab = [f64; 3];

/// The difference of two colours: 1 can just be told apart.
pub(super) fn difference(a: Color, b: Color) -> f64 {
    of_lab(lab(a), lab(b))
}

fn lab(Color(rgb): Color) -> Lab {
    let [r, g, b] = rgb.map(|value| {
        let v = f64::from(value) / 255.0;
        if v <= 0.040_45 { v / 12.92 } else { math::pow((v + 0.055) / 1.055, 2.4) }
    });
    let xyz = [
        (0.412_456_4 * r + 0.357_576_1 * g + 0.180_437_5 * b) / 0.950_47,
        0.212_672_9 * r + 0.715_152_2 * g + 0.072_175_0 * b,
        (0.019_333_9 * r + 0.119_192_0 * g + 0.950_304_1 * b) / 1.088_83,
    ];
    let [x, y, z] =
        xyz.map(|t| if t > 216.0 / 24389.0 { math::cbrt(t) } else { (24389.0 / 27.0 * t + 16.0) / 116.0 });
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

fn of_lab([l1, a1, b1]: Lab, [l2, a2, b2]: Lab) -> f64 {
    let seventh = |c: f64| {
        let c7 = math::powi(c, 7);
        (c7 / (c7 + math::powi(25.0, 7))).sqrt()
    };
    let mean_c = (math::hypot(a1, b1) + math::hypot(a2, b2)) / 2.0;
    let g = 0.5 * (1.0 - seventh(mean_c));
    let (a1, a2) = ((1.0 + g) * a1, (1.0 + g) * a2);
    let (c1, c2) = (math::hypot(a1, b1), math::hypot(a2, b2));
    let angle = |a: f64, b: f64| {
        if a == 0.0 && b == 0.0 { 0.0 } else { math::atan2(b, a).to_degrees().rem_euclid(360.0) }
    };
    let (h1, h2) = (angle(a1, b1), angle(a2, b2));
    let is_grey = c1 * c2 == 0.0;
    let turn = match h2 - h1 {
        _ if is_grey => 0.0,
        d if d > 180.0 => d - 360.0,
        d if d < -180.0 => d + 360.0,
        d => d,
    };
    let sin = |degrees: f64| math::sin(degrees.to_radians());
    let cos = |degrees: f64| math::cos(degrees.to_radians());
    let (dl, dc, dh) = (l2 - l1, c2 - c1, 2.0 * (c1 * c2).sqrt() * sin(turn / 2.0));
    let (l, c) = ((l1 + l2) / 2.0, (c1 + c2) / 2.0);
    let h = match (h1 + h2, (h1 - h2).abs()) {
        (sum, _) if is_grey => sum,
        (sum, apart) if apart <= 180.0 => sum / 2.0,
        (sum, _) if sum < 360.0 => (sum + 360.0) / 2.0,
        (sum, _) => (sum - 360.0) / 2.0,
    };
    let t = 1.0 - 0.17 * cos(h - 30.0) + 0.24 * cos(2.0 * h) + 0.32 * cos(3.0 * h + 6.0)
        - 0.20 * cos(4.0 * h - 63.0);
    let turned = 30.0 * math::exp(-math::powi((h - 275.0) / 25.0, 2));
    let middle = (l - 50.0) * (l - 50.0);
    let sl = 1.0 + 0.015 * middle / (20.0 + middle).sqrt();
    let (sc, sh) = (1.0 + 0.045 * c, 1.0 + 0.015 * c * t);
    let rt = -sin(2.0 * turned) * 2.0 * seventh(c);
    let (l, c, h) = (dl / sl, dc / sc, dh / sh);
    (l * l + c * c + h * h + rt * c * h).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn published_pairs_differ_by_what_was_published() {
        for (a, b, expected) in [
            ([50.0, 2.6772, -79.7751], [50.0, 0.0, -82.7485], 2.0425),
            ([50.0, -1.3802, -84.2814], [50.0, 0.0, -82.7485], 1.0),
            ([50.0, 2.5, 0.0], [50.0, 0.0, -2.5], 4.3065),
            ([50.0, 2.5, 0.0], [73.0, 25.0, -18.0], 27.1492),
            ([60.2574, -34.0099, 36.2677], [60.4626, -34.1751, 39.4387], 1.2644),
            ([2.0776, 0.0795, -1.1350], [0.9033, -0.0636, -0.5514], 0.9082),
        ] {
            for found in [of_lab(a, b), of_lab(b, a)] {
                assert!((found - expected).abs() < 6e-5, "{a:?} {b:?}: {found} is not {expected}");
            }
        }
    }
}
