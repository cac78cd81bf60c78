//! Pictures as people have them: from pipes, in odd formats, broken off, and not of a tree.

use pleach_tests::{Dir, Run};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Stdio;

fn target(name: &str) -> PathBuf {
    pleach_tests::root().join("targets").join(name)
}

/// Runs the program with bytes on its standard input.
fn piped(dir: &Dir, args: &[&str], bytes: &[u8]) -> Run {
    let mut command = dir.command(args);
    let child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn();
    let mut child = child.unwrap();
    let mut input = child.stdin.take().unwrap();
    let bytes = bytes.to_vec();
    // Who refuses what it is given does not read it to its end.
    let writer = std::thread::spawn(move || drop(input.write_all(&bytes)));
    let output = child.wait_with_output().unwrap();
    writer.join().unwrap();
    Run::new(format!("{args:?} with a pipe"), output)
}

const QUICK: [&str; 8] = ["--evaluations", "12", "--size", "140", "--from", "acer", "--free", "crown"];

#[test]
fn goals_come_from_standard_input() {
    let dir = Dir::new();
    let acer = std::fs::read(target("acer.png")).unwrap();
    for name in ["-", "/dev/stdin"] {
        let scores =
            piped(&dir, &["score", name, target("acer.png").to_str().unwrap(), "--json"], &acer).json();
        assert_eq!(scores["iou"], 1.0, "{name}");
    }
    let _ = piped(&dir, &[&["fit", "-"][..], &QUICK].concat(), &acer).ok();
    assert!(dir.path("runs/stdin/best.toml").exists());
    let text = std::fs::read_to_string(dir.path("runs/stdin/best.toml")).unwrap();
    assert!(text.contains("stdin"), "{text}");
    piped(&dir, &["score", "-", "-"], &acer).fails(1, &["standard input"]);
    piped(&dir, &["score", "-", "x.png"], b"no picture").fails(1, &["standard input is not a picture"]);
    piped(&dir, &["score", "-", "x.png"], b"").fails(1, &["standard input is not a picture"]);
}

#[test]
fn a_jpeg_that_breaks_off_is_no_goal() {
    let dir = Dir::new();
    let half = pleach_tests::root().join("crates/silhouette/tests/pictures/half.jpg");
    let half = half.to_str().unwrap();
    dir.run(["fit", half, "--out", "run"]).fails(1, &["half.jpg", "breaks off"]);
    dir.run(["score", half, half]).fails(1, &["half.jpg", "breaks off"]);
    dir.run(["mask", half, "-o", "m.png"]).fails(1, &["half.jpg", "breaks off"]);
    assert!(!dir.path("run").exists() && !dir.path("m.png").exists());
}

#[test]
fn tiff_is_a_goal_like_any_other() {
    let dir = Dir::new();
    // Eight bits, one strip, black on white.
    let picture = image::open(target("palm.png")).unwrap().to_luma8();
    let (width, height) = picture.dimensions();
    let mut tiff = b"II*\0\x08\0\0\0\x08\0".to_vec();
    let entry =
        |tag: u16, value: u32| [&tag.to_le_bytes()[..], &[4, 0, 1, 0, 0, 0], &value.to_le_bytes()].concat();
    let pixels = picture.into_raw();
    let length = u32::try_from(pixels.len()).unwrap();
    for (tag, value) in
        [(256, width), (257, height), (258, 8), (259, 1), (262, 1), (273, 110), (278, height), (279, length)]
    {
        tiff.extend(entry(tag, value));
    }
    tiff.extend([0; 4]);
    assert_eq!(tiff.len(), 110);
    tiff.extend(pixels);
    let _ = dir.file("palm.tif", tiff);
    let scores = dir.run(["score", "palm.tif", target("palm.png").to_str().unwrap(), "--json"]).json();
    assert_eq!(scores["iou"], 1.0);
}

#[cfg(unix)]
#[test]
fn names_need_not_be_utf_8() {
    use std::ffi::{OsStr, OsString};
    use std::os::unix::ffi::OsStrExt;
    let dir = Dir::new();
    let name = OsStr::from_bytes(b"pal\xffm.png");
    std::fs::copy(target("palm.png"), dir.path("").join(name)).unwrap();
    let args = |first: &[&OsStr]| -> Vec<OsString> { first.iter().map(|a| (*a).to_owned()).collect() };
    let score = dir.run(args(&["score".as_ref(), name, name, "--json".as_ref()])).json();
    assert_eq!(score["iou"], 1.0);
    let mut fit = args(&["fit".as_ref(), name]);
    fit.extend(QUICK.map(OsString::from));
    let _ = dir.run(fit).ok();
    // Its folder can be typed.
    assert!(dir.path("runs/pal\u{fffd}m/best.toml").exists());
}

#[test]
fn a_fit_says_what_is_odd_about_its_goal_and_goes_on() {
    let dir = Dir::new();
    let fit = |goal: &Path| dir.run([&["fit", goal.to_str().unwrap(), "--overwrite"][..], &QUICK].concat());
    let quiet = fit(&target("acer.png"));
    let _ = quiet.ok();
    assert!(!quiet.stderr().contains("warning"), "{quiet}");
    let square = image::GrayImage::from_fn(64, 64, |x, y| {
        image::Luma([if (16..48).contains(&x) && (16..48).contains(&y) { 0 } else { 255 }])
    });
    square.save(dir.path("square.png")).unwrap();
    let odd = fit(&dir.path("square.png"));
    let _ = odd.ok();
    assert!(odd.stderr().contains("square.png: the shape has neither gaps nor notches"), "{odd}");
}

/// The peak of memory that the system allows is what counts here: 1.5 GB of addresses.
#[cfg(target_os = "linux")]
#[test]
fn a_colour_profile_that_unpacks_to_a_gigabyte_fits_in_less() {
    let dir = Dir::new();
    // Stored blocks cannot be large, so the bomb of the library's tests is made here the short way: a long
    // run of matches in one block of fixed codes.
    let mut bits = "110".to_owned() + "00110000";
    // Symbol 285 is 258 bytes, distance code 0 is one byte back; 8 of them are 13 bytes.
    let eight = "1100010100000".repeat(8);
    bits.truncate(11);
    // Fill to a whole byte with literals of eight bits each, then whole bytes of eight matches.
    let mut stream = vec![0x78, 0x9c];
    let pack = |bits: &str, out: &mut Vec<u8>, left: &mut String| {
        left.push_str(bits);
        let whole = left.len() / 8 * 8;
        for byte in left.as_bytes()[..whole].chunks(8) {
            out.push((0..8).map(|i| u8::from(byte[i] == b'1') << i).sum());
        }
        *left = left[whole..].to_owned();
    };
    let mut left = String::new();
    pack(&bits, &mut stream, &mut left);
    let start = stream.len();
    pack(&eight, &mut stream, &mut left);
    let unit = stream[start..].to_vec();
    assert_eq!(unit.len(), 13);
    for _ in 0..(2_u64 << 30) / (8 * 258) {
        stream.extend_from_slice(&unit);
    }
    pack("00000000000000", &mut stream, &mut left);
    let png = std::fs::read(target("acer.png")).unwrap();
    let profile = pleach_tests::png_chunk(b"iCCP", &[b"profile\0\0", &stream[..]].concat());
    let bomb = dir.file("bomb.png", [&png[..33], &profile, &png[33..]].concat());
    let script = format!(
        "ulimit -v 1500000; exec {} score {} {} --json --threads 1",
        pleach_tests::program().display(),
        bomb.display(),
        target("acer.png").display()
    );
    let output = std::process::Command::new("sh").args(["-c", &script]).output().unwrap();
    assert_eq!(Run::new("a bomb".to_owned(), output).json()["iou"], 1.0);
}

#[test]
fn gif_and_bmp_are_goals_like_any_other() {
    let dir = Dir::new();
    let picture = image::open(target("palm.png")).unwrap();
    let palm = target("palm.png");
    let iou = |name: &str| {
        dir.run(["score", name, palm.to_str().unwrap(), "--json"]).json()["iou"].as_f64().unwrap()
    };
    for name in ["palm.gif", "palm.bmp"] {
        picture.to_rgb8().save(dir.path(name)).unwrap();
        assert_eq!(iou(name), 1.0, "{name}");
        let whole = std::fs::read(dir.path(name)).unwrap();
        let _ = dir.file("half.pic", &whole[..whole.len() / 2]);
        dir.run(["score", "half.pic", "half.pic"]).fails(1, &["half.pic", "damaged or incomplete"]);
    }
    // Of an animation the first picture counts.
    let mut frames = Vec::new();
    let mut encoder = image::codecs::gif::GifEncoder::new(&mut frames);
    let blank = image::RgbaImage::from_pixel(picture.width(), picture.height(), image::Rgba([255; 4]));
    for frame in [picture.to_rgba8(), blank] {
        encoder.encode_frame(image::Frame::new(frame)).unwrap();
    }
    drop(encoder);
    let _ = dir.file("palms.gif", &frames);
    assert_eq!(iou("palms.gif"), 1.0);
}

#[test]
fn a_drawing_is_a_goal_like_any_other() {
    let dir = Dir::new();
    let tree = "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 200 200'>
        <rect x='92' y='120' width='16' height='70'/><circle cx='100' cy='75' r='60' fill='darkgreen'/></svg>";
    let _ = dir.file("tree.svg", tree);
    // Drawings have a longer side of 1024 pixels.
    image::GrayImage::from_fn(1024, 1024, |x, y| {
        let [x, y] = [x, y].map(|place| (f64::from(place) + 0.5) * 200.0 / 1024.0);
        let trunk = (92.0..108.0).contains(&x) && (120.0..190.0).contains(&y);
        image::Luma([if trunk || (x - 100.0).hypot(y - 75.0) < 60.0 { 0 } else { 255 }])
    })
    .save(dir.path("tree.png"))
    .unwrap();
    let scores = dir.run(["score", "tree.svg", "tree.png", "--json"]).json();
    assert!(scores["iou"].as_f64().unwrap() > 0.98, "{scores}");
    assert_eq!(piped(&dir, &["score", "-", "tree.svg", "--json"], tree.as_bytes()).json()["iou"], 1.0);
    let _ = dir.run([&["fit", "tree.svg", "--out", "run"][..], &QUICK].concat()).ok();
    // It goes on only with the same drawing.
    let _ = dir.file("tree.svg", tree.replace("'60'", "'50'"));
    dir.run([&["fit", "tree.svg", "--out", "run", "--resume"][..], &QUICK].concat()).fails(1, &["tree.svg"]);
    let _ = dir.file(
        "blur.svg",
        tree.replace("<rect", "<filter id='f'><feGaussianBlur/></filter><rect filter='url(#f)'"),
    );
    dir.run(["score", "blur.svg", "tree.png"]).fails(1, &["blur.svg is a drawing", "filter", "PNG"]);
    let _ = dir.file("half.svg", &tree[..60]);
    dir.run(["score", "half.svg", "tree.png"]).fails(1, &["half.svg is a drawing"]);
}

#[test]
fn pictures_that_claim_to_be_huge_are_refused_before_they_are_decoded() {
    let dir = Dir::new();
    let mut bmp = b"BM\x00\x00\x00\x00\0\0\0\0\x36\0\0\0\x28\0\0\0".to_vec();
    for side in [60_000_i32, -60_000] {
        bmp.extend(side.to_le_bytes());
    }
    bmp.extend([1, 0, 24, 0]);
    bmp.resize(54, 0);
    let _ = dir.file("huge.bmp", &bmp);
    let gif = [
        b"GIF89a",
        &[0xff, 0xff, 0xff, 0xff, 0, 0, 0][..],
        &[0x2c, 0, 0, 0, 0, 0xff, 0xff, 0xff, 0xff, 0, 2, 1, 7, 0, 0x3b],
    ];
    let _ = dir.file("huge.gif", gif.concat());
    for name in ["huge.bmp", "huge.gif"] {
        dir.run(["score", name, name]).fails(1, &[name, "at most 8192 to a side"]);
    }
}

#[test]
#[cfg(unix)]
fn pictures_of_telephones_are_converted_by_a_program_of_the_system() {
    use std::os::unix::fs::PermissionsExt as _;
    let dir = Dir::new();
    let palm = target("palm.png");
    // What a converter would make of it stands behind the head of a HEIC file.
    let head = b"\0\0\0\x18ftypheic\0\0\0\0mif1heic";
    let _ = dir.file("-palm.heic", [&head[..], &std::fs::read(&palm).unwrap()].concat());
    let score = |path: &str| {
        let mut command = dir.command(["score", "./-palm.heic", palm.to_str().unwrap(), "--json"]);
        Run::new("score".to_owned(), command.env("PATH", path).output().unwrap())
    };
    score("").fails(1, &["-palm.heic is a HEIC picture", "none of the programs", "heif-convert", "libheif"]);
    let _ = dir.file("heif-convert", "#!/bin/sh\n/usr/bin/tail -c +25 \"$1\" > \"$2\"\n");
    let tool = dir.path("heif-convert");
    std::fs::set_permissions(&tool, std::fs::Permissions::from_mode(0o755)).unwrap();
    let bin = dir.path("").display().to_string();
    let run = score(&bin);
    assert_eq!(run.json()["iou"], 1.0, "{run}");
    assert!(run.stderr().contains("converted by heif-convert"), "{run}");
    // A run is known by the file, whatever a converter writes into its picture.
    let text = "#!/bin/sh\n/usr/bin/tail -c +25 \"$1\" > \"$2\"; /bin/date +%N >> \"$2\"\n";
    std::fs::write(&tool, text).unwrap();
    let fit = |resume: &[&str]| {
        let flags =
            ["--evaluations", "3", "--size", "64", "--from", "palm", "--individual", "off", "--out", "run"];
        let mut command = dir.command(["fit", "./-palm.heic"].iter().chain(&flags).chain(resume));
        Run::new("fit".to_owned(), command.env("PATH", &bin).output().unwrap())
    };
    let _ = fit(&[]).ok();
    let _ = fit(&["--resume"]).ok();
    // So are further pictures.
    let view = fit(&["--view", "90=./-palm.heic", "--overwrite"]);
    assert_eq!(view.code(), 0, "{view}");
    assert!(dir.path("run/overlay-view-1.png").exists());
    std::fs::write(&tool, "#!/bin/sh\necho no codec >&2; exit 3\n").unwrap();
    score(&bin).fails(1, &["heif-convert does not convert", "no codec"]);
}
