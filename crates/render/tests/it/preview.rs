//! Pictures: what must be true of them beside looking good.

use pleach_mesh::Palette;
use pleach_render::preview::{Background, Ground};
use pleach_render::{Picture, Preview, PreviewSettings, png_file};
use pleach_tree::Tree;
use pleach_tree::{Color, Season};

fn grown(name: &str, season: Option<Season>) -> (Tree, Palette) {
    let species = pleach_generators::preset(name).unwrap();
    let mut tree = species.grow(1).unwrap();
    let palette = Palette::new(&species.appearance, season);
    palette.apply_season(&mut tree);
    (tree, palette)
}

fn picture(name: &str, season: Option<Season>, settings: &PreviewSettings) -> Picture {
    let (tree, palette) = grown(name, season);
    Preview::new(&tree, &palette, 96).picture(settings)
}

fn small() -> PreviewSettings {
    let (background, ground) = (Background::Transparent, Ground::None);
    PreviewSettings { width: 96, height: 96, background, ground, ..PreviewSettings::default() }
}

fn mean(picture: &Picture) -> [f64; 4] {
    let mut sum = [0.0; 4];
    for pixel in picture.rgba.chunks_exact(4) {
        let alpha = f64::from(pixel[3]);
        (0..3).for_each(|k| sum[k] += f64::from(pixel[k]) * alpha);
        sum[3] += alpha;
    }
    [sum[0] / sum[3], sum[1] / sum[3], sum[2] / sum[3], sum[3] / 255.0]
}

#[test]
fn a_transparent_picture_shows_the_tree_alone() {
    let picture = picture("acer", None, &small());
    assert_eq!(picture.rgba.len(), 96 * 96 * 4);
    let edge = (0..96).flat_map(|i| [(i, 0), (i, 95), (0, i), (95, i)]);
    assert!(edge.into_iter().all(|(x, y)| picture.rgba[(y * 96 + x) * 4 + 3] == 0), "the tree is inside");
    let covered = mean(&picture)[3] / (96.0 * 96.0);
    assert!((0.05..0.6).contains(&covered), "{covered}");
    let high: Vec<usize> =
        (0..96).filter(|y| (0..96).any(|x| picture.rgba[(y * 96 + x) * 4 + 3] > 0)).collect();
    assert!(high.len() > 80, "the tree fills the picture: {} rows", high.len());
}

#[test]
fn leaves_are_green_in_summer_and_not_in_autumn() {
    let [r, g, b, _] = mean(&picture("quaking_aspen", None, &small()));
    assert!(g > r && g > b, "{r} {g} {b}");
    let [r, g, b, _] = mean(&picture("quaking_aspen", Some(Season::Autumn), &small()));
    assert!(r > g && g > b, "{r} {g} {b}");
    let winter = mean(&picture("quaking_aspen", Some(Season::Winter), &small()));
    let summer = mean(&picture("quaking_aspen", None, &small()));
    assert!(winter[3] < 0.6 * summer[3], "winter is bare");
}

#[test]
fn the_sun_stands_at_the_upper_left_and_the_ground_takes_the_shadow() {
    let bare = picture("black_tupelo", None, &small());
    let light = |left: bool| {
        let mut sum = (0.0, 0.0);
        for (i, pixel) in bare.rgba.chunks_exact(4).enumerate() {
            if (i % 96 < 48) == left && pixel[3] == 255 {
                sum = (sum.0 + f64::from(pixel[1]), sum.1 + 1.0);
            }
        }
        sum.0 / sum.1
    };
    assert!(light(true) > light(false), "{} {}", light(true), light(false));
    let shadow = picture("black_tupelo", None, &PreviewSettings { ground: Ground::Shadow, ..small() });
    let half: usize = shadow.rgba.chunks_exact(4).filter(|p| (20..200).contains(&p[3])).count();
    assert!(half > 200, "a shadow is there and can be seen through: {half}");
}

#[test]
fn a_plain_background_is_exactly_its_colour() {
    let background = Background::Plain(Color([10, 200, 30]));
    let picture = picture("palm", None, &PreviewSettings { background, ..small() });
    assert_eq!(picture.rgba[..4], [10, 200, 30, 255]);
    assert!(picture.rgba.chunks_exact(4).all(|p| p[3] == 255));
}

#[test]
fn the_same_picture_whatever_the_number_of_threads() {
    let [one, three] = [1, 3].map(|n| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n).build().unwrap();
        pool.install(|| picture("palm", None, &PreviewSettings { ground: Ground::Grass, ..small() }))
    });
    assert!(one == three);
}

#[test]
fn a_turn_table_keeps_the_tree_inside_and_nothing_is_no_panic() {
    let (tree, palette) = grown("acer", None);
    let preview = Preview::new(&tree, &palette, 96);
    for i in 0..6 {
        let settings = PreviewSettings { azimuth: f64::from(i), all_around: true, ..small() };
        let picture = preview.picture(&settings);
        let edge = (0..96).flat_map(|i| [(i, 0), (i, 95), (0, i), (95, i)]);
        assert!(edge.into_iter().all(|(x, y)| picture.rgba[(y * 96 + x) * 4 + 3] == 0), "turn {i}");
    }
    let nothing = Preview::new(&Tree::default(), &palette, 96).picture(&small());
    assert!(nothing.rgba.iter().all(|b| *b == 0));
}

#[test]
fn pasting_stays_inside() {
    let dot = |width: u32, height: u32, value: u8| Picture {
        width,
        height,
        rgba: vec![value; (width * height * 4) as usize],
    };
    let mut page = dot(4, 3, 0);
    page.paste(&dot(2, 2, 9), 3, 2);
    page.paste(&dot(1, 1, 7), 4, 0);
    page.paste(&dot(1, 1, 7), 0, 9);
    assert!(page.rgba[..44].iter().all(|v| *v == 0) && page.rgba[44..] == [9; 4]);
}

#[test]
fn png_files_hold_one_picture_or_an_animation() {
    let picture = picture("palm", None, &small());
    let mut file = Vec::new();
    png_file::write(&mut file, &vec![picture.clone(); 3], 100).unwrap();
    let reader = png::Decoder::new(std::io::Cursor::new(&file)).read_info().unwrap();
    assert_eq!(reader.info().animation_control().unwrap().num_frames, 3);
    let mut file = Vec::new();
    png_file::write(&mut file, std::slice::from_ref(&picture), 0).unwrap();
    let mut reader = png::Decoder::new(std::io::Cursor::new(&file)).read_info().unwrap();
    let mut back = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut back).unwrap();
    assert!(back == picture.rgba);
    assert!(png_file::write(&mut Vec::new(), &[], 0).is_err());
}
