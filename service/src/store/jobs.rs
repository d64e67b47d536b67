//! Jobs and their tasks.
//!
//! A task is claimed by a worker for a while. If the worker does not end it by then, as after a crash, another one claims it.
//! Only its worker can end it, so each task ends once.

use std::collections::BTreeMap;

use rusqlite::{Connection, OptionalExtension, Row, params};

use super::documents::now;
use super::{Store, StoreError};

/// A job.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Job {
    /// Its name.
    pub(crate) id: String,
    /// What is asked of each program, JSON.
    pub(crate) asked: String,
    /// Whose it is.
    pub(crate) author: String,
    /// When it was made, seconds since 1970 (UTC).
    pub(crate) made: i64,
    /// When its last task ended.
    pub(crate) ended: Option<i64>,
    /// Whether it was cancelled.
    pub(crate) is_cancelled: bool,
    /// How many tasks are in each state.
    pub(crate) counts: BTreeMap<String, i64>,
}

/// How a task ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum End {
    /// The program was translated.
    Done,
    /// It was refused.
    Refused,
    /// The job was cancelled.
    Cancelled,
}

impl End {
    const fn name(self) -> &'static str {
        match self {
            End::Done => "done",
            End::Refused => "refused",
            End::Cancelled => "cancelled",
        }
    }
}

/// A task that a worker has claimed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Task {
    /// Its job.
    pub(crate) job: String,
    /// Counted from 1.
    pub(crate) number: i64,
    /// The program.
    pub(crate) program: String,
    /// Which of its revisions.
    pub(crate) revision: i64,
    /// What is asked, JSON.
    pub(crate) asked: String,
    /// Whose job it is.
    pub(crate) author: String,
}

/// What became of a task.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct TaskResult {
    /// Counted from 1.
    pub(crate) number: i64,
    /// The program.
    pub(crate) program: String,
    /// Its folder and name in the revision.
    pub(crate) place: [String; 2],
    /// Which revision.
    pub(crate) revision: i64,
    /// `waiting`, `running`, `done`, `refused`, `cancelled`.
    pub(crate) state: String,
    /// What came out, JSON; empty before.
    pub(crate) result: String,
}

impl Store {
    /// Keeps a job with a task for each program, in order.
    pub(crate) fn create_job(
        &self,
        id: &str,
        asked: &str,
        author: &str,
        programs: &[(String, i64)],
    ) -> Result<(), StoreError> {
        self.database.write(|to| {
            to.execute(
                "INSERT INTO job (id, asked, author, made, ended) VALUES (?1, ?2, ?3, ?4, ?5)",
                params![id, asked, author, now(), programs.is_empty().then(now)],
            )?;
            let mut task = to.prepare_cached(
                "INSERT INTO task (job, number, program, revision, state) VALUES (?1, ?2, ?3, ?4, 'waiting')",
            )?;
            for (number, (program, revision)) in programs.iter().enumerate() {
                task.execute(params![id, number as i64 + 1, program, revision])?;
            }
            Ok(())
        })
    }

    /// Claims the next task for a worker, for so many seconds.
    pub(crate) fn claim(&self, worker: &str, seconds: i64) -> Result<Option<Task>, StoreError> {
        // Most of the time there is none, and nobody waits for the writer.
        let is_open = self.database.read(|from| {
            let mut open = from.prepare_cached(
                "SELECT 1 FROM task WHERE state = 'waiting' OR state = 'running' AND until < ?1",
            )?;
            Ok(open.exists([now()])?)
        })?;
        if !is_open {
            return Ok(None);
        }
        self.database.write(|to| {
            let mut left = to.prepare_cached(
                "UPDATE task SET state = 'cancelled' WHERE state = 'running' AND until < ?1
                 AND job IN (SELECT id FROM job WHERE is_cancelled) RETURNING job",
            )?;
            let left: Vec<String> = left.query_map([now()], |row| row.get(0))?.collect::<Result<_, _>>()?;
            left.iter().try_for_each(|job| end_job(to, job))?;
            let mut claim = to.prepare_cached(
                "UPDATE task SET state = 'running', worker = ?1, until = ?2 WHERE (job, number) = (
                     SELECT t.job, t.number FROM task t JOIN job j ON j.id = t.job
                     WHERE NOT j.is_cancelled AND (t.state = 'waiting' OR t.state = 'running' AND t.until < ?3)
                     ORDER BY j.made, t.job, t.number LIMIT 1)
                 RETURNING job, number, program, revision",
            )?;
            let time = now();
            let claimed = claim
                .query_row(params![worker, time + seconds, time], |row| {
                    Ok(Task {
                        job: row.get(0)?,
                        number: row.get(1)?,
                        program: row.get(2)?,
                        revision: row.get(3)?,
                        asked: String::new(),
                        author: String::new(),
                    })
                })
                .optional()?;
            let Some(task) = claimed else { return Ok(None) };
            let mut job = to.prepare_cached("SELECT asked, author FROM job WHERE id = ?1")?;
            let (asked, author) = job.query_row([&task.job], |row| Ok((row.get(0)?, row.get(1)?)))?;
            Ok(Some(Task { asked, author, ..task }))
        })
    }

    /// Ends a task of a worker; whether it was still the worker's.
    pub(crate) fn end_task(
        &self,
        worker: &str,
        task: &Task,
        end: End,
        result: &str,
    ) -> Result<bool, StoreError> {
        self.database.write(|to| {
            let mut ended = to.prepare_cached(
                "UPDATE task SET state = ?4, result = ?5 WHERE job = ?1 AND number = ?2 AND worker = ?3 AND state = 'running'",
            )?;
            let ended = ended.execute(params![task.job, task.number, worker, end.name(), result])?;
            end_job(to, &task.job)?;
            Ok(ended == 1)
        })
    }

    /// Gives a task back that a worker has not ended.
    pub(crate) fn give_back(&self, worker: &str, task: &Task) -> Result<(), StoreError> {
        self.database.write(|to| {
            to.execute(
                "UPDATE task SET state = 'waiting' WHERE job = ?1 AND number = ?2 AND worker = ?3 AND state = 'running'",
                params![task.job, task.number, worker],
            )?;
            Ok(())
        })
    }

    /// Cancels a job: no further task of it begins.
    pub(crate) fn cancel(&self, id: &str) -> Result<(), StoreError> {
        self.database.write(|to| {
            to.prepare_cached("UPDATE job SET is_cancelled = TRUE WHERE id = ?1 AND ended IS NULL")?
                .execute([id])?;
            to.execute(
                "UPDATE task SET state = 'cancelled' WHERE job = ?1 AND state = 'waiting'
                 AND job IN (SELECT id FROM job WHERE is_cancelled)",
                [id],
            )?;
            end_job(to, id)
        })
    }

    /// A job.
    pub(crate) fn job(&self, id: &str) -> Result<Job, StoreError> {
        self.database.read(|from| {
            let mut one = from.prepare_cached(
                "SELECT id, asked, author, made, ended, is_cancelled FROM job WHERE id = ?1",
            )?;
            let mut job = one.query_row([id], read)?;
            count(from, &mut job)?;
            Ok(job)
        })
    }

    /// Jobs, the newest first, so many at most; those before one.
    pub(crate) fn jobs(&self, before: Option<&str>, most: u32) -> Result<Vec<Job>, StoreError> {
        self.database.read(|from| {
            let mut all = from.prepare_cached(
                "SELECT id, asked, author, made, ended, is_cancelled FROM job
                 WHERE ?1 IS NULL OR (made, id) < (SELECT made, id FROM job WHERE id = ?1)
                 ORDER BY made DESC, id DESC LIMIT ?2",
            )?;
            let rows = all.query_map(params![before, most], read)?;
            let mut jobs: Vec<Job> = rows.collect::<Result<_, _>>()?;
            jobs.iter_mut().try_for_each(|job| count(from, job))?;
            Ok(jobs)
        })
    }

    /// What became of the tasks of a job: those after a number, so many at most.
    pub(crate) fn results(&self, id: &str, after: i64, most: u32) -> Result<Vec<TaskResult>, StoreError> {
        self.database.read(|from| {
            let mut all = from.prepare_cached(
                "SELECT t.number, t.program, r.folder, r.name, t.revision, t.state, t.result FROM task t
                 JOIN revision r ON r.program = t.program AND r.number = t.revision
                 WHERE t.job = ?1 AND t.number > ?2 ORDER BY t.number LIMIT ?3",
            )?;
            let rows = all.query_map(params![id, after, most], |row| {
                Ok(TaskResult {
                    number: row.get(0)?,
                    program: row.get(1)?,
                    place: [row.get(2)?, row.get(3)?],
                    revision: row.get(4)?,
                    state: row.get(5)?,
                    result: row.get(6)?,
                })
            })?;
            Ok(rows.collect::<Result<_, _>>()?)
        })
    }
}

fn read(row: &Row) -> rusqlite::Result<Job> {
    Ok(Job {
        id: row.get(0)?,
        asked: row.get(1)?,
        author: row.get(2)?,
        made: row.get(3)?,
        ended: row.get(4)?,
        is_cancelled: row.get(5)?,
        counts: BTreeMap::new(),
    })
}

fn count(from: &Connection, job: &mut Job) -> Result<(), StoreError> {
    let mut counts = from.prepare_cached("SELECT state, count(*) FROM task WHERE job = ?1 GROUP BY state")?;
    job.counts =
        counts.query_map([&job.id], |row| Ok((row.get(0)?, row.get(1)?)))?.collect::<Result<_, _>>()?;
    Ok(())
}

/// Marks a job as ended where no task of it is left.
fn end_job(to: &Connection, id: &str) -> Result<(), StoreError> {
    to.prepare_cached(
        "UPDATE job SET ended = ?2 WHERE id = ?1 AND ended IS NULL
         AND NOT EXISTS (SELECT 1 FROM task WHERE job = ?1 AND state IN ('waiting', 'running'))",
    )?
    .execute(params![id, now()])?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::contents::Receiving;
    use super::super::programs::{Details, Said};
    use super::*;

    fn store(programs: usize) -> (tempfile::TempDir, Store) {
        let folder = tempfile::tempdir().expect("a folder");
        let store = Store::open(&folder.path().join("a.sqlite")).expect("a store");
        let all: Vec<(String, i64)> = (0..programs).map(|n| (format!("p{n}"), 1)).collect();
        for (id, _) in &all {
            let details = Details { name: id.clone(), ..Details::default() };
            store
                .create_program(id, &details, Receiving::default(), &Said::default(), None)
                .expect("a program");
        }
        store.create_job("j", "{}", "ana", &all).expect("a job");
        (folder, store)
    }

    fn counts(store: &Store) -> Vec<(String, i64)> {
        store.job("j").expect("a job").counts.into_iter().collect()
    }

    #[test]
    fn a_task_of_a_worker_that_has_died_is_done_by_another_once() {
        let (_folder, store) = store(1);
        // Its time is over before it begins.
        let first = store.claim("dead", -1).expect("a store").expect("a task");
        let second = store.claim("alive", 60).expect("a store").expect("the task again");
        assert_eq!(first, second);
        assert_eq!(store.claim("third", 60).expect("a store"), None);
        assert!(!store.end_task("dead", &first, End::Done, "late").expect("a store"));
        assert!(store.end_task("alive", &second, End::Done, "first").expect("a store"));
        assert!(!store.end_task("alive", &second, End::Done, "again").expect("a store"));
        let results = store.results("j", 0, 10).expect("results");
        assert_eq!((results[0].state.as_str(), results[0].result.as_str()), ("done", "first"));
        assert!(store.job("j").expect("a job").ended.is_some());
    }

    #[test]
    fn a_cancelled_job_begins_no_task() {
        let (_folder, store) = store(3);
        let running = store.claim("a", 60).expect("a store").expect("a task");
        let left = store.claim("dead", -1).expect("a store").expect("a task");
        assert_ne!(running.number, left.number);
        store.cancel("j").expect("a store");
        assert_eq!(counts(&store), [("cancelled".to_owned(), 1), ("running".to_owned(), 2)]);
        // The one of a dead worker is swept away when another one looks for work.
        assert_eq!(store.claim("b", 60).expect("a store"), None);
        assert_eq!(counts(&store), [("cancelled".to_owned(), 2), ("running".to_owned(), 1)]);
        assert!(store.job("j").expect("a job").ended.is_none());
        assert!(store.end_task("a", &running, End::Done, "").expect("a store"));
        assert!(store.job("j").expect("a job").ended.is_some());
    }

    #[test]
    fn a_task_that_is_given_back_waits() {
        let (_folder, store) = store(1);
        let task = store.claim("a", 60).expect("a store").expect("a task");
        store.give_back("b", &task).expect("a store");
        assert_eq!(counts(&store), [("running".to_owned(), 1)]);
        store.give_back("a", &task).expect("a store");
        assert_eq!(counts(&store), [("waiting".to_owned(), 1)]);
    }

    #[test]
    fn a_job_without_programs_is_over() {
        let (_folder, store) = store(0);
        assert!(store.job("j").expect("a job").ended.is_some());
    }
}
