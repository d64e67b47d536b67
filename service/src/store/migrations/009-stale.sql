-- Whether a translation was stale when the facts of its program were computed last.
ALTER TABLE translation ADD COLUMN is_stale BOOLEAN NOT NULL DEFAULT FALSE;
CREATE INDEX translation_state ON translation (state, program);
CREATE INDEX translation_stale ON translation (program) WHERE is_stale;
