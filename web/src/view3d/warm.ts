// What the graphics card needs before it can draw a model, given to it in steps: all at once, in the first picture, it
// would hold up the page.
import { type Camera, Group, Mesh, type Scene, Texture, type WebGLRenderer, WebGLRenderTarget } from "three";
import { nextTask } from "./context";
import { materialsOf } from "./glb-file";

/** The shadows of `root` as meshes. */
function shadowsOf(root: Group): Group {
  const shadows = new Group();
  root.traverse((node) => {
    if (node instanceof Mesh && node.customDepthMaterial) {
      shadows.add(new Mesh(node.geometry, node.customDepthMaterial));
    }
  });
  return shadows;
}

/**
 * Makes the shaders of `scene` and of `root`, which will be in it, and of its shadows, and loads its
 * textures.
 */
export async function warmUp(
  renderer: WebGLRenderer,
  root: Group,
  camera: Camera,
  scene: Scene,
): Promise<void> {
  await renderer.compileAsync(scene, camera);
  await renderer.compileAsync(root, camera, scene);
  // Shaders of shadows are for what is drawn on a texture.
  const target = new WebGLRenderTarget(1, 1);
  renderer.setRenderTarget(target);
  const shadows = renderer.compileAsync(shadowsOf(root), camera, scene);
  renderer.setRenderTarget(null);
  await shadows;
  target.dispose();
  // What three asks of a shader when it is first drawn with. It asks once.
  for (const shader of renderer.info.programs ?? []) {
    shader.getUniforms();
    await nextTask();
  }
  for (const material of materialsOf(root).values()) {
    for (const value of Object.values(material)) {
      if (!(value instanceof Texture)) continue;
      renderer.initTexture(value);
      await nextTask();
    }
  }
}
