// Translucent triangles of one colour each: marks that shine through what is in front of them.

struct FillPoint {
    @builtin(position) point_in_clip: vec4<f32>,
    @location(0) colour: vec4<f32>,
}

// What remains of a mark behind a surface.
const HIDDEN_FILL_SHARE: f32 = 0.42;
// A mark wins against the surface that it lies on, by this share of the depth range.
const FILL_DEPTH_BIAS: f32 = 1e-5;

@vertex
fn vs_fill(
    @location(0) point_in_local: vec3<f32>,
    @location(1) colour: vec4<f32>,
) -> FillPoint {
    var out: FillPoint;
    out.point_in_clip = scene.clip_from_local * vec4<f32>(point_in_local, 1.0);
    out.point_in_clip.z -= FILL_DEPTH_BIAS * out.point_in_clip.w;
    out.colour = linear_from_srgb(colour);
    return out;
}

@fragment
fn fs_fill(in: FillPoint) -> @location(0) vec4<f32> {
    return in.colour;
}

@fragment
fn fs_hidden_fill(in: FillPoint) -> @location(0) vec4<f32> {
    return in.colour * vec4<f32>(1.0, 1.0, 1.0, HIDDEN_FILL_SHARE);
}
