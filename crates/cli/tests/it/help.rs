//! Help texts as people read them: how wide they are, and that their examples work.

use crate::import;
use pleach_tests::Dir;

/// The commands that the help of `path` lists, and those below them.
fn commands(dir: &Dir, path: &[String]) -> Vec<Vec<String>> {
    let mut found = vec![path.to_vec()];
    let help = help(dir, path, 100);
    let list =
        help.lines().skip_while(|line| *line != "Commands:").skip(1).take_while(|line| !line.is_empty());
    for line in list.filter(|line| line.starts_with("  ") && !line.starts_with("   ")) {
        let name = line.split_whitespace().next().unwrap();
        if name != "help" {
            found.extend(commands(dir, &[path, &[name.to_owned()]].concat()));
        }
    }
    found
}

fn help(dir: &Dir, path: &[String], columns: u32) -> String {
    let mut command = dir.command(path);
    let output = command.arg("--help").env("COLUMNS", columns.to_string()).output().unwrap();
    assert!(output.status.success(), "{path:?}");
    String::from_utf8(output.stdout).unwrap()
}

/// The commands under `Examples:`, without what is said of them.
fn examples(help: &str) -> Vec<String> {
    let lines = help.lines().skip_while(|line| *line != "Examples:").skip(1);
    let block: Vec<&str> = lines.take_while(|line| !line.is_empty()).collect();
    let block = block.join("\n").replace("\\\n", " ");
    let commands = block.lines().map(|line| {
        // A comment is set apart by two spaces; those within a broken command are of no matter.
        let line = line.trim();
        let mut words = String::new();
        let mut rest = line;
        while let Some((before, after)) = rest.split_once("  ") {
            words.push_str(before);
            rest = after.trim_start();
            if !rest.starts_with("--") {
                return words;
            }
            words.push(' ');
        }
        words + rest
    });
    commands.filter(|line| !line.starts_with('#')).collect()
}

#[test]
fn every_command_shows_examples() {
    let dir = Dir::new();
    let all = commands(&dir, &[]);
    assert!(all.len() >= 15, "{all:?}");
    for path in all.iter().filter(|path| path.len() == 1) {
        assert!(!examples(&help(&dir, path, 100)).is_empty(), "{path:?}");
    }
}

#[test]
fn help_is_as_wide_as_the_terminal_and_no_wider() {
    let dir = Dir::new();
    for path in commands(&dir, &[]) {
        for columns in [80, 100] {
            let help = help(&dir, &path, columns);
            for line in help.lines() {
                let width = line.chars().count();
                // What cannot be broken stands alone: clap's own usage and lists of values.
                let whole = line.starts_with("Usage:") || line.trim_start().split(' ').count() <= 2;
                assert!(width <= columns as usize || whole, "{path:?} at {columns}: {line}");
            }
            for line in examples(&help) {
                assert!(line.starts_with("pleach "), "{path:?} at {columns} breaks `{line}`");
            }
        }
    }
}

/// A word alone on a line, with text of the same paragraph above and below, was wrapped twice.
#[test]
fn no_text_is_wrapped_twice() {
    let dir = Dir::new();
    for path in commands(&dir, &[]) {
        for columns in [80, 100] {
            let help = help(&dir, &path, columns);
            let lines: Vec<&str> = help.lines().collect();
            let indent = |line: &str| line.len() - line.trim_start().len();
            for three in lines.windows(3) {
                let of_one_paragraph =
                    three.iter().all(|line| !line.trim().is_empty() && indent(line) == indent(three[1]));
                let orphan = three[1].split_whitespace().count() == 1 && three[1].chars().count() < 30;
                let full = three[0].chars().count() > columns as usize / 2;
                assert!(
                    !(of_one_paragraph && orphan && full),
                    "{path:?} at {columns}:\n{}",
                    three.join("\n")
                );
            }
        }
    }
}

/// A directory with everything that examples of `names` mention.
fn furnished(names: &[&str]) -> Dir {
    let dir = Dir::new();
    let root = pleach_tests::root();
    let acer = root.join("targets/acer.png");
    for folder in ["targets", "goals", "my-trees", "experiments"] {
        std::fs::create_dir(dir.path(folder)).unwrap();
    }
    for name in [
        "goal.png",
        "front.png",
        "side.png",
        "corner.png",
        "other.png",
        "best.png",
        "oak.png",
        "oak.jpg",
        "photo.jpg",
        "goals/acer.png",
        "goals/second.png",
        "targets/quaking_aspen.png",
    ] {
        std::fs::copy(&acer, dir.path(name)).unwrap();
    }
    // Photographs as large as the pixel that an example points at wants; they take a while to draw.
    let photographed = names.iter().any(|name| ["fit", "mask", "score"].contains(name));
    let photos = [("oak.jpg", "#a9c8ee"), ("photo.jpg", "#a9c8ee"), ("shed.jpg", "#c8b8a0")];
    for (photo, background) in photos.into_iter().filter(|_| photographed) {
        let args = ["render", "palm", "--size", "1600", "--ground", "none", "--background", background];
        let _ = dir.run([&args[..], &["-o", "drawn.png"]].concat()).ok();
        std::fs::rename(dir.path("drawn.png"), dir.path(photo)).unwrap();
    }
    // A mask by hand, of the photographs' size.
    let side = if photographed { "1600" } else { "64" };
    let _ = dir.run(["silhouette", "quaking_aspen", "--size", side, "-o", "mine.png"]).ok();
    std::fs::create_dir(dir.path("photos")).unwrap();
    std::fs::copy(dir.path("oak.jpg"), dir.path("photos/oak.jpg")).unwrap();
    let _ = dir.file("goals.csv", "file,height\noak.png,12\n");
    let lpy = "Axiom: A(8)\nderivation length: 2\nproduction:\nA(s) --> F(s)[+(85)A(s/2)]\nendlsystem\n";
    for (name, text) in [
        ("bush.lpy", lpy),
        ("oak.xml", import::BIRCH),
        ("white_birch.py", import::MAPLE),
        ("ash.json", import::ASH),
    ] {
        let _ = dir.file(name, text);
    }
    let toml = dir.run(["species", "palm"]).ok();
    let toml = toml.replace("name = \"palm\"", "name = \"mine\"");
    for name in ["my_tree.toml", "mine.toml", "my-trees/one.toml"] {
        let _ = dir.file(name, &toml);
    }
    dir
}

/// `line` with little to do: few evaluations from a known start, small pictures, few of them.
fn cut_short(line: &str) -> String {
    // All species are drawn by the first example that says so.
    let line = &line.replace(" all --no-leaves", " palm --no-leaves");
    let mut words: Vec<String> = line.split_whitespace().map(str::to_owned).collect();
    let mut set = |option: &str, value: &str| match words.iter().position(|word| word == option) {
        Some(i) => value.clone_into(&mut words[i + 1]),
        None => words.splice(2..2, [option.to_owned(), value.to_owned()]).for_each(drop),
    };
    match line.split(' ').nth(1) {
        Some("fit") => {
            set("--evaluations", "20");
            // These say themselves where the search begins, and their stems have no draws of their own.
            if !["--evolve-rules", "--volume-from"].iter().any(|option| line.contains(option)) {
                set("--individual", "8trees");
                set("--from", "palm");
            }
            if !line.contains("--resume") && !line.contains("--continue") {
                words.insert(2, "--overwrite".to_owned());
            }
        }
        Some("render") => {
            if line.contains("--generator all") {
                set("--generator", "fractal");
            }
            if line.contains("--turntable") {
                set("--turntable", "3");
            }
            set("--size", "32");
        }
        Some("map") if line.contains("--grid") => set("--grid", "2x2"),
        _ => {}
    }
    words.join(" ")
}

/// Runs every example of some commands.
fn run_examples_of(names: &[&str]) {
    let dir = furnished(names);
    let home = dir.path("home").display().to_string();
    for folder in [".local/share/bash-completion/completions", ".zfunc", ".config/fish/completions"] {
        std::fs::create_dir_all(dir.path("home").join(folder)).unwrap();
    }
    for name in names {
        for example in examples(&help(&dir, &[(*name).to_owned()], 100)) {
            // A shell takes care of `>`, `|`, `*` and `&&`.
            let piped = |line: &str| line.split(" | ").map(cut_short).collect::<Vec<_>>().join(" | ");
            let commands = example.split(" && ").map(piped).collect::<Vec<_>>().join(" && ");
            let script = commands.replace('~', &home).replace("pleach ", "\"$PLEACH\" ");
            let output = std::process::Command::new("sh")
                .current_dir(dir.path(""))
                .env("PLEACH", pleach_tests::program())
                .args(["-c", &script])
                .output()
                .unwrap();
            let message = String::from_utf8_lossy(&output.stderr);
            assert!(output.status.success(), "{example}\n{script}\n{message}");
        }
    }
}

#[test]
fn examples_that_grow_work() {
    run_examples_of(&[
        "grow",
        "species",
        "params",
        "grammar",
        "import",
        "silhouette",
        "score",
        "completions",
        "man",
    ]);
}

#[test]
#[ignore = "nightly: minutes; that the examples are understood is tested beside the code"]
fn examples_that_draw_work() {
    run_examples_of(&["render", "mask"]);
}

#[test]
#[ignore = "nightly: minutes; that the examples are understood is tested beside the code"]
fn examples_of_maps_and_blends_work() {
    run_examples_of(&["map", "blend"]);
}

#[test]
#[ignore = "nightly: minutes; that the examples are understood is tested beside the code"]
fn examples_of_fits_work() {
    run_examples_of(&["fit"]);
}

/// They want the run folders of the goals that they name.
#[test]
#[ignore = "nightly: minutes; that the examples are understood is tested beside the code"]
fn examples_of_collections_work() {
    let dir = Dir::new();
    std::fs::create_dir(dir.path("goals")).unwrap();
    for seed in ["1", "2"] {
        let out = format!("goals/{seed}.png");
        let _ = dir.run(["silhouette", "palm", "--seed", seed, "--size", "48", "-o", &out]).ok();
    }
    let _ = dir.file("goals.csv", "file\ngoals/1.png\ngoals/2.png\n");
    let fit = ["fit", "--list", "goals.csv", "--size", "48", "--from", "palm", "--evaluations", "12"];
    let _ = dir.run([&fit[..], &["--individual", "off"]].concat()).ok();
    let examples = examples(&help(&dir, &["collect".to_owned()], 100));
    assert!(examples.len() >= 5, "{examples:?}");
    for example in examples {
        let output = std::process::Command::new("sh")
            .current_dir(dir.path(""))
            .env("PLEACH", pleach_tests::program())
            .args(["-c", &example.replace("pleach ", "\"$PLEACH\" ")])
            .output()
            .unwrap();
        assert!(output.status.success(), "{example}\n{}", String::from_utf8_lossy(&output.stderr));
    }
}

/// What `docs/figures.md` says of pictures, with small ones.
#[test]
#[ignore = "nightly: forty pictures"]
fn the_dissertations_pictures_are_remade_as_documented() {
    let page = std::fs::read_to_string(pleach_tests::root().join("docs/figures.md")).unwrap();
    let dir = Dir::new();
    let mut blocks = 0;
    // The gallery has a test of its own.
    let page = page.replace("pleach render --gallery -o gallery.png\n", "");
    for block in page.split("```sh\n").skip(1).map(|rest| rest.split("```").next().unwrap()) {
        let script =
            block.replace("pleach render ", "pleach render --size 32 ").replace("pleach ", "\"$PLEACH\" ");
        let output = std::process::Command::new("sh")
            .current_dir(dir.path(""))
            .env("PLEACH", pleach_tests::program())
            .args(["-e", "-c", &script])
            .output()
            .unwrap();
        assert!(output.status.success(), "{block}\n{}", String::from_utf8_lossy(&output.stderr));
        blocks += 1;
    }
    assert!(blocks >= 7, "{blocks}");
    let picture = |name: &str| std::fs::read(dir.path(name)).unwrap();
    // What a figure shows differs from what it is compared with: `sed` found its line.
    let pairs = [
        ("shape-0.png", "shape-5.png"),
        ("willow.png", "willow-thick.png"),
        ("tropism-0,0,0.png", "tropism-0,0,-2.png"),
        ("tropism-0,0,-2.png", "tropism--1,0,-2.png"),
        ("pruned-0.png", "pruned-1.png"),
        ("pruned-0.5.png", "pruned-1.png"),
        ("solid-1.png", "solid-2.png"),
        ("solid-3.png", "solid-4.png"),
    ];
    for (one, other) in pairs {
        assert_ne!(picture(one), picture(other), "{one} {other}");
    }
    let _ = dir.run(["render", "quaking_aspen", "--size", "32", "-o", "straight.png"]).ok();
    assert_ne!(picture("helix.png"), picture("straight.png"));
}
