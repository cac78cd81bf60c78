//! Drawings in the plane.

use pleach_lsystem::{Derivation, GrowFault, LSystem};

fn svg(text: &str) -> Result<String, GrowFault> {
    let system = LSystem::read("test", text).unwrap_or_else(|e| panic!("{e}"));
    system.derive(&Derivation::default()).unwrap().to_svg()
}

#[test]
fn a_square_is_one_line() {
    let drawing = svg("width: 0.1\naxiom: F+F+F+F").unwrap();
    assert!(
        drawing.contains("M1030.0 1030.0L1030.0 30.0L30.0 30.0L30.0 1030.0L1030.0 1030.0\""),
        "{drawing}"
    );
    assert!(drawing.contains("stroke-width=\"100.0\""), "{drawing}");
    assert_eq!(drawing.matches("<path").count(), 1);
}

#[test]
fn gaps_branches_and_polygons_are_shapes_of_their_own() {
    let drawing = svg("angle: 45\naxiom: F f F [ + F ] { -f+f+f }").unwrap();
    // The branch goes on from the line before it.
    assert_eq!(drawing.matches("<path").count(), 3, "{drawing}");
    assert!(drawing.contains("Z\" fill=\"#6f973c\""), "{drawing}");
    assert_eq!(svg("axiom: f+f").unwrap_err(), GrowFault::NothingDrawn);
}
