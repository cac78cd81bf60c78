//! The names that scripts read.

use pleach_reading::Reading;
use pleach_silhouette::Bitmap;

/// The promised keys, in their order.
const KEYS: &str = "feet feet_confidence width_confidence trunk trunk_confidence lean_deg lean_deg_confidence \
    first_fork first_fork_confidence fork_arms_deg fork_x bare_height bare_height_confidence crown crown_confidence \
    crown_widest crown_width crown_widest_confidence asymmetry asymmetry_confidence gap_share gap_by_height gap_sizes \
    gap_share_confidence clumps clumps_confidence twig_fineness twig_fineness_confidence leaf_size_px \
    leaf_size_px_confidence stroke_deg stroke_deg_confidence stroke_upright hanging_ends grain_upright \
    grain_rising grain_confidence foliage_share foliage_share_confidence leaves leaves_confidence";

#[test]
fn the_keys_are_as_promised_and_read_back() {
    let tree = Bitmap::from_fn(100, 120, |x, y| (45..52).contains(&x) || y < 70 && x % 9 > y % 5);
    let reading = Reading::from_silhouette(&tree);
    let text = serde_json::to_string(&reading).unwrap();
    // The JSON reader may be off by the last bit.
    let back: Reading = serde_json::from_str(&text).unwrap();
    assert_eq!(format!("{back:.9?}"), format!("{reading:.9?}"));
    let mut from = 0;
    for key in KEYS.split_whitespace() {
        let at = text[from..].find(&format!("\"{key}\":"));
        from += at.unwrap_or_else(|| panic!("`{key}` is missing, or in another place"));
    }
    let value: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(value.as_object().unwrap().len(), KEYS.split_whitespace().count());
    assert!(value["feet"][0]["x"].is_number() && value["feet"][0]["width"].is_number());
    assert_eq!(value["trunk"][0].as_array().unwrap().len(), 3);
    assert_eq!(value["crown"]["left"].as_array().unwrap().len(), 33);
    assert_eq!(value["crown"]["right"].as_array().unwrap().len(), 33);
    assert!(serde_json::from_str::<Reading>(&text.replace("hanging_ends", "hanging")).is_err());
}
