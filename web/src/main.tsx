import { render } from "preact";
import "./styles/tokens.css";
import "./styles/base.css";
import "./styles/controls.css";
import "./styles/frame.css";
import "./styles/fit.css";
import "./styles/goal.css";
import "./styles/kept.css";
import "./styles/map.css";
import "./styles/species.css";
import "./styles/grammar.css";
import "./styles/gallery.css";
import { App } from "./app";
import { reportDeaths } from "./engine/client";
import { wasmModule } from "./engine/module";
import type { FitOptions } from "./engine/protocol";
import { startOffline } from "./offline/offline";
import { fitLink, restoreFit } from "./rooms/fit/autosave";
import { elapsed, progress, told } from "./rooms/fit/fit-state";
import { masks } from "./rooms/fit/goal-state";
import { drawn } from "./rooms/fit/growing-state";
import { mapLink, times } from "./rooms/map/map-state";
import { say, sayError } from "./state/notes";
import { register, startRouting } from "./state/route";
import { speciesLink } from "./state/species-link";
import { view } from "./view3d/handle";

// The library loads while the page is drawn.
wasmModule().catch(sayError);
reportDeaths((what, message) =>
  say(`The worker of ${what} stopped (${message}). A new one was started.`, "error"),
);
register(speciesLink);
register(mapLink);
register(fitLink);

// For the console and the tests: what the graphics card holds, how fast the map answers, how far a search is and how many
// of its trees were drawn, options of the next one, how much undo holds.
Object.assign(window, {
  studio: {
    memory: () => view()?.memory() ?? null,
    mapTimes: times,
    undoBytes: () => masks.bytes(),
    search: () => ({
      seconds: elapsed.peek(),
      trees: progress.peek()?.evaluations ?? 0,
      drawn: { ...drawn },
    }),
    tell: (options: FitOptions) => {
      told.options = options;
    },
  },
});

const root = document.getElementById("app");
if (root) {
  await restoreFit().catch(sayError);
  // Sets the room at once; what a link holds follows when the library has read it.
  const routing = startRouting();
  render(<App />, root);
  await routing;
}
startOffline();
