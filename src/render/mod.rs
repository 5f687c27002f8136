//! Drawing: the same call for files and for a window.
