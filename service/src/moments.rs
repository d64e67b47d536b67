//! Moments as text.

use std::time::{Duration, UNIX_EPOCH};

/// A moment, seconds since 1970 (UTC), as RFC 3339 has it.
pub(crate) fn moment(seconds: i64) -> String {
    let since = Duration::from_secs(u64::try_from(seconds).unwrap_or_default());
    humantime::format_rfc3339_seconds(UNIX_EPOCH + since).to_string()
}
