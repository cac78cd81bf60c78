// What programs that show links show of this one: title, description and picture.

const TITLE = "pleach studio: the tree in a picture, as a species that grows";
const DESCRIPTION =
  "Drop a silhouette or a photograph of a tree. The page finds a species that grows such trees, in the browser, and sends nothing anywhere.";
const PICTURE = {
  file: "preview.jpg",
  width: "1200",
  height: "630",
  alt: "A fitted tree in three dimensions beside the silhouette that it was fitted to.",
};

/**
 * A plugin of Vite. The environment's PLEACH_ADDRESS is the address of the page's folder: most programs take pictures by
 * whole addresses only, and the page itself does not know where it will be.
 */
export function preview() {
  const address = process.env.PLEACH_ADDRESS;
  const folder = address ? `${address.replace(/\/$/, "")}/` : "./";
  const properties = {
    "og:type": "website",
    "og:site_name": "pleach",
    "og:title": TITLE,
    "og:description": DESCRIPTION,
    ...(address ? { "og:url": folder } : {}),
    "og:image": folder + PICTURE.file,
    "og:image:type": "image/jpeg",
    "og:image:width": PICTURE.width,
    "og:image:height": PICTURE.height,
    "og:image:alt": PICTURE.alt,
  };
  const names = {
    "twitter:card": "summary_large_image",
    "twitter:title": TITLE,
    "twitter:description": DESCRIPTION,
    "twitter:image": folder + PICTURE.file,
    "twitter:image:alt": PICTURE.alt,
  };
  const tags = (key, fields) =>
    Object.entries(fields).map(([name, content]) => ({
      tag: "meta",
      attrs: { [key]: name, content },
      injectTo: "head",
    }));
  return {
    name: "preview",
    apply: "build",
    transformIndexHtml: () => [...tags("property", properties), ...tags("name", names)],
  };
}
