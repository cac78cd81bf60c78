// What files cost those who use them, in words.

const number = new Intl.NumberFormat("en");

export const megabytes = (bytes: number) => `${(bytes / 1e6).toFixed(1)} MB`;

/** "49,998 triangles, 8.4 MB"; the megabytes alone where the triangles are not known. */
export const cost = (triangles: number | null, bytes: number) =>
  triangles === null ? megabytes(bytes) : `${number.format(triangles)} triangles, ${megabytes(bytes)}`;
