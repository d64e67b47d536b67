//! Connections: how many, how long a client may take for the head of its request, and how they end.
//!
//! A head that does not come within its time is the end of its connection, also where none has been begun, so that idle
//! clients hold nothing for ever. So does an answer that its client does not read. Not here: bodies ([`super::arrival`]) and answers.

use std::io;
use std::sync::Arc;
use std::time::Duration;

use axum::Router;
use hyper::server::conn::http1;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::server::graceful::GracefulShutdown;
use hyper_util::service::TowerToHyperService;
use tokio::net::TcpListener;
use tokio::sync::Semaphore;
use tokio_io_timeout::TimeoutStream;

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
    limits: Limits,
    stopped: impl Future<Output = ()>,
) -> io::Result<()> {
    let places = Arc::new(Semaphore::new(CONNECTIONS));
    let graceful = GracefulShutdown::new();
    let mut stopped = std::pin::pin!(stopped);
    loop {
        let next = async {
            let place = places.clone().acquire_owned().await.map_err(io::Error::other)?;
            Ok::<_, io::Error>((listener.accept().await?.0, place))
        };
        let next = tokio::select! {
            () = &mut stopped => break,
            next = next => next,
        };
        let (stream, place) = match next {
            Ok(next) => next,
            Err(error) => {
                observe::fault(&format!("no connection: {error}"));
                tokio::time::sleep(PAUSE).await;
                continue;
            }
        };
        // Answers are written as a whole; nothing is gained by waiting for more.
        let _ = stream.set_nodelay(true);
        let mut stream = TimeoutStream::new(stream);
        stream.set_write_timeout(Some(limits.reader));
        let connection = http1::Builder::new()
            .timer(TokioTimer::new())
            .header_read_timeout(limits.head)
            .max_buf_size(HEAD)
            .serve_connection(TokioIo::new(Box::pin(stream)), TowerToHyperService::new(routes.clone()));
        let connection = graceful.watch(connection);
        tokio::spawn(async move {
            // A client that breaks off is no fault of the service.
            let _ = connection.await;
            drop(place);
        });
    }
    drop(listener);
    let _ = tokio::time::timeout(GRACE, graceful.shutdown()).await;
    Ok(())
}
