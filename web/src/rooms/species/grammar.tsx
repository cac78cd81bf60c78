// The grammar of a species as text, with what is wrong with it, examples, and the notation in short.
import type { JSX } from "preact";
import { useEffect, useId, useRef } from "preact/hooks";
import { families } from "../../engine/catalogue";
import type { Remark } from "../../engine/protocol";
import { startOrSay } from "../../state/species";
import { CodeField, goToMark, inWords } from "../../ui/code-field";
import { Field } from "../../ui/controls";
import { Icon } from "../../ui/icons";
import { grammar, isBehind, remarks, type, watchGrammar } from "./grammar-state";

const EXAMPLES = families.find(({ family }) => family === "lsystem")?.species ?? [];

function Examples(): JSX.Element {
  return (
    <Field label="Examples">
      {(id) => (
        <select
          id={id}
          value=""
          onChange={(event) => {
            void startOrSay({ builtin: event.currentTarget.value });
            event.currentTarget.value = "";
          }}
        >
          <option value="">Open one of {EXAMPLES.length} grammars</option>
          {EXAMPLES.map(({ name, description }) => (
            <option key={name} value={name}>
              {description || name}
            </option>
          ))}
        </select>
      )}
    </Field>
  );
}

/** What each mark says, as a list that screen readers hear; each entry goes to its place. */
function Remarks({ id, onPick }: { id: string; onPick: (mark: Remark) => void }): JSX.Element {
  return (
    <div id={id} class="remarks" role="status">
      {remarks.value.length > 0 && (
        <ul>
          {remarks.value.map((remark) => (
            <li key={`${remark.line}:${remark.column} ${remark.message}`}>
              <button type="button" class={remark.warning ? "odd" : "wrong"} onClick={() => onPick(remark)}>
                <Icon name="info" />
                <span>
                  <strong>Line {remark.line}</strong> {inWords(remark)}
                </span>
              </button>
            </li>
          ))}
        </ul>
      )}
      {isBehind.value && <p class="hint">The tree is that of the text before the mistake.</p>}
    </div>
  );
}

/** What stands for what. `docs/grammars.md` has all of it. */
const NOTATION: readonly (readonly [code: string, meaning: string])[] = [
  ["axiom: X", "the string before the first step"],
  ["X -> F[+X]X", "each X becomes what follows the arrow, in every step"],
  ["steps: 5", "how many steps"],
  ["angle: 25", "degrees of turns without a number"],
  ["F  F(2)", "forward, drawing; 2 long"],
  ["+ -  & ^  / \\", "turn left, right; pitch down, up; roll right, left"],
  ["[ ]", "a branch"],
  ["!(0.1)", "width"],
  ["A(l) : l > 1 -> …", "a rule with a number and a condition"],
  ["-0.3-> … -0.7-> …", "by chance, with these probabilities"],
  ["rand(1, 2)", "a random number"],
  ['param n = 3 in 1..9 "…"', "a number with a slider under Parameters"],
  ["# …", "a comment"],
];

function Notation(): JSX.Element {
  return (
    <details class="notation">
      <summary>Notation</summary>
      <dl>
        {NOTATION.map(([code, meaning]) => (
          <div key={code}>
            <dt>
              <code>{code}</code>
            </dt>
            <dd>{meaning}</dd>
          </div>
        ))}
      </dl>
      <p class="hint">A line that begins with a space belongs to the one above.</p>
    </details>
  );
}

export function Grammar(): JSX.Element {
  const field = useRef<HTMLTextAreaElement>(null);
  const id = useId();
  useEffect(watchGrammar, []);
  const text = grammar.value;
  return (
    <section class="grammar" aria-label="Grammar">
      <Examples />
      {text === null ? (
        <p class="empty">The grammar is being read.</p>
      ) : (
        <CodeField
          label="Text of the grammar"
          text={text}
          marks={remarks.value}
          describedBy={id}
          field={field}
          onText={type}
        />
      )}
      <Remarks
        id={id}
        onPick={(mark) => {
          if (field.current) goToMark(field.current, mark);
        }}
      />
      <Notation />
    </section>
  );
}
