//! The page as the program serves it: its own files to its own address, and nothing else.
//!
//! With the feature `studio` the page has to be built; without it the program says how to get one that has it.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use pleach_tests::Dir;

#[cfg(not(feature = "studio"))]
#[test]
fn a_program_without_the_page_says_how_to_get_it() {
    let dir = Dir::new();
    dir.run(["studio", "--no-open"])
        .fails(1, &["without the page", "npm --prefix web ci", "--features studio"]);
}

#[cfg(feature = "studio")]
mod served {
    use super::Dir;
    use std::io::{BufRead as _, BufReader, Read as _, Write as _};
    use std::net::TcpStream;
    use std::process::{Child, Stdio};

    /// A running server, which ends with the test.
    struct Studio {
        child: Child,
        host: String,
        _dir: Dir,
    }

    impl Studio {
        fn start() -> Self {
            let dir = Dir::new();
            let mut command = dir.command(["studio", "--no-open", "--port", "0"]);
            let mut child = command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn().unwrap();
            let mut address = String::new();
            BufReader::new(child.stdout.take().unwrap()).read_line(&mut address).unwrap();
            let host = address.trim().strip_prefix("http://").unwrap().trim_end_matches('/').to_owned();
            Self { child, host, _dir: dir }
        }

        /// The head and the body of an answer.
        fn ask(&self, method: &str, path: &str, host: &str) -> (String, Vec<u8>) {
            let mut stream = TcpStream::connect(&self.host).unwrap();
            write!(stream, "{method} {path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n").unwrap();
            let mut answer = Vec::new();
            stream.read_to_end(&mut answer).unwrap();
            let end = answer.windows(4).position(|window| window == b"\r\n\r\n").unwrap();
            (String::from_utf8(answer[..end].to_vec()).unwrap(), answer[end + 4..].to_vec())
        }

        fn get(&self, path: &str) -> (String, Vec<u8>) {
            self.ask("GET", path, &self.host)
        }
    }

    impl Drop for Studio {
        fn drop(&mut self) {
            let _ = self.child.kill();
            let _ = self.child.wait();
        }
    }

    #[test]
    fn the_page_comes_with_a_strict_policy_and_all_its_files() {
        let studio = Studio::start();
        assert!(studio.host.starts_with("127.0.0.1:"), "{}", studio.host);
        let (head, body) = studio.get("/");
        let page = String::from_utf8(body).unwrap();
        assert!(head.starts_with("HTTP/1.1 200") && head.contains("text/html"), "{head}");
        for part in ["Content-Security-Policy: default-src 'none'", "frame-ancestors 'none'", "nosniff"] {
            assert!(head.contains(part), "{part}\n{head}");
        }
        let script = page.split('"').find(|part| part.ends_with(".js")).unwrap().trim_start_matches('.');
        let (head, body) = studio.get(script);
        assert!(head.starts_with("HTTP/1.1 200") && head.contains("text/javascript"), "{script}\n{head}");
        assert!(body.len() > 1000);
        let (head, body) = studio.ask("HEAD", "/?any", &studio.host);
        assert!(head.starts_with("HTTP/1.1 200") && body.is_empty(), "{head}");
    }

    #[test]
    fn no_other_file_no_other_method_and_no_other_name_is_answered() {
        let studio = Studio::start();
        for path in
            ["/Cargo.toml", "/../Cargo.toml", "/..%2fCargo.toml", "//etc/passwd", "/assets/../../README.md"]
        {
            let (head, body) = studio.get(path);
            assert!(head.starts_with("HTTP/1.1 404"), "{path}: {head}");
            assert!(body.len() < 100, "{path}");
        }
        assert!(studio.ask("POST", "/", &studio.host).0.starts_with("HTTP/1.1 405"));
        for host in ["example.org", "127.0.0.1:1", "127.0.0.1"] {
            assert!(studio.ask("GET", "/", host).0.starts_with("HTTP/1.1 403"), "{host}");
        }
    }

    #[test]
    fn a_port_in_use_is_named() {
        let studio = Studio::start();
        let port = studio.host.rsplit(':').next().unwrap().to_owned();
        Dir::new().run(["studio", "--no-open", "--port", &port]).fails(1, &[&port, "--port takes another"]);
    }
}
