// The canvas of the species room, its name, its keys and what stands on it.
import { useSignal, useSignalEffect } from "@preact/signals";
import type { JSX } from "preact";
import { useEffect, useRef } from "preact/hooks";
import type { TreeStats } from "../../engine/protocol";
import { sayError } from "../../state/notes";
import { recipes, spec, speciesName } from "../../state/species";
import { reducedMotion, theme } from "../../state/theme";
import { Alert, Button, Segmented } from "../../ui/controls";
import { Thumb } from "../../ui/thumb";
import { KEYS_IN_WORDS, setView, turnByKey } from "../../view3d/handle";
import type { TreeView } from "../../view3d/tree-view";
import { exportView } from "./exports";
import {
  busy,
  cards,
  coarser,
  counts,
  failure,
  LEAVES,
  type Leaves,
  leaves,
  level,
  mesh,
} from "./tree-state";
import { tookToDraw, viewIsOpen } from "./view-budget";

/** The picture where nothing is drawn in three dimensions: pixels per side, and milliseconds without a change before it. */
const FLAT = { size: 640, wait: 300 };

const number = new Intl.NumberFormat("en");

export function describe(stats: TreeStats, name: string, seed: number, season: string): string {
  const when = season ? ` in ${season}` : "";
  return `${name.replaceAll("_", " ")}${when}, seed ${seed}: ${stats.height.toFixed(1)} m high, ${stats.width.toFixed(1)} m wide, ${number.format(stats.stems)} stems, ${number.format(stats.leaves)} leaves`;
}

export function Stage(): JSX.Element {
  const canvas = useRef<HTMLCanvasElement>(null);
  const view = useRef<TreeView | null>(null);
  const ready = useSignal(false);
  const lost = useSignal(false);
  const broken = useSignal<string | null>(null);
  const wind = useSignal(false);

  useEffect(() => {
    let gone = false;
    import("../../view3d/tree-view")
      .then((module) => {
        if (gone || !canvas.current) return;
        const setLost = (isLost: boolean) => {
          lost.value = isLost;
        };
        view.current = new module.TreeView(canvas.current, setLost, tookToDraw);
        viewIsOpen(true);
        setView(view.current);
        ready.value = true;
      })
      .catch((error: unknown) => {
        broken.value = `The view in three dimensions could not start: ${error instanceof Error ? error.message : error}`;
      });
    return () => {
      gone = true;
      view.current = null;
      viewIsOpen(false);
      setView(null);
    };
  }, [ready, lost, broken]);

  useSignalEffect(() => {
    if (ready.value && mesh.value && cards.value) view.current?.setMesh(mesh.value.data, cards.value);
  });
  useSignalEffect(() => {
    if (ready.value) view.current?.setTheme(theme() === "dark");
  });
  useSignalEffect(() => {
    if (ready.value) view.current?.setWind(wind.value && !reducedMotion.value);
  });

  const shown = mesh.value;
  const { seed, season } = recipes.value;
  const text = shown ? describe(shown.data.stats, speciesName.value, seed, season) : "The tree is growing";
  return (
    <section class="stage" aria-label="The tree">
      {/* biome-ignore lint/a11y/useSemanticElements: no element means "a view that arrow keys turn". */}
      <div
        class="view"
        role="group"
        aria-label={`View of the tree. ${KEYS_IN_WORDS}`}
        // biome-ignore lint/a11y/noNoninteractiveTabindex: the keys below turn the tree.
        tabIndex={0}
        onKeyDown={turnByKey}
      >
        {broken.value === null ? (
          <canvas ref={canvas} role="img" aria-label={text} data-testid="tree" />
        ) : (
          <div class="flat">
            <Thumb spec={spec.value} seed={seed} season={season} name={text} {...FLAT} />
          </div>
        )}
      </div>
      <div class={`busy${busy.value ? " on" : ""}`} aria-hidden="true" />
      {failure.value && <Alert text={failure.value} />}
      {broken.value && <Alert text={broken.value} />}
      {lost.value && (
        <Alert text="The graphics card lost the view. It comes back by itself; the species is kept." />
      )}
      <div class="stagebar">
        <Segmented
          label="Level of detail"
          value={String(level.value)}
          options={["0", "1", "2", "3"].map((value) => ({
            value,
            label: value === "0" ? "Finest" : `LOD ${value}`,
          }))}
          onPick={(value) => {
            level.value = Number(value);
          }}
        />
        <label class="inline">
          <span>Leaves</span>
          <select
            value={leaves.value}
            onChange={(event) => {
              leaves.value = event.currentTarget.value as Leaves;
            }}
          >
            {LEAVES.map((kind) => (
              <option key={kind} value={kind}>
                {kind}
              </option>
            ))}
          </select>
        </label>
        <Button
          icon="wind"
          label="Wind"
          pressed={wind.value}
          disabled={reducedMotion.value}
          {...(reducedMotion.value ? { title: "Your system asks for little motion." } : {})}
          onPress={() => {
            wind.value = !wind.value;
          }}
        />
        <Button
          icon="download"
          label="PNG"
          title="Download this view as a picture"
          onPress={() => {
            void exportView().catch(sayError);
          }}
        />
      </div>
      <Numbers text={text} />
    </section>
  );
}

function Numbers({ text }: { text: string }): JSX.Element {
  const shown = mesh.value;
  if (!shown) return <p class="numbers">{text}</p>;
  const { bark, leaves: leafy, vertices } = counts(shown.data);
  const { height, width, stems } = shown.data.stats;
  const less = coarser(shown);
  return (
    <div class="numbers">
      {less && (
        <p class="less" role="status" data-testid="coarser">
          {less}
        </p>
      )}
      <dl data-testid="counts">
        <div>
          <dt>Height</dt>
          <dd>{height.toFixed(1)} m</dd>
        </div>
        <div>
          <dt>Width</dt>
          <dd>{width.toFixed(1)} m</dd>
        </div>
        <div>
          <dt>Stems</dt>
          <dd>{number.format(stems)}</dd>
        </div>
        <div>
          <dt>Bark triangles</dt>
          <dd>{number.format(bark)}</dd>
        </div>
        <div>
          <dt>Leaf triangles</dt>
          <dd>{number.format(leafy)}</dd>
        </div>
        <div>
          <dt>Vertices</dt>
          <dd>{number.format(vertices)}</dd>
        </div>
      </dl>
    </div>
  );
}
