// Files from outside: a picture becomes the goal, a species file or a link opens.
import { goalError, takePicture } from "./rooms/fit/goal-state";
import { say } from "./state/notes";
import { go } from "./state/route";
import { start } from "./state/species";
import { baseName } from "./ui/files";

const MAX_SPECIES_FILE = 4_000_000;

async function takeSpecies(text: string, name: string): Promise<void> {
  await start({ toml: text, name });
  // What was wrong with another file is not about this one.
  goalError.value = null;
  go("species");
  say(`${name} is open.`);
}

export async function takeFile(file: File): Promise<void> {
  if (/\.toml$/i.test(file.name)) {
    if (file.size > MAX_SPECIES_FILE)
      throw new Error(`${file.name} has ${file.size} bytes: a species file is smaller.`);
    await takeSpecies(await file.text(), baseName(file.name));
    return;
  }
  go("fit");
  await takePicture(file);
}

/** Pasted text: a species file, or a link of this page. */
export async function takeText(text: string): Promise<void> {
  const hash = /^https?:\/\/\S*(#(?:fit|map|species|gallery)\?\S+)$/.exec(text.trim())?.[1];
  if (hash) {
    location.hash = hash;
    return;
  }
  if (/^\s*(#|[a-z_]+\s*=|\[)/m.test(text) && text.includes("=") && text.length < MAX_SPECIES_FILE) {
    await takeSpecies(text, "pasted");
  }
}
