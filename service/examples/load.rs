//! A client that asks as fast as it is answered, to measure a server.
//!
//! ```text
//! load 127.0.0.1:8274 CLIENTS SECONDS GET  /persistence/part.cn
//! load 127.0.0.1:8274 CLIENTS SECONDS POST '/transpiler/{}?dialect=mach9' FILE
//! ```
//!
//! Each client keeps its connection. `{}` is a number that no other request has. Tells answers a second by their status, and
//! how long they took.

#![allow(clippy::print_stdout, reason = "its figures are for whoever calls it")]

use std::collections::BTreeMap;
use std::error::Error;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

static NUMBER: AtomicU64 = AtomicU64::new(0);

/// What is asked.
struct Load {
    address: String,
    method: String,
    target: String,
    body: Vec<u8>,
    time: Duration,
}

/// Answers by their status, and the time of each.
type Answers = (BTreeMap<u16, u64>, Vec<Duration>);

fn client(load: &Load) -> Result<Answers, Box<dyn Error + Send + Sync>> {
    let stream = TcpStream::connect(&load.address)?;
    stream.set_nodelay(true)?;
    let mut reader = BufReader::new(stream.try_clone()?);
    let mut writer = stream;
    let (mut statuses, mut times) = (BTreeMap::new(), Vec::new());
    let mut body = Vec::new();
    let begun = Instant::now();
    while begun.elapsed() < load.time {
        let number = NUMBER.fetch_add(1, Ordering::Relaxed).to_string();
        let target = load.target.replace("{}", &number);
        let mut request = format!("{} {target} HTTP/1.1\r\nHost: {}\r\n", load.method, load.address);
        if !load.body.is_empty() {
            request += &format!("Content-Length: {}\r\n", load.body.len());
        }
        let mut request = (request + "\r\n").into_bytes();
        request.extend_from_slice(&load.body);
        let since = Instant::now();
        writer.write_all(&request)?;
        let mut line = String::new();
        reader.read_line(&mut line)?;
        let status: u16 = line.split(' ').nth(1).unwrap_or_default().parse()?;
        let mut length = 0;
        loop {
            line.clear();
            reader.read_line(&mut line)?;
            let Some((name, value)) = line.trim_end().split_once(':') else { break };
            if name.eq_ignore_ascii_case("content-length") {
                length = value.trim().parse()?;
            }
        }
        body.resize(length, 0);
        reader.read_exact(&mut body)?;
        times.push(since.elapsed());
        *statuses.entry(status).or_default() += 1;
    }
    Ok((statuses, times))
}

fn main() -> Result<(), Box<dyn Error + Send + Sync>> {
    let arguments = std::env::args().skip(1).collect::<Vec<_>>();
    let [address, clients, seconds, method, target, file @ ..] = arguments.as_slice() else {
        return Err("load ADDRESS CLIENTS SECONDS METHOD TARGET [FILE]".into());
    };
    let load = Load {
        address: address.clone(),
        method: method.clone(),
        target: target.clone(),
        body: file.first().map(std::fs::read).transpose()?.unwrap_or_default(),
        time: Duration::from_secs(seconds.parse()?),
    };
    let clients: usize = clients.parse()?;
    let begun = Instant::now();
    let all = std::thread::scope(|scope| {
        let all = (0..clients).map(|_| scope.spawn(|| client(&load))).collect::<Vec<_>>();
        all.into_iter()
            .map(|one| one.join().unwrap_or_else(|_| Err("a client ended".into())))
            .collect::<Vec<_>>()
    });
    let took = begun.elapsed().as_secs_f64();
    let (mut statuses, mut times) = (BTreeMap::<u16, u64>::new(), Vec::new());
    for one in all {
        let (own, mut took) = one?;
        own.into_iter().for_each(|(status, count)| *statuses.entry(status).or_default() += count);
        times.append(&mut took);
    }
    times.sort_unstable();
    let at =
        |part: usize| times.get(times.len().saturating_sub(1) * part / 1000).copied().unwrap_or_default();
    let rates = statuses.iter().map(|(status, count)| format!("{status}: {:.0}/s", *count as f64 / took));
    println!("{}", rates.collect::<Vec<_>>().join(", "));
    println!("p50 {:?}, p99 {:?}, p99.9 {:?}, longest {:?}", at(500), at(990), at(999), at(1000));
    Ok(())
}
