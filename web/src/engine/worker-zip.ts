// Several trees in one file. One tree is held at a time.
import { Glb } from "./glb";
import { Packer } from "./packer";
import type { Handlers } from "./worker";
import { write } from "./worker-species";

export const zipHandlers: Handlers<"zip" | "pack"> = {
  zip({ trees, format, options }, report) {
    const packer = new Packer();
    const notes = new Set<string>();
    let triangles = 0;
    for (const [at, { spec, seed, stem }] of trees.entries()) {
      report({ stage: `Tree ${at + 1} of ${trees.length}`, done: at, all: trees.length });
      const [files, note] = write(spec, seed, format, stem, options);
      if (note) notes.add(note);
      for (const [name, bytes] of files) {
        if (format === "glb") triangles += new Glb(bytes).triangles;
        packer.add(name, bytes);
      }
    }
    return { zip: packer.finish(), triangles: format === "glb" ? triangles : null, notes: [...notes] };
  },

  pack(files) {
    const packer = new Packer();
    for (const { name, bytes } of files) packer.add(name, bytes);
    return packer.finish();
  },
};
