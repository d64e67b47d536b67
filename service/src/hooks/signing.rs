//! Signatures of messages, by Standard Webhooks 1.0 (<https://www.standardwebhooks.com>): HMAC-SHA256 of `id.timestamp.body`.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use hmac::{Hmac, KeyInit, Mac};
use sha2::Sha256;

use crate::http::Problem;

/// Bytes of a secret. The specification asks for 24 to 64.
const SECRET: usize = 32;

/// The beginning of a secret for people, so that a search finds one that has got into a text.
const PREFIX: &str = "whsec_";

/// A new secret.
pub(super) fn secret() -> Result<[u8; SECRET], Problem> {
    let mut bytes = [0; SECRET];
    getrandom::fill(&mut bytes).map_err(|_| Problem::fault())?;
    Ok(bytes)
}

/// A secret as its receiver keeps it.
pub(super) fn shown(secret: &[u8]) -> String {
    format!("{PREFIX}{}", STANDARD.encode(secret))
}

/// The value of `webhook-signature`. The timestamp is that of the attempt, in seconds since 1970 (UTC).
pub(super) fn signature(secret: &[u8], id: &str, timestamp: i64, body: &str) -> String {
    // A key of any length is one of HMAC.
    let Ok(mut mac) = Hmac::<Sha256>::new_from_slice(secret) else { return String::new() };
    for piece in [id, ".", &timestamp.to_string(), ".", body] {
        mac.update(piece.as_bytes());
    }
    format!("v1,{}", STANDARD.encode(mac.finalize().into_bytes()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The example of the authors' libraries, and one that openssl has computed:
    /// `printf 'a.1.{}' | openssl dgst -sha256 -hmac key -binary | openssl base64`.
    #[test]
    fn signatures_are_those_of_others() {
        let secret = STANDARD.decode("MfKQ9r8GKYqrTwjUPD8ILPZIo2LaLaSw").expect("a secret");
        let id = "msg_p5jXN8AQM9LWM0D4loKWxJek";
        assert_eq!(
            signature(&secret, id, 1_614_265_330, r#"{"test": 2432232314}"#),
            "v1,g0hM9SsE+OTPJTGt/tmIKtSyZlE3uFJELVlNIOLJ1OE="
        );
        assert_eq!(signature(b"key", "a", 1, "{}"), "v1,bL1jQXV9xdvhtjVTxMVmcec+7wicDeM5+UJZVhyrJw0=");
        assert_eq!(shown(&secret), "whsec_MfKQ9r8GKYqrTwjUPD8ILPZIo2LaLaSw");
    }
}
