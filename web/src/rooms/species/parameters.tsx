// Every declared parameter, by groups, with a search; above them the few that people want first.
import { useComputed, useSignal } from "@preact/signals";
import type { JSX } from "preact";
import type { Parameter } from "../../engine/protocol";
import { active, locked, opened, values } from "../../state/species";
import { Icon } from "../../ui/icons";
import { SlotRow, unitText } from "./slot-row";

/** `branches_v` reads "branches v": the names stay those of species files. */
const words = (name: string) => name.replaceAll("_", " ");

function slotLabel(parameter: Parameter, slot: string): string {
  if (parameter.slots.length === 1) return words(parameter.name);
  const inside = /\[(.*)\]$/.exec(slot)?.[1] ?? slot;
  if (!/^\d+$/.test(inside)) return inside;
  return inside === "0" ? "trunk" : `level ${inside}`;
}

function range(parameter: Parameter): string {
  if (parameter.choices) return `one of ${parameter.choices.length}`;
  const unit = unitText(parameter.unit);
  return `${parameter.min ?? "any"} to ${parameter.max ?? "any"}${unit ? ` ${unit}` : ""}`;
}

function ParameterBlock({ parameter }: { parameter: Parameter }): JSX.Element {
  return (
    <div class="parameter">
      <details class="doc">
        <summary>
          <span class="name">{words(parameter.name)}</span>
          <Icon name="info" />
          <span class="hidden">What {words(parameter.name)} means</span>
        </summary>
        <p>
          {parameter.doc}. <span class="allowed">Allowed: {range(parameter)}.</span>{" "}
          {parameter.source && <span class="allowed">{parameter.source}</span>}
        </p>
      </details>
      {parameter.slots.map((slot) => (
        <SlotRow
          key={slot.slot}
          parameter={parameter}
          slot={slot}
          label={slotLabel(parameter, slot.slot)}
          value={values.value[slot.index] ?? slot.default}
          active={active.value[slot.index] ?? true}
          locked={locked.value.has(slot.slot)}
        />
      ))}
    </div>
  );
}

const matches = (parameter: Parameter, query: string) =>
  `${parameter.name} ${words(parameter.name)} ${parameter.doc} ${parameter.group}`
    .toLowerCase()
    .includes(query);

/** The few numbers that people want first, in their words. Those without an effect are left out. */
function Handles(): JSX.Element | null {
  const rows = useComputed(() => {
    const of = (parameter: Parameter) =>
      parameter.slots.flatMap((slot) => (slot.handle ? [{ parameter, slot, handle: slot.handle }] : []));
    const all = (opened.value?.declared ?? []).flatMap(of);
    return all.sort((a, b) => a.handle.order - b.handle.order);
  });
  const shown = rows.value.filter(({ slot }) => active.value[slot.index] ?? true);
  if (shown.length === 0) return null;
  return (
    <section class="handles" aria-label="Main parameters">
      {shown.map(({ parameter, slot, handle }) => (
        <SlotRow
          key={slot.slot}
          parameter={parameter}
          slot={slot}
          label={handle.name}
          value={values.value[slot.index] ?? slot.default}
          active={true}
          locked={locked.value.has(slot.slot)}
          isHandle={true}
        />
      ))}
    </section>
  );
}

export function Parameters(): JSX.Element {
  const query = useSignal("");
  const open = useSignal<ReadonlySet<string>>(new Set());
  const groups = useComputed(() => {
    const wanted = query.value.trim().toLowerCase();
    const found = new Map<string, Parameter[]>();
    for (const parameter of opened.value?.declared ?? []) {
      if (wanted && !matches(parameter, wanted)) continue;
      const group = found.get(parameter.group);
      if (group) group.push(parameter);
      else found.set(parameter.group, [parameter]);
    }
    return [...found];
  });
  const searching = query.value.trim() !== "";
  return (
    <section class="parameters" aria-label="Parameters">
      <Handles />
      <div class="searchbox">
        <Icon name="search" />
        <input
          type="search"
          aria-label="Search the parameters"
          placeholder="Search the parameters"
          value={query.value}
          onInput={(event) => {
            query.value = event.currentTarget.value;
          }}
        />
      </div>
      {groups.value.map(([group, parameters], at) => {
        // The first group starts open, all the others closed; a search opens what it finds.
        const shown = searching || open.value.has(group) !== (at === 0);
        return (
          <section class="group" key={group}>
            <h3>
              <button
                type="button"
                aria-expanded={shown}
                onClick={() => {
                  const next = new Set(open.peek());
                  if (!next.delete(group)) next.add(group);
                  open.value = next;
                }}
              >
                <Icon name="chevron" />
                <span>{group}</span>
                <span class="count">{parameters.length}</span>
              </button>
            </h3>
            {shown &&
              parameters.map((parameter) => <ParameterBlock key={parameter.name} parameter={parameter} />)}
          </section>
        );
      })}
      {groups.value.length === 0 && (
        <p class="empty">{searching ? "No parameter matches." : "The parameters are being read."}</p>
      )}
    </section>
  );
}
