// Shapes of stored JSON. What a browser has kept may be another version's, or half of what it was.

/** Whether a value is a `T`. */
export type Shape<T> = (value: unknown) => value is T;

/** What a shape is of. */
export type Of<S> = S extends Shape<infer T> ? T : never;

const shape = <T>(is: (value: unknown) => boolean): Shape<T> => is as Shape<T>;

export const text = shape<string>((value) => typeof value === "string");
export const flag = shape<boolean>((value) => typeof value === "boolean");
/** JSON has no others than finite ones, but 1e999 is read as infinite. */
export const number = shape<number>((value) => Number.isFinite(value));
export const whole = shape<number>((value) => Number.isSafeInteger(value) && (value as number) >= 0);

export const orNull = <T>(of: Shape<T>): Shape<T | null> => shape((value) => value === null || of(value));

/** What earlier versions did not store. */
export const orMissing = <T>(of: Shape<T>): Shape<T | undefined> =>
  shape((value) => value === undefined || of(value));

/** An object with some of these fields and no others. */
export const some = <F extends Record<string, Shape<unknown>>>(
  of: F,
): Shape<{ [Name in keyof F]?: Of<F[Name]> }> =>
  shape(
    (value) =>
      typeof value === "object" &&
      value !== null &&
      Object.entries(value).every(([name, field]) => Object.hasOwn(of, name) && of[name]?.(field)),
  );

export const list = <T>(of: Shape<T>): Shape<T[]> =>
  shape((value) => Array.isArray(value) && value.every((each) => of(each)));

export const oneOf = <T extends string>(...known: readonly T[]): Shape<T> =>
  shape((value) => known.some((each) => each === value));

/** An object with at least these fields. */
export const fields = <F extends Record<string, Shape<unknown>>>(
  of: F,
): Shape<{ [Name in keyof F]: Of<F[Name]> }> =>
  shape(
    (value) =>
      typeof value === "object" &&
      value !== null &&
      Object.entries(of).every(([name, is]) => is((value as Record<string, unknown>)[name])),
  );

/** The version of what is stored, or null where it has none. */
export function versionOf(value: unknown): number | null {
  return fields({ version: number })(value) ? value.version : null;
}
