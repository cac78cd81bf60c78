// Runs one job at a time and keeps only the newest of those that wait: for sliders and pointers.

export class Latest<T> {
  private running = false;
  private next: T | undefined;

  constructor(
    private readonly job: (input: T, isStale: () => boolean) => Promise<void>,
    private readonly failed: (error: unknown) => void,
  ) {}

  ask(input: T): void {
    this.next = input;
    if (!this.running) void this.run();
  }

  private async run(): Promise<void> {
    this.running = true;
    while (this.next !== undefined) {
      const input = this.next;
      this.next = undefined;
      try {
        await this.job(input, () => this.next !== undefined);
      } catch (error) {
        this.failed(error);
      }
    }
    this.running = false;
  }
}
