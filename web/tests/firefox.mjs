// Debian's Firefox, driven by Marionette, its own protocol: playwright-core needs a Firefox of its own. Text over one
// socket: a number of bytes, a colon, and JSON.
import { spawn } from "node:child_process";
import {
  existsSync,
  mkdirSync,
  mkdtempSync,
  readdirSync,
  readFileSync,
  rmSync,
  writeFileSync,
} from "node:fs";
import { connect } from "node:net";
import { tmpdir } from "node:os";
import { delimiter, join } from "node:path";
import { setTimeout as pause } from "node:timers/promises";
import { PATIENCE } from "./browser.mjs";

const NAMES = ["firefox-esr", "firefox"];

/** The path of a Firefox: FIREFOX, which then has to be there, or the first in PATH; null if there is none. */
export function findFirefox() {
  const { FIREFOX, PATH = "" } = process.env;
  if (FIREFOX) return FIREFOX;
  const paths = PATH.split(delimiter).flatMap((folder) => NAMES.map((name) => join(folder, name)));
  return paths.find((path) => existsSync(path)) ?? null;
}

const PREFERENCES = {
  "marionette.port": 0,
  "browser.download.folderList": 2,
  "browser.download.always_ask_before_handling_new_types": false,
  // As below.
  "webgl.forbid-software": false,
  "webgl.force-enabled": true,
  "app.update.disabledForTesting": true,
  "browser.aboutwelcome.enabled": false,
  "browser.safebrowsing.update.enabled": false,
  "browser.shell.checkDefaultBrowser": false,
  "browser.startup.page": 0,
  "datareporting.policy.dataSubmissionEnabled": false,
  "extensions.update.enabled": false,
  "network.captive-portal-service.enabled": false,
  "network.connectivity-service.enabled": false,
  "toolkit.telemetry.enabled": false,
};

/** Three dimensions by Mesa's software, where that is installed: there is neither a graphics card nor a screen. */
const SOFTWARE = { EGL_PLATFORM: "surfaceless", MOZ_WEBGL_FORCE_EGL: "1" };

/** Waits until `look` gives something. */
async function until(look, what, patience = PATIENCE) {
  for (const end = Date.now() + patience; Date.now() < end; await pause(50)) {
    const found = await look();
    if (found) return found;
  }
  throw new Error(`Firefox: ${what} did not come in ${patience / 1000} s`);
}

/** Calls by name over a socket, one after the other. */
async function commands(port) {
  const socket = connect(port, "127.0.0.1");
  const waiting = [];
  let bytes = Buffer.alloc(0);
  const take = () => {
    const colon = bytes.indexOf(":");
    const size = colon < 0 ? Number.POSITIVE_INFINITY : Number(bytes.subarray(0, colon));
    if (bytes.length < colon + 1 + size) return null;
    const message = JSON.parse(bytes.subarray(colon + 1, colon + 1 + size));
    bytes = bytes.subarray(colon + 1 + size);
    return message;
  };
  socket.on("data", (more) => {
    bytes = Buffer.concat([bytes, more]);
    for (let message = take(); message; message = take()) waiting.shift()?.(message);
  });
  // The first message is a greeting.
  await new Promise((resolve, reject) => {
    waiting.push(resolve);
    socket.on("error", reject);
  });
  let id = 0;
  return async (name, parameters = {}) => {
    const text = JSON.stringify([0, ++id, name, parameters]);
    const answer = new Promise((resolve) => waiting.push(resolve));
    socket.write(`${Buffer.byteLength(text)}:${text}`);
    const [, , error, result] = await answer;
    if (error) throw new Error(`${name}: ${error.message}`);
    return result;
  };
}

/** A Firefox with an empty profile. Files that it downloads lie in `downloads`. */
export async function openFirefox(path) {
  const folder = mkdtempSync(join(tmpdir(), "pleach-firefox-"));
  const [profile, downloads] = ["profile", "downloads"].map((name) => join(folder, name));
  for (const each of [profile, downloads]) mkdirSync(each);
  const preferences = Object.entries({ ...PREFERENCES, "browser.download.dir": downloads });
  const lines = preferences.map(([name, value]) => `user_pref("${name}", ${JSON.stringify(value)});`);
  writeFileSync(join(profile, "user.js"), lines.join("\n"));
  const program = spawn(
    path,
    ["--marionette", "--remote-allow-system-access", "--headless", "--no-remote", "--profile", profile],
    {
      stdio: "ignore",
      env: { ...process.env, HOME: folder, ...SOFTWARE },
    },
  );
  let fault = null;
  program.on("error", (error) => {
    fault = error;
  });
  const ended = new Promise((resolve) => program.on("close", resolve));
  const portFile = join(profile, "MarionetteActivePort");
  const port = await until(() => {
    if (fault) throw fault;
    return existsSync(portFile) && Number(readFileSync(portFile, "utf8"));
  }, "its port");
  const call = await commands(port);
  await call("WebDriver:NewSession", {});
  await call("WebDriver:SetTimeouts", { script: PATIENCE, pageLoad: PATIENCE });
  await call("WebDriver:SetWindowRect", { width: 1280, height: 900 });

  /** What a function of the page's returns, or what its promise brings. */
  const evaluate = async (run, ...args) => {
    const script = `return (${run})(...arguments);`;
    return (await call("WebDriver:ExecuteScript", { script, args, sandbox: null })).value;
  };
  /** As above, with the rights of the browser itself. */
  const inBrowser = async (run, ...args) => {
    await call("Marionette:SetContext", { value: "chrome" });
    try {
      return await evaluate(run, ...args);
    } finally {
      await call("Marionette:SetContext", { value: "content" });
    }
  };
  const wait = (run, ...args) => until(() => evaluate(run, ...args), `${run}`);
  const find = (selector) =>
    until(
      () => call("WebDriver:FindElement", { using: "css selector", value: selector }).catch(() => null),
      selector,
    );
  const idOf = async (selector) => Object.values((await find(selector)).value)[0];
  return {
    evaluate,
    inBrowser,
    /** Until a function of the page's returns something true. */
    wait,
    go: (url) => call("WebDriver:Navigate", { url }),
    /** As a hand does it: scrolls there, and fails where something else is in front. */
    click: async (selector) => call("WebDriver:ElementClick", { id: await idOf(selector) }),
    screenshot: async () =>
      Buffer.from((await call("WebDriver:TakeScreenshot", { full: false })).value, "base64"),
    /** The bytes of the next file that ends so, once it is whole. */
    downloaded: (ending) =>
      until(() => {
        const names = readdirSync(downloads);
        const name = names.find((each) => each.endsWith(ending));
        if (!name || names.some((each) => each.endsWith(".part"))) return null;
        try {
          return readFileSync(join(downloads, name));
        } catch (error) {
          // It has another name while it is written.
          if (error.code === "ENOENT") return null;
          throw error;
        }
      }, `a file ${ending}`),
    /** Mistakes of scripts, and what they wrote as errors, of pages below an address. */
    problems: (address) =>
      inBrowser(
        (address) =>
          [...Services.console.getMessageArray()]
            .filter((each) => each instanceof Ci.nsIScriptError && each.sourceName.startsWith(address))
            .filter((each) => !(each.flags & Ci.nsIScriptError.warningFlag))
            .map((each) => each.message),
        address,
      ),
    async close() {
      await call("Marionette:Quit", { flags: ["eForceQuit"] }).catch(() => program.kill());
      await ended;
      rmSync(folder, { recursive: true, force: true, maxRetries: 3 });
    },
  };
}
