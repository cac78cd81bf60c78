// Downloads of the species room: the species file, meshes, pictures, eight trees at once.
import { useSignal } from "@preact/signals";
import type { JSX } from "preact";
import type { MeshFormat } from "../../engine/protocol";
import { keepSpecies } from "../../state/library";
import { sayError } from "../../state/notes";
import { recipes, spec, speciesName, toToml } from "../../state/species";
import { Button, Check } from "../../ui/controls";
import { baseName, fileName } from "../../ui/files";
import {
  type Asked,
  BUDGETS,
  exportMesh,
  exportToml,
  exportView,
  FORMATS,
  optionsNow,
  TEXTURES,
} from "./exports";
import { DetailChoice, FormatChoice, ShadersChoice, TexturesChoice } from "./file-choices";
import { Turntable } from "./turntable";
import { ZipDetails, ZipPart } from "./zip-part";
import { MANY, otherSeeds, type ZipJob } from "./zip-state";

function jobOf(format: MeshFormat, asked: Asked): ZipJob {
  const { seed } = recipes.value;
  const name = baseName(fileName(speciesName.value, "zip"));
  const trees = [seed, ...otherSeeds(seed, MANY - 1)].map((each) => ({
    spec: spec.value,
    seed: each,
    stem: `${name}-${each}`,
  }));
  return { name, trees, format, options: optionsNow(format, asked) };
}

function EightTrees({ asked }: { asked: Asked }): JSX.Element {
  const format = useSignal<MeshFormat>("glb");
  return (
    <ZipDetails>
      {() => (
        <>
          <FormatChoice
            value={format.value}
            onPick={(picked) => {
              format.value = picked;
            }}
          />
          <ZipPart
            job={jobOf(format.value, asked)}
            what="The tree that you see and seven of other seeds, with the detail, pictures and numbers from above."
          />
        </>
      )}
    </ZipDetails>
  );
}

export function Files(): JSX.Element {
  const asked = useSignal<Asked>({
    budget: BUDGETS[0],
    textures: TEXTURES[0],
    shaders: "wind",
    collision: false,
  });
  const ask = (part: Partial<Asked>) => {
    asked.value = { ...asked.peek(), ...part };
  };
  const { budget, textures, shaders, collision } = asked.value;
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
              onPress={() => void exportMesh(format, asked.value).catch(sayError)}
            />
            <span>{what}</span>
          </li>
        ))}
        <li>
          <Button icon="download" label="PNG" onPress={() => void exportView().catch(sayError)} />
          <span>this view, without a background</span>
        </li>
        <li>
          <Turntable name={`${speciesName.value}-${recipes.value.seed}`} />
          <span>this view as it turns once</span>
        </li>
      </ul>
      <DetailChoice
        label="Detail of GLB, OBJ and USDA"
        value={budget}
        onPick={(next) => ask({ budget: next })}
      />
      <TexturesChoice value={textures} onPick={(next) => ask({ textures: next })} />
      <ShadersChoice value={shaders} onPick={(next) => ask({ shaders: next })} />
      <Check
        label="GLB with pieces that things bump into"
        checked={collision}
        onChange={(next) => ask({ collision: next })}
      />
      <EightTrees asked={asked.value} />
      <p class="hint">
        Files are in metres with +Y up. They hold the tree of the seed and season that you see; PLY and STL
        its level of detail too.
      </p>
    </section>
  );
}
