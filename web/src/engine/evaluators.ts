// The workers that score the trees of a search, each piece by the first that is free.
import { Cancelled, Client } from "./client";
import { cores } from "./pool";

export class Evaluators {
  private readonly clients = Array.from({ length: cores }, () => new Client("the search"));
  private readonly free = [...this.clients];
  /** Pieces that no worker has begun: each is told which one it is given to. */
  private readonly waiting: ((client: Client) => void)[] = [];
  private recipe: Uint8Array | null = null;
  private isOver = false;

  get count(): number {
    return this.clients.length;
  }

  /** Whether a worker would have nothing to do once those that score now are done. */
  get wantWork(): boolean {
    return this.waiting.length < this.clients.length;
  }

  /** What comes from now on is scored by `recipe`. Pieces that wait are never scored. */
  async use(recipe: Uint8Array): Promise<void> {
    this.waiting.length = 0;
    this.recipe = recipe;
    await Promise.all(this.clients.map((each) => each.call("evaluator", recipe)));
  }

  /** A worker that fails once is replaced, and its piece is done again: scores do not depend on who gives them. */
  async score(piece: Uint8Array): Promise<Uint8Array<ArrayBuffer>> {
    const client = await this.take();
    if (this.isOver) throw new Cancelled();
    try {
      return await client.call("evaluate", piece);
    } catch (error) {
      if (error instanceof Cancelled || !this.recipe) throw error;
      await client.call("evaluator", this.recipe);
      return await client.call("evaluate", piece);
    } finally {
      this.giveBack(client);
    }
  }

  /** Stops what is scored, for good. */
  cancel(): void {
    this.isOver = true;
    this.waiting.length = 0;
    for (const each of this.clients) each.cancel();
  }

  private take(): Promise<Client> {
    const client = this.free.pop();
    return client ? Promise.resolve(client) : new Promise((resolve) => this.waiting.push(resolve));
  }

  private giveBack(client: Client): void {
    const next = this.waiting.shift();
    if (next) next(client);
    else this.free.push(client);
  }
}
