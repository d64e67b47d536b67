//! Connections: how many, how long a client may take for the head of its request, and how they end.
//!
//! A head that does not come within its time is the end of its connection, also where none has been begun, so that idle
//! clients hold nothing for ever. So does an answer that its client does not read, and a TLS handshake that takes as long as a head may. Not here: bodies ([`super::arrival`]) and answers.

use std::io;
use std::net::SocketAddr;
use std::pin::Pin;
use std::sync::Arc;
use std::time::Duration;

use axum::Router;
use axum::http::Request;
use hyper::body::Incoming;
use hyper::server::conn::http1;
use hyper::service::Service;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::server::graceful::{GracefulShutdown, Watcher};
use hyper_util::service::TowerToHyperService;
use tokio::io::{AsyncRead, AsyncWrite};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::Semaphore;
use tokio_io_timeout::TimeoutStream;
use tokio_rustls::TlsAcceptor;

use crate::{Limits, observe};

/// Connections at once at most; further ones wait. A process has 1024 open files at least.
const CONNECTIONS: usize = 512;

/// Bytes of a head at most; as many of a body are read at once.
const HEAD: usize = 128 << 10;

/// Time for the running requests after a stop.
const GRACE: Duration = Duration::from_secs(35);

/// Pause after a failed accept, such as for want of open files.
const PAUSE: Duration = Duration::from_millis(100);

/// Answers until `stopped`; requests that are being answered then end first.
pub(crate) async fn serve(
    listener: TcpListener,
    routes: Router,
    tls: Option<TlsAcceptor>,
    limits: Limits,
    stopped: impl Future<Output = ()>,
) -> io::Result<()> {
    let places = Arc::new(Semaphore::new(CONNECTIONS));
    let graceful = GracefulShutdown::new();
    let mut stopped = std::pin::pin!(stopped);
    loop {
        let next = async {
            let place = places.clone().acquire_owned().await.map_err(io::Error::other)?;
            Ok::<_, io::Error>((listener.accept().await?, place))
        };
        let next = tokio::select! {
            () = &mut stopped => break,
            next = next => next,
        };
        let ((stream, peer), place) = match next {
            Ok(next) => next,
            Err(error) => {
                observe::fault(&format!("no connection: {error}"));
                tokio::time::sleep(PAUSE).await;
                continue;
            }
        };
        // Answers are written as a whole; nothing is gained by waiting for more.
        let _ = stream.set_nodelay(true);
        let known = Known { routes: TowerToHyperService::new(routes.clone()), peer: Peer(peer) };
        let (watcher, tls) = (graceful.watcher(), tls.clone());
        tokio::spawn(async move {
            // A client that breaks off is no fault of the service.
            let _ = answer(stream, tls, known, watcher, limits).await;
            drop(place);
        });
    }
    drop(listener);
    let _ = tokio::time::timeout(GRACE, graceful.shutdown()).await;
    Ok(())
}

/// The address of the client of a request: that of its connection. What a header says of it is not believed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Peer(pub(crate) SocketAddr);

/// The routes, for requests of a client.
struct Known {
    routes: TowerToHyperService<Router>,
    peer: Peer,
}

impl Service<Request<Incoming>> for Known {
    type Response = <TowerToHyperService<Router> as Service<Request<Incoming>>>::Response;
    type Error = <TowerToHyperService<Router> as Service<Request<Incoming>>>::Error;
    type Future = <TowerToHyperService<Router> as Service<Request<Incoming>>>::Future;

    fn call(&self, mut request: Request<Incoming>) -> Self::Future {
        request.extensions_mut().insert(self.peer);
        self.routes.call(request)
    }
}

/// Answers the requests of a connection.
async fn answer(
    stream: TcpStream,
    tls: Option<TlsAcceptor>,
    known: Known,
    watcher: Watcher,
    limits: Limits,
) -> io::Result<()> {
    let mut stream = TimeoutStream::new(stream);
    stream.set_write_timeout(Some(limits.reader));
    let stream = Box::pin(stream);
    match tls {
        None => requests(stream, known, watcher, limits).await,
        Some(tls) => {
            let late = |_| io::Error::from(io::ErrorKind::TimedOut);
            let stream = tokio::time::timeout(limits.head, tls.accept(stream)).await.map_err(late)??;
            requests(Box::pin(stream), known, watcher, limits).await
        }
    }
}

async fn requests<S: AsyncRead + AsyncWrite + Send + 'static>(
    stream: Pin<Box<S>>,
    known: Known,
    watcher: Watcher,
    limits: Limits,
) -> io::Result<()> {
    let connection = http1::Builder::new()
        .timer(TokioTimer::new())
        .header_read_timeout(limits.head)
        .max_buf_size(HEAD)
        .serve_connection(TokioIo::new(stream), known);
    watcher.watch(connection).await.map_err(io::Error::other)
}
