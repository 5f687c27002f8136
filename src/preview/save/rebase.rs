//! File names in a shot that moves to another folder.

use std::path::{Component, Path, PathBuf};

use jsonc_parser::ast;
use jsonc_parser::common::Ranged;
use serde_json::Value;

use super::put::Document;
use super::{SaveError, parted_mark};

/// Where a shot file names files; `*` is any key or index.
const FILE_NAMES: [&str; 9] = [
    "import",
    "camera",
    "viewers.*",
    "garments.*.mesh",
    "fabrics.*.file",
    "motions.*.file",
    "obstacles.*.mesh",
    "obstacles.*.meshes.*.mesh",
    "obstacles.*.mesh_sequence.pattern",
];

/// The text of a shot file that moves from one folder to another, with every relative file name as
/// the new folder sees the same file; absolute where there is no way between them, as between drives.
/// Names that are absolute stay.
///
/// Both folders are given in full. Where links lie on the way, give them as the file system resolves
/// them: a name like `../a` means the folder above what a link leads to.
///
/// # Errors
/// If the text is no object in JSON with comments, or a folder is not given in full.
pub fn rebased(text: &str, from: &Path, to: &Path) -> Result<String, SaveError> {
    if let Some(folder) = [from, to].into_iter().find(|folder| !folder.is_absolute()) {
        return Err(SaveError::RelativeFolder(folder.to_owned()));
    }
    let (mark, text) = parted_mark(text);
    let document = Document::parse(text)?;
    let mut names = Vec::new();
    for place in FILE_NAMES {
        let segments: Vec<&str> = place.split('.').collect();
        for property in &document.root.properties {
            if property.name.as_str() == segments[0] {
                collect(&property.value, &segments[1..], &mut names);
            }
        }
    }
    names.sort_by_key(|name| name.start());
    let mut rebased = text.to_owned();
    for name in names.into_iter().rev().filter(|name| !Path::new(name.value.as_ref()).is_absolute())
    {
        let seen = seen_from(to, &from.join(name.value.as_ref()));
        rebased.replace_range(name.start()..name.end(), &Value::from(seen).to_string());
    }
    Ok(format!("{mark}{rebased}"))
}

/// A file's name as a folder sees it, with `/` between the parts; the whole path where there is no
/// way from one to the other. Both are given in full; links are not followed.
pub fn seen_from(folder: &Path, file: &Path) -> String {
    let (folder, file) = (without_detours(folder), without_detours(file));
    let parts = |path: &Path| -> Vec<String> {
        path.components().map(|part| part.as_os_str().to_string_lossy().into_owned()).collect()
    };
    let (above, below) = (parts(&folder), parts(&file));
    let common = above.iter().zip(&below).take_while(|(a, b)| a == b).count();
    if common == 0 {
        return file.to_string_lossy().into_owned();
    }
    let up = std::iter::repeat_n("..", above.len() - common);
    up.chain(below[common..].iter().map(String::as_str)).collect::<Vec<_>>().join("/")
}

/// Without `.`, and with `..` taken out.
fn without_detours(path: &Path) -> PathBuf {
    path.components().fold(PathBuf::new(), |mut path, part| {
        match part {
            Component::CurDir => {}
            Component::ParentDir => {
                path.pop();
            }
            other => path.push(other),
        }
        path
    })
}

fn collect<'d, 'a>(
    value: &'d ast::Value<'a>,
    segments: &[&str],
    names: &mut Vec<&'d ast::StringLit<'a>>,
) {
    match (value, segments.split_first()) {
        (ast::Value::StringLit(name), None) => names.push(name),
        (ast::Value::Array(list), Some((&"*", rest))) => {
            list.elements.iter().for_each(|element| collect(element, rest, names));
        }
        (ast::Value::Object(group), Some((&segment, rest))) => {
            for property in &group.properties {
                if segment == "*" || segment == property.name.as_str() {
                    collect(&property.value, rest, names);
                }
            }
        }
        _ => {}
    }
}
