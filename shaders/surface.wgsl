// Cloth and obstacles: lit from both sides, coloured by face, with the mesh drawn on top.

struct Material {
    // Albedo of the two sides where no colour map is shown.
    front_tint: vec3<f32>,
    // 0: tints, 1: the colour map.
    table_share: f32,
    back_tint: vec3<f32>,
    table_row: u32,
    // How dark the mesh's edges are, 0..1.
    wire_strength: f32,
    // Brightening towards grazing angles, as loose fibres do, 0..1.
    sheen: f32,
    // How much of the light's modelling is kept, 0..1: less keeps a colour map readable.
    modelling: f32,
    unused: f32,
}

@group(1) @binding(0) var<uniform> material: Material;

// Lights stand still in the world, so that all views agree. Z is up.
const KEY_DIRECTION: vec3<f32> = vec3<f32>(-0.7005, -0.4003, 0.5908);
const KEY_LIGHT: vec3<f32> = vec3<f32>(0.90, 0.87, 0.82);
const FILL_DIRECTION: vec3<f32> = vec3<f32>(0.7845, 0.5883, 0.1961);
const FILL_LIGHT: vec3<f32> = vec3<f32>(0.14, 0.15, 0.18);
const SKY_LIGHT: vec3<f32> = vec3<f32>(0.47, 0.48, 0.51);
const GROUND_LIGHT: vec3<f32> = vec3<f32>(0.27, 0.26, 0.25);
// How far the key light reaches around the terminator.
const KEY_WRAP: f32 = 0.12;
// The light that `modelling` = 0 leaves.
const EVEN_LIGHT: vec3<f32> = vec3<f32>(0.86, 0.86, 0.86);
// What is left of the light where a surface turns away from the eye: folds read from any side, even
// with the key light behind the camera.
const GRAZING_SHARE: f32 = 0.58;
// The back of a face in a colour map: darker and greyer, the hue unchanged.
const BACK_SHADE: f32 = 0.70;
const BACK_GREY: f32 = 0.22;
const LUMINANCE: vec3<f32> = vec3<f32>(0.2126, 0.7152, 0.0722);
// Edges fade out where a face's smallest height is between these: they would be a dark mush.
const WIRE_GONE_PX: f32 = 2.5;
const WIRE_FULL_PX: f32 = 9.0;

struct SurfacePoint {
    @builtin(position) point_in_clip: vec4<f32>,
    @location(0) point_in_local: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) barycentric: vec3<f32>,
    @location(3) @interpolate(flat) colour_coordinate: f32,
}

@vertex
fn vs_surface(
    @builtin(vertex_index) index: u32,
    @location(0) point_in_local: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) colour_coordinate: f32,
) -> SurfacePoint {
    var out: SurfacePoint;
    out.point_in_clip = scene.clip_from_local * vec4<f32>(point_in_local, 1.0);
    out.point_in_local = point_in_local;
    out.normal = normal;
    let corner = index % 3u;
    out.barycentric = vec3<f32>(f32(corner == 0u), f32(corner == 1u), f32(corner == 2u));
    out.colour_coordinate = colour_coordinate;
    return out;
}

fn light_on(normal: vec3<f32>) -> vec3<f32> {
    let sky = mix(GROUND_LIGHT, SKY_LIGHT, 0.5 + 0.5 * normal.z);
    let key = max(dot(normal, KEY_DIRECTION) + KEY_WRAP, 0.0) / (1.0 + KEY_WRAP);
    let fill = max(dot(normal, FILL_DIRECTION), 0.0);
    let light = sky + KEY_LIGHT * key + FILL_LIGHT * fill;
    return mix(EVEN_LIGHT, light, material.modelling);
}

fn albedo(coordinate: f32, front: bool) -> vec3<f32> {
    let last = f32(textureDimensions(colour_tables).x - 1u);
    let column = i32(clamp(coordinate, 0.0, 1.0) * last + 0.5);
    var mapped = textureLoad(colour_tables, vec2<i32>(column, i32(material.table_row)), 0).rgb;
    if (!front) {
        mapped = mix(mapped, vec3<f32>(dot(mapped, LUMINANCE)), BACK_GREY) * BACK_SHADE;
    }
    let tint = select(material.back_tint, material.front_tint, front);
    return mix(tint, mapped, material.table_share);
}

fn wire_coverage(barycentric: vec3<f32>) -> f32 {
    let dx = dpdx(barycentric);
    let dy = dpdy(barycentric);
    let per_px = max(sqrt(dx * dx + dy * dy), vec3<f32>(1e-6));
    let distance_px = barycentric / per_px;
    let nearest = min(distance_px.x, min(distance_px.y, distance_px.z));
    let line = clamp(scene.wire_half_width_px + 0.5 - nearest, 0.0, 1.0);
    let smallest_height_px = 1.0 / max(per_px.x, max(per_px.y, per_px.z));
    return line * smoothstep(WIRE_GONE_PX, WIRE_FULL_PX, smallest_height_px);
}

@fragment
fn fs_surface(in: SurfacePoint, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let wire = wire_coverage(in.barycentric) * material.wire_strength;
    let to_eye = normalize(scene.eye_in_local - in.point_in_local);
    let outward = normalize(in.normal) * select(-1.0, 1.0, front);
    let facing = clamp(dot(outward, to_eye), 0.0, 1.0);
    let depth = mix(1.0, mix(GRAZING_SHARE, 1.0, sqrt(facing)), material.modelling);
    let light = light_on(outward) * depth;
    let grazing_squared = (1.0 - facing) * (1.0 - facing);
    let loose_fibres = material.sheen * 0.25 * grazing_squared * grazing_squared;
    let colour = (albedo(in.colour_coordinate, front) + loose_fibres) * light;
    return vec4<f32>(mix(colour, colour * 0.12, wire), 1.0);
}
