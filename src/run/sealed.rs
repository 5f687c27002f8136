//! The envelope of every binary file: what it is, which version, how long, and a checksum over all
//! of it, so that a damaged file is refused before anything in it is believed.

use std::io::Read;

use sha2::{Digest, Sha256};

use super::StateError;
use super::bytes::{ByteReader, ByteWriter};

/// What is in an envelope.
#[derive(Clone, Copy, Debug)]
pub(super) struct Kind {
    /// The first eight bytes of the file.
    pub magic: &'static [u8; 8],
    /// Raised when the content changes; older versions stay readable.
    pub version: u32,
}

/// A frame's state. Version 2 has the anchors of handles and the points of deforming
/// obstacles.
pub(super) const FRAME: Kind = Kind { magic: b"SILKFRAM", version: 2 };

/// The obstacles at rest.
pub(super) const OBSTACLES: Kind = Kind { magic: b"SILKOBST", version: 1 };

/// zstd's own default: mantissas hardly compress, so that more effort would buy little.
const COMPRESSION_LEVEL: i32 = 3;

/// Bytes before the checksum; the checksum covers them and everything after itself.
const PREFIX_LENGTH: usize = 32;

/// Puts content into its envelope.
pub(super) fn seal(kind: Kind, content: &[u8]) -> Result<Vec<u8>, std::io::Error> {
    let stored = zstd::bulk::compress(content, COMPRESSION_LEVEL)?;
    let mut file = ByteWriter::default();
    file.items(kind.magic);
    file.put(kind.version);
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
pub(super) fn unseal(kind: Kind, file: &[u8]) -> Result<(u32, Vec<u8>), StateError> {
    let envelope = Envelope::open(kind, file)?;
    Ok((envelope.version, decompress(envelope.stored, envelope.full_length)?))
}

/// Compares a file with its checksum, without a look at the content.
///
/// # Errors
/// If the file is damaged, of another kind or of a later version.
pub(super) fn check_seal(kind: Kind, file: &[u8]) -> Result<(), StateError> {
    Envelope::open(kind, file).map(|_| ())
}

/// An envelope whose checksum is right.
struct Envelope<'a> {
    version: u32,
    full_length: u64,
    /// The compressed content.
    stored: &'a [u8],
}

impl<'a> Envelope<'a> {
    fn open(kind: Kind, file: &'a [u8]) -> Result<Self, StateError> {
        let mut reader = ByteReader::new(file);
        let found = reader.take("file type", kind.magic.len())?;
        if found != kind.magic {
            let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
            return Err(StateError::NotAState { expected: text(kind.magic), found: text(found) });
        }
        // Before the checksum, whose place a later version may change.
        let version: u32 = reader.get("format version")?;
        if !(1..=kind.version).contains(&version) {
            return Err(StateError::Version { found: version, known: kind.version });
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
        Ok(Self { version, full_length, stored })
    }
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
