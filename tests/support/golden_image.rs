//! Compares a picture with the expected one in its folder.

use std::path::{Path, PathBuf};

use image::{Rgba, RgbaImage};
use serde::Deserialize;

/// How much a picture may differ: adapters and drivers round differently along edges.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Tolerance {
    /// A pixel differs if one of its channels is off by more than this many levels of 255.
    levels: u8,
    /// Share of the pixels that may differ.
    share: f64,
}

/// True if new pictures are to be taken as expected.
pub fn blessing() -> bool {
    std::env::var_os("SHOTSILK_BLESS").is_some_and(|value| value == "1")
}

/// # Panics
/// If the picture differs from `tests/golden/NAME/expected.png` by more than the tolerance.
pub fn check(name: &str, picture: &RgbaImage) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden").join(name);
    let expected_path = folder.join("expected.png");
    if blessing() {
        picture.save(&expected_path).expect("the expected picture can be written");
        return;
    }
    let text = std::fs::read_to_string(folder.join("tolerance.json")).expect("a tolerance");
    let tolerance: Tolerance = serde_json::from_str(&text).expect("a whole tolerance");
    let expected = image::open(&expected_path)
        .unwrap_or_else(|e| panic!("{}: {e}; SHOTSILK_BLESS=1 makes it", expected_path.display()))
        .to_rgba8();
    let share = differing_share(picture, &expected, tolerance.levels);
    if share > tolerance.share {
        let kept = keep(name, picture, &expected);
        panic!(
            "{name}: {:.3} % of the pixels differ by more than {} levels, allowed are {:.3} %; see {}",
            share * 100.0,
            tolerance.levels,
            tolerance.share * 100.0,
            kept.display()
        );
    }
}

/// 1 for pictures of different size.
fn differing_share(a: &RgbaImage, b: &RgbaImage, levels: u8) -> f64 {
    if a.dimensions() != b.dimensions() {
        return 1.0;
    }
    let differs =
        |(p, q): &(&Rgba<u8>, &Rgba<u8>)| p.0.iter().zip(q.0).any(|(x, y)| x.abs_diff(y) > levels);
    let count = a.pixels().zip(b.pixels()).filter(differs).count();
    count as f64 / f64::from(a.width() * a.height())
}

/// Writes the picture and its difference from the expected one, and says where.
fn keep(name: &str, picture: &RgbaImage, expected: &RgbaImage) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("golden").join(name);
    std::fs::create_dir_all(&folder).expect("the target folder is writable");
    picture.save(folder.join("picture.png")).expect("the target folder is writable");
    let difference = RgbaImage::from_fn(picture.width(), picture.height(), |x, y| {
        let a = picture.get_pixel(x, y).0;
        let b = expected.get_pixel_checked(x, y).map_or([0; 4], |p| p.0);
        // Eight times, so that small differences can be seen.
        let channel = |i: usize| a[i].abs_diff(b[i]).saturating_mul(8);
        Rgba([channel(0), channel(1), channel(2), 255])
    });
    difference.save(folder.join("difference.png")).expect("the target folder is writable");
    folder
}

#[test]
fn a_picture_that_differs_in_a_tenth_of_its_pixels_is_told_so() {
    let a = RgbaImage::from_pixel(10, 10, Rgba([100, 100, 100, 255]));
    let mut b = a.clone();
    for x in 0..10 {
        b.put_pixel(x, 3, Rgba([100, 109, 100, 255]));
    }
    assert_eq!(differing_share(&a, &b, 8), 0.1);
    assert_eq!(differing_share(&a, &b, 9), 0.0);
    assert_eq!(differing_share(&a, &RgbaImage::new(9, 10), 255), 1.0);
}
