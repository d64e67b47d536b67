//! Settings of a server: its address, the names by which it may be asked for, its rates, and whom it may tell of events.

use std::net::SocketAddr;
use std::path::PathBuf;
use std::time::Duration;

/// Cost of a digest of a password (argon2id).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cost {
    /// Memory, KiB.
    pub memory: u32,
    /// Passes over the memory.
    pub rounds: u32,
    /// Lanes, computed one after the other.
    pub lanes: u32,
}

impl Default for Cost {
    /// The least of what OWASP recommends: some 30 ms of a processor.
    fn default() -> Cost {
        Cost { memory: 19 << 10, rounds: 2, lanes: 1 }
    }
}

/// A rate: so many at once, and one more after each interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rate {
    /// As many at once.
    pub burst: u32,
    /// The interval.
    pub every: Duration,
}

/// Web hooks: addresses outside that a server may tell of events. Without targets it sends nothing.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Hooks {
    /// Addresses, https or http, below which hooks may be: `https://erp.example/hooks`.
    pub targets: Vec<String>,
    /// A file with certificates of authorities for https, beside those of the web, PEM.
    pub authorities: Option<PathBuf>,
}

/// The address of a server, and who may ask it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Listen {
    /// The address; port 0 is any that is free.
    pub address: SocketAddr,
    /// Names that Host and Origin may have, besides those of this computer.
    pub hosts: Vec<String>,
    /// Certificates and private key, PEM.
    pub tls: Option<[PathBuf; 2]>,
    /// Whether a proxy ends TLS.
    pub behind_proxy: bool,
}

impl Listen {
    /// Whether other computers may ask: by its address, or by way of a proxy.
    pub(crate) fn is_public(&self) -> bool {
        !self.address.ip().is_loopback() || self.behind_proxy || !self.hosts.is_empty()
    }
}

impl From<SocketAddr> for Listen {
    /// Without TLS and without further names.
    fn from(address: SocketAddr) -> Listen {
        Listen { address, hosts: Vec::new(), tls: None, behind_proxy: false }
    }
}
