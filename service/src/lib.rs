//! The service: programs, their documents and outputs over HTTP, kept in a database.
//!
//! | addresses | what |
//! |---|---|
//! | `/transpiler`, `/persistence`, `/output` | the services of the case study |
//! | `/api/v1/programs`, `/api/v1/translations` | programs, their revisions, their translations |
//! | `/api/v1/machines`, `/api/v1/dialects` | texts of the shop: profiles of its machines, dictionaries of its dialects |
//! | `/api/v1/jobs`, `/api/v1/search` | many programs translated, and found by what they do |
//! | `/api/v1/hooks` | addresses that are told of releases, stale translations and ended jobs |
//! | `/api/v1/session`, `/accounts`, `/tokens`, `/audit` | users, and what they did |
//! | `/`, `/api/v1/engine` | the studio's page and its engines |
//! | `/api/v1/openapi.json`, `/api/v1/docs`, `/metrics` | the description of all addresses, and counters |
//!
//! One process has all of them ([`Part::All`]), or one of the case study's three, which finds PERSISTENCE over HTTP. No
//! state is in a process but the store's connections. Programs are read from requests alone: no file of the server is
//! readable through a program's calls. Work of the compiler has limits of time, size and number (`work`).
//!
//! It answers this computer alone, without a login, until there is an account. Others need accounts (`access`). Not here:
//! the compiler (`ncc_engine`, `ncc_driver`), the command line.

mod access;
mod api;
mod case_study;
mod chance;
mod comparing;
mod compiler;
mod facts;
mod hooks;
mod http;
mod import;
mod moments;
mod observe;
mod rights;
mod settings;
mod shop;
mod store;
mod studio;
mod translating;
mod work;
mod workers;

use std::io;
use std::net::TcpListener;
use std::path::Path;
use std::sync::{Arc, OnceLock};
use std::time::Duration;

use axum::extract::DefaultBodyLimit;
use axum::{Router, middleware};
use tokio::sync::watch;
use tokio_rustls::TlsAcceptor;

use self::access::Caller;
use self::access::guard::{self, Guard};
pub use self::access::{Users, UsersError};
use self::case_study::{Remote, Shelf};
use self::hooks::{Targets, sending};
use self::http::arrival::{self, Arrivals};
use self::http::{Problem, compression, connections, gate, openapi, tls};
pub use self::import::{Entry, Import, Imported, NotImported};
use self::observe::Counters;
pub use self::observe::{Form as LogForm, Level as LogLevel, log};
pub use self::rights::{Role, Scope};
pub use self::settings::{Cost, Hooks, Listen, Rate};
pub use self::store::Place;
use self::store::{Store, StoreError};
use self::studio::Rooms;
use self::work::Pool;
use self::workers::Bell;

/// Limits of the service.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Bytes of a program and of a document.
    pub largest: u64,
    /// Bytes of all bodies of requests together.
    pub bodies: usize,
    /// Pieces of work of the compiler that wait for each thread.
    pub waiting: usize,
    /// Time limit of a piece of work.
    pub work: Duration,
    /// Time limit of the head of a request.
    pub head: Duration,
    /// Time limit of the body of a request.
    pub body: Duration,
    /// Time limit of a client that reads nothing of its answer.
    pub reader: Duration,
    /// Cost of the digest of a password.
    pub password: Cost,
    /// Time after which a session that is not used ends.
    pub session: Duration,
    /// Attempts to log in, of an account and of an address. Each process counts them itself, as all rates.
    pub attempts: Rate,
    /// Requests of an account, and of an address without a login.
    pub requests: Rate,
    /// Pieces of work of the compiler for an account.
    pub work_of_one: Rate,
    /// Engines of pages at once: two for each page that is open.
    pub rooms: usize,
    /// The same of one user.
    pub rooms_of_user: usize,
    /// Bytes that one of them holds.
    pub room_bytes: u64,
    /// Bytes that all of them hold together.
    pub rooms_bytes: u64,
    /// Moves of a program at most, where a page asks for its path.
    pub moves: usize,
    /// Longest time for which one is kept without use.
    pub room_age: Duration,
    /// Time limit of a message to a hook, with its answer.
    pub hook: Duration,
    /// Pauses after each failed attempt to tell a hook, in whole seconds; after one more it is given up.
    pub hook_pauses: [Duration; 7],
}

impl Default for Limits {
    fn default() -> Limits {
        Limits {
            largest: 256 << 20,
            bodies: 1 << 30,
            waiting: 64,
            work: Duration::from_secs(30),
            head: Duration::from_secs(30),
            body: Duration::from_secs(120),
            reader: Duration::from_secs(30),
            password: Cost::default(),
            session: Duration::from_secs(12 * 3600),
            attempts: Rate { burst: 20, every: Duration::from_secs(15) },
            requests: Rate { burst: 2000, every: Duration::from_millis(2) },
            work_of_one: Rate { burst: 500, every: Duration::from_millis(20) },
            rooms: 64,
            rooms_of_user: 16,
            room_bytes: 600 << 20,
            rooms_bytes: 1 << 30,
            // With their modes, some 300 MB.
            moves: 2_000_000,
            room_age: Duration::from_secs(1800),
            hook: Duration::from_secs(10),
            // A receiver that is mended within a day and a half misses nothing.
            hook_pauses: [10, 60, 300, 1800, 2 * 3600, 6 * 3600, 24 * 3600].map(Duration::from_secs),
        }
    }
}

/// Bytes of a thread's stack: programs nest.
const STACK: usize = 8 << 20;

/// The services of a process.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Part {
    /// All of them.
    All {
        /// The place of the database.
        database: Place,
    },
    /// PERSISTENCE and the machines' profiles.
    Persistence {
        /// As of [`Part::All`].
        database: Place,
    },
    /// TRANSPILER.
    Transpiler {
        /// The address of PERSISTENCE: `http://127.0.0.1:8275`.
        persistence: String,
    },
    /// OUTPUT.
    Output {
        /// As of [`Part::Transpiler`].
        persistence: String,
    },
}

/// Reason why a server cannot be opened.
#[derive(Debug)]
pub enum OpenError {
    /// It would answer other computers, and no account is there.
    NoAccount,
    /// It would answer other computers without TLS.
    NoTls,
    /// The certificate or the key cannot be used; the reason.
    Tls(String),
    /// The address cannot be listened on.
    Address(io::Error),
    /// The database cannot be used; its reason.
    Database(String),
    /// A target of hooks, or the file with their authorities, cannot be used; the reason.
    Hooks(String),
}

/// State that all requests share.
struct Shared {
    shelf: Shelf,
    /// The store, where this process has it.
    own: Option<Store>,
    pool: Pool,
    counters: Arc<Counters>,
    bell: Bell,
    /// Wakes the one who tells hooks of events.
    hook_bell: Bell,
    /// Addresses that hooks may have; none where this process sends nothing.
    targets: OnceLock<Targets>,
    rooms: Rooms,
    /// Bytes of a program and of a document at most.
    largest: u64,
    /// Author of all changes: without a login, there is one user.
    author: String,
    guard: Guard,
}

impl Shared {
    /// The store of this process, for a user.
    fn store_of(&self, caller: &Caller) -> Result<Store, Problem> {
        Ok(self.own.as_ref().ok_or_else(Problem::no_address)?.of(caller.who()))
    }

    /// Does something with the documents, on a thread that may wait.
    async fn keep<T: Send + 'static>(
        &self,
        caller: &Caller,
        work: impl FnOnce(&Shelf) -> Result<T, Problem> + Send + 'static,
    ) -> Result<T, Problem> {
        let shelf = self.shelf.of(caller);
        tokio::task::spawn_blocking(move || work(&shelf)).await.unwrap_or_else(|_| Err(Problem::fault()))
    }

    /// Does something with the store of this process, on a thread that may wait.
    async fn store<T: Send + 'static>(
        &self,
        caller: &Caller,
        work: impl FnOnce(&Store) -> Result<T, Problem> + Send + 'static,
    ) -> Result<T, Problem> {
        let store = self.store_of(caller)?;
        tokio::task::spawn_blocking(move || work(&store)).await.unwrap_or_else(|_| Err(Problem::fault()))
    }

    /// Does work of the compiler with the store of this process, within its limits.
    async fn compile<T: Send + 'static>(
        &self,
        caller: &Caller,
        work: impl FnOnce(&Store) -> Result<T, Problem> + Send + 'static,
    ) -> Result<T, Problem> {
        let store = self.store_of(caller)?;
        self.guard.takes_work(caller)?;
        let done = self.pool.run(move || work(&store)).await;
        done.unwrap_or_else(|not| Err(Problem::of_work(not, self.pool.limit())))
    }

    /// The same for work that waits as long as it takes for its turn.
    async fn compile_in_turn<T: Send + 'static>(
        &self,
        caller: &Caller,
        work: impl FnOnce(&Store) -> Result<T, Problem> + Send + 'static,
    ) -> Result<T, Problem> {
        let store = self.store_of(caller)?;
        let done = self.pool.run_in_turn(move || work(&store)).await;
        done.unwrap_or_else(|not| Err(Problem::of_work(not, self.pool.limit())))
    }

    /// Does work of the compiler, within its limits.
    async fn work<T: Send + 'static>(
        &self,
        caller: &Caller,
        work: impl FnOnce(&Shelf) -> Result<T, Problem> + Send + 'static,
    ) -> Result<T, Problem> {
        let shelf = self.shelf.of(caller);
        self.guard.takes_work(caller)?;
        match self.pool.run(move || work(&shelf)).await {
            // A program that was interrupted with the process is not a wrong one.
            Ok(Err(_)) if ncc_exec::halt::is_asked() => Err(Problem::busy("the service ends")),
            Ok(done) => done,
            Err(not) => Err(Problem::of_work(not, self.pool.limit())),
        }
    }
}

/// Copies a database into a new file, an SQLite one of either, which nobody else may read; gives how many rows it has. Servers
/// may go on meanwhile.
///
/// # Errors
/// The file is there already or cannot be written, or the database cannot be read; the reason.
pub fn backup(place: &Place, into: &Path) -> Result<u64, String> {
    store::backup(place, into).map_err(|error| error.to_string())
}

/// Makes an empty database what a backup has, all of it or nothing; gives how many rows.
///
/// # Errors
/// The file is no backup or damaged, or the database is not empty or cannot be written; the reason.
pub fn restore(place: &Place, file: &Path) -> Result<u64, String> {
    store::restore(place, file).map_err(|error| match error {
        StoreError::Exists => "the database is not empty".to_owned(),
        error => error.to_string(),
    })
}

/// A server that is ready.
pub struct Service {
    listener: TcpListener,
    listen: Listen,
    tls: Option<TlsAcceptor>,
    routes: Router<Arc<Shared>>,
    shared: Arc<Shared>,
    threads: usize,
    /// Number of workers.
    workers: usize,
    limits: Limits,
}

impl Service {
    /// Listens on an address; port 0 is any that is free. Without accounts, changes are `author`'s.
    ///
    /// # Errors
    /// The address is taken, the database or the certificate cannot be used; or other computers may ask, and there are no
    /// accounts, or there is no TLS.
    pub fn open(listen: impl Into<Listen>, part: &Part, author: &str) -> Result<Service, OpenError> {
        Service::with_limits(listen, part, author, Limits::default())
    }

    /// The same, with limits of its own.
    ///
    /// # Errors
    /// As of [`Service::open`].
    pub fn with_limits(
        listen: impl Into<Listen>,
        part: &Part,
        author: &str,
        limits: Limits,
    ) -> Result<Service, OpenError> {
        let mut listen = listen.into();
        let own = match part {
            Part::All { database } | Part::Persistence { database } => {
                let store = Store::open(database).map_err(|error| OpenError::Database(error.to_string()))?;
                Some(store)
            }
            Part::Transpiler { .. } | Part::Output { .. } => None,
        };
        if listen.is_public() {
            let has_accounts = own.as_ref().map_or(Ok(false), Store::has_accounts);
            if !has_accounts.map_err(|error| OpenError::Database(error.to_string()))? {
                return Err(OpenError::NoAccount);
            }
        }
        if !listen.address.ip().is_loopback() && listen.tls.is_none() && !listen.behind_proxy {
            return Err(OpenError::NoTls);
        }
        let tls = listen.tls.as_ref().map(tls::acceptor).transpose().map_err(OpenError::Tls)?;
        let (addresses, elsewhere) = match part {
            Part::All { .. } => (
                case_study::transpiler()
                    .merge(case_study::persistence())
                    .merge(case_study::output())
                    .merge(shop::routes())
                    .merge(api::routes())
                    .merge(hooks::routes())
                    .merge(access::routes())
                    .merge(studio::routes()),
                None,
            ),
            Part::Persistence { .. } => {
                (case_study::persistence().merge(shop::routes()).merge(access::routes()), None)
            }
            Part::Transpiler { persistence } => (case_study::transpiler(), Some(persistence)),
            Part::Output { persistence } => (case_study::output(), Some(persistence)),
        };
        let routes = openapi::described(addresses.merge(observe::routes()));
        let there = || Shelf::There(Arc::new(Remote::at(elsewhere.map_or("", String::as_str))));
        let shelf = own.clone().map_or_else(there, Shelf::Here);
        let listener = TcpListener::bind(listen.address).map_err(OpenError::Address)?;
        listen.address = listener.local_addr().map_err(OpenError::Address)?;
        let guard = Guard::new(
            &limits,
            tls.is_some() || listen.behind_proxy,
            openapi::open().chain(studio::open()).collect(),
        );
        let threads = std::thread::available_parallelism().map_or(2, usize::from);
        let pool = Pool::new(threads, limits.waiting, limits.work);
        let shared = Arc::new(Shared {
            shelf,
            own,
            pool,
            rooms: Rooms::new(&limits),
            counters: Arc::new(Counters::new()),
            bell: Bell::new(),
            hook_bell: Bell::new(),
            targets: OnceLock::new(),
            largest: limits.largest,
            author: author.to_owned(),
            guard,
        });
        let workers = if matches!(part, Part::All { .. }) { threads } else { 0 };
        Ok(Service { listener, listen, tls, routes, shared, threads, workers, limits })
    }

    /// The same service, which tells hooks of events. Without targets it tells nobody.
    ///
    /// # Errors
    /// A target or the file of authorities is not of the form.
    pub fn with_hooks(self, hooks: &Hooks) -> Result<Service, OpenError> {
        if !hooks.targets.is_empty() {
            let targets = Targets::of(hooks, &self.limits).map_err(OpenError::Hooks)?;
            // The first ones stay.
            let _ = self.shared.targets.set(targets);
        }
        Ok(self)
    }

    /// Address of the server.
    pub fn address(&self) -> String {
        format!("{}://{}", if self.tls.is_some() { "https" } else { "http" }, self.listen.address)
    }

    /// Serves until the process is asked to stop (`ncc_exec::halt`); requests that are being answered end first.
    ///
    /// # Errors
    /// The network.
    pub fn serve(self) -> io::Result<()> {
        let runtime = tokio::runtime::Builder::new_multi_thread()
            .worker_threads(self.threads)
            .thread_stack_size(STACK)
            .max_blocking_threads(64)
            .enable_all()
            .build()?;
        let routes = self
            .routes
            .fallback(async || Problem::no_address())
            .method_not_allowed_fallback(async || Problem::method())
            .layer(middleware::from_fn_with_state(Arc::clone(&self.shared), workers::ring))
            .layer(middleware::from_fn_with_state(Arc::clone(&self.shared), guard::pass))
            .layer(DefaultBodyLimit::max(usize::try_from(self.shared.largest).unwrap_or(usize::MAX)))
            .layer(middleware::from_fn_with_state(Arrivals::new(&self.limits), arrival::pass))
            .layer(compression::layer())
            .layer(middleware::map_response(compression::tag))
            .layer(middleware::from_fn_with_state(gate::Gate::new(&self.listen), gate::pass))
            .layer(middleware::from_fn_with_state(Arc::clone(&self.shared.counters), observe::pass))
            .with_state(Arc::clone(&self.shared));
        runtime.block_on(async {
            self.listener.set_nonblocking(true)?;
            let listener = tokio::net::TcpListener::from_std(self.listener)?;
            let (stop, asked) = watch::channel(false);
            let workers: Vec<_> = (0..self.workers)
                .map(|_| tokio::spawn(workers::work(Arc::clone(&self.shared), asked.clone())))
                // Half of the threads at most compute facts, so that requests find a thread.
                .chain(
                    (0..self.workers.div_ceil(2)).map(|_| {
                        tokio::spawn(workers::compute_facts(Arc::clone(&self.shared), asked.clone()))
                    }),
                )
                .chain((0..self.workers.min(1)).flat_map(|_| {
                    let [one, other] = [(); 2].map(|()| (Arc::clone(&self.shared), asked.clone()));
                    [tokio::spawn(sending::run(one.0, one.1)), tokio::spawn(sending::tidy(other.0, other.1))]
                }))
                .collect();
            let stopped = async {
                while !ncc_exec::halt::is_asked() {
                    tokio::time::sleep(Duration::from_millis(50)).await;
                }
                let _ = stop.send(true);
            };
            let served = connections::serve(listener, routes, self.tls, self.limits, stopped).await;
            for worker in workers {
                // One that broke off has left its task to others.
                let _ = worker.await;
            }
            served
        })?;
        runtime.shutdown_background();
        Ok(())
    }
}
