//! What each parameter of Appendix C does to a tree, seen from outside.

use pleach_tree::{Species, SpeciesDoc, SpeciesError, StemKind, Tree};
use pleach_weber_penn::WeberPennFamily;

pub(super) fn read(text: &str) -> Result<Species, SpeciesError> {
    SpeciesDoc::parse("test.toml", text)?.species(&WeberPennFamily)
}

pub(super) fn grow(text: &str) -> Tree {
    grow_seed(text, 1)
}

fn grow_seed(text: &str, seed: u64) -> Tree {
    let tree = read(text).unwrap_or_else(|e| panic!("{e}")).grow(seed).unwrap();
    tree.well_formed().unwrap();
    tree
}

pub(super) fn stems(tree: &Tree, level: u16) -> Vec<&pleach_tree::Stem> {
    tree.stems.iter().filter(|s| s.level == level).collect()
}

/// A straight trunk of ten metres with straight branches at right angles and no leaves.
pub(super) const PLAIN: &str = "
g_scale = 10
g_scale_v = 0
levels = 2
base_size = [0.2, 0, 0, 0]
down_angle = [0, 90, 0, 0]
down_angle_v = [0, 0, 0, 0]
rotate = [0, 90, 0, 0]
branches = [1, 20, 0, 0]
length = [1, 0.3, 0, 0]
curve = [0, 0, 0, 0]
curve_v = [0, 0, 0, 0]
bend_v = [0, 0, 0, 0]
tropism = [0, 0, 0]
flare = 0
leaf_blos_num = 0
";

pub(super) fn with(lines: &str) -> String {
    let replaced: Vec<&str> = lines.lines().filter_map(|l| l.split('=').next()).map(str::trim).collect();
    let kept = PLAIN.lines().filter(|l| !replaced.contains(&l.split('=').next().unwrap_or("").trim()));
    kept.chain(lines.lines()).collect::<Vec<_>>().join("\n")
}

#[test]
fn shapes_order_the_branch_lengths_as_their_names_say() {
    let lengths = |shape: &str| -> Vec<f64> {
        let tree = grow(&with(&format!("shape = \"{shape}\"")));
        stems(&tree, 1).iter().map(|s| tree.length_of(s)).collect()
    };
    let middle = |l: &[f64]| l[l.len() / 2];
    let conical = lengths("conical");
    assert!(conical.windows(2).all(|w| w[0] > w[1]), "longest below");
    let inverse = lengths("inverse_conical");
    assert!(inverse.windows(2).all(|w| w[0] < w[1]), "longest above");
    let cylindrical = lengths("cylindrical");
    assert!(cylindrical.iter().all(|l| (l - 3.0).abs() < 1e-9));
    let spherical = lengths("spherical");
    assert!(middle(&spherical) > spherical[0] && middle(&spherical) > *spherical.last().unwrap());
    let hemispherical = lengths("hemispherical");
    assert!(hemispherical[0] > 2.9 && hemispherical.last().unwrap() < &1.2);
    let tapered = lengths("tapered_cylindrical");
    assert!(tapered[0] > 2.9 && *tapered.last().unwrap() > 1.4);
    for flame in ["flame", "tend_flame"] {
        let l = lengths(flame);
        let widest = l.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)).unwrap().0;
        assert!(widest > 0 && widest < l.len() / 2, "{flame} is widest below the middle, not at {widest}");
    }
    // The custom shape follows the envelope: widest a tenth above its foot.
    let custom = {
        let text = "shape = \"custom\"\nprune_width_peak = 0.1\nprune_power_high = 1\nprune_power_low = 1";
        let tree = grow(&with(text));
        stems(&tree, 1).iter().map(|s| tree.length_of(s)).collect::<Vec<_>>()
    };
    let widest = custom.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)).unwrap().0;
    assert!((1..4).contains(&widest), "{custom:?}");
}

#[test]
fn base_splits_fork_the_trunk_and_negative_ones_at_random() {
    let trunks = |n: i32, seed| {
        let text = with(&format!("base_splits = {n}\nsplit_angle = [40, 0, 0, 0]"));
        stems(&grow_seed(&text, seed), 0).len()
    };
    assert_eq!(trunks(2, 1), 3);
    let drawn: std::collections::BTreeSet<usize> = (0..40).map(|seed| trunks(-2, seed)).collect();
    assert_eq!(drawn.into_iter().collect::<Vec<_>>(), [1, 2, 3]);
}

#[test]
fn seg_splits_are_diffused_over_segments() {
    let text =
        with("seg_splits = [0.5, 0, 0, 0]\ncurve_res = [11, 3, 1, 1]\nbase_size = [0, 0, 0, 0]\nlevels = 1");
    let tree = grow(&text);
    let clones: Vec<_> = tree.stems.iter().filter(|s| s.kind == StemKind::Fork).collect();
    assert!(!clones.is_empty());
    // The first segment after which the carried error reaches one is the second.
    assert!((clones[0].offset - 2.0 * 10.0 / 11.0).abs() < 1e-9, "{}", clones[0].offset);
    for clone in clones {
        assert_eq!(clone.level, 0);
        let start = tree.knots_of(clone)[0].point;
        let origin = &tree.stems[clone.parent.unwrap() as usize];
        let near = tree.knots_of(origin).iter().map(|k| k.point.distance(start)).fold(1e9, f64::min);
        assert!(near < 1e-9, "a clone starts on the stem that it leaves");
    }
}

#[test]
fn branch_dist_goes_from_alternate_through_opposite_to_whorled() {
    let heights = |dist: f64| -> Vec<f64> {
        let text =
            format!("branch_dist = [0, {dist}, 0, 0]\nbranches = [1, 40, 0, 0]\ncurve_res = [4, 3, 1, 1]");
        let tree = grow(&with(&text));
        stems(&tree, 1).iter().map(|s| s.offset).collect()
    };
    let distinct = |mut h: Vec<f64>| {
        h.sort_by(f64::total_cmp);
        h.dedup_by(|a, b| (*a - *b).abs() < 1e-6);
        h.len()
    };
    let alternate = heights(0.0);
    assert_eq!(distinct(alternate.clone()), alternate.len());
    let opposite = heights(1.0);
    let pairs = distinct(opposite.clone());
    assert!(pairs <= opposite.len() / 2 + 4, "{pairs} heights for {} branches", opposite.len());
    let whorled = heights(4.0);
    assert_eq!(distinct(whorled.clone()) * 5, whorled.len(), "whorls of five");
    let mixed = heights(3.5);
    let whorls = distinct(mixed.clone());
    let mean = mixed.len() as f64 / whorls as f64;
    assert!((4.0..5.0).contains(&mean), "whorls of 4 and 5, not of {mean}");
}

#[test]
fn negative_rotate_lays_branches_to_two_sides() {
    // A second-level branch on a level branch: ±60° from straight down.
    let text = with(
        "levels = 3\nrotate = [0, 90, -120, 0]\nbranches = [1, 6, 10, 0]\nlength = [1, 0.3, 0.3, 0]\n\
         down_angle = [0, 90, 90, 0]\nbase_size = [0.2, 0.1, 0, 0]",
    );
    let tree = grow(&text);
    let twigs = stems(&tree, 2);
    assert!(twigs.len() > 20);
    for twig in twigs {
        let knots = tree.knots_of(twig);
        let direction = (knots[1].point - knots[0].point).normalize();
        assert!((direction.z + 0.5).abs() < 1e-6, "60° from straight down, not z = {}", direction.z);
    }
}

#[test]
fn down_angle_v_is_spread_along_the_parent_when_negative() {
    let text = with("down_angle = [0, 60, 0, 0]\ndown_angle_v = [0, -40, 0, 0]\nbranches = [1, 100, 0, 0]");
    let tree = grow(&text);
    let angles: Vec<f64> = stems(&tree, 1)
        .iter()
        .map(|s| {
            let k = tree.knots_of(s);
            (k[1].point - k[0].point).normalize().z.acos().to_degrees()
        })
        .collect();
    // 60 + 40 at the base, 60 − 24 at the tip, each ± 10 %.
    assert!(angles[0] > 88.0 && *angles.last().unwrap() < 44.0, "{angles:?}");
}

#[test]
fn trunks_from_the_floor_keep_apart_and_face_outwards() {
    let text = with("floor_splits = 12\nlevels = 1\ncurve = [60, 0, 0, 0]\ncurve_res = [6, 1, 1, 1]");
    let tree = grow(&text);
    assert_eq!(tree.stems.len(), 12);
    let spacing = 2.5 * 0.015 * 10.0;
    let base: Vec<_> = tree.stems.iter().map(|s| tree.knots_of(s)[0].point).collect();
    for (i, a) in base.iter().enumerate() {
        assert!(base[..i].iter().all(|b| a.distance(*b) >= spacing));
        let tip = tree.knots_of(&tree.stems[i]).last().unwrap().point;
        let (out, lean) = (a.truncate().normalize(), (tip - *a).truncate().normalize());
        assert!(out.dot(lean) > 0.999, "trunk {i} leans outwards");
    }
}

#[test]
fn fans_of_branches_and_of_leaves_spread_at_the_tip() {
    let tree = grow(&with(
        "branches = [1, -7, 0, 0]\nrotate = [0, 90, 0, 0]\ndown_angle = [0, 0, 0, 0]\ntaper = [0.5, 1, 1, 1]",
    ));
    let fan = stems(&tree, 1);
    assert_eq!(fan.len(), 7);
    let direction = |s: &pleach_tree::Stem| {
        let k = tree.knots_of(s);
        (k[1].point - k[0].point).normalize()
    };
    let spread = direction(fan[0]).angle_between(direction(fan[6])).to_degrees();
    assert!((spread - 90.0).abs() < 1e-6, "{spread}");

    let palm = pleach_weber_penn::preset("fan_palm").unwrap().grow(1).unwrap();
    let first = palm.leaves[0].stem;
    let on_one: Vec<_> = palm.leaves.iter().filter(|l| l.stem == first).collect();
    assert!(on_one.len() > 20 && on_one.iter().all(|l| l.position.distance(on_one[0].position) < 0.05));
}

#[test]
fn children_start_inside_the_rim_of_their_parent() {
    for name in ["quaking_aspen", "black_oak", "sphere_tree", "palm"] {
        let tree = pleach_weber_penn::preset(name).unwrap().grow(3).unwrap();
        for stem in tree.stems.iter().filter(|s| s.kind == StemKind::Branch) {
            let parent = &tree.stems[stem.parent.unwrap() as usize];
            let start = tree.knots_of(stem)[0];
            let (mut nearest, mut radius_there) = (f64::INFINITY, 0.0);
            for (piece, r0, r1) in tree.pieces_of(parent) {
                for i in 0..=32 {
                    let t = f64::from(i) / 32.0;
                    let d = piece.at(t).distance(start.point);
                    if d < nearest {
                        // A palm's last bead closes between its last two knots, and not in a line.
                        (nearest, radius_there) = (d, if r1 > 0.0 { r0 + (r1 - r0) * t } else { r0 });
                    }
                }
            }
            let slack = 0.02 * tree.length_of(parent) / f64::from(parent.knot_count) + 0.03;
            assert!(
                nearest <= radius_there + slack,
                "{name}: {nearest} from the axis, radius {radius_there}"
            );
        }
    }
}

#[test]
fn pruning_fits_the_envelope_and_the_ratio_fades_it() {
    let reach = |ratio: f64, extra: &str| {
        let text =
            with(&format!("length = [0.9, 0.8, 0, 0]\nprune_ratio = {ratio}\nprune_width = 0.2\n{extra}"));
        let tree = grow(&text);
        let far = |s: &&pleach_tree::Stem| tree.knots_of(s).last().unwrap().point.truncate().length();
        stems(&tree, 1).iter().map(far).fold(0.0, f64::max)
    };
    let (free, half, full) = (reach(0.0, ""), reach(0.5, ""), reach(1.0, ""));
    assert!(full < 2.0 && half > full && free > half, "{full} {half} {free}");
}

#[test]
fn pruning_by_the_envelope_leaves_a_trunk_to_every_seed() {
    // Trunks that lean and bend so far that for some seeds no length of them fits.
    let text = with("curve = [60, 0, 0, 0]\ncurve_v = [180, 0, 0, 0]\nprune_ratio = 1\nprune_width = 0.3");
    let species = read(&text).unwrap();
    let trunks = |seed| species.grow(seed).map(|tree| stems(&tree, 0).len());
    let trunks: Vec<_> = (1..=100).map(trunks).collect();
    assert!(trunks.iter().all(|one| *one == Ok(1)), "{trunks:?}");
    // What stands in the way is in the way of trunks as well.
    let wall = r#"prune_obstacles = [{ shape = "box", min = [-9, -9, 0], max = [9, 9, 20] }]"#;
    let error = read(&format!("{text}\n{wall}")).unwrap().grow(1).unwrap_err().to_string();
    assert!(error.contains("pruning took it"), "{error}");
}

#[test]
fn solids_and_obstacles_bound_the_tree() {
    let inside = [
        r#"prune_inside = [{ shape = "sphere", center = [0, 0, 6], radius = 2.5 }]"#,
        r#"prune_inside = [{ shape = "cylinder", center = [0, 0, 0], radius = 1.5, height = 11 }]"#,
        r#"prune_inside = [{ shape = "box", min = [-1, -2, 0], max = [1, 2, 11] }]"#,
    ];
    let fits: [fn(glam::DVec3) -> bool; 3] = [
        |p| p.distance(glam::dvec3(0.0, 0.0, 6.0)) <= 2.5,
        |p| p.truncate().length() <= 1.5,
        |p| p.x.abs() <= 1.0 && p.y.abs() <= 2.0,
    ];
    for (solid, fits) in inside.iter().zip(fits) {
        let tree = grow(&with(&format!("length = [0.8, 0.9, 0, 0]\nprune_ratio = 1\n{solid}")));
        let branches = stems(&tree, 1);
        assert!(branches.len() > 5, "{solid}");
        for stem in branches {
            assert!(tree.knots_of(stem)[1..].iter().all(|k| fits(k.point)), "{solid}");
        }
    }
    // A building beside the tree and nothing else.
    let wall = r#"prune_ratio = 1
prune_inside = []
prune_obstacles = [{ shape = "box", min = [1, -20, 0], max = [20, 20, 20] }]"#;
    let tree = grow(&with(&format!("length = [0.9, 0.4, 0, 0]\nbranches = [1, 60, 0, 0]\n{wall}")));
    let xs: Vec<f64> = stems(&tree, 1).iter().map(|s| tree.knots_of(s).last().unwrap().point.x).collect();
    assert!(xs.iter().all(|x| *x <= 1.0) && xs.iter().any(|x| *x < -3.0));
}

#[test]
fn blossoms_replace_leaves_at_their_rate() {
    let apple = pleach_weber_penn::preset("apple").unwrap().grow(1).unwrap();
    let rate = apple.blossoms.len() as f64 / (apple.blossoms.len() + apple.leaves.len()) as f64;
    assert!((rate - 0.35).abs() < 0.02, "{rate}");
    let cherry = pleach_weber_penn::preset("hill_cherry").unwrap().grow(1).unwrap();
    assert!(cherry.leaves.is_empty() && cherry.blossoms.len() > 1000);
}

#[test]
fn leaf_bend_turns_leaves_outwards_and_up() {
    let facing = |bend: f64| {
        let text = include_str!("../../../../species/weber-penn/quaking_aspen.toml")
            .replace("leaf_bend = 0.6", &format!("leaf_bend = {bend}"));
        let tree = grow(&text);
        let up: f32 = tree.leaves.iter().map(|l| l.along.cross(l.across).normalize().z).sum();
        up / tree.leaves.len() as f32
    };
    let (none, some, all) = (facing(0.0), facing(0.5), facing(1.0));
    assert!(all > 0.99 && some > none + 0.1, "{none} {some} {all}");
}

#[test]
fn one_more_branch_leaves_the_other_branches_alone() {
    // Addressed randomness: the same child has the same draws whatever its siblings.
    let angles = |branches: u32| -> Vec<f64> {
        let text = format!(
            "branches = [1, {branches}, 0, 0]\nbase_size = [0, 0, 0, 0]\nrotate = [0, 0, 0, 0]\nrotate_v = [0, 180, 0, 0]"
        );
        let tree = grow(&with(&text));
        stems(&tree, 1)
            .iter()
            .map(|s| {
                let k = tree.knots_of(s);
                let d = k[1].point - k[0].point;
                d.y.atan2(d.x)
            })
            .collect()
    };
    let (few, more) = (angles(20), angles(21));
    assert!(few.len() >= 16);
    for (a, b) in few.iter().zip(&more) {
        assert!((a - b).abs() < 1e-9, "{a} became {b}");
    }
}

#[test]
fn mistakes_in_a_file_are_told_with_place_range_and_nearest_name() {
    let message = |text: &str| read(text).unwrap_err().to_string();
    let cases = [
        ("\nlegth = [1, 0.3, 0.6, 0]", "test.toml:2:1: `legth` is not a known name, did you mean `length`?"),
        ("length = [1, 0.3, 0.6]", "test.toml:1:10: `length` has 3 values, expected 4"),
        ("ratio = nan", "test.toml:1:9: `ratio` is NaN, which is not a finite number"),
        ("ratio = inf", "is not a finite number"),
        ("levels = 9", "test.toml:1:10: `levels` is 9, which is out of range: allowed is 1 to 4"),
        ("levels = 2.5", "is not a whole number"),
        ("branches = 1e9", "`branches` has 1 value, expected 4"),
        ("branches = [1, 1e9, 30, 1]", "`branches[1]` is 1000000000, which is out of range"),
        ("leaf_scale = -1", "out of range: allowed is 0 to 100"),
        ("shape = \"concial\"", "did you mean `conical`?"),
        ("ratio = \"thin\"", "is a string, expected a number"),
        ("ratio = [1]", "is an array, expected a single number"),
        ("ratio = ", "test.toml:1:"),
        ("prune_inside = [{ shape = \"ball\" }]", "is `ball`, which is not one of sphere, cylinder, box"),
        ("prune_inside = [{ shape = \"sphere\", center = [0, 0] }]", "expected 3"),
        ("prune_inside = [{ shape = \"sphere\", center = [0, 0, 1] }]", "`radius`"),
        ("tree_seed = -4", "`tree_seed`"),
        ("name = 3", "`name` is a number, expected a string"),
        ("g_scale = 1e308", "test.toml:1:11: `g_scale` is 1e308, which is out of range"),
        ("prune_inside = [{ shape = \"sphere\", center = [0, 1e308, 0], radius = 1 }]", "is 1e308, which is"),
        (
            "levels = 3\nname = \"../../escaped\"",
            "test.toml:2:8: `name` contains `/`, expected a name such as",
        ),
        ("name = \"..\"", "`name` is a folder"),
        ("name = \"\"", "`name` is empty"),
        ("name = \"a\\u001b[31m\"", "`name` contains the character \\u{1b}"),
        ("description = \"a\\u202eb\"", "`description` contains the character \\u{202e}"),
        ("seed = 3", "test.toml:1:1: `seed` is not a known name here: the seed of the tree is `tree_seed`"),
        ("season = \"autumn\"", "`season` is not a known name, did you mean `appearance.season`?"),
    ];
    for (text, expected) in cases {
        let message = message(text);
        assert!(message.contains(expected), "{text:?} gives\n{message}\nwithout\n{expected}");
    }
    // All mistakes of a file are told at once.
    assert_eq!(message("levels = 9\nratio = -1\nfoo = 2").lines().count(), 3);
}

#[test]
fn monsters_end_in_errors_within_the_limit() {
    let monster = "levels = 4\nbranches = [1, 10000, 10000, 10000]\nbase_size = [0.99, 0.99, 0.99, 0]";
    let started = read(monster).unwrap().grow(1).unwrap_err();
    assert!(started.to_string().contains("stems"), "{started}");
    let leafy = "leaf_blos_num = 100000\nbranches = [1, 5000, 30, 1]";
    assert!(read(leafy).unwrap().grow(1).unwrap_err().to_string().contains("leaves"));
}

/// What a search sets to zero is what makes one tree of a species larger than another.
#[test]
fn without_variations_of_size_trunks_of_all_seeds_are_alike() {
    for name in ["quaking_aspen", "balsam_fir"] {
        let path = format!("{}/../../species/weber-penn/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        let species = read(&std::fs::read_to_string(path).unwrap()).unwrap();
        let space = species.generator.space();
        let feet = |values: &[f64]| -> Vec<f64> {
            let params = space.check(values.to_vec()).unwrap();
            let of = |seed| Species { params: params.clone(), ..species.clone() }.grow(seed).unwrap();
            // The radius of a trunk's foot is in proportion to its length, whatever way it bends.
            let foot = |tree: &Tree| tree.knots_of(stems(tree, 0)[0])[0].radius;
            (1..5).map(|seed| foot(&of(seed))).collect()
        };
        let mut values = species.params.values().to_vec();
        let spread = |feet: &[f64]| feet.iter().any(|r| (r / feet[0] - 1.0).abs() > 1e-9);
        assert!(spread(&feet(&values)), "{name}");
        assert!(!species.generator.shows_size_jitter(&values), "{name}");
        let slots: Vec<String> = space.size_jitters().map(|slot| space.slot_name(slot)).collect();
        assert_eq!(slots, ["g_scale_v", "length_v[0]"]);
        space.size_jitters().for_each(|slot| values[slot.index()] = 0.0);
        assert!(!spread(&feet(&values)), "{name}");
        // Several trunks show how much they differ.
        values[space.select("branches[0]").unwrap()[0].index()] = 3.0;
        assert!(species.generator.shows_size_jitter(&values), "{name}");
    }
}
