//! Bodies as they arrive: how large one may be, how long it may take, and how many bytes all of them together may hold.
//!
//! A body that is promised to be too large is refused before it comes. All together are counted as they come, not as they
//! are promised, and until their requests have been answered.

use std::error::Error;
use std::fmt;
use std::pin::Pin;
use std::sync::{Arc, Mutex, PoisonError};
use std::task::{Context, Poll};
use std::time::Duration;

use axum::body::{Body, Bytes, HttpBody};
use axum::extract::{Request, State};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use http_body::{Frame, SizeHint};
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tokio::time::Sleep;

use super::Problem;
use crate::Limits;

/// Limits of all bodies.
#[derive(Clone)]
pub(crate) struct Arrivals {
    /// Bytes that all bodies together may still hold.
    free: Arc<Semaphore>,
    /// Bytes of one body.
    largest: u64,
    /// Time limit of one body.
    patience: Duration,
}

/// Reason why a body did not arrive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Broken {
    /// Its time was over.
    TooSlow,
    /// All bodies together hold too much.
    Crowded,
}

impl fmt::Display for Broken {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match self {
            Broken::TooSlow => "the body came too slowly",
            Broken::Crowded => "too many bodies at once",
        })
    }
}

impl Error for Broken {}

impl Broken {
    /// Of an error by which a body ended.
    pub(crate) fn of(error: &(dyn Error + 'static)) -> Option<Broken> {
        error.downcast_ref().copied().or_else(|| Broken::of(error.source()?))
    }
}

impl Arrivals {
    pub(crate) fn new(limits: &Limits) -> Arrivals {
        let free = Arc::new(Semaphore::new(limits.bodies.min(Semaphore::MAX_PERMITS)));
        Arrivals { free, largest: limits.largest, patience: limits.body }
    }
}

/// Memory that the body of a request holds.
type Held = Arc<Mutex<Option<OwnedSemaphorePermit>>>;

/// A body on its way.
struct Arriving {
    body: Body,
    free: Arc<Semaphore>,
    held: Held,
    late: Pin<Box<Sleep>>,
}

impl Arriving {
    fn hold(&self, bytes: usize) -> Result<(), Broken> {
        let bytes = u32::try_from(bytes).map_err(|_| Broken::Crowded)?;
        let more = self.free.clone().try_acquire_many_owned(bytes).map_err(|_| Broken::Crowded)?;
        let mut held = self.held.lock().unwrap_or_else(PoisonError::into_inner);
        match held.as_mut() {
            Some(held) => held.merge(more),
            None => *held = Some(more),
        }
        Ok(())
    }
}

impl HttpBody for Arriving {
    type Data = Bytes;
    type Error = axum::Error;

    fn poll_frame(
        self: Pin<&mut Self>,
        context: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, axum::Error>>> {
        let own = self.get_mut();
        let Poll::Ready(frame) = Pin::new(&mut own.body).poll_frame(context) else {
            let late = own.late.as_mut().poll(context);
            return late.map(|()| Some(Err(axum::Error::new(Broken::TooSlow))));
        };
        let bytes = match &frame {
            Some(Ok(frame)) => frame.data_ref().map_or(0, Bytes::len),
            _ => 0,
        };
        Poll::Ready(match own.hold(bytes) {
            Ok(()) => frame,
            Err(broken) => Some(Err(axum::Error::new(broken))),
        })
    }

    fn is_end_stream(&self) -> bool {
        self.body.is_end_stream()
    }

    fn size_hint(&self) -> SizeHint {
        self.body.size_hint()
    }
}

/// Lets a request's body arrive within the limits.
pub(crate) async fn pass(State(arrivals): State<Arrivals>, request: Request, next: Next) -> Response {
    if request.body().size_hint().lower() > arrivals.largest {
        return Problem::too_large(arrivals.largest).into_response();
    }
    let held = Held::default();
    let request = request.map(|body| {
        let late = Box::pin(tokio::time::sleep(arrivals.patience));
        Body::new(Arriving { body, free: arrivals.free.clone(), held: held.clone(), late })
    });
    let answer = next.run(request).await;
    drop(held);
    answer
}
