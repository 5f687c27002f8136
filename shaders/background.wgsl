// One triangle that covers the frame, with a gradient from top to bottom.

@vertex
fn vs_background(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    let corner = vec2<f32>(f32((index << 1u) & 2u), f32(index & 2u));
    return vec4<f32>(corner * 2.0 - 1.0, 1.0, 1.0);
}

@fragment
fn fs_background(@builtin(position) point_in_image: vec4<f32>) -> @location(0) vec4<f32> {
    let down = point_in_image.y / scene.height_px;
    return vec4<f32>(mix(scene.background_top, scene.background_bottom, down), 1.0);
}
