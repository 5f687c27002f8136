//! The graphics device: found by kind or name, its errors recorded instead of fatal.

use std::convert::Infallible;
use std::str::FromStr;
use std::sync::{Arc, Mutex, PoisonError};

use thiserror::Error;

/// Which graphics adapter to draw with.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum AdapterChoice {
    /// Hardware if there is any, else software.
    #[default]
    Any,
    /// Drawn by the CPU: the same picture on every machine.
    Software,
    Hardware,
    /// The first adapter whose name contains this, in any case.
    Named(String),
}

/// `software`, `hardware`, `any`, or part of an adapter's name.
impl FromStr for AdapterChoice {
    type Err = Infallible;
    fn from_str(text: &str) -> Result<Self, Infallible> {
        Ok(match text {
            "any" => Self::Any,
            "software" => Self::Software,
            "hardware" => Self::Hardware,
            name => Self::Named(name.to_owned()),
        })
    }
}

/// Why there is no picture.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum RenderError {
    #[error(
        "no graphics adapter {wanted} (found: {found}); for drawing without a graphics card install mesa-vulkan-drivers and libvulkan1"
    )]
    NoAdapter { wanted: String, found: String },
    #[error("graphics adapter \"{adapter}\" gives no device: {reason}")]
    NoDevice { adapter: String, reason: String },
    #[error("cannot draw a picture of {width} x {height} px: the adapter's limit is {limit} px")]
    TooLarge { width: u32, height: u32, limit: u32 },
    #[error("a picture of {width} x {height} px has no pixels")]
    Empty { width: u32, height: u32 },
    #[error("the graphics device reports: {0}")]
    Device(String),
}

/// A device, its queue, and what went wrong on them.
pub struct Gpu {
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    adapter_name: String,
    error: Arc<Mutex<Option<String>>>,
}

impl Gpu {
    /// # Errors
    /// [`RenderError::NoAdapter`] if none matches, [`RenderError::NoDevice`] if it refuses.
    pub fn new(choice: &AdapterChoice) -> Result<Self, RenderError> {
        pollster::block_on(Self::find(choice))
    }

    async fn find(choice: &AdapterChoice) -> Result<Self, RenderError> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
        let mut found = Vec::new();
        // OpenGL only where the native interfaces have nothing: probing it is slow and noisy.
        for backends in [wgpu::Backends::PRIMARY, wgpu::Backends::GL] {
            let mut adapters = instance.enumerate_adapters(backends).await;
            adapters.sort_by_key(|a| rank(a.get_info().device_type));
            found.extend(adapters.iter().map(|a| a.get_info().name));
            if let Some(adapter) = adapters.into_iter().find(|a| choice.allows(&a.get_info())) {
                return Self::open(&adapter).await;
            }
        }
        let found = if found.is_empty() { "none".to_owned() } else { found.join(", ") };
        Err(RenderError::NoAdapter { wanted: choice.description(), found })
    }

    /// The first adapter allowed that can draw to a surface.
    pub(super) async fn for_surface(
        choice: &AdapterChoice,
        instance: &wgpu::Instance,
        surface: &wgpu::Surface<'_>,
    ) -> Result<(Self, wgpu::Adapter), RenderError> {
        let mut adapters = instance.enumerate_adapters(wgpu::Backends::all()).await;
        adapters.sort_by_key(|a| rank(a.get_info().device_type));
        let names: Vec<String> = adapters.iter().map(|a| a.get_info().name).collect();
        let fits =
            |a: &wgpu::Adapter| choice.allows(&a.get_info()) && a.is_surface_supported(surface);
        match adapters.into_iter().find(fits) {
            Some(adapter) => Ok((Self::open(&adapter).await?, adapter)),
            None => {
                let found = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
                Err(RenderError::NoAdapter { wanted: choice.description(), found })
            }
        }
    }

    async fn open(adapter: &wgpu::Adapter) -> Result<Self, RenderError> {
        let adapter_name = adapter.get_info().name;
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("shotsilk"),
            required_limits: wgpu::Limits::downlevel_defaults().using_resolution(adapter.limits()),
            ..Default::default()
        };
        let (device, queue) = adapter.request_device(&descriptor).await.map_err(|e| {
            RenderError::NoDevice { adapter: adapter_name.clone(), reason: e.to_string() }
        })?;
        Ok(Self::from_device(device, queue, adapter_name))
    }

    /// A device that a window has opened. Takes over the handling of its errors.
    pub fn from_device(device: wgpu::Device, queue: wgpu::Queue, adapter_name: String) -> Self {
        let error = Arc::new(Mutex::new(None));
        let record = error.clone();
        device.on_uncaptured_error(Arc::new(move |e: wgpu::Error| {
            // The first error is the cause, those after it are its consequences.
            record
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
                .get_or_insert_with(|| e.to_string());
        }));
        Self { device, queue, adapter_name, error }
    }

    /// As the driver calls itself.
    pub fn adapter_name(&self) -> &str {
        &self.adapter_name
    }

    /// Waits until all that was submitted is done.
    ///
    /// # Errors
    /// What the device has reported.
    pub fn wait(&self) -> Result<(), RenderError> {
        self.device
            .poll(wgpu::PollType::wait_indefinitely())
            .map_err(|e| RenderError::Device(e.to_string()))?;
        self.check()
    }

    /// The first error since the last call.
    ///
    /// # Errors
    /// That error.
    pub fn check(&self) -> Result<(), RenderError> {
        match self.error.lock().unwrap_or_else(PoisonError::into_inner).take() {
            Some(message) => Err(RenderError::Device(message)),
            None => Ok(()),
        }
    }

    /// # Errors
    /// If no texture of this size can be made.
    pub(super) fn check_size(&self, [width, height]: [u32; 2]) -> Result<(), RenderError> {
        let limit = self.device.limits().max_texture_dimension_2d;
        if width == 0 || height == 0 {
            return Err(RenderError::Empty { width, height });
        }
        if width > limit || height > limit {
            return Err(RenderError::TooLarge { width, height, limit });
        }
        Ok(())
    }
}

impl AdapterChoice {
    fn allows(&self, info: &wgpu::AdapterInfo) -> bool {
        let software = info.device_type == wgpu::DeviceType::Cpu;
        match self {
            Self::Any => true,
            Self::Software => software,
            Self::Hardware => !software,
            Self::Named(part) => info.name.to_lowercase().contains(&part.to_lowercase()),
        }
    }

    fn description(&self) -> String {
        match self {
            Self::Any => "of any kind".to_owned(),
            Self::Software => "in software".to_owned(),
            Self::Hardware => "in hardware".to_owned(),
            Self::Named(part) => format!("named \"{part}\""),
        }
    }
}

/// Faster kinds first.
fn rank(kind: wgpu::DeviceType) -> u8 {
    match kind {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        wgpu::DeviceType::VirtualGpu => 2,
        wgpu::DeviceType::Other => 3,
        wgpu::DeviceType::Cpu => 4,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_adapter_is_named_together_with_the_package_that_helps() {
        let error = Gpu::new(&AdapterChoice::Named("no such card".into())).err().unwrap();
        let text = error.to_string();
        assert!(text.contains("no such card") && text.contains("mesa-vulkan-drivers"), "{text}");
    }

    #[test]
    fn adapters_are_chosen_by_kind_or_name() {
        assert_eq!("software".parse(), Ok(AdapterChoice::Software));
        assert_eq!("llvmpipe".parse(), Ok(AdapterChoice::Named("llvmpipe".into())));
    }

    #[test]
    fn an_error_on_the_device_is_recorded_and_reported_once() {
        let gpu = Gpu::new(&AdapterChoice::Software).unwrap();
        let _refused = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: 16,
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::MAP_WRITE,
            mapped_at_creation: false,
        });
        assert!(matches!(gpu.check(), Err(RenderError::Device(_))));
        assert_eq!(gpu.check(), Ok(()));
    }
}
