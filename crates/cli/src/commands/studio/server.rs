//! A server for one page, on this machine alone.

use super::page;
use anyhow::Context;
use std::net::{Ipv4Addr, SocketAddr};
use tiny_http::{Header, Method, Request, Response, StatusCode};

/// Headers of every answer: the page may load only its own files, and send nothing anywhere.
const HEADERS: [(&str, &str); 5] = [
    (
        "Content-Security-Policy",
        "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'; style-src 'self'; \
         img-src 'self' blob: data:; connect-src 'self'; font-src 'self'; manifest-src 'self'; base-uri 'none'; \
         form-action 'none'; frame-ancestors 'none'",
    ),
    ("X-Content-Type-Options", "nosniff"),
    ("Referrer-Policy", "no-referrer"),
    ("Cross-Origin-Resource-Policy", "same-origin"),
    // A newer program has a newer page at the same address.
    ("Cache-Control", "no-cache"),
];

pub(super) struct Server {
    inner: tiny_http::Server,
    port: u16,
}

impl Server {
    /// Listens on the loopback address.
    pub(super) fn bind(port: u16) -> anyhow::Result<Self> {
        let address = SocketAddr::from((Ipv4Addr::LOCALHOST, port));
        let inner =
            tiny_http::Server::http(address).map_err(|error| anyhow::anyhow!("{error}")).with_context(
                || format!("port {port} cannot be used; --port takes another, or 0 for any that is free"),
            )?;
        let port = inner.server_addr().to_ip().map_or(port, |address| address.port());
        Ok(Self { inner, port })
    }

    pub(super) fn address(&self) -> String {
        format!("http://127.0.0.1:{}/", self.port)
    }

    /// Answers until the program is ended.
    pub(super) fn serve(&self) -> anyhow::Result<()> {
        loop {
            let request = self.inner.recv().context("the page cannot be served any more")?;
            // A browser that has closed the connection is not an error.
            let _ = self.answer(request);
        }
    }

    fn answer(&self, request: Request) -> std::io::Result<()> {
        let (status, kind, body): (u16, &str, &'static [u8]) = if !self.is_for_us(&request) {
            // A page of another name that resolves to this machine, for example.
            (403, TEXT, b"This server answers only to its own address.\n")
        } else if !matches!(request.method(), Method::Get | Method::Head) {
            (405, TEXT, b"This server only gives the files of its page.\n")
        } else if let Some((body, kind)) = page::file(request.url()) {
            (200, kind, body)
        } else {
            (404, TEXT, b"The page has no such file.\n")
        };
        let fields = HEADERS.into_iter().chain([("Content-Type", kind)]);
        let headers = fields.filter_map(|(name, value)| Header::from_bytes(name, value).ok()).collect();
        request.respond(Response::new(StatusCode(status), headers, body, Some(body.len()), None))
    }

    /// Whether the request names this server.
    fn is_for_us(&self, request: &Request) -> bool {
        let host = request.headers().iter().find(|header| header.field.equiv("Host"));
        let own = ["127.0.0.1", "localhost"].map(|name| format!("{name}:{}", self.port));
        host.is_some_and(|host| own.iter().any(|own| host.value.as_str() == own))
    }
}

const TEXT: &str = "text/plain; charset=utf-8";
