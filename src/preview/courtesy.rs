//! Threads that compute give way to the one that answers the user: on a machine whose processors are
//! all busy, a picture that takes 40 ms would otherwise take three times as long.

use thread_priority::{ThreadPriority, ThreadPriorityValue, set_current_thread_priority};

/// Of 0 to 99, as high as half of that is usual: low enough that drawing comes first wherever both want
/// the processor, and of no consequence where only one does.
const PRIORITY: u8 = 20;

/// Has this thread, and those it starts, give way from now on. Where the system does not allow that,
/// everything still works.
pub fn give_way() {
    if let Ok(value) = ThreadPriorityValue::try_from(PRIORITY) {
        let _ = set_current_thread_priority(ThreadPriority::Crossplatform(value));
    }
}
