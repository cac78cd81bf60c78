// The values that were used last, by key; the others are released.

export class Cache<T> {
  private readonly kept = new Map<string, T>();

  constructor(
    private readonly size: number,
    private readonly release: (value: T) => void = () => {},
  ) {}

  get(key: string, make: () => T): T {
    const found = this.kept.get(key);
    if (found !== undefined) {
      // A Map keeps the order of insertion: the newest goes last.
      this.kept.delete(key);
      this.kept.set(key, found);
      return found;
    }
    const made = make();
    this.kept.set(key, made);
    for (const [oldest, value] of this.kept) {
      if (this.kept.size <= this.size) break;
      this.kept.delete(oldest);
      this.release(value);
    }
    return made;
  }

  has(key: string): boolean {
    return this.kept.has(key);
  }
}
