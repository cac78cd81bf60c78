//! Files for engines: the budget that a GLB has where nothing else is asked for, and smaller vertices.

use crate::export::{glb, names, triangles};
use pleach_tests::Dir;

/// Without options a GLB is for engines; what asks for more gets more.
#[test]
fn a_glb_is_for_engines_unless_something_else_is_asked_for() {
    let dir = Dir::new();
    let file = |more: &[&str]| {
        let _ = dir.run([&["grow", "quaking_aspen", "-o", "a.glb"], more].concat()).ok();
        glb(&dir.path("a.glb"))
    };
    let usual = file(&[]);
    let count = triangles(&usual)[0];
    assert!((42_500..=50_000).contains(&count), "{count}");
    assert_eq!(names(&usual["images"]), ["bark", "bark normal", "bark roughness", "twigs"]);
    assert!(triangles(&file(&["--finest"]))[0] > 400_000);
    assert!(file(&["--finest"])["images"].is_null());
    for finer in [&["--lod", "1"][..], &["--leaves", "outline"], &["--sway"], &["--tolerance", "2"]] {
        assert!(triangles(&file(finer))[0] > 400_000, "{finer:?}");
    }
    for kept in [&["--wind"][..], &["--billboard", "2"], &["--textures", "none"], &["--season", "autumn"]] {
        assert!(triangles(&file(kept))[0] <= 50_000, "{kept:?}");
    }
    assert_eq!(names(&file(&["--textures", "none"])["images"]), ["twigs"]);
    let forest = file(&["--forest", "10x10m"]);
    assert!(triangles(&forest).iter().all(|count| *count <= 50_000));
    dir.run(["grow", "acer", "--finest", "--triangles", "900", "-o", "x.glb"]).fails(2, &["--finest"]);
}

#[test]
fn compressed_files_are_smaller_and_have_the_same_triangles() {
    let dir = Dir::new();
    let file = |more: &[&str]| {
        let _ = dir.run([&["grow", "acer", "-o", "a.glb"], more].concat()).ok();
        (std::fs::metadata(dir.path("a.glb")).unwrap().len(), glb(&dir.path("a.glb")))
    };
    // Pictures stay as large as they are, so that there are none but those of the cards.
    let levels = ["--triangles", "30000,8000", "--billboard", "2", "--textures", "none"];
    for more in [&[][..], &["--leaves", "instances"], &levels] {
        let (plain, small) = (file(more), file(&[more, &["--compress", "quantize"]].concat()));
        assert!(10 * small.0 < 8 * plain.0, "{more:?}: {} of {} bytes", small.0, plain.0);
        assert_eq!(triangles(&small.1), triangles(&plain.1), "{more:?}");
    }
    dir.run(["grow", "acer", "--compress", "meshopt", "-o", "x.glb"]).fails(2, &["quantize"]);
    dir.run(["grow", "acer", "--compress", "quantize", "--wind", "-o", "x.glb"]).fails(2, &["--wind"]);
    dir.run(["grow", "acer", "--growth", "--wind", "-o", "x.glb"]).fails(2, &["--wind"]);
    let instances = ["grow", "acer", "--growth", "--leaves", "instances", "-o", "x.glb"];
    dir.run(instances).fails(1, &["`growth`", "`leaves` as instances"]);
    dir.run(["grow", "acer", "--compress", "quantize", "-o", "x.obj"]).fails(1, &["--compress", ".glb"]);
}

/// A line of 32,768 pieces has more triangles at its coarsest.
#[test]
fn a_tree_that_does_not_fit_is_written_whole_and_the_program_says_so() {
    let dir = Dir::new();
    let dragon = std::fs::read_to_string(pleach_tests::root().join("species/lsystem/abop_dragon.toml"));
    let _ = dir.file("long.toml", dragon.unwrap().replace("steps: 10", "steps: 15"));
    for more in [&[][..], &["--forest", "9x9", "--variants", "1"]] {
        let run = dir.run([&["grow", "long.toml", "-o", "long.glb"], more].concat());
        assert_eq!(run.code(), 0, "{run}");
        assert!(run.to_string().contains("fit into a level of 50000 triangles"), "{run}");
        assert!(triangles(&glb(&dir.path("long.glb")))[0] > 400_000);
    }
    let run = dir.run(["grow", "long.toml", "-o", "long.glb", "--finest"]);
    assert!(run.code() == 0 && !run.to_string().contains("does not fit"), "{run}");
    dir.run(["grow", "long.toml", "-o", "x.glb", "--triangles", "50000"]).fails(1, &["409600"]);
}
