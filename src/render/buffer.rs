//! Memory on the device whose content changes with every picture.

use super::gpu::Gpu;

/// A buffer that must grow gets this much room at least (bytes).
const BUFFER_SIZE_MIN: u64 = 1 << 16;

/// A buffer that is replaced by a larger one when its content does not fit.
pub(super) struct GrowingBuffer {
    label: &'static str,
    usage: wgpu::BufferUsages,
    pub buffer: Option<wgpu::Buffer>,
    used: u64,
}

/// What became of a buffer when it was written.
#[derive(PartialEq, Eq)]
pub(super) enum Storage {
    Kept,
    New,
}

impl GrowingBuffer {
    pub fn new(label: &'static str, usage: wgpu::BufferUsages) -> Self {
        Self { label, usage: usage | wgpu::BufferUsages::COPY_DST, buffer: None, used: 0 }
    }

    /// Replaces the content by the parts, one after the other. Their sizes are multiples of 4
    /// bytes, as those of all vertices and uniforms are.
    pub fn write<T: bytemuck::Pod>(&mut self, gpu: &Gpu, parts: &[&[T]]) -> Storage {
        let size: u64 = parts.iter().map(|part| size_of_val(*part) as u64).sum();
        let fits = self.buffer.as_ref().is_some_and(|buffer| buffer.size() >= size);
        let buffer = match self.buffer.take() {
            Some(buffer) if fits => buffer,
            _ => gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(self.label),
                size: size.next_power_of_two().max(BUFFER_SIZE_MIN),
                usage: self.usage,
                mapped_at_creation: false,
            }),
        };
        let mut offset = 0;
        for part in parts {
            gpu.queue.write_buffer(&buffer, offset, bytemuck::cast_slice(part));
            offset += size_of_val(*part) as u64;
        }
        self.buffer = Some(buffer);
        self.used = size;
        if fits { Storage::Kept } else { Storage::New }
    }

    /// The content; `None` if there is none.
    pub fn slice(&self) -> Option<wgpu::BufferSlice<'_>> {
        self.buffer.as_ref().filter(|_| self.used > 0).map(|buffer| buffer.slice(..self.used))
    }
}
