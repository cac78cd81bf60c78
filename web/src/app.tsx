// The frame of the page: rooms, link, theme, notes, files that are dropped or pasted anywhere.
import { Component, type ComponentChildren, type JSX } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { takeFile, takeText } from "./incoming";
import { FitRoom } from "./rooms/fit/fit-room";
import { picture } from "./rooms/fit/goal-state";
import { GalleryRoom } from "./rooms/gallery/gallery-room";
import { MapRoom } from "./rooms/map/map-room";
import { SpeciesRoom } from "./rooms/species/species-room";
import { type Action, announced, dismiss, notes, sayError } from "./state/notes";
import { go, link, type Room, room } from "./state/route";
import { theme, toggleTheme } from "./state/theme";
import { copyText } from "./ui/clipboard";
import { Button } from "./ui/controls";
import { Icon, Mark } from "./ui/icons";

const NAMES: Record<Room, string> = { fit: "Fit", map: "Map", species: "Species", gallery: "Gallery" };

async function copyLink(): Promise<void> {
  const address = new URL(await link(), location.href).href;
  history.replaceState(history.state, "", address);
  const otherwise = "The browser does not allow copying. The link is in the address bar.";
  await copyText(address, `The link is copied. ${linked()}`, otherwise);
}

/** What a link has, in words. */
function linked(): string {
  if (room.peek() === "fit" && picture.peek()?.target === null) {
    return "It has the species of the species room and the places on the map, but not your picture.";
  }
  return "It has the goal, the places on the map, and the species of the species room.";
}

function Rooms(): JSX.Element {
  return (
    <nav class="rooms" aria-label="Rooms">
      {(Object.keys(NAMES) as Room[]).map((name) => (
        <a
          key={name}
          href={`#${name}`}
          aria-current={room.value === name ? "page" : undefined}
          onClick={(event) => {
            event.preventDefault();
            go(name);
          }}
        >
          <Icon name={name} />
          <span>{NAMES[name]}</span>
        </a>
      ))}
    </nav>
  );
}

function NoteButton({ id, action }: { id: number; action: Action }): JSX.Element {
  const press = () => {
    dismiss(id);
    action.run();
  };
  return <Button label={action.label} onPress={press} />;
}

function Notes(): JSX.Element {
  return (
    <div class="notes">
      {notes.value.map((note) => (
        <div key={note.id} class={`note ${note.kind}`} role={note.kind === "error" ? "alert" : "status"}>
          <p>{note.text}</p>
          {note.action && <NoteButton id={note.id} action={note.action} />}
          <Button
            icon="close"
            iconOnly
            kind="quiet"
            label="Close this note"
            onPress={() => dismiss(note.id)}
          />
        </div>
      ))}
    </div>
  );
}

/** A mistake in one room must not take the page down. */
class Guard extends Component<{ children: ComponentChildren }, { message: string | null }> {
  override state = { message: null };

  static override getDerivedStateFromError(error: unknown): { message: string } {
    return { message: error instanceof Error ? error.message : String(error) };
  }

  render(): ComponentChildren {
    const { message } = this.state;
    if (message === null) return this.props.children;
    return (
      <div class="broken" role="alert">
        <p>This room stopped: {message}</p>
        <Button label="Open it again" kind="primary" onPress={() => this.setState({ message: null })} />
      </div>
    );
  }
}

function Current(): JSX.Element {
  switch (room.value) {
    case "fit":
      return <FitRoom />;
    case "map":
      return <MapRoom />;
    case "species":
      return <SpeciesRoom />;
    case "gallery":
      return <GalleryRoom />;
  }
}

/** Drops and pastes count wherever they fall. */
function useIncoming(frame: { current: HTMLElement | null }): void {
  useEffect(() => {
    const over = (event: DragEvent) => {
      if (!event.dataTransfer?.types.includes("Files")) return;
      event.preventDefault();
      frame.current?.classList.add("dropping");
    };
    const leave = (event: DragEvent) => {
      if (event.relatedTarget === null) frame.current?.classList.remove("dropping");
    };
    const drop = (event: DragEvent) => {
      event.preventDefault();
      frame.current?.classList.remove("dropping");
      const file = event.dataTransfer?.files[0];
      if (file) takeFile(file).catch(sayError);
    };
    const paste = (event: ClipboardEvent) => {
      if (event.target instanceof HTMLInputElement || event.target instanceof HTMLTextAreaElement) return;
      const file = event.clipboardData?.files[0];
      const text = event.clipboardData?.getData("text/plain") ?? "";
      if (file) takeFile(file).catch(sayError);
      else if (text) takeText(text).catch(sayError);
    };
    addEventListener("dragover", over);
    addEventListener("dragleave", leave);
    addEventListener("drop", drop);
    addEventListener("paste", paste);
    return () => {
      removeEventListener("dragover", over);
      removeEventListener("dragleave", leave);
      removeEventListener("drop", drop);
      removeEventListener("paste", paste);
    };
  }, [frame]);
}

export function App(): JSX.Element {
  const frame = useRef<HTMLDivElement>(null);
  useIncoming(frame);
  useEffect(() => {
    document.title = `${NAMES[room.value]} · pleach studio`;
  }, [room.value]);
  const dark = theme() === "dark";
  return (
    <div class="frame" ref={frame}>
      <button type="button" class="skip" onClick={skip}>
        Skip to the room
      </button>
      <header class="top">
        <p class="brand">
          <Mark />
          <span>pleach</span> <span class="sub">studio</span>
        </p>
        <Rooms />
        <div class="actions">
          <Button
            icon="link"
            label="Copy link"
            kind="quiet"
            onPress={() => void copyLink()}
            testid="copy-link"
          />
          <Button
            icon={dark ? "sun" : "moon"}
            iconOnly
            kind="quiet"
            label={dark ? "Light page" : "Dark page"}
            onPress={toggleTheme}
          />
        </div>
      </header>
      <main id="room" class={`room ${room.value}`} tabIndex={-1}>
        <h1 class="hidden">{NAMES[room.value]}</h1>
        <Guard key={room.value}>
          <Current />
        </Guard>
      </main>
      <Notes />
      <p class="hidden" role="status" aria-live="polite">
        {announced.value}
      </p>
      <p class="drophint" aria-hidden="true">
        Drop a picture to fit it, or a species file to open it
      </p>
    </div>
  );
}

/** A button and no link: the hash is the page's state. */
function skip(): void {
  document.getElementById("room")?.focus();
}
