// In which numbers two species of one family differ most.
import type { OpenedSpecies, Parameter, Slot } from "../../engine/protocol";
import { openSource } from "../../state/species";
import { choiceName, unitText } from "../species/slot-row";
import type { StoredFit } from "./stored-fit";

export interface Difference {
  slot: string;
  /** In words or digits, with the unit. */
  values: [string, string];
  /** In parts of what is plausible. */
  size: number;
}

export interface Differences {
  /** The families, where they are not the same: their numbers mean different things. */
  families: [string, string] | null;
  list: Difference[];
}

/** What is not seen in a tree. */
const LEAST = 0.01;

function size(slot: Slot, one: number, other: number, choice: boolean): number {
  if (one === other) return 0;
  if (choice) return 1;
  const [low, high] = slot.plausible;
  if (slot.scale === "log" && Math.min(one, other, low) > 0 && high > low) {
    return Math.abs(Math.log(one / other)) / Math.log(high / low);
  }
  return high > low ? Math.abs(one - other) / (high - low) : 1;
}

function told(parameter: Parameter, value: number): string {
  const choice = choiceName(parameter, value);
  if (choice !== null) return choice;
  return `${Number(value.toPrecision(3))} ${unitText(parameter.unit)}`.trim();
}

function between(one: OpenedSpecies, other: OpenedSpecies): Difference[] {
  const theirs = new Map(other.declared.flatMap(({ slots }) => slots.map((slot) => [slot.slot, slot.index])));
  const all = one.declared.flatMap((parameter) =>
    parameter.slots.flatMap((slot): Difference[] => {
      const index = theirs.get(slot.slot);
      const [a, b] = [one.values[slot.index], other.values[index ?? -1]];
      if (index === undefined || a === undefined || b === undefined) return [];
      // A number without an effect in either tree makes no difference.
      if (!one.active[slot.index] && !other.active[index]) return [];
      const values: [string, string] = [told(parameter, a), told(parameter, b)];
      return [{ slot: slot.slot, values, size: size(slot, a, b, parameter.choices !== null) }];
    }),
  );
  return all.filter(({ size }) => size > LEAST).sort((a, b) => b.size - a.size);
}

export async function differences(one: StoredFit, other: StoredFit): Promise<Differences> {
  const open = ({ result }: StoredFit) => openSource({ toml: result.toml, name: result.report.species });
  const [first, second] = [await open(one), await open(other)];
  const families: [string, string] = [first.info.generator, second.info.generator];
  if (families[0] !== families[1]) return { families, list: [] };
  return { families: null, list: between(first, second) };
}
