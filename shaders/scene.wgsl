// What every pass shares: the view and the background. Mirrored by `render/uniforms.rs`.
// "Local" is the world moved to the draw list's origin (m), so that 32 bits are enough.

struct Scene {
    clip_from_local: mat4x4<f32>,
    eye_in_local: vec3<f32>,
    // Half of a wireframe line belongs to each of an edge's two faces.
    wire_half_width_px: f32,
    // Linear, as all colours in the shaders.
    background_top: vec3<f32>,
    width_px: f32,
    background_bottom: vec3<f32>,
    height_px: f32,
}

@group(0) @binding(0) var<uniform> scene: Scene;
// A row for each colour map; decoded to linear when read.
@group(0) @binding(1) var colour_tables: texture_2d<f32>;

// A colour as it is written, with its opacity.
fn linear_from_srgb(c: vec4<f32>) -> vec4<f32> {
    let low = c.rgb / 12.92;
    let high = pow((c.rgb + 0.055) / 1.055, vec3<f32>(2.4));
    return vec4<f32>(select(high, low, c.rgb <= vec3<f32>(0.04045)), c.a);
}
