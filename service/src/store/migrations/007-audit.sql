-- Who did what when. Each entry has the digest of the one before it, so that none can be changed or taken out unseen.
CREATE TABLE audit (
    number BIGINT PRIMARY KEY,
    moment BIGINT NOT NULL,
    account TEXT NOT NULL,
    way TEXT NOT NULL,
    address TEXT NOT NULL,
    request TEXT NOT NULL,
    action TEXT NOT NULL,
    subject TEXT NOT NULL,
    detail TEXT NOT NULL,
    digest TEXT NOT NULL
);
CREATE INDEX audit_account ON audit (account, number);
CREATE INDEX audit_subject ON audit (subject, number);
CREATE INDEX audit_moment ON audit (moment, number);
-- in sqlite
CREATE TRIGGER audit_kept BEFORE UPDATE ON audit BEGIN SELECT RAISE(ABORT, 'the audit is append-only'); END;
CREATE TRIGGER audit_stays BEFORE DELETE ON audit BEGIN SELECT RAISE(ABORT, 'the audit is append-only'); END;
-- in postgres
CREATE FUNCTION audit_is_kept() RETURNS trigger LANGUAGE plpgsql AS
    $$ BEGIN RAISE EXCEPTION 'the audit is append-only'; END $$;
CREATE TRIGGER audit_kept BEFORE UPDATE OR DELETE OR TRUNCATE ON audit
    FOR EACH STATEMENT EXECUTE FUNCTION audit_is_kept();
-- in both
