//! What shells and scripts see of the program: standard output, exit codes, quiet, completions,
//! manual pages, colours.

use pleach_tests::{Dir, Run};
use std::process::Output;

/// Runs the program and keeps standard output as bytes.
fn output(dir: &Dir, args: &[&str]) -> Output {
    let output = dir.command(args).output().unwrap();
    assert!(output.status.success(), "{args:?}\n{}", String::from_utf8_lossy(&output.stderr));
    output
}

fn entries(dir: &Dir) -> usize {
    std::fs::read_dir(dir.path("")).unwrap().count()
}

#[test]
fn a_dash_is_standard_output_with_the_bytes_of_the_file() {
    for format in ["json", "png", "swc", "csv", "glb", "ply", "stl", "usda"] {
        let dir = Dir::new();
        let out = output(&dir, &["grow", "acer", "-o", "-", "--format", format]);
        assert_eq!(entries(&dir), 0, "{format}: no file, and no folder called `-`");
        let notes = String::from_utf8_lossy(&out.stderr).into_owned();
        assert!(notes.contains("acer (seed 1)") && !notes.contains("wrote"), "{format}: {notes}");
        let name = format!("tree.{format}");
        let _ = dir.run(["grow", "acer", "-o", &name]).ok();
        assert!(out.stdout == std::fs::read(dir.path(&name)).unwrap(), "{format}");
    }
    for command in ["render", "silhouette"] {
        let dir = Dir::new();
        let out = output(&dir, &[command, "palm", "--size", "64", "-o", "-"]);
        assert_eq!((entries(&dir), out.stderr.len()), (0, 0), "{command}");
        let _ = dir.run([command, "palm", "--size", "64", "-o", "palm.png"]).ok();
        assert!(out.stdout == std::fs::read(dir.path("palm.png")).unwrap(), "{command}");
    }
}

#[test]
fn a_skeleton_is_what_standard_output_gets_where_nothing_is_said() {
    let dir = Dir::new();
    let skeleton = dir.run(["grow", "palm", "-o", "-"]).json();
    assert_eq!(skeleton["stems"][0]["kind"], "trunk");
    assert_eq!(entries(&dir), 0);
}

#[test]
fn an_obj_on_standard_output_names_no_file_beside_it() {
    let dir = Dir::new();
    let out = output(&dir, &["grow", "palm", "-o", "-", "--format", "obj"]);
    let text = String::from_utf8(out.stdout).unwrap();
    assert!(text.contains("usemtl bark") && !text.contains("mtllib"), "{}", &text[..80]);
    for format in ["obj", "usda"] {
        dir.run(["grow", "palm", "-o", "-", "--format", format, "--leaves", "cards"])
            .fails(1, &["--leaves cards", "beside", ".glb"]);
    }
    assert_eq!(entries(&dir), 0);
}

#[test]
fn standard_output_takes_one_thing() {
    let dir = Dir::new();
    dir.run(["grow", "acer", "-o", "-", "--json"]).fails(1, &["--json", "standard output"]);
    dir.run(["grow", "acer", "-o", "-", "--seeds", "0..3"]).fails(1, &["folder", "standard output"]);
    dir.run(["render", "all", "-o", "-"]).fails(1, &["folder"]);
    assert_eq!(entries(&dir), 0);
}

#[test]
fn a_reader_who_has_enough_is_not_an_error() {
    let dir = Dir::new();
    let mut child = dir
        .command(["grow", "acer", "-o", "-", "--format", "ply"])
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let out = child.wait_with_output().unwrap();
    assert!(out.status.success(), "{}", String::from_utf8_lossy(&out.stderr));
}

#[test]
fn what_ends_in_a_slash_is_a_folder() {
    let dir = Dir::new();
    let _ = dir.run(["grow", "palm", "--size", "32", "-o", "v1.2/"]).ok();
    assert!(dir.path("v1.2/palm-1.json").exists() && dir.path("v1.2/palm-1.png").exists());
    let _ = dir.run(["render", "palm", "--size", "32", "-o", "r1.png/"]).ok();
    assert!(dir.path("r1.png/palm-1.png").exists());
    let _ = dir.run(["grow", "palm", "--seeds", "1..3", "-o", "seeds.d/", "--format", "glb"]).ok();
    assert_eq!(std::fs::read_dir(dir.path("seeds.d")).unwrap().count(), 2);
    assert!(dir.path("seeds.d/palm-2.glb").exists());
}

#[test]
fn quiet_leaves_results_and_errors() {
    let dir = Dir::new();
    let run: Run = dir.run(["grow", "palm", "--size", "32", "-q"]);
    assert!(run.ok().contains("palm (seed 1)"), "{run}");
    assert_eq!(run.stderr(), "");
    let run = dir.run(["--quiet", "render", "palm", "--size", "32"]);
    assert_eq!((run.ok(), run.stderr()), (String::new(), String::new()));
    dir.run(["grow", "plam", "--quiet"]).fails(1, &["error: ", "did you mean `palm`?"]);
}

#[test]
fn errors_are_coloured_like_those_of_arguments_unless_told_not_to() {
    let dir = Dir::new();
    let stderr = |name: &str, arg: &str| {
        let output = dir.command(["grow", "palm", arg]).env(name, "1").output().unwrap();
        String::from_utf8(output.stderr).unwrap()
    };
    let red = "\u{1b}[1m\u{1b}[31merror:\u{1b}[0m ";
    let [usage, own] = ["--nonsense", "-oa.b"].map(|arg| stderr("CLICOLOR_FORCE", arg));
    assert!(usage.starts_with(red) && own.starts_with(red), "{usage:?} {own:?}");
    assert!(stderr("NO_COLOR", "-oa.b").starts_with("error: cannot write"));
    assert!(dir.run(["grow", "palm", "-oa.b"]).stderr().starts_with("error: "), "no terminal, no colour");
}

/// The commands that `pleach help` lists.
fn commands(dir: &Dir) -> Vec<String> {
    let help = dir.run(["--help"]).ok();
    let list = help.lines().skip_while(|l| *l != "Commands:").skip(1).take_while(|l| !l.is_empty());
    let names: Vec<String> = list
        .filter(|l| l.starts_with("  ") && !l.starts_with("   "))
        .filter_map(|l| l.split_whitespace().next())
        .map(str::to_owned)
        .collect();
    assert!(names.len() > 10 && names.contains(&"grow".to_owned()), "{names:?}");
    names
}

#[test]
fn completions_know_every_command_in_every_shell() {
    let dir = Dir::new();
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = dir.run(["completions", shell]).ok();
        for command in commands(&dir) {
            assert!(script.contains(&command), "{shell}: {command}");
        }
        assert!(script.contains("turntable"), "{shell}");
    }
    // Bash itself reads what is for bash.
    let _ = dir.file("pleach.bash", dir.run(["completions", "bash"]).ok());
    let script = "source ./pleach.bash && COMP_WORDS=(pleach gr) COMP_CWORD=1 && _pleach pleach gr pleach && \
                  echo \"${COMPREPLY[@]}\"";
    let bash = std::process::Command::new("bash").current_dir(dir.path("")).args(["-c", script]).output();
    match bash {
        Ok(out) => assert_eq!(String::from_utf8_lossy(&out.stdout).trim(), "grow grammar", "{out:?}"),
        Err(error) => assert_eq!(error.kind(), std::io::ErrorKind::NotFound),
    }
    dir.run(["completions", "tcsh"]).fails(2, &["bash", "fish", "zsh"]);
}

#[test]
fn every_command_has_a_manual_page() {
    let dir = Dir::new();
    let _ = dir.run(["man", "-o", "man1"]).ok();
    for command in commands(&dir).iter().filter(|name| *name != "help") {
        let page = std::fs::read_to_string(dir.path(&format!("man1/pleach-{command}.1"))).unwrap();
        for words in [".TH", "NAME", "SYNOPSIS", "OPTIONS", ".SH EXAMPLES"] {
            assert!(page.contains(words), "{command}: {words}");
        }
    }
    assert!(dir.path("man1/pleach.1").exists() && dir.path("man1/pleach-experiment-run.1").exists());
}

#[test]
fn a_negative_number_is_a_value_and_not_an_option() {
    let dir = Dir::new();
    for (args, words) in [
        (["grow", "acer", "--seed", "-3"], "whole number"),
        (["grow", "acer", "--tolerance", "-2"], "0.01 to 1000"),
        (["render", "acer", "--turntable", "-3"], "2..=360"),
        (["fit", "acer.png", "--height", "-3"], "--height"),
        (["silhouette", "acer", "--size", "-3"], "8..=8192"),
    ] {
        let run = dir.run(args);
        run.fails(2, &[words]);
        assert!(!run.stderr().contains("as a value"), "{run}");
    }
}
