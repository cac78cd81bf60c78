import { defineConfig } from "vite";
import { offline } from "./tools/offline.mjs";
import { preview } from "./tools/preview-tags.mjs";
import { sizes } from "./tools/sizes.mjs";

export default defineConfig({
  // Relative addresses, so that the folder works under any path.
  base: "./",
  plugins: [preview(), offline(), sizes()],
  oxc: { jsx: { runtime: "automatic", importSource: "preact" } },
  worker: { format: "es" },
  build: {
    target: "es2022",
    // The policy allows no `data:` scripts or fonts: nothing is inlined.
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    chunkSizeWarningLimit: 900,
    // `sizes` says them by when they are loaded.
    reportCompressedSize: false,
    rolldownOptions: { checks: { pluginTimings: false } },
  },
});
