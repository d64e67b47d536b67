//! TLS: certificates and the private key, from PEM files.
//!
//! Not here: who decides whether a server has TLS.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use rustls::ServerConfig;
use rustls::crypto::ring;
use rustls::pki_types::pem::PemObject;
use rustls::pki_types::{CertificateDer, PrivateKeyDer};
use tokio_rustls::TlsAcceptor;

/// Takes TLS connections, with the certificates and the key of two files: TLS 1.2 and 1.3, HTTP/1.1.
///
/// # Errors
/// The reason: a file cannot be read, others can read the key, or the key is not that of the certificate.
pub(crate) fn acceptor([certificates, key]: &[PathBuf; 2]) -> Result<TlsAcceptor, String> {
    is_kept_secret(key)?;
    let chain = CertificateDer::pem_file_iter(certificates).and_then(Iterator::collect::<Result<Vec<_>, _>>);
    let chain = chain.map_err(|error| format!("{}: {error}", certificates.display()))?;
    if chain.is_empty() {
        return Err(format!("{} has no certificate", certificates.display()));
    }
    let secret = PrivateKeyDer::from_pem_file(key).map_err(|error| format!("{}: {error}", key.display()))?;
    let config = ServerConfig::builder_with_provider(Arc::new(ring::default_provider()))
        .with_safe_default_protocol_versions()
        .map_err(|error| error.to_string())?;
    let mut config = config
        .with_no_client_auth()
        .with_single_cert(chain, secret)
        .map_err(|error| format!("{} and {}: {error}", certificates.display(), key.display()))?;
    config.alpn_protocols = vec![b"http/1.1".to_vec()];
    Ok(TlsAcceptor::from(Arc::new(config)))
}

/// Other users of this computer cannot read the key.
#[cfg(unix)]
fn is_kept_secret(key: &Path) -> Result<(), String> {
    use std::os::unix::fs::PermissionsExt;
    let about = std::fs::metadata(key).map_err(|error| format!("{}: {error}", key.display()))?;
    match about.permissions().mode() & 0o007 {
        0 => Ok(()),
        _ => Err(format!("every user of this computer can read {}: chmod o= {0}", key.display())),
    }
}

/// The rights of a file are not asked for here.
#[cfg(not(unix))]
fn is_kept_secret(_: &Path) -> Result<(), String> {
    Ok(())
}
