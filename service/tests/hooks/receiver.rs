//! A receiver of messages, and what it sees of them.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::{SocketAddr, TcpListener};
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use rustls::pki_types::pem::PemObject;
use rustls::pki_types::{CertificateDer, PrivateKeyDer};
use rustls::{ServerConfig, ServerConnection, StreamOwned};
use serde_json::Value;
use sha2::{Digest, Sha256};

/// Time for which a test waits for a message.
const PATIENCE: Duration = Duration::from_secs(60);

/// A reply to a message.
#[derive(Clone, Copy, Debug)]
pub(super) enum Reply {
    /// A status with a short body.
    Status(u16),
    /// None, until the sender has enough.
    Nothing,
    /// The end of the connection.
    Close,
    /// 302 to another address of the receiver.
    Redirect,
    /// 200 with a body that has no end.
    Flood,
}

/// A message.
#[derive(Clone, Debug)]
pub(super) struct Message {
    pub(super) path: String,
    /// Names in small letters.
    headers: Vec<(String, String)>,
    pub(super) body: String,
}

/// SHA-256 in hexadecimal digits.
pub(super) fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// HMAC-SHA256 by its definition (RFC 2104), for keys of a block at most.
fn hmac(key: &[u8], text: &[u8]) -> Vec<u8> {
    let pad =
        |with: u8| -> Vec<u8> { (0..64).map(|at| key.get(at).copied().unwrap_or_default() ^ with).collect() };
    let inner = Sha256::digest([&pad(0x36)[..], text].concat());
    Sha256::digest([&pad(0x5c)[..], &inner[..]].concat()).to_vec()
}

/// The bytes of a text in base64 (RFC 4648, 4).
fn bytes(base64: &str) -> Vec<u8> {
    let value = |sign: u8| -> Option<u32> {
        let at = match sign {
            b'A'..=b'Z' => sign - b'A',
            b'a'..=b'z' => sign - b'a' + 26,
            b'0'..=b'9' => sign - b'0' + 52,
            b'+' => 62,
            b'/' => 63,
            _ => return None,
        };
        Some(u32::from(at))
    };
    let (mut out, mut bits, mut count) = (Vec::new(), 0_u32, 0);
    for value in base64.bytes().map_while(value) {
        bits = bits << 6 | value;
        count += 6;
        if count >= 8 {
            count -= 8;
            out.push((bits >> count & 0xff) as u8);
        }
    }
    out
}

impl Message {
    pub(super) fn header(&self, name: &str) -> &str {
        let mut all = self.headers.iter().filter(|(own, _)| own == name);
        let first = all.next().map_or("", |(_, value)| value);
        assert!(all.next().is_none(), "{name} stands there twice: {self:?}");
        first
    }

    pub(super) fn json(&self) -> Value {
        serde_json::from_str(&self.body).unwrap_or_else(|error| panic!("{error}: {}", self.body))
    }

    /// Its signature is that of a hook, as the hook's maker was told of it.
    pub(super) fn is_signed_by(&self, hook: &Value) {
        let secret = hook["secret"].as_str().and_then(|own| own.strip_prefix("whsec_")).expect("a secret");
        let (id, timestamp) = (self.header("webhook-id"), self.header("webhook-timestamp"));
        assert!(id.len() == 20 && !id.contains('.'), "{id}");
        assert!(timestamp.parse::<u64>().is_ok_and(|seconds| seconds > 1_700_000_000), "{timestamp}");
        let text = format!("{id}.{timestamp}.{}", self.body);
        let signature = self.header("webhook-signature").strip_prefix("v1,").expect("a version");
        assert_eq!(bytes(signature), hmac(&bytes(secret), text.as_bytes()), "{self:?}");
    }
}

/// A receiver. It listens until the process of the tests ends.
pub(super) struct Receiver {
    address: SocketAddr,
    is_tls: bool,
    messages: mpsc::Receiver<Message>,
}

impl Receiver {
    /// One that replies to each message by its number, from 0.
    pub(super) fn new(reply: impl Fn(usize) -> Reply + Send + Sync + 'static) -> Receiver {
        Receiver::listening(None, reply)
    }

    /// The same with a certificate and a key.
    pub(super) fn with_tls(
        [certificate, key]: &[PathBuf; 2],
        reply: impl Fn(usize) -> Reply + Send + Sync + 'static,
    ) -> Receiver {
        let certificate = CertificateDer::from_pem_file(certificate).expect("a certificate");
        let key = PrivateKeyDer::from_pem_file(key).expect("a key");
        let config = ServerConfig::builder_with_provider(Arc::new(rustls::crypto::ring::default_provider()))
            .with_safe_default_protocol_versions()
            .expect("versions")
            .with_no_client_auth()
            .with_single_cert(vec![certificate], key)
            .expect("a pair");
        Receiver::listening(Some(Arc::new(config)), reply)
    }

    fn listening(
        tls: Option<Arc<ServerConfig>>,
        reply: impl Fn(usize) -> Reply + Send + Sync + 'static,
    ) -> Receiver {
        let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
        let address = listener.local_addr().expect("an address");
        let (sender, messages) = mpsc::channel();
        let (reply, count, sender) =
            (Arc::new(reply), Arc::new(AtomicUsize::new(0)), Arc::new(Mutex::new(sender)));
        let is_tls = tls.is_some();
        std::thread::spawn(move || {
            for stream in listener.incoming().flatten() {
                let (tls, reply, count, sender) = (tls.clone(), reply.clone(), count.clone(), sender.clone());
                std::thread::spawn(move || {
                    let received = |message| {
                        let number = count.fetch_add(1, Ordering::SeqCst);
                        let _ = sender.lock().expect("a sender").send(message);
                        reply(number)
                    };
                    match tls {
                        None => answer(stream, received),
                        Some(tls) => {
                            let own = ServerConnection::new(tls).expect("a connection");
                            answer(StreamOwned::new(own, stream), received);
                        }
                    }
                });
            }
        });
        Receiver { address, is_tls, messages }
    }

    /// Its address, without a path.
    pub(super) fn address(&self) -> String {
        format!("{}://{}", if self.is_tls { "https" } else { "http" }, self.address)
    }

    /// An address of it.
    pub(super) fn at(&self, path: &str) -> String {
        format!("{}/{path}", self.address())
    }

    /// The next message.
    pub(super) fn next(&self) -> Message {
        self.messages.recv_timeout(PATIENCE).expect("a message")
    }

    /// Nothing more has come.
    pub(super) fn has_no_more(&self) {
        let next = self.messages.recv_timeout(Duration::ZERO);
        assert!(matches!(next, Err(RecvTimeoutError::Timeout)), "{next:?}");
    }
}

/// Receives a message, and replies. A connection without one gets no reply.
fn answer<S: Read + Write>(stream: S, received: impl FnOnce(Message) -> Reply) {
    let mut stream = BufReader::new(stream);
    let Some(message) = read(&mut stream) else { return };
    let reply = received(message);
    let stream = stream.get_mut();
    let written = match reply {
        Reply::Close => return,
        Reply::Nothing => {
            let _ = stream.read(&mut [0]);
            return;
        }
        Reply::Status(status) => write!(
            stream,
            "HTTP/1.1 {status} x\r\nContent-Length: {}\r\n\r\n",
            if status == 204 { 0 } else { 2 }
        )
        .and_then(|()| if status == 204 { Ok(()) } else { stream.write_all(b"ok") }),
        Reply::Redirect => {
            write!(stream, "HTTP/1.1 302 x\r\nLocation: /elsewhere\r\nContent-Length: 0\r\n\r\n")
        }
        Reply::Flood => {
            let mut written = write!(stream, "HTTP/1.1 200 x\r\nContent-Length: 1000000000000\r\n\r\n");
            while written.is_ok() {
                written = stream.write_all(&[b'x'; 4096]);
            }
            return;
        }
    };
    written.and_then(|()| stream.flush()).expect("a reply");
}

fn read(stream: &mut impl BufRead) -> Option<Message> {
    let mut line = || {
        let mut line = String::new();
        stream.read_line(&mut line).ok().filter(|read| *read > 0).map(|_| line.trim_end().to_owned())
    };
    let first = line()?;
    let mut words = first.split(' ');
    // A redirect that is followed comes as GET.
    let path = match words.next()? {
        "POST" => words.next()?.to_owned(),
        _ => first.clone(),
    };
    let mut headers = Vec::new();
    loop {
        let next = line()?;
        let Some((name, value)) = next.split_once(':') else { break };
        headers.push((name.to_ascii_lowercase(), value.trim().to_owned()));
    }
    let length = headers.iter().find(|(name, _)| name == "content-length");
    let mut body = vec![0; length.map_or(Some(0), |(_, length)| length.parse().ok())?];
    stream.read_exact(&mut body).ok()?;
    Some(Message { path, headers, body: String::from_utf8(body).ok()? })
}
