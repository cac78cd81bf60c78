// Saves the view that is open as it turns once: a video, or pictures in a zip where the browser records no video.
import { useSignal } from "@preact/signals";
import type { JSX } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { zipClient } from "../../engine/clients";
import { announce, say, sayError } from "../../state/notes";
import { Bar, Button } from "../../ui/controls";
import { megabytes } from "../../ui/cost";
import { download, fileName } from "../../ui/files";
import { view } from "../../view3d/handle";
import { pictures, type Turn, video, videoType } from "../../view3d/turntable";

async function record(name: string, progress: Turn["progress"], signal: AbortSignal): Promise<void> {
  const open = view();
  if (!open) throw new Error("The view is not ready yet.");
  const turn = { view: open, progress, signal };
  const type = videoType();
  const made = type ? await video(turn, type) : await zipClient.call("pack", await pictures(turn));
  const ending = type ? (/mp4/.test(type) ? "mp4" : "webm") : "zip";
  const file = fileName(`${name}-turntable`, ending);
  download(file, made);
  say(`${file} is written: ${megabytes(made.size)}.`);
}

export function Turntable({ name }: { name: string }): JSX.Element {
  const share = useSignal<number | null>(null);
  const stop = useRef<AbortController | null>(null);
  useEffect(() => () => stop.current?.abort(), []);
  const begin = async () => {
    const own = new AbortController();
    stop.current = own;
    share.value = 0;
    announce("Recording the turntable");
    try {
      await record(name, (done) => (share.value = done), own.signal);
    } catch (error) {
      if (!own.signal.aborted) sayError(error);
    } finally {
      share.value = null;
    }
  };
  if (share.value !== null) {
    return (
      <span class="turning">
        <Bar label="Progress of the turntable" share={share.value} />
        <Button icon="stop" label="Cancel" testid="turntable-cancel" onPress={() => stop.current?.abort()} />
      </span>
    );
  }
  return (
    <Button
      icon="download"
      label="Turntable"
      title={
        videoType()
          ? "A video of the view as it turns once around the tree"
          : "Pictures of the view as it turns once around the tree, in a zip"
      }
      testid="turntable"
      onPress={() => void begin()}
    />
  );
}
