use super::*;
use proptest::prelude::*;

fn told(origin: &str, text: &str) -> String {
    match read_skeleton(origin, text.as_bytes()) {
        Ok(tree) => {
            tree.well_formed().unwrap();
            format!("{} stems", tree.stems.len())
        }
        Err(error) => error.to_string(),
    }
}

/// Kinds, levels and offsets.
fn stems(tree: &Tree) -> Vec<(StemKind, Option<u32>, u16, f64)> {
    tree.stems
        .iter()
        .map(|stem| (stem.kind, stem.parent, stem.level, (stem.offset * 1e6).round() / 1e6))
        .collect()
}

#[test]
fn nodes_of_one_type_become_stems_by_their_thickness() {
    // A trunk that forks into a thick and a thin arm; the thin one comes first, and parents after their children.
    let swc = "\u{feff}# scanned\n4 3 0 0 4 0.1 2\n1 1 0 0 0 0.3 -1\n3 3 1 0 3 0.05 2\n2 3 0 0 2 0.2 1 # the fork\n";
    let tree = read_skeleton("a.SWC", swc.as_bytes()).unwrap();
    tree.well_formed().unwrap();
    use StemKind::{Branch, Trunk};
    assert_eq!(stems(&tree), [(Trunk, None, 0, 0.0), (Branch, Some(0), 1, 2.0)]);
    assert_eq!(tree.knots_of(&tree.stems[0]).len(), 3);
    let branch = tree.knots_of(&tree.stems[1]);
    assert_eq!((branch[0].point, branch[0].radius), (DVec3::Z * 2.0, 0.05), "as thin as it is further on");
}

#[test]
fn types_that_are_levels_are_kept() {
    // A fork goes on at the level of its parent, a branch one deeper.
    let swc = "1 5 0 0 0 0.3 -1\n2 5 0 0 2 0.2 1\n3 5 0 0 2 0.1 2\n4 5 1 0 3 0.1 3\n5 6 0 0 2 0.02 2\n6 6 0 1 2 0.01 5\n";
    let tree = read_skeleton("a.swc", swc.as_bytes()).unwrap();
    use StemKind::{Branch, Fork, Trunk};
    assert_eq!(stems(&tree), [(Trunk, None, 0, 0.0), (Fork, Some(0), 0, 2.0), (Branch, Some(0), 1, 2.0)]);
}

#[test]
fn points_that_are_there_twice_end_no_stem() {
    let swc = "1 3 5 5 5 1 -1\n2 3 5 5 5 1 1\n3 3 5 5 6 1 2\n4 3 5 5 6 1 3\n5 3 5 5 7 1 4\n6 3 5 5 7 0.5 5\n";
    let tree = read_skeleton("a.swc", swc.as_bytes()).unwrap();
    assert_eq!(tree.stems.len(), 1, "and a branch without a length is none");
    let points: Vec<DVec3> = tree.knots.iter().map(|knot| knot.point).collect();
    assert_eq!(points, [DVec3::ZERO, DVec3::Z, DVec3::Z * 2.0], "the foot is the origin");
}

#[test]
fn branches_of_a_stem_without_length_stand_on_what_is_below_it() {
    let swc = "1 5 0 0 0 1 -1\n2 5 0 0 4 1 1\n3 6 0 0 4 0.5 2\n4 7 0 0 4 0.2 3\n5 7 1 0 4 0.2 4\n";
    let tree = read_skeleton("a.swc", swc.as_bytes()).unwrap();
    tree.well_formed().unwrap();
    assert_eq!(stems(&tree), [(StemKind::Trunk, None, 0, 0.0), (StemKind::Branch, Some(0), 1, 4.0)]);
}

#[test]
fn several_trunks_are_one_tree() {
    assert_eq!(told("a.swc", "1 3 0 0 0 1 -1\n2 3 0 0 1 1 1\n8 3 2 0 0 1 -1\n9 3 2 0 1 1 8\n"), "2 stems");
}

/// A trunk of two cylinders with a branch on the middle of the second one.
const ROWS: [[&str; 11]; 3] = [
    ["0.2", "2", "100", "50", "7", "0", "0", "1", "0", "2", "0"],
    ["0.1", "2", "100", "50", "9", "0", "0", "1", "1", "0", "0"],
    ["0.05", "1.5", "100", "50", "10", "1", "0", "0", "2", "0", "1"],
];

fn table(headings: &str, separator: &str, decimal: &str) -> String {
    let rows = ROWS.map(|row| row.map(|cell| cell.replace('.', decimal)).join(separator));
    format!("{headings}\n{}\n", rows.join("\n"))
}

#[test]
fn columns_of_cylinders_are_known_by_the_names_of_other_programs() {
    let expected = stems(
        &read_skeleton(
            "a.csv",
            table(
                "radius,length,start.x,start.y,start.z,axis.x,axis.y,axis.z,parent,extension,BranchOrder",
                ",",
                ".",
            )
            .as_bytes(),
        )
        .unwrap(),
    );
    assert_eq!(expected, [(StemKind::Trunk, None, 0, 0.0), (StemKind::Branch, Some(0), 1, 3.0)]);
    for (headings, separator, decimal) in [
        (
            "Radius;Length;Start_X;Start_Y;Start_Z;Axis_X;Axis_Y;Axis_Z;Parent;Extension;Branch_Order",
            ";",
            ",",
        ),
        (
            "radius_cyl,length,startX,startY,startZ,axisX,axisY,axisZ,parent_ID,extension_ID,branching_order",
            ",",
            ".",
        ),
        ("radius (m)\tlength (m)\tstart_point\taxis_direction\tparent\textension\tbranch_order", "\t", "."),
        (
            "Radius,Length,Start X,Start Y,Start Z,Axis X,Axis Y,Axis Z,Parent,extension,Branch order",
            ",",
            ".",
        ),
    ] {
        let text = table(headings, separator, decimal);
        let read =
            read_skeleton("a.csv", text.as_bytes()).unwrap_or_else(|error| panic!("{headings}: {error}"));
        assert_eq!(stems(&read), expected, "{headings}");
    }
}

#[test]
fn cylinders_with_ends_and_without_extensions_are_read() {
    let text = "ID;parentID;startX;startY;startZ;endX;endY;endZ;radius;branchOrder;branchID\n\
                0;-1;0;0;0;0;0;2;0.2;0;0\n1;0;0;0;2;0;0;4;0.1;0;0\n2;1;0;0;3;1,5;0;3;0.05;1;1\n";
    let mixed = told("a.csv", text);
    assert!(mixed.starts_with("a.csv:4: `endX` is `1,5`, with a comma, while line 2"), "{mixed}");
    let tree = read_skeleton("a.csv", text.replace("1,5", "1.5").as_bytes()).unwrap();
    assert_eq!(stems(&tree), [(StemKind::Trunk, None, 0, 0.0), (StemKind::Branch, Some(0), 1, 3.0)]);
}

#[test]
fn radii_change_evenly_along_a_stem() {
    let text =
        table("radius,length,start_x,start_y,start_z,axis_x,axis_y,axis_z,parent,extension,x", ",", ".");
    let tree = read_skeleton("a.csv", text.as_bytes()).unwrap();
    let radii: Vec<f64> = tree.knots.iter().map(|knot| (knot.radius * 1e6).round() / 1e6).collect();
    assert_eq!(radii, [0.25, 0.15, 0.05, 0.05, 0.05]);
}

#[test]
fn what_is_no_skeleton_is_told_with_its_line() {
    for (origin, text, message) in [
        ("a.swc", "", "a.swc:1: there is no stem"),
        ("a.swc", "1 1 0 0 0 1 -1\n", "a.swc:1: there is no stem"),
        ("a.swc", "1 1 0 0 0 0 -1\n2 1 0 0 1 0 1\n", "a.swc:1: every radius is 0"),
        ("a.swc", "1 1 0 0 0 1 -1\n2 1 0 0\n", "a.swc:2: the line has 4 numbers, expected seven"),
        ("a.swc", "1 1 0 0 0 1 -1\n2 1 0 NaN 1 1 1\n", "a.swc:2: the y is `NaN`, expected a number"),
        (
            "a.swc",
            "1 1 0 0 0 1 -1\n2 1 0 1,5 1 1 1\n",
            "a.swc:2: the y is `1,5`, expected a number with a decimal point",
        ),
        ("a.swc", "# x\n1.5 1 0 0 0 1 -1\n", "a.swc:2: the number is `1.5`, expected a whole number"),
        ("a.swc", "1 1 0 0 0 -1 -1\n", "a.swc:1: the radius is -1, expected 0 or more"),
        ("a.swc", "1 1 0 0 0 1 -1\n1 1 0 0 1 1 1\n", "a.swc:2: the number 1 is there already, in line 1"),
        ("a.swc", "1 1 0 0 0 1 -1\n2 1 0 0 1 1 7\n", "a.swc:2: the parent is 7, and no row has this number"),
        (
            "a.swc",
            "1 1 0 0 0 1 -1\n2 1 0 0 1 1 4\n3 1 0 0 2 1 2\n4 1 0 0 3 1 3\n",
            "a.swc:2: the row is above itself",
        ),
        ("a.swc", "1 1 0 0 0 1 1\n", "a.swc:1: the row is above itself"),
        (
            "a.swc",
            "1 1 0 0 0 1 -1\n2 1 0 0 1e9 1 1\n",
            "a.swc:1: a point of the stem that begins here is more than 10000 m",
        ),
        ("a.csv", "radius,length\n1,2\n", "a.csv:1: the columns of cylinders are missing: start_x"),
        (
            "a.csv",
            "radius,start_x,start_y,start_z,parent\n",
            "a.csv:1: the columns of cylinders are missing: axis_x",
        ),
        (
            "a.csv",
            "start_x,start_y,start_z,end_x,end_y,end_z,parent\n",
            "a.csv:1: no column is called `radius`",
        ),
        (
            "a.csv",
            "radius,start_x,start_y,start_z,end_x,end_y,end_z,parent\n1,0,0,0,0,0,1,0.5\n",
            "a.csv:2: the parent is `0.5`, expected a whole number",
        ),
        (
            "a.csv",
            "radius,start_x,start_y,start_z,end_x,end_y,end_z,parent\n1,0,0,0,0,0,1,0\n1,0,0,1,0,0,2,3\n",
            "a.csv:3: the parent is 3, and no row has this number",
        ),
        (
            "a.csv",
            "radius,start_x,start_y,start_z,end_x,end_y,end_z,parent\n1,0,0,0,0,0,1,2\n1,0,0,1,0,0,2,1\n",
            "a.csv:2: the row is above itself",
        ),
        (
            "a.csv",
            "radius,length,start_x,start_y,start_z,axis_x,axis_y,axis_z,parent\n1,1,0,0,0,0,0,0,0\n",
            "a.csv:2: the axis has no length",
        ),
        (
            "a.csv",
            "radius,length,start_x,start_y,start_z,axis_x,axis_y,axis_z,parent\n1,-1,0,0,0,0,0,1,0\n",
            "a.csv:2: the length is -1",
        ),
        (
            "a.csv",
            "radius,length,start_x,start_y,start_z,axis_x,axis_y,axis_z,parent\n-1,1,0,0,0,0,0,1,0\n",
            "a.csv:2: the radius is -1",
        ),
        (
            "a.csv",
            "radius,length,start_x,start_y,start_z,axis_x,axis_y,axis_z,parent\n1,,0,0,0,0,0,1,0\n",
            "a.csv:2: `length` is empty",
        ),
    ] {
        let told = told(origin, text);
        assert!(told.starts_with(message), "expected {message}, told {told}");
    }
}

#[test]
fn files_beyond_any_tree_are_refused() {
    let large = vec![b'#'; MAX_SKELETON_BYTES as usize + 1];
    assert!(read_skeleton("a.swc", &large).unwrap_err().to_string().contains("more than 67108864 bytes"));
    let long = "1 1 0 0 0 1 -1\n".repeat(MAX_ROWS + 1);
    assert!(told("a.swc", &long).starts_with("a.swc:1000001: there are more than 1000000 nodes"));
}

#[test]
fn a_chain_as_long_as_can_be_is_one_stem() {
    let node = |i: usize| {
        format!("{} 3 0 0 {} 0.01 {}\n", i + 1, i as f64 * 1e-3, if i == 0 { -1 } else { i as i64 })
    };
    let text: String = (0..100_000).map(node).collect();
    assert_eq!(told("a.swc", &text), "1 stems");
    // As many levels as there are nodes: each has a branch that goes on.
    let node = |i: usize| {
        format!(
            "{} {} 0 0 {} {} {}\n",
            i + 1,
            5 + i / 2,
            (i / 2 + i % 2) as f64 * 1e-3,
            1.0 / (1 + i) as f64,
            if i == 0 { -1 } else { i as i64 }
        )
    };
    let text: String = (0..200_000).map(node).collect();
    assert_eq!(told("a.swc", &text), "100000 stems");
}

proptest! {
    #[test]
    fn any_rows_are_a_tree_or_an_error(rows in proptest::collection::vec((0..12_i64, 0..9_i64, 0..3_i32, 0..3_i32, 0..3_i32, -1..13_i64), 0..12)) {
        let swc: String = rows.iter().map(|(n, t, x, z, r, p)| format!("{n} {t} {x} 0 {z} {r} {p}\n")).collect();
        told("a.swc", &swc);
        let unique: String = rows.iter().enumerate().map(|(n, (_, t, x, z, r, p))| format!("{n} {t} {x} 0 {z} {r} {p}\n")).collect();
        told("a.swc", &unique);
        for headings in ["parent,extension,branchorder", "parent,branch,branchorder", "parent,x,branchorder"] {
            let csv: String = rows.iter().map(|(n, t, x, z, r, p)| format!("{r},{x},0,{z},{r},{t},{z},{p},{n},{t}\n")).collect();
            told("a.csv", &format!("radius,startx,starty,startz,endx,endy,endz,{headings}\n{csv}"));
        }
    }
}

#[test]
fn any_type_of_a_node_is_read() {
    for kind in [i64::MIN, i64::MAX] {
        let swc = format!("1 {kind} 0 0 0 0.1 -1\n2 {kind} 0 0 1 0.1 1\n");
        let tree = read_skeleton("a.swc", swc.as_bytes());
        assert!(tree.is_ok_and(|tree| tree.stems.len() == 1), "{kind}");
    }
}
