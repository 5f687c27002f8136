//! The wish to stop, from the keyboard or the system: asked for between steps, so that a run is
//! left which is whole.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use signal_hook::SigId;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

/// Who asks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Signal {
    /// Ctrl-C.
    Interrupt,
    Terminate,
}

impl Signal {
    const ALL: [Signal; 2] = [Signal::Interrupt, Signal::Terminate];

    /// 128 plus the signal's number, as shells have it.
    pub fn exit_code(self) -> u8 {
        match self {
            Signal::Interrupt => 130,
            Signal::Terminate => 143,
        }
    }

    fn number(self) -> i32 {
        match self {
            Signal::Interrupt => SIGINT,
            Signal::Terminate => SIGTERM,
        }
    }
}

/// Remembers the last signal. A second one ends the program at once.
#[derive(Debug)]
pub struct Interrupt {
    /// Index into [`Signal::ALL`] plus 1; 0 while nobody has asked.
    requested: Arc<AtomicUsize>,
    registrations: Vec<SigId>,
}

impl Interrupt {
    /// Listens until dropped.
    ///
    /// # Errors
    /// If the system refuses the handler.
    pub fn install() -> io::Result<Self> {
        let asked_before = Arc::new(AtomicBool::new(false));
        let mut interrupt =
            Self { requested: Arc::new(AtomicUsize::new(0)), registrations: Vec::new() };
        for (index, signal) in Signal::ALL.into_iter().enumerate() {
            let number = signal.number();
            // In this order: the first signal arms what the second one meets.
            let shutdown = flag::register_conditional_shutdown(
                number,
                i32::from(signal.exit_code()),
                Arc::clone(&asked_before),
            )?;
            interrupt.registrations.push(shutdown);
            interrupt.registrations.push(flag::register(number, Arc::clone(&asked_before))?);
            let requested = Arc::clone(&interrupt.requested);
            interrupt.registrations.push(flag::register_usize(number, requested, index + 1)?);
        }
        Ok(interrupt)
    }

    /// Who has asked to stop, if anybody has.
    pub fn requested(&self) -> Option<Signal> {
        let index = self.requested.load(Ordering::Relaxed).checked_sub(1)?;
        Signal::ALL.get(index).copied()
    }
}

impl Drop for Interrupt {
    fn drop(&mut self) {
        for registration in self.registrations.drain(..) {
            signal_hook::low_level::unregister(registration);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One test, since signals reach the whole process.
    #[test]
    fn a_signal_is_remembered_with_its_exit_code() {
        for (signal, exit_code) in [(Signal::Interrupt, 130), (Signal::Terminate, 143)] {
            let interrupt = Interrupt::install().unwrap();
            assert_eq!(interrupt.requested(), None);
            signal_hook::low_level::raise(signal.number()).unwrap();
            assert_eq!(interrupt.requested(), Some(signal));
            assert_eq!(signal.exit_code(), exit_code);
        }
    }
}
