// Where a goal comes from: a file, the clipboard, or one of the pictures that the page brings.
import { useSignal } from "@preact/signals";
import type { JSX } from "preact";
import { useEffect } from "preact/hooks";
import { worksOffline } from "../../offline/offline";
import { sayError } from "../../state/notes";
import { Button } from "../../ui/controls";
import { baseName, pickFile } from "../../ui/files";
import { picture, takePicture, takeTarget, targets } from "./goal-state";

export const words = (file: string) => baseName(file).replaceAll("_", " ");

async function choose(): Promise<void> {
  const file = await pickFile("image/png,image/jpeg,image/webp,image/tiff,image/gif,image/bmp,image/svg+xml");
  if (file) await takePicture(file);
}

export function ChooseButton({ primary }: { primary: boolean }): JSX.Element {
  return (
    <Button
      icon="upload"
      label="Choose a picture"
      kind={primary ? "primary" : "plain"}
      onPress={() => void choose().catch(sayError)}
    />
  );
}

function useTargets(): readonly string[] {
  const list = useSignal<readonly string[]>([]);
  useEffect(() => {
    void targets().then((all) => {
      list.value = all;
    });
  }, [list]);
  return list.value;
}

/** The first thing that a newcomer sees. */
export function Welcome(): JSX.Element {
  const list = useTargets();
  return (
    <div class="welcome">
      <h2>Grow the tree in a picture</h2>
      <p class="lead">
        Drop a silhouette or a photograph of a tree. The page finds a species that grows such trees, from any
        seed. Nothing leaves your computer.
        {worksOffline.value && <span data-testid="works-offline"> The page works offline now.</span>}
      </p>
      <div class="row">
        <ChooseButton primary />
        <span class="hint">or drop or paste one anywhere</span>
      </div>
      <h3>Or begin with one of these</h3>
      <ul class="targets">
        {list.map((file) => (
          <li key={file}>
            <button type="button" onClick={() => void takeTarget(file).catch(sayError)}>
              <img src={`./targets/${file}`} alt="" loading="lazy" width={96} height={96} />
              <span>{words(file)}</span>
            </button>
          </li>
        ))}
      </ul>
    </div>
  );
}

export function TargetSelect({ disabled }: { disabled: boolean }): JSX.Element {
  const list = useTargets();
  return (
    <select
      aria-label="Goals of the page"
      disabled={disabled}
      value={picture.value?.target ?? ""}
      onChange={(event) => {
        const file = event.currentTarget.value;
        if (file) void takeTarget(file).catch(sayError);
      }}
    >
      <option value="">{picture.value?.target ? "Goals of the page" : "Goals of the page …"}</option>
      {list.map((file) => (
        <option key={file} value={file}>
          {words(file)}
        </option>
      ))}
    </select>
  );
}
