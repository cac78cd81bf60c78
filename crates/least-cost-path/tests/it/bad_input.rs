//! What is wrong in a species file is told with its place; what cannot grow is an error.

use pleach_least_cost_path::LeastCostPathFamily;
use pleach_tree::{GrowError, Growth, Limits, Species, SpeciesDoc};

fn read(text: &str) -> Result<Species, String> {
    let doc = SpeciesDoc::parse("t", text).and_then(|doc| doc.species(&LeastCostPathFamily));
    doc.map_err(|error| error.to_string())
}

fn top(species: &Species) -> f64 {
    species.grow(1).unwrap().knots.iter().map(|knot| knot.point.z).fold(0.0, f64::max)
}

#[test]
fn curves_that_cannot_be_drawn_are_told_with_their_place() {
    for (text, message) in [
        ("outline = \"\"", "t:1:11: `outline` is an empty SVG path"),
        (
            "outline = \"M 3 4\"",
            "t:1:11: `outline` encloses nothing: it needs a height, and a distance from its axis",
        ),
        ("outline = \"M 0 0 L 0 9\"", "encloses nothing"),
        ("outline = \"M 0 0 L 9 0\"", "encloses nothing"),
        ("outline = \"M 30 0 C 80 -20 -1e308 -175 0 -180\"", "coordinates beyond a thousand million"),
        ("outline = \"M 0 0 L NaN 3\"", "is not an SVG path"),
        ("outline = \"M 0 0 L 1e999 3\"", "finite"),
        ("outline = \"hello\"", "is not an SVG path"),
        ("outline = []", "encloses nothing"),
        ("outline = [[1, 0], [nan, 1]]", "t:1:21: `outline` is NaN, which is not a finite number"),
        ("outline = [[1, 0], [-1, 1]]", "t:1:21: `outline` is -1, which is out of range"),
        ("outline = [[1, 0], [1, inf]]", "t:1:24: `outline` is inf, which is not a finite number"),
        ("outline = [[1, 0, 2]]", "has 3 values, expected 2"),
        ("outline = [1, 2]", "t:1:12: `outline` is a number, expected a point: [radius, height]"),
        ("outline = 3", "t:1:11: `outline` is a number, expected an SVG path, an array of points or a table"),
        ("outline = { radii = [[1, 2], [1]] }", "as many directions"),
        ("outline = { radii = [[0, 0], [0, 0]] }", "a radius above zero"),
        ("outline = { radius = 1 }", "expected `radii`"),
    ] {
        let error = read(text).map(|species| species.name).unwrap_err();
        assert!(error.contains(message), "{text}: {error}");
    }
}

#[test]
fn arcs_are_drawn() {
    let rest = "crown_shape = \"revolution\"\nnodes = 300\nsubgraph_nodes = 20\ncrown_height = 4\ncrown_radius = 2\n";
    let arc = read(&format!("{rest}outline = \"M 0 0 A 50 50 0 0 0 0 -100\"")).unwrap();
    let circle: Vec<String> = (0..=60)
        .map(|i| (f64::from(i) * 3.0_f64).to_radians())
        .map(|t| format!("[{:?}, {:?}]", t.sin().abs(), 1.0 - t.cos()))
        .collect();
    let points = read(&format!("{rest}outline = [{}]", circle.join(", "))).unwrap();
    assert!((top(&arc) - top(&points)).abs() < 0.3, "{} and {}", top(&arc), top(&points));
}

#[test]
fn volumes_are_checked_part_by_part() {
    for (text, message) in [
        ("volumes = []", "`volumes` has 0 parts, expected 1 to 200"),
        ("volumes = 1", "`volumes` is a number, expected an array of tables"),
        ("volumes = [1]", "`volumes[0]` is a number, expected a table with a shape"),
        (
            "volumes = [{ shape = \"cube\" }]",
            "`cube`, which is not one of stem, cylinder, cone, sphere, ellipsoid",
        ),
        ("volumes = [{ shape = \"sphere\", radius = 1 }]", "`volumes[0].center` is missing"),
        (
            "volumes = [{ shape = \"sphere\", center = [0, 0, nan], radius = 1 }]",
            "t:1:48: `volumes[0].center` is NaN",
        ),
        ("volumes = [{ shape = \"sphere\", center = [0, 0, 1], radius = -1 }]", "out of range"),
        (
            "volumes = [{ shape = \"sphere\", center = [0, 0, 1], radius = 1, to = 2 }]",
            "`volumes[0].to` is not a known name",
        ),
    ] {
        let error = read(text).map(|species| species.name).unwrap_err();
        assert!(error.contains(message), "{text}: {error}");
    }
}

#[test]
fn a_volume_without_content_is_an_error() {
    let flat = read("volumes = [{ shape = \"sphere\", center = [0, 0, 1], radius = 0 }]").unwrap();
    assert!(matches!(flat.grow(1), Err(GrowError::Conflict(_))));
    let below = read("volumes = [{ shape = \"sphere\", center = [0, 0, -9], radius = 1 }]").unwrap();
    assert!(matches!(below.grow(1), Err(GrowError::Conflict(_))));
    let error = read("nodes = 0").map(|species| species.name).unwrap_err();
    assert!(error.contains("`nodes` is 0, which is out of range: allowed is 10 to 1000000"), "{error}");
}

#[test]
fn extremes_grow_or_are_errors() {
    for text in [
        "nodes = 10\nbranching = [400, 400, 1, 1, 1, 1, 1, 1]",
        "subgraph_nodes = 5\nbranching = [1, 1, 1, 1, 1, 1, 1, 1]\nlevels = 8",
        "crown_angle = 5\nangle = [5, 5, 5, 5, 5, 5, 5, 5]\nnodes = 200",
        "crown_angle = 180\nangle = [180, 180, 180, 180, 180, 180, 180, 180]\nnodes = 200",
        "spacing = 0\nnodes = 200",
        "spacing = 0.85\nnodes = 200",
        "trunk_height = 0\nroot_depth = 20\nroot_laterals = 0",
        "trunk_height = 60\ntrunk_width = 0.01\ncrown_radius = 0.05\nnodes = 300",
        "trunk_lean = 80\ncrown_radius = 60\nnodes = 300",
        "clusters = 20\nnodes = 400",
        "clusters = 5\ntrunk_height = 0\nnodes = 400",
        "shell = 0.02\nnodes = 20",
        "weight_randomness = 1\nlink = 1.2\nnodes = 300",
        "graph = \"threshold\"\nlink = 1.2\nnodes = 300",
        "lifespan = 0",
        "light_branching = 1\nlight_lifespan = 6\nlifespan_end = 0.95\nlifespan_drop = \"random\"",
        "orientation = [0, 1, 1, 1, 1, 1, 1, 1]\ntrunk_height = 0",
    ] {
        let species = read(text).unwrap();
        let tree = species.grow(3).unwrap_or_else(|error| panic!("{text}: {error}"));
        assert_eq!(tree.well_formed(), Ok(()), "{text}");
        assert!(!tree.stems.is_empty(), "{text}");
    }
}

#[test]
fn what_is_too_much_is_refused_before_it_is_grown() {
    for text in [
        "nodes = 1000000\nlink = 6",
        "nodes = 1000000\ngraph = \"threshold\"",
        "subgraph_nodes = 20000\nbranching = [400, 400, 400, 400, 400, 400, 400, 400]\nlevels = 8",
    ] {
        let error = read(text).unwrap().grow(1).map(|tree| tree.stems.len()).unwrap_err();
        assert!(matches!(error, GrowError::TooMuchWork { .. }), "{text}: {error}");
    }
    // Darts that find no place, and nodes that lie crowded in a large box, are given up on the way.
    let far = "volumes = [{ shape = \"sphere\", center = [0, 0, 1], radius = 0.1 }, { shape = \"sphere\", center = [900, 900, 900], radius = 0.1 }]";
    let limits = Limits { work: 2_000_000, ..Limits::DEFAULT };
    for (text, blame) in [
        ("nodes = 50000\nlevels = 1\nspacing = 0.85".to_owned(), "because of `spacing` and `nodes`"),
        (format!("nodes = 20000\nlevels = 1\n{far}"), "because of `volumes`"),
        (format!("nodes = 20000\nlevels = 1\nspacing = 0\n{far}"), "because of `volumes`"),
        (
            "subgraph_nodes = 1000\nspacing = 0.85\nbranching = [50, 1, 1, 1, 1, 1, 1, 1]\nlevels = 2"
                .to_owned(),
            "because of `spacing` and `subgraph_nodes`",
        ),
    ] {
        for parallel in [false, true] {
            let grown = read(&text).unwrap().grow_with(&Growth { limits, parallel, ..Growth::seed(1) });
            let told = grown.map(|tree| tree.stems.len()).unwrap_err().to_string();
            assert!(told.contains(blame), "{text}: {told}");
        }
    }
    let small = Limits { work: 1000, ..Limits::DEFAULT };
    let refused = read("").unwrap().grow_with(&Growth { limits: small, ..Growth::seed(1) });
    let told = refused.map(|tree| tree.stems.len()).unwrap_err().to_string();
    assert!(told.contains("because of `nodes`"), "{told}");
}
