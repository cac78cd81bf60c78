// Derives one of the grammars with the npm package lindenmayer and prints the string:
// node lindenmayer.mjs NAME STEPS, from a folder where the package is installed.

import { createRequire } from "node:module";
import { writeFileSync } from "node:fs";
import { join } from "node:path";

const LSystem = createRequire(join(process.cwd(), "nowhere.js"))("lindenmayer");
const [name, steps] = [process.argv[2], Number(process.argv[3])];

const module = (symbol, ...params) => ({ symbol, params });
const h = Math.sqrt(0.3 * 0.7);
const grammars = {
  koch: { axiom: "F-F-F-F", productions: { F: "F-F+F+FF-F-F+F" } },
  plant: { axiom: "X", productions: { X: "F-[[X]+X]+F[+FX]-X", F: "FF" } },
  // One letter for each of the two edges.
  dragon: { axiom: "L", productions: { L: "L+R+", R: "-L-R" } },
  tree: {
    axiom: [module("A", 1, 10)],
    productions: {
      A: ({ part: { params: [l, w] } }) => [
        module("!", w), module("F", l),
        module("["), module("+", 30), module("A", l * 0.9, w * 0.7), module("]"),
        module("["), module("-", 30), module("A", l * 0.8, w * 0.7), module("]"),
      ],
    },
  },
  row: {
    axiom: [module("F", 1)],
    productions: {
      F: ({ part: { params: [x] } }) => [
        module("F", x * 0.3), module("+"), module("F", x * h), module("-"), module("-"),
        module("F", x * h), module("+"), module("F", x * 0.7),
      ],
    },
  },
};

const system = new LSystem(grammars[name]);
system.iterate(steps);
const text = typeof system.axiom === "string"
  ? system.axiom
  : system.axiom.map(({ symbol, params }) => (params?.length ? `${symbol}(${params.join(", ")})` : symbol)).join("");
writeFileSync(1, text + "\n");
