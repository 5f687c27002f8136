// Lines of constant width on the image, with round ends and smooth edges. An instance is a line;
// one without length is a dot.

struct LinePoint {
    @builtin(position) point_in_clip: vec4<f32>,
    // Along the line from its start, and across it.
    @location(0) offset_px: vec2<f32>,
    @location(1) @interpolate(flat) length_px: f32,
    @location(2) @interpolate(flat) radius_px: f32,
    @location(3) colour: vec4<f32>,
}

// What remains of a line behind a surface.
const HIDDEN_SHARE: f32 = 0.16;
// Room around a line for its smooth edge.
const FRINGE_PX: f32 = 1.0;
// Lines that lie on a surface win against it, by this share of the depth range.
const DEPTH_BIAS: f32 = 1e-5;

// The part of a..b in front of the near plane, from its end `a`.
fn clipped(a: vec4<f32>, b: vec4<f32>) -> vec4<f32> {
    if (a.z >= 0.0) {
        return a;
    }
    return mix(a, b, a.z / (a.z - b.z));
}

@vertex
fn vs_line(
    @builtin(vertex_index) index: u32,
    @location(0) start_in_local: vec3<f32>,
    @location(1) end_in_local: vec3<f32>,
    @location(2) start_colour: vec4<f32>,
    @location(3) end_colour: vec4<f32>,
    @location(4) width_px: f32,
) -> LinePoint {
    var out: LinePoint;
    let full_start = scene.clip_from_local * vec4<f32>(start_in_local, 1.0);
    let full_end = scene.clip_from_local * vec4<f32>(end_in_local, 1.0);
    if (full_start.z < 0.0 && full_end.z < 0.0) {
        out.point_in_clip = vec4<f32>(2.0, 2.0, 2.0, 1.0);
        return out;
    }
    let start = clipped(full_start, full_end);
    let end = clipped(full_end, full_start);
    let half_size_px = 0.5 * vec2<f32>(scene.width_px, scene.height_px);
    let start_px = start.xy / start.w * half_size_px;
    let end_px = end.xy / end.w * half_size_px;
    let span = end_px - start_px;
    out.length_px = length(span);
    out.radius_px = 0.5 * width_px;
    let along = select(vec2<f32>(1.0, 0.0), span / max(out.length_px, 1e-6), out.length_px > 1e-4);
    let across = vec2<f32>(-along.y, along.x);

    let reach = out.radius_px + FRINGE_PX;
    let at_end = index == 1u || index == 2u || index == 4u;
    let side = select(-reach, reach, index == 2u || index == 4u || index == 5u);
    let forward = select(-reach, out.length_px + reach, at_end);
    out.offset_px = vec2<f32>(forward, side);
    let anchor = select(start, end, at_end);
    let point = (start_px + along * forward + across * side) / half_size_px;
    // Depth is linear on the image, so the division can be done here and nothing bends.
    let depth = max(anchor.z / anchor.w - DEPTH_BIAS, 0.0);
    out.point_in_clip = vec4<f32>(point, depth, 1.0);
    out.colour = linear_from_srgb(select(start_colour, end_colour, at_end));
    return out;
}

fn line_colour(in: LinePoint) -> vec4<f32> {
    let beyond = max(max(-in.offset_px.x, in.offset_px.x - in.length_px), 0.0);
    let distance_px = length(vec2<f32>(beyond, in.offset_px.y));
    let coverage = clamp(in.radius_px + 0.5 - distance_px, 0.0, 1.0);
    return vec4<f32>(in.colour.rgb, in.colour.a * coverage);
}

@fragment
fn fs_line(in: LinePoint) -> @location(0) vec4<f32> {
    return line_colour(in);
}

@fragment
fn fs_hidden_line(in: LinePoint) -> @location(0) vec4<f32> {
    return line_colour(in) * vec4<f32>(1.0, 1.0, 1.0, HIDDEN_SHARE);
}
