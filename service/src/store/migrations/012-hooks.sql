-- Web hooks: addresses that are told of events. `events` has the names of the kinds, with a space between them; the empty folder is
-- everything. The secret is here as it is: the service signs with it.
CREATE TABLE hook (
    id TEXT PRIMARY KEY,
    target TEXT NOT NULL,
    secret BLOB NOT NULL,
    events TEXT NOT NULL,
    folder TEXT NOT NULL,
    state TEXT NOT NULL DEFAULT 'active',
    author TEXT NOT NULL,
    made BIGINT NOT NULL
);
-- What each hook is told: an event for each hook that wants it, written with the change itself. `id` is that of the event, and so
-- the same for all hooks. A delivery that is being sent is its worker's until a moment; then others send it again.
CREATE TABLE delivery (
    number INTEGER PRIMARY KEY,
    id TEXT NOT NULL,
    hook TEXT NOT NULL REFERENCES hook (id) ON DELETE CASCADE,
    event TEXT NOT NULL,
    subject TEXT NOT NULL,
    body TEXT NOT NULL,
    moment BIGINT NOT NULL,
    state TEXT NOT NULL DEFAULT 'waiting',
    attempts BIGINT NOT NULL DEFAULT 0,
    next BIGINT NOT NULL,
    worker TEXT NOT NULL DEFAULT '',
    until BIGINT NOT NULL DEFAULT 0,
    status BIGINT,
    reason TEXT NOT NULL DEFAULT '',
    ended BIGINT,
    UNIQUE (hook, id)
);
CREATE INDEX delivery_hook ON delivery (hook, number);
CREATE INDEX delivery_open ON delivery (next, number) WHERE ended IS NULL;
CREATE INDEX delivery_sending ON delivery (hook, until) WHERE state = 'sending';
CREATE INDEX delivery_ended ON delivery (ended) WHERE ended IS NOT NULL;
