// Eight other trees of the kind that was found: a click shows one of them in the place of the tree that was found.
import { useSignal, useSignalEffect } from "@preact/signals";
import type { JSX } from "preact";
import { speciesClient } from "../../engine/clients";
import type { FitResult } from "../../engine/protocol";
import { sayError } from "../../state/notes";
import { openSource } from "../../state/species";
import { Thumb } from "../../ui/thumb";
import { MANY, otherSeeds } from "../species/zip-state";
import { season } from "./model-state";
import { other, pick, result } from "./record";

const kindOf = (found: FitResult | null) => found && { toml: found.toml, name: found.report.species };

export function Others(): JSX.Element | null {
  const own = useSignal(1);
  useSignalEffect(() => {
    const kind = kindOf(result.value);
    if (!kind) return;
    openSource(kind)
      .then(({ info }) => {
        own.value = info.tree_seed ?? 1;
      })
      .catch(sayError);
  });
  const source = kindOf(result.value);
  if (!source) return null;
  const { toml } = source;
  const spec = { source, values: null };
  const show = async (seed: number) => {
    const its = await speciesClient.call("toml", { spec, name: null, treeSeed: seed });
    // A new fit may have ended meanwhile.
    if (result.peek()?.toml !== toml) return;
    pick({ seed, toml: its, kind: toml });
    document.getElementById("room")?.scrollTo({ top: 0, behavior: "smooth" });
  };
  return (
    <section class="outcome" aria-label="Other trees of the kind">
      <h3>Eight other trees of the kind</h3>
      <p class="hint">Choose one to see it from all sides and to save it.</p>
      <ul class="strip eight">
        {otherSeeds(own.value, MANY).map((seed) => (
          <li key={seed}>
            <button
              type="button"
              aria-pressed={other.value?.seed === seed}
              onClick={() => void show(seed).catch(sayError)}
            >
              <Thumb spec={spec} seed={seed} season={season.value} size={144} name={`Seed ${seed}`} />
              <span>Seed {seed}</span>
            </button>
          </li>
        ))}
      </ul>
    </section>
  );
}
