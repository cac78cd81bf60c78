// Shape a species by hand.
import { useSignal } from "@preact/signals";
import type { JSX } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { keepSpecies } from "../../state/library";
import { sayError } from "../../state/notes";
import { restored } from "../../state/route";
import {
  change,
  opened,
  recipes,
  refusal,
  resetAll,
  speciesName,
  throwDice,
  toToml,
  wanted,
} from "../../state/species";
import { Alert, Button, Check, Field, Segmented } from "../../ui/controls";
import { useUndoKeys } from "../../ui/keys";
import { BUDGETS, type Budget, exportMesh, exportToml, exportView, FORMATS } from "./exports";
import { Grammar } from "./grammar";
import { Parameters } from "./parameters";
import { Picker } from "./picker";
import { Seeds } from "./seeds";
import { Stage } from "./stage";

type Tab = "parameters" | "grammar" | "seeds" | "files";
const TABS: readonly { value: Tab; label: string }[] = [
  { value: "parameters", label: "Parameters" },
  { value: "grammar", label: "Grammar" },
  { value: "seeds", label: "Seeds" },
  { value: "files", label: "Download" },
];

const STRENGTHS = [
  { value: "0.1", label: "A little" },
  { value: "0.3", label: "Some" },
  { value: "0.7", label: "Much" },
] as const;

function Toolbar(): JSX.Element {
  const strength = useSignal<(typeof STRENGTHS)[number]["value"]>("0.3");
  return (
    <div class="toolbar" role="toolbar" aria-label="Changes">
      <Button
        icon="undo"
        iconOnly
        label="Undo (Ctrl+Z)"
        disabled={!recipes.canUndo.value}
        onPress={() => recipes.undo()}
        testid="undo"
      />
      <Button
        icon="redo"
        iconOnly
        label="Redo (Ctrl+Shift+Z)"
        disabled={!recipes.canRedo.value}
        onPress={() => recipes.redo()}
        testid="redo"
      />
      <Button
        icon="reset"
        iconOnly
        label="Reset all"
        disabled={recipes.value.values === null}
        onPress={resetAll}
      />
      <span class="joined">
        <Button
          icon="dice"
          label="Dice"
          title="Change what is not locked, within what is natural"
          onPress={() => void throwDice(Number(strength.value)).catch(sayError)}
          testid="dice"
        />
        <select
          aria-label="How far the dice go"
          value={strength.value}
          onChange={(event) => {
            const picked = STRENGTHS.find((each) => each.value === event.currentTarget.value);
            if (picked) strength.value = picked.value;
          }}
        >
          {STRENGTHS.map(({ value, label }) => (
            <option key={value} value={value}>
              {label}
            </option>
          ))}
        </select>
      </span>
    </div>
  );
}

function Files(): JSX.Element {
  const budget = useSignal<Budget>(BUDGETS[0]);
  const wind = useSignal(true);
  return (
    <section class="files" aria-label="Download">
      <div class="keeprow">
        <Button
          icon="keep"
          label="Keep in my species"
          kind="primary"
          onPress={() =>
            void toToml()
              .then((text) => keepSpecies(speciesName.peek(), text))
              .catch(sayError)
          }
        />
        <Button
          icon="download"
          label="TOML, the species file"
          onPress={() => void exportToml().catch(sayError)}
          testid="toml"
        />
      </div>
      <ul class="formats">
        {FORMATS.map(({ format, label, what }) => (
          <li key={format}>
            <Button
              icon="download"
              label={label}
              testid={`export-${format}`}
              onPress={() => void exportMesh(format, budget.value, wind.value).catch(sayError)}
            />
            <span>{what}</span>
          </li>
        ))}
        <li>
          <Button icon="download" label="PNG" onPress={() => void exportView().catch(sayError)} />
          <span>this view, without a background</span>
        </li>
      </ul>
      <Field label="Detail of GLB, OBJ and USDA">
        {(id) => (
          <select
            id={id}
            data-testid="budget"
            value={budget.value.id}
            onChange={(event) => {
              const { value } = event.currentTarget;
              budget.value = BUDGETS.find((one) => one.id === value) ?? BUDGETS[0];
            }}
          >
            {BUDGETS.map((one) => (
              <option key={one.id} value={one.id}>
                {one.label}
              </option>
            ))}
          </select>
        )}
      </Field>
      <Check
        label="With weights for wind"
        checked={wind.value}
        onChange={(on) => {
          wind.value = on;
        }}
      />
      <p class="hint">
        Files are in metres with +Y up. They hold the tree of the seed and season that you see; PLY and STL
        its level of detail too.
      </p>
    </section>
  );
}

export function SpeciesRoom(): JSX.Element {
  const tab = useSignal<Tab>("parameters");
  // Between two species nothing is open, and the tabs stay as they were.
  const hasGrammar = useRef(false);
  if (opened.value) hasGrammar.current = opened.value.grammar !== null;
  const tabs = TABS.filter(({ value }) => value !== "grammar" || hasGrammar.current);
  const shown = tabs.some(({ value }) => value === tab.value) ? tab.value : "parameters";
  useUndoKeys(recipes);
  useEffect(() => {
    if (restored.value) wanted.value = true;
  }, [restored.value]);
  const info = opened.value?.info;
  const seasons = ["", ...new Set([...(info?.seasons ?? []), "winter"])];
  return (
    <>
      <div class="canvas">
        <Stage />
      </div>
      <aside class="panel" aria-label="Species">
        <header class="panelhead">
          <h2>{(info?.name ?? speciesName.value).replaceAll("_", " ")}</h2>
          <p class="about">
            {info
              ? `${info.description || "A species of its own"} · ${info.generator}`
              : "The species is being read."}
          </p>
          <div class="pair">
            <Picker />
            <Field label="Season">
              {(id) => (
                <select
                  id={id}
                  value={recipes.value.season}
                  onChange={(event) => change({ season: event.currentTarget.value })}
                >
                  {seasons.map((season) => (
                    <option key={season} value={season}>
                      {season || "its own"}
                    </option>
                  ))}
                </select>
              )}
            </Field>
          </div>
          <Toolbar />
          {refusal.value && <Alert text={refusal.value} />}
          <Segmented
            label="Part of the panel"
            value={shown}
            options={tabs}
            onPick={(picked) => {
              tab.value = picked;
            }}
          />
        </header>
        <div class="panelbody">
          {shown === "parameters" && <Parameters />}
          {shown === "grammar" && <Grammar />}
          {shown === "seeds" && <Seeds />}
          {shown === "files" && <Files />}
        </div>
      </aside>
    </>
  );
}
