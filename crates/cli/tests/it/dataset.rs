//! Training data: what is in the files, that no thread or interruption changes a byte, and what is refused.

use pleach_tests::arrays::{Array, npz, tar};
use pleach_tests::{Dir, read, wait_for};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Stdio;

/// Every file of a folder.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap());
    entries.map(|entry| (entry.file_name().into_string().unwrap(), read(&entry.path()))).collect()
}

/// A species whose trees are at the limits of a search: some draws grow and some do not.
fn large(dir: &Dir) {
    let aspen = dir.run(["species", "quaking_aspen"]).ok();
    let line = |line: &str| match line.split(" = ").next() {
        Some("name") => "name = \"large\"\n".to_owned(),
        Some("branches") => "branches = [1, 150, 120, 1]\n".to_owned(),
        Some("leaf_blos_num") => "leaf_blos_num = 400\n".to_owned(),
        _ => format!("{line}\n"),
    };
    let _ = dir.file("large.toml", aspen.lines().map(line).collect::<String>());
}

fn manifest(dir: &Dir, folder: &str) -> Value {
    serde_json::from_slice(&read(&dir.path(folder).join("manifest.json"))).unwrap()
}

fn sides(array: &Array) -> &[usize] {
    &array.shape
}

/// The pixels of a picture, 1 where it is black.
fn ink(dir: &Dir, file: &str) -> Vec<u8> {
    let picture = image::open(dir.path(file)).unwrap().to_luma8();
    picture.pixels().map(|pixel| u8::from(pixel.0[0] < 128)).collect()
}

const LAYERS: &[&str] = &["--with", "wood,depth,skeleton"];

#[test]
fn arrays_hold_the_trees_of_sample_as_silhouette_draws_them() {
    let dir = Dir::new();
    let ask = ["dataset", "palm", "coffey_winter_oak", "-n", "3", "--size", "48", "-o", "set"];
    let run = dir.run([&ask[..], LAYERS].concat());
    assert!(run.ok().is_empty() && run.stderr().contains("wrote set: 6 trees in 1 shards"), "{run}");
    let arrays = npz(&read(&dir.path("set/shard-00000.npz")));
    assert_eq!(arrays["species"].u32s(), [0, 1, 0, 1, 0, 1], "species take turns");
    assert_eq!(arrays["number"].u32s(), [0, 0, 1, 1, 2, 2]);
    for name in ["silhouettes", "wood", "depth"] {
        assert_eq!(sides(&arrays[name]), [6, 2, 48, 48], "{name}");
    }

    // The manifest says what is there.
    let manifest = manifest(&dir, "set");
    assert_eq!((&manifest["complete"], &manifest["trees"]), (&true.into(), &6.into()));
    let described: Vec<_> = manifest["arrays"].as_array().unwrap().iter().map(|one| &one["name"]).collect();
    assert_eq!(described.len(), arrays.len());
    assert!(described.iter().all(|name| arrays.contains_key(name.as_str().unwrap())));
    let digest = std::process::Command::new("sha256sum").arg(dir.path("set/shard-00000.npz")).output();
    if let Ok(digest) = digest {
        let digest = String::from_utf8(digest.stdout).unwrap();
        assert_eq!(digest.split(' ').next(), manifest["shards"][0]["sha256"].as_str());
    }

    // Numbers that another generator has are absent.
    let names: Vec<_> =
        manifest["numbers"].as_array().unwrap().iter().map(|name| name.as_str().unwrap()).collect();
    let numbers = arrays["numbers"].f64s();
    assert_eq!(sides(&arrays["numbers"]), [6, names.len()]);
    for (tree, row) in numbers.chunks(names.len()).enumerate() {
        let own = manifest["species"][tree % 2]["numbers"].as_array().unwrap();
        for (name, value) in names.iter().zip(row) {
            assert_eq!(value.is_nan(), !own.contains(&Value::from(*name)), "tree {tree}: {name}");
        }
    }

    // The same trees as `pleach sample` writes, and the same pictures as `pleach silhouette` draws.
    let _ = dir.run(["sample", "palm", "-n", "3", "-o", "palms"]).ok();
    let table = String::from_utf8(read(&dir.path("palms/samples.csv"))).unwrap();
    let seeds = arrays["tree_seed"].u64s();
    let silhouettes = arrays["silhouettes"].u8s();
    for number in 0..3 {
        let row: Vec<&str> = table.lines().nth(number + 1).unwrap().split(',').collect();
        assert_eq!(row[1], seeds[2 * number].to_string());
        let drawn = &numbers[2 * number * names.len()..][..row.len() - 2];
        assert!(row[2..].iter().zip(drawn).all(|(cell, value)| cell.parse() == Ok(*value)));
        for (view, azimuth) in ["0", "90"].into_iter().enumerate() {
            let species = format!("palms/{}.toml", number + 1);
            let _ =
                dir.run(["silhouette", &species, "--size", "48", "--view", azimuth, "-o", "one.png"]).ok();
            let picture = &silhouettes[(2 * number * 2 + view) * 48 * 48..][..48 * 48];
            assert!(ink(&dir, "one.png") == picture, "palm {number} from {azimuth}");
        }
    }

    // Wood is a part of the tree, and what is seen of it has a distance.
    let (wood, depth) = (arrays["wood"].u8s(), arrays["depth"].f32s());
    let inside = silhouettes.iter().zip(&wood).zip(&depth);
    assert!(inside.clone().all(|((tree, wood), depth)| wood <= tree && depth.is_finite() == (*tree == 1)));
    let offsets = arrays["skeleton_offsets"].u64s();
    assert_eq!((offsets.len(), offsets[0], offsets[6]), (7, 0, sides(&arrays["skeletons"])[0] as u64));
    assert_eq!(arrays["skeletons"].f32s()[..3], [0.0, 0.0, 0.0], "the foot of the first palm");
    assert!(arrays["meters_per_pixel"].f64s().iter().all(|meters| (0.01..1.0).contains(meters)));
}

#[test]
fn a_webdataset_holds_the_same() {
    let dir = Dir::new();
    let ask = ["dataset", "palm", "-n", "3", "--size", "32", "--view", "-30"];
    let ask = [&ask[..], LAYERS].concat();
    let _ = dir.run([&ask[..], &["-o", "arrays"]].concat()).ok();
    let _ = dir.run([&ask[..], &["-o", "tars", "--format", "webdataset"]].concat()).ok();
    let arrays = npz(&read(&dir.path("arrays/shard-00000.npz")));
    let files = tar(&read(&dir.path("tars/shard-00000.tar")));
    assert_eq!(files.len(), 3 * 6);
    let array = |tree: usize, name: &str| Array::read(&files[&format!("{tree:010}.{name}")]);
    for tree in 0..3 {
        let about: Value = serde_json::from_slice(&files[&format!("{tree:010}.json")]).unwrap();
        assert_eq!(about["tree_seed"], arrays["tree_seed"].u64s()[tree]);
        assert_eq!(about["meters_per_pixel"][0], arrays["meters_per_pixel"].f64s()[tree]);
        let width = sides(&arrays["numbers"])[1];
        assert_eq!(array(tree, "numbers.npy").f64s(), arrays["numbers"].f64s()[tree * width..][..width]);
        let offsets = arrays["skeleton_offsets"].u64s();
        let [from, to] = [offsets[tree] as usize * 6, offsets[tree + 1] as usize * 6];
        assert_eq!(array(tree, "skeleton.npy").f32s(), arrays["skeletons"].f32s()[from..to]);
        let bits = |values: &[f32]| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
        let depth = &arrays["depth"].f32s()[tree * 32 * 32..][..32 * 32];
        assert_eq!(bits(&array(tree, "depth0.npy").f32s()), bits(depth));
        let _ = dir.file("view.png", &files[&format!("{tree:010}.view0.png")]);
        assert_eq!(ink(&dir, "view.png"), arrays["silhouettes"].u8s()[tree * 32 * 32..][..32 * 32]);
        assert!(files[&format!("{tree:010}.wood0.png")].starts_with(b"\x89PNG"));
    }
    // A shard is what tar itself lists.
    let listed = std::process::Command::new("tar").arg("-tvf").arg(dir.path("tars/shard-00000.tar")).output();
    if let Ok(listed) = listed {
        let listed = String::from_utf8(listed.stdout).unwrap();
        assert!(listed.lines().all(|line| line.starts_with("-rw-r--r-- 0/0")), "{listed}");
    }
}

#[test]
fn no_number_of_threads_changes_a_byte() {
    let dir = Dir::new();
    for format in ["npz", "webdataset"] {
        let set = |out: &str, threads: &str| {
            let ask =
                ["dataset", "palm", "acer", "-n", "7", "--size", "24", "--shard", "4", "--format", format];
            let _ =
                dir.run([&ask[..], LAYERS, &["-o", out, "--threads", threads, "--overwrite"]].concat()).ok();
            files(&dir.path(out))
        };
        let one = set("one", "1");
        assert_eq!(one.len(), 4 + 2, "{format}: {:?}", one.keys());
        assert!(one == set("two", "2"), "{format}");
    }
}

#[test]
#[cfg(unix)]
fn an_interrupted_run_goes_on_to_the_same_bytes() {
    let dir = Dir::new();
    let ask = ["dataset", "quaking_aspen", "-n", "200", "--size", "64", "--shard", "10"];
    let args = |out: &'static str, more: &[&'static str]| [&ask[..], &["-o", out], more].concat();
    let _ = dir.run(args("whole", &[])).ok();
    let whole = files(&dir.path("whole"));

    let spawn = |more: &[&'static str]| {
        let mut command = dir.command(args("parts", more));
        command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
    };
    let signal = |child: &std::process::Child, name: &str| {
        let status = std::process::Command::new("kill").args([name, &child.id().to_string()]).status();
        assert!(status.unwrap().success());
    };
    let killed = spawn(&[]);
    wait_for(&dir.path("parts/shard-00001.npz"));
    signal(&killed, "-KILL");
    let _ = killed.wait_with_output().unwrap();
    assert_eq!(manifest(&dir, "parts")["complete"], false, "the run was long enough to be killed");

    // It is neither written over nor gone on with by accident, nor with other arguments.
    dir.run(args("parts", &[])).fails(1, &["parts is not empty", "--resume", "--overwrite"]);
    dir.run(args("parts", &["--resume", "--seed", "2"])).fails(1, &["seed was 1, now 2", "--overwrite"]);
    let other = ["dataset", "palm", "-n", "200", "--size", "64", "--shard", "10", "-o", "parts", "--resume"];
    dir.run(other).fails(1, &["species was quaking_aspen, now palm"]);

    // Asked to stop, it says how to go on.
    let written = files(&dir.path("parts")).keys().filter(|name| name.ends_with(".npz")).count();
    let stopped = spawn(&["--resume", "--threads", "1"]);
    // One that the killed run has not written: before it, signals may not be caught yet.
    wait_for(&dir.path(&format!("parts/shard-{written:05}.npz")));
    signal(&stopped, "-TERM");
    let output = stopped.wait_with_output().unwrap();
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(130), "{message}");
    assert!(message.contains("interrupted after") && message.contains("--resume"), "{message}");
    assert!(!files(&dir.path("parts")).keys().any(|name| name.ends_with(".tmp")));

    // A file in progress that a crash has left, a damaged shard and a manifest without the last shards.
    let _ = dir.file("parts/shard-00007.npz.a1B2c3.tmp", "half");
    let _ = dir.file("parts/shard-00001.npz", "damaged");
    let _ = dir.run(args("parts", &["--resume"])).ok();
    assert!(files(&dir.path("parts")) == whole, "interrupted and whole run differ");
    // Once more: nothing is left to do.
    let _ = dir.run(args("parts", &["--resume"])).ok();
    assert!(files(&dir.path("parts")) == whole);
    // And a resumed run begins where there is nothing.
    let _ = dir.run(args("fresh", &["--resume", "--threads", "1"])).ok();
    assert!(files(&dir.path("fresh")) == whole);
}

#[test]
fn draws_without_a_tree_are_recorded_and_change_no_others() {
    let dir = Dir::new();
    large(&dir);
    let set = |out: &str, species: &[&str], more: &[&str]| {
        let ask =
            [&["dataset"], species, &["-n", "8", "--size", "64", "--shard", "4", "-o", out], more].concat();
        let run = dir.run(ask);
        let _ = run.ok();
        run.stderr()
    };
    let said = set("both", &["large.toml", "palm"], &[]);
    let table = String::from_utf8(read(&dir.path("both/failures.csv"))).unwrap();
    let failed: Vec<&str> = table.lines().skip(1).collect();
    assert!(!failed.is_empty(), "one of the draws is too large");
    assert!(said.contains(&format!("{} of 16 draws gave no tree", failed.len())), "{said}");
    for row in &failed {
        assert!(row.starts_with("large,") && row.contains("16 draws") && row.contains("more than"), "{row}");
    }
    let manifest = manifest(&dir, "both");
    assert_eq!(
        (&manifest["trees"], &manifest["failures"]),
        (&(16 - failed.len()).into(), &failed.len().into())
    );
    // The palms are those of a data set of palms.
    let _ = set("palms", &["palm"], &["--overwrite"]);
    let seeds = |out: &str, shards: u32, species: u32| {
        let shard = |number| npz(&read(&dir.path(&format!("{out}/shard-{number:05}.npz"))));
        let seeds = (0..shards).flat_map(|number| {
            let arrays = shard(number);
            let all = arrays["species"].u32s().into_iter().zip(arrays["tree_seed"].u64s());
            all.filter(move |(one, _)| *one == species).map(|(_, seed)| seed).collect::<Vec<_>>()
        });
        seeds.collect::<Vec<u64>>()
    };
    assert_eq!(seeds("both", 4, 1), seeds("palms", 2, 0));
    // Failures of shards that are kept stay in the table.
    let whole = files(&dir.path("both"));
    std::fs::remove_file(dir.path("both/shard-00003.npz")).unwrap();
    let _ = set("both", &["large.toml", "palm"], &["--resume"]);
    assert!(files(&dir.path("both")) == whole);
}

#[test]
fn what_cannot_be_is_refused_before_anything_is_written() {
    let dir = Dir::new();
    for (code, args, says) in [
        (2, &["palm", "-n", "0"][..], "1..=10000000"),
        (2, &["palm", "--size", "0"], "8..=4096"),
        (2, &["palm", "--size", "100000"], "8..=4096"),
        (2, &["palm", "--shard", "0"], "1..=1000000"),
        (2, &["palm", "--view", "north"], "not an azimuth in degrees"),
        (2, &["palm", "--view", ""], "such as 0,90"),
        (2, &["palm", "--view", "0,nan"], "not an azimuth in degrees"),
        (2, &["palm", "--with", "leaves"], "wood, depth, skeleton"),
        (2, &["palm", "--format", "hdf5"], "npz, webdataset"),
        (2, &["palm", "--spread", "-1"], "not a number from 0 to 10"),
        (2, &["palm", "--resume", "--overwrite"], "cannot be used with"),
        (2, &[], "SPECIES"),
        (1, &["plam"], "did you mean `palm`?"),
        (1, &["palm", "palm"], "palm is there twice"),
        (1, &["palm", "--free", "ratoi"], "ratio"),
        (1, &["palm", "--free", "ratio", "--fix", "ratio"], "no number of palm varies"),
        (
            1,
            &["palm", "--size", "4096", "--with", "depth", "-n", "1000"],
            "--shard is 1000: the pictures of a shard",
        ),
        (1, &["palm", "-n", "10000000", "--shard", "10"], "--shard is 10: there would be 1000000 shards"),
    ] {
        dir.run([&["dataset", "-o", "x"], args].concat()).fails(code, &[says]);
        assert!(!dir.path("x").exists(), "{args:?}");
    }
}

#[test]
fn other_peoples_files_stay() {
    let dir = Dir::new();
    let ask = |out: &'static str, more: &[&'static str]| {
        dir.run([&["dataset", "palm", "-n", "2", "--size", "16", "-o", out], more].concat())
    };
    std::fs::create_dir(dir.path("home")).unwrap();
    let _ = dir.file("home/thesis.tex", "precious");
    ask("home", &[]).fails(1, &["home is not empty"]);
    ask("home", &["--overwrite"])
        .fails(1, &["thesis.tex, which is not a file of a data set", "empty folder"]);
    ask("home", &["--resume"]).fails(1, &["manifest.json", "missing"]);
    assert_eq!(files(&dir.path("home")).len(), 1);
    let _ = dir.file("file", "not a folder");
    ask("file", &[]).fails(1, &["file cannot be made a folder"]);
    // What is replaced leaves nothing behind.
    let _ = dir.run(["dataset", "palm", "-n", "4", "--size", "16", "--shard", "1", "-o", "set"]).ok();
    let _ = ask("set", &["--overwrite"]).ok();
    assert_eq!(
        files(&dir.path("set")).into_keys().collect::<Vec<_>>(),
        ["failures.csv", "manifest.json", "shard-00000.npz"]
    );
    let _ = dir.file("set/manifest.json", "{\"spoilt\": ");
    ask("set", &["--resume"]).fails(1, &["not the manifest of a data set", "--overwrite"]);
}

/// A disk that is full, as a limit on the size of files: the shards before stay, and a run goes on when there is room.
#[test]
#[cfg(unix)]
fn a_full_disk_leaves_the_shards_before_it() {
    let dir = Dir::new();
    let ask = "dataset palm -n 40 --size 64 --with depth --shard 20 -o set";
    let program = pleach_tests::program().display();
    // Blocks of 512 bytes; SIGXFSZ is ignored, so that writing fails as on a full disk.
    let script = format!("trap '' XFSZ; ulimit -f 60; {program} {ask}");
    let output =
        std::process::Command::new("sh").current_dir(dir.path("")).args(["-c", &script]).output().unwrap();
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(1), "{message}");
    assert!(message.contains("shard-00000.npz cannot be written"), "{message}");
    assert!(files(&dir.path("set")).keys().all(|name| !name.starts_with("shard")), "nothing is half written");
    let _ = dir.run(ask.split(' ').chain(["--resume"])).ok();
    assert_eq!(npz(&read(&dir.path("set/shard-00001.npz")))["depth"].shape, [20, 2, 64, 64]);
}
