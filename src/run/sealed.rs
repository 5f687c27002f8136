//! The envelope of every binary file: what it is, which version, how long, and a checksum over all
//! of it, so that a damaged file is refused before anything in it is believed.

use std::io::Read;

use sha2::{Digest, Sha256};

use super::StateError;
use super::bytes::{ByteReader, ByteWriter};

/// The first eight bytes of a frame's state.
pub(super) const FRAME_MAGIC: &[u8; 8] = b"SILKFRAM";
/// The first eight bytes of the obstacles at rest.
pub(super) const OBSTACLES_MAGIC: &[u8; 8] = b"SILKOBST";

/// Raised when the content changes; older versions stay readable.
pub(super) const STATE_VERSION: u32 = 1;

/// zstd's own default: mantissas hardly compress, so that more effort would buy little.
const COMPRESSION_LEVEL: i32 = 3;

/// Bytes before the checksum; the checksum covers them and everything after itself.
const PREFIX_LENGTH: usize = 32;

/// Puts content into its envelope.
pub(super) fn seal(magic: &[u8; 8], content: &[u8]) -> Result<Vec<u8>, std::io::Error> {
    let stored = zstd::bulk::compress(content, COMPRESSION_LEVEL)?;
    let mut file = ByteWriter::default();
    file.items(magic);
    file.put(STATE_VERSION);
    file.put(0u32);
    file.put(content.len() as u64);
    file.put(stored.len() as u64);
    let mut file = file.into_bytes();
    debug_assert_eq!(file.len(), PREFIX_LENGTH);
    let checksum = checksum(&file, &stored);
    file.extend_from_slice(&checksum);
    file.extend_from_slice(&stored);
    Ok(file)
}

/// The content of an envelope, and the version it is written in.
pub(super) fn unseal(magic: &[u8; 8], file: &[u8]) -> Result<(u32, Vec<u8>), StateError> {
    let mut reader = ByteReader::new(file);
    let found = reader.take("file type", magic.len())?;
    if found != magic {
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        return Err(StateError::NotAState { expected: text(magic), found: text(found) });
    }
    // Before the checksum, whose place a later version may change.
    let version: u32 = reader.get("format version")?;
    if !(1..=STATE_VERSION).contains(&version) {
        return Err(StateError::Version { found: version, known: STATE_VERSION });
    }
    let _reserved: u32 = reader.get("reserved field")?;
    let full_length: u64 = reader.get("full length")?;
    let stored_length: u64 = reader.get("stored length")?;
    let expected = reader.take("checksum", 32)?;
    let stored = &file[PREFIX_LENGTH + 32..];
    if stored.len() as u64 != stored_length {
        let found = stored.len() as u64;
        return Err(StateError::StoredLength { found, expected: stored_length });
    }
    let found = checksum(&file[..PREFIX_LENGTH], stored);
    if found != expected {
        return Err(StateError::Checksum { found: hex(&found), expected: hex(expected) });
    }
    Ok((version, decompress(stored, full_length)?))
}

/// Stops soon after the promised length, whatever the stream would grow to.
fn decompress(stored: &[u8], full_length: u64) -> Result<Vec<u8>, StateError> {
    let mut content = Vec::new();
    zstd::stream::Decoder::new(stored)
        .and_then(|decoder| decoder.take(full_length.saturating_add(1)).read_to_end(&mut content))
        .map_err(StateError::Compression)?;
    match content.len() as u64 {
        found if found == full_length => Ok(content),
        found => Err(StateError::FullLength { found, expected: full_length }),
    }
}

fn checksum(prefix: &[u8], stored: &[u8]) -> [u8; 32] {
    Sha256::new().chain_update(prefix).chain_update(stored).finalize().into()
}

/// Two lower-case digits a byte.
pub(super) fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}
