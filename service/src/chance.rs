//! Names and secrets by chance.

/// The signs: 5 bits each, none of which looks like another.
const SIGNS: &[u8; 32] = b"0123456789abcdefghjkmnpqrstvwxyz";

/// So many signs, from the system's source of chance.
///
/// # Errors
/// The system gives no random bytes.
pub(crate) fn signs(count: usize) -> Result<String, getrandom::Error> {
    let mut bytes = vec![0_u8; count];
    getrandom::fill(&mut bytes)?;
    Ok(bytes.iter().map(|byte| char::from(SIGNS[usize::from(byte % 32)])).collect())
}
