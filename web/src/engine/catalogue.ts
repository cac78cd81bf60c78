// The generators with their species, as the library listed them when it was built for the page: nothing waits for it to load.
import listed from "../wasm/catalogue.json";
import type { Family } from "./protocol";

export const families: readonly Family[] = listed;
