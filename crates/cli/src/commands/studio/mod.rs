//! `pleach studio`: the page in a browser, served from the program itself.

#[cfg(feature = "studio")]
mod page;
#[cfg(feature = "studio")]
mod server;

const EXAMPLES: &str = "Examples:
  pleach studio                 open the page in the browser
  pleach studio --no-open       only say where it is
  pleach studio --port 8000     at another port

The page works on this machine alone: nothing that is dropped on it leaves it, and the program answers no other \
machine and gives no file but those of the page. Ctrl-C ends it.";

/// The default port. It should stay the same: a browser keeps a page's saved data by its address.
const PORT: u16 = 7326;

/// Fit, blend and shape trees in a page of the browser
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Studio {
    /// Port of this machine; 0 for any that is free. Your species and settings are kept by the browser for one
    /// port
    #[arg(long, value_name = "N", default_value_t = PORT)]
    port: u16,
    /// Do not open a browser
    #[arg(long)]
    no_open: bool,
}

impl Studio {
    #[cfg(feature = "studio")]
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        use crate::output;

        let server = server::Server::bind(self.port)?;
        output::line(server.address())?;
        if !self.no_open
            && let Err(error) = open::that_detached(server.address())
        {
            output::note(format!("no browser can be opened ({error}): open the address in one yourself"));
        }
        output::note("ctrl-C ends it");
        server.serve()
    }

    #[cfg(not(feature = "studio"))]
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        anyhow::bail!(
            "this program was built without the page; in a clone of the repository, with Node 20 or newer, \
             `npm --prefix web ci && npm --prefix web run build` makes it, and `cargo install --path crates/cli \
             --features studio` a program that serves it. Without pleach, any web server can serve web/dist"
        )
    }
}
