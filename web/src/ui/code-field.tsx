// A text of several lines with their numbers, with marks at places and words under the lines that they are about.
import { useSignal } from "@preact/signals";
import type { JSX, RefObject } from "preact";
import { memo } from "preact/compat";
import { useEffect } from "preact/hooks";
import type { Remark } from "../engine/protocol";

interface CodeFieldProps {
  label: string;
  text: string;
  marks: readonly Remark[];
  /** The id of an element that says what the marks say. */
  describedBy: string;
  field: RefObject<HTMLTextAreaElement | null>;
  onText: (text: string) => void;
}

/** What a mark says, as sentences. */
export function inWords({ message, help }: Remark): string {
  return help ? `${message}. ${help.charAt(0).toUpperCase()}${help.slice(1)}` : message;
}

const NO_MARKS: readonly Remark[] = [];

/** Marks by the line under which they are told. */
function byLine(marks: readonly Remark[], lines: number): Map<number, readonly Remark[]> {
  const found = new Map<number, readonly Remark[]>();
  for (const mark of marks) {
    // While one deletes lines, marks may be behind the end for a moment.
    const line = Math.min(mark.line, lines);
    found.set(line, [...(found.get(line) ?? NO_MARKS), mark]);
  }
  return found;
}

/** The line's characters in pieces, with those of the marks underlined. */
function pieces(text: string, marks: readonly Remark[]): JSX.Element[] {
  const chars = [...text];
  const ends = new Set([0, chars.length]);
  const spans = marks.map(({ line, column, end_line, end_column, warning }) => {
    const start = Math.min(column - 1, Math.max(0, chars.length - 1));
    const end = end_line > line ? chars.length : Math.min(chars.length, Math.max(end_column - 1, start + 1));
    ends.add(start);
    ends.add(end);
    return { start, end, warning };
  });
  const cuts = [...ends].sort((a, b) => a - b);
  return cuts.slice(0, -1).map((from, at) => {
    const over = spans.filter(({ start, end }) => start <= from && from < end);
    const kind = over.some(({ warning }) => !warning) ? "wrong" : over.length > 0 ? "odd" : "";
    return (
      <span key={from} class={kind}>
        {chars.slice(from, cuts[at + 1]).join("")}
      </span>
    );
  });
}

interface LineProps {
  text: string;
  marks: readonly Remark[];
  /** The cursor stands in text that the words would cover. */
  isAside: boolean;
}

/** Lies under a line of the field, wraps as that does, and shows what the field cannot. */
const Line = memo(function Line({ text, marks, isAside }: LineProps): JSX.Element {
  if (marks.length === 0) return <div class="codeline">{text || "\u200b"}</div>;
  const kind = marks.some((mark) => !mark.warning) ? "wrong" : "odd";
  return (
    <div class={`codeline ${kind}`}>
      {text === "" ? "\u200b" : pieces(text, marks)}
      {!isAside && (
        <div class="remark" style={{ "--at": Math.min(...marks.map((mark) => mark.column)) - 1 }}>
          {marks.map((mark) => (
            <p key={`${mark.column} ${mark.message}`}>{mark.message}</p>
          ))}
        </div>
      )}
    </div>
  );
});

/** The line, from 1, in which the cursor stands; 0 while the field has not the focus. */
function cursorLine(field: HTMLTextAreaElement | null): number {
  if (!field || document.activeElement !== field) return 0;
  return field.value.slice(0, field.selectionEnd).split("\n").length;
}

/** Puts the cursor where a mark is. */
export function goToMark(field: HTMLTextAreaElement, { line, column, end_line, end_column }: Remark): void {
  const lines = field.value.split("\n");
  const place = (to: number, at: number) => {
    const before = lines.slice(0, to - 1).reduce((sum, each) => sum + each.length + 1, 0);
    return before + [...(lines[to - 1] ?? "")].slice(0, at - 1).join("").length;
  };
  field.focus();
  field.setSelectionRange(place(line, column), place(end_line, end_column));
}

export function CodeField({ label, text, marks, describedBy, field, onText }: CodeFieldProps): JSX.Element {
  const cursor = useSignal(0);
  useEffect(() => {
    const look = () => {
      cursor.value = cursorLine(field.current);
    };
    document.addEventListener("selectionchange", look);
    return () => document.removeEventListener("selectionchange", look);
  }, [cursor, field]);
  const lines = text.split("\n");
  const told = byLine(marks, lines.length);
  return (
    <div class="codefield" style={{ "--digits": String(lines.length).length }}>
      <div class="codelines" aria-hidden="true">
        {lines.map((line, at) => (
          <Line
            key={at}
            text={line}
            marks={told.get(at + 1) ?? NO_MARKS}
            isAside={told.has(at + 1) && cursor.value === at + 2 && lines[at + 1] !== ""}
          />
        ))}
      </div>
      <textarea
        ref={field}
        aria-label={label}
        aria-describedby={describedBy}
        aria-invalid={marks.some((mark) => !mark.warning)}
        value={text}
        spellcheck={false}
        autocapitalize="off"
        autocomplete="off"
        onInput={(event) => {
          cursor.value = cursorLine(event.currentTarget);
          onText(event.currentTarget.value);
        }}
        onBlur={() => {
          cursor.value = 0;
        }}
      />
    </div>
  );
}
