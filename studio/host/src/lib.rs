//! The studio for one user on this computer: the page, the engine behind it, and the programs of one file or folder.
//!
//! ```text
//! GET  /                            the page
//! PUT  /engine/ROOM/files/NAME      a file for the engine of that room
//! POST /engine/ROOM/run             a request; the answer is a line of JSON, then the outputs
//! GET  /programs                    the programs, with a stamp that changes when one of them does
//! GET  /programs?stamp=STAMP        the same, as soon as the stamp is another one, or after a while
//! GET  /programs/NAME, PUT          a program; saved only over what its writer has read (`If-Match`)
//! ```
//!
//! Nobody else gets in: the server listens on this computer alone, each request but those for the page's own files has the
//! token that was made at the start, and names this server as its host. No file outside the folder is read or written, and
//! no link is followed. The page and the form of an engine's answers are for `ncc serve` too. Not here: the page (`studio/src`), the engine (`ncc_engine`), opening a browser.

mod engines;
mod gate;
pub mod page;
mod programs;

use std::io;
use std::net::{Ipv4Addr, SocketAddr, TcpListener};
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use axum::extract::DefaultBodyLimit;
use axum::routing::{get, post, put};
use axum::{Router, middleware};

use self::engines::Engines;
pub use self::engines::{answer, is_room};
use self::gate::Gate;
use self::programs::Programs;

/// The largest program or body that is taken, bytes.
const LARGEST: usize = 256 << 20;

/// What all requests share.
struct Shared {
    gate: Gate,
    engines: Engines,
    programs: Programs,
}

/// A server that is ready.
pub struct Studio {
    listener: TcpListener,
    shared: Arc<Shared>,
}

impl Studio {
    /// Listens on a port of this computer, or on any that is free (0). `programs` is a file or a folder.
    ///
    /// # Errors
    /// The port is taken, or there is no such file or folder.
    pub fn open(port: u16, programs: &Path) -> io::Result<Studio> {
        let programs = Programs::of(programs)?;
        let listener = TcpListener::bind(SocketAddr::from((Ipv4Addr::LOCALHOST, port)))?;
        let gate = Gate::new(listener.local_addr()?.port())?;
        Ok(Studio { listener, shared: Arc::new(Shared { gate, engines: Engines::default(), programs }) })
    }

    /// Where a browser finds the page. What is behind the sign is the token, which browsers send nowhere.
    pub fn address(&self) -> String {
        self.shared.gate.address()
    }

    /// Serves until the process is asked to stop (`ncc_exec::halt`).
    ///
    /// # Errors
    /// The network.
    pub fn serve(self) -> io::Result<()> {
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build()?;
        runtime.block_on(async {
            self.listener.set_nonblocking(true)?;
            let listener = tokio::net::TcpListener::from_std(self.listener)?;
            let stopped = async {
                while !ncc_exec::halt::is_asked() {
                    tokio::time::sleep(Duration::from_millis(50)).await;
                }
            };
            // Connections that wait for a change would wait on.
            let serve = axum::serve(listener, router(self.shared));
            tokio::select! {
                done = serve => done,
                () = stopped => Ok(()),
            }
        })?;
        // What an engine is at stops by itself; nobody waits for it.
        runtime.shutdown_background();
        Ok(())
    }
}

fn router(shared: Arc<Shared>) -> Router {
    let guarded = Router::new()
        .route("/engine/{room}/files/{name}", put(engines::keep))
        .route("/engine/{room}/run", post(engines::run))
        .route("/programs", get(programs::list))
        .route("/programs/{name}", get(programs::read).put(programs::write))
        .layer(DefaultBodyLimit::max(LARGEST))
        .route_layer(middleware::from_fn_with_state(Arc::clone(&shared), gate::token));
    Router::new()
        .merge(guarded)
        .fallback(page::file)
        .layer(middleware::from_fn_with_state(Arc::clone(&shared), gate::host))
        .with_state(shared)
}
