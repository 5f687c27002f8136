//! What can be tuned while a shot runs: which settings, how they are called, and in what range.

mod table;
mod value;

pub(super) use value::stated_value;
pub use value::{default_value, value};

use serde_json::Value;

use crate::scene::{Known, Scene, contact_thickness_most, shot_schema};
use table::{AIR, CONTACT, FABRIC, Row, SIZING, VIEW};

/// A setting that can be tuned.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// As an override names it, `garments.0.view.nu_back`.
    pub path: String,
    /// A few words of an artist.
    pub label: &'static str,
    /// Empty for a plain number.
    pub unit: &'static str,
    pub kind: ParameterKind,
    /// The program's own value, whatever the shot says; `None` where there is none.
    pub default: Option<Value>,
    /// The format's own sentence, with the consequence of a change.
    pub help: String,
    /// Under which heading it stands.
    pub group: String,
}

/// What values there are. Within its range a value is accepted beside any others in theirs; the
/// range is that of a slider, and what a shot says or somebody types may lie outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ParameterKind {
    Number {
        min: f64,
        max: f64,
        scale: Scale,
        /// Digits after the point that are worth showing.
        decimals: usize,
        off: Off,
    },
    Integer {
        min: i64,
        max: i64,
    },
    /// Three components of the same range.
    Vector3 {
        min: f64,
        max: f64,
        decimals: usize,
    },
}

/// How a slider runs from one end to the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    Linear,
    /// Equal steps are equal factors; the range is above 0.
    Logarithmic,
}

/// Whether `null`, infinity, is a value: the criterion is off.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Off {
    Never,
    Null,
}

/// The settings of a shot that can be tuned, those that matter most first. `written` is
/// [`LoadedShot::written`](crate::scene::LoadedShot).
///
/// A garment has view settings of its own where there are several garments, or where the shot gives
/// it one. A fabric whose name an override cannot hold (with `.` or `=` in it) is left out.
pub fn parameters(written: &Value, scene: &Scene) -> Vec<Parameter> {
    let schema = shot_schema();
    let mut list = List { known: Known::of(&schema), parameters: Vec::new() };
    list.add("View", "view.", &VIEW);
    for (index, garment) in scene.garments.iter().enumerate() {
        let path = format!("garments.{index}.view.");
        let own = VIEW.iter().filter(|row| {
            scene.garments.len() > 1 || value::stated(written, &format!("{path}{}", row.name))
        });
        list.add(&format!("View: {}", garment.name), &path, own);
    }
    for (index, garment) in scene.garments.iter().enumerate() {
        let path = format!("garments.{index}.sizing.");
        list.add(&format!("Sizing: {}", garment.name), &path, &SIZING);
        list.part_edge_lengths(garment.sizing.edge_length_min, garment.sizing.edge_length_max);
    }
    list.add("Time and air", "", &AIR);
    list.add("Contact", "contact.", &CONTACT);
    list.bound_thickness(scene);
    for name in fabrics_in_use(written) {
        list.add(&format!("Fabric: {name}"), &format!("fabrics.{name}."), &FABRIC);
    }
    list.parameters
}

/// Each once, in the order of the garments.
fn fabrics_in_use(written: &Value) -> Vec<&str> {
    let mut names = Vec::new();
    for garment in written["garments"].as_array().into_iter().flatten() {
        if let Some(name) = garment["fabric"].as_str()
            && !names.contains(&name)
            && !name.contains(['.', '='])
        {
            names.push(name);
        }
    }
    names
}

struct List<'a> {
    known: Known<'a>,
    parameters: Vec<Parameter>,
}

impl List<'_> {
    fn add<'r>(&mut self, group: &str, prefix: &str, rows: impl IntoIterator<Item = &'r Row>) {
        for row in rows {
            let path = format!("{prefix}{}", row.name);
            self.parameters.push(Parameter {
                label: row.label,
                unit: row.unit,
                kind: row.kind,
                default: default_value(&path),
                help: self.known.help(&path).unwrap_or_default(),
                group: group.to_owned(),
                path,
            });
        }
    }

    /// The thickest contact, which was added last with its group, is what the smallest garment allows.
    fn bound_thickness(&mut self, scene: &Scene) {
        let areas = scene.garments.iter().map(|garment| garment.mesh.total_material_area());
        let most = areas.map(contact_thickness_most).fold(f64::INFINITY, f64::min);
        let of_contact = self.parameters.iter_mut().rev().take(CONTACT.len());
        for Parameter { path, kind, .. } in of_contact {
            if let ("contact.thickness", ParameterKind::Number { min, max, .. }) =
                (path.as_str(), kind)
            {
                // Short of the limit, so that rounding does not pass it.
                *max = max.min(0.99 * most);
                *min = min.min(*max);
            }
        }
    }

    /// The ranges of the garment's edge lengths, which were added last, must not overlap, since the
    /// shortest is at most the longest: they meet at a length between what the garment has (m). Each
    /// spans a factor of ten at least.
    fn part_edge_lengths(&mut self, shortest: f64, longest: f64) {
        if !shortest.is_finite() {
            return;
        }
        let meeting = table::EDGE_LENGTH_MEETING.max(shortest).min(longest);
        let of_garment = self.parameters.iter_mut().rev().take(SIZING.len());
        for Parameter { path, kind, .. } in of_garment {
            let ParameterKind::Number { min, max, .. } = kind else { continue };
            match path.rsplit('.').next() {
                Some("edge_length_min") => (*min, *max) = (min.min(0.1 * meeting), meeting),
                Some("edge_length_max") => (*min, *max) = (meeting, max.max(10.0 * meeting)),
                _ => {}
            }
        }
    }
}

#[cfg(test)]
mod tests;
