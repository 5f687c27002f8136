//! Two pictures, or the pictures of two folders by name.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use image::RgbaImage;

use super::{CompareArgs, bad_input};
use crate::compare::{
    Comparison, Fault, Item, Kind, Metric, PictureDifference, Tolerance, side_by_side,
};

/// The comparison, and a page of the worst picture: A, B and where they differ.
pub fn compare(
    args: &CompareArgs,
    tolerance: Option<Tolerance>,
) -> Result<(Comparison, Option<RgbaImage>)> {
    let levels = tolerance.map_or(0, |t| t.levels);
    let mut items = Vec::new();
    let mut worst: Option<(f64, RgbaImage)> = None;
    for Match { name, a, b } in matches(&args.a, &args.b)? {
        let mut item = Item { name, ..Item::default() };
        match (a, b) {
            (Some(a), Some(b)) => {
                let [a, b] = [read(&a)?, read(&b)?];
                let page = differ(&mut item, &a, &b, levels);
                let flip = item.value(Metric::Flip).flatten().unwrap_or(f64::INFINITY);
                if args.diff.is_some() && worst.as_ref().is_none_or(|(most, _)| flip > *most) {
                    worst = Some((flip, page));
                }
            }
            (Some(_), None) => item.fault = Some(Fault::OnlyInA),
            (None, _) => item.fault = Some(Fault::OnlyInB),
        }
        items.push(item);
    }
    let [a, b] = [&args.a, &args.b].map(|path| path.display().to_string());
    let comparison = Comparison { a, b, kind: Kind::Pictures, tolerance, items };
    Ok((comparison, worst.map(|(_, page)| page)))
}

/// Fills in what differs and returns the page that shows it.
fn differ(item: &mut Item, a: &RgbaImage, b: &RgbaImage, levels: u8) -> RgbaImage {
    if a.dimensions() != b.dimensions() {
        let [a_size, b_size] = [a, b].map(|p| <[u32; 2]>::from(p.dimensions()));
        item.fault = Some(Fault::Sizes { a: a_size, b: b_size });
        return side_by_side(&[a, b]);
    }
    let difference = PictureDifference::new(a, b, levels);
    item.values = difference.values();
    side_by_side(&[a, b, &difference.picture(a.width())])
}

fn read(path: &Path) -> Result<RgbaImage> {
    let picture = image::open(path)
        .with_context(|| format!("cannot read the picture {:?}", path.display()))
        .map_err(bad_input)?;
    Ok(picture.to_rgba8())
}

/// Two files that go by one name, or one whose other is missing.
pub(super) struct Match {
    pub name: String,
    pub a: Option<PathBuf>,
    pub b: Option<PathBuf>,
}

/// Two files as they are; of two folders the PNG files, in order of name.
///
/// # Errors
/// If a folder cannot be read, or neither holds a picture.
pub(super) fn matches(a: &Path, b: &Path) -> Result<Vec<Match>> {
    if !a.is_dir() {
        let name = b.file_name().unwrap_or(b.as_os_str()).to_string_lossy().into_owned();
        return Ok(vec![Match { name, a: Some(a.to_owned()), b: Some(b.to_owned()) }]);
    }
    let [in_a, in_b] = [names(a)?, names(b)?];
    if in_a.is_empty() && in_b.is_empty() {
        let why = format!("there is no PNG file in {:?} or {:?}", a.display(), b.display());
        return Err(bad_input(anyhow::Error::msg(why)));
    }
    let all: BTreeSet<&String> = in_a.union(&in_b).collect();
    let path = |folder: &Path, names: &BTreeSet<String>, name: &String| {
        names.contains(name).then(|| folder.join(name))
    };
    Ok(all
        .into_iter()
        .map(|name| Match { name: name.clone(), a: path(a, &in_a, name), b: path(b, &in_b, name) })
        .collect())
}

fn names(folder: &Path) -> Result<BTreeSet<String>> {
    let listed = || -> Result<BTreeSet<String>> {
        let mut names = BTreeSet::new();
        for entry in fs::read_dir(folder)? {
            let path = entry?.path();
            let is_png = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("png"));
            if let Some(name) = path.file_name().and_then(|n| n.to_str())
                && is_png
                && !name.starts_with('.')
                && path.is_file()
            {
                names.insert(name.to_owned());
            }
        }
        Ok(names)
    };
    listed().with_context(|| format!("cannot list {:?}", folder.display())).map_err(bad_input)
}
