import { defineConfig } from "vite";
import { offline } from "./tools/offline.mjs";
import { preview } from "./tools/preview-tags.mjs";

export default defineConfig({
  // Relative addresses, so that the folder works under any path.
  base: "./",
  plugins: [preview(), offline()],
  oxc: { jsx: { runtime: "automatic", importSource: "preact" } },
  worker: { format: "es" },
  build: {
    target: "es2022",
    // The policy allows no `data:` scripts or fonts: nothing is inlined.
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    chunkSizeWarningLimit: 900,
  },
});
