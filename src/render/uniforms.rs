//! What the shaders read, byte for byte. A test compares this with the shaders themselves.

use bytemuck::{Pod, Zeroable};

/// `Scene` in `scene.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(super) struct SceneUniforms {
    pub clip_from_local: [[f32; 4]; 4],
    pub eye_in_local: [f32; 3],
    pub wire_half_width_px: f32,
    pub background_top: [f32; 3],
    pub width_px: f32,
    pub background_bottom: [f32; 3],
    pub height_px: f32,
}

/// `Material` in `surface.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub(super) struct MaterialUniforms {
    pub front_tint: [f32; 3],
    pub table_share: f32,
    pub back_tint: [f32; 3],
    pub table_row: u32,
    pub wire_strength: f32,
    pub sheen: f32,
    pub modelling: f32,
    pub unused: f32,
}

pub(super) const BACKGROUND_WGSL: &str = concat!(
    include_str!("../../shaders/scene.wgsl"),
    include_str!("../../shaders/background.wgsl")
);
pub(super) const SURFACE_WGSL: &str =
    concat!(include_str!("../../shaders/scene.wgsl"), include_str!("../../shaders/surface.wgsl"));
pub(super) const FILL_WGSL: &str =
    concat!(include_str!("../../shaders/scene.wgsl"), include_str!("../../shaders/fill.wgsl"));
pub(super) const LINES_WGSL: &str =
    concat!(include_str!("../../shaders/scene.wgsl"), include_str!("../../shaders/lines.wgsl"));

#[cfg(test)]
mod tests {
    use std::mem::{offset_of, size_of};

    use super::*;

    /// Names and byte offsets of a struct's members, and its size.
    fn layout(wgsl: &str, name: &str) -> (Vec<(String, usize)>, usize) {
        let module = naga::front::wgsl::parse_str(wgsl).expect("the shader parses");
        let (_, ty) = module
            .types
            .iter()
            .find(|(_, ty)| ty.name.as_deref() == Some(name))
            .unwrap_or_else(|| panic!("the shader has no struct {name}"));
        let naga::TypeInner::Struct { members, span } = &ty.inner else {
            panic!("{name} is no struct");
        };
        let offset = |m: &naga::StructMember| (m.name.clone().unwrap(), m.offset as usize);
        (members.iter().map(offset).collect(), *span as usize)
    }

    macro_rules! assert_mirrors {
        ($wgsl:expr, $name:literal, $ty:ty, [$($field:ident),+ $(,)?]) => {
            let (members, size) = layout($wgsl, $name);
            let mirrored = vec![$((stringify!($field).to_owned(), offset_of!($ty, $field))),+];
            assert_eq!(members, mirrored);
            assert_eq!(size, size_of::<$ty>());
        };
    }

    #[test]
    fn the_scene_has_the_shaders_layout() {
        for wgsl in [BACKGROUND_WGSL, SURFACE_WGSL, FILL_WGSL, LINES_WGSL] {
            assert_mirrors!(
                wgsl,
                "Scene",
                SceneUniforms,
                [
                    clip_from_local,
                    eye_in_local,
                    wire_half_width_px,
                    background_top,
                    width_px,
                    background_bottom,
                    height_px,
                ]
            );
        }
    }

    #[test]
    fn a_material_has_the_shaders_layout() {
        assert_mirrors!(
            SURFACE_WGSL,
            "Material",
            MaterialUniforms,
            [
                front_tint,
                table_share,
                back_tint,
                table_row,
                wire_strength,
                sheen,
                modelling,
                unused,
            ]
        );
    }
}
