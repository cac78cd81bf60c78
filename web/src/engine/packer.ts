// A zip file, put together file by file. What is done is handed to the browser as it comes: it keeps large files on disk.
import { Zip, ZipDeflate, ZipPassThrough } from "fflate";

/** Pictures are compressed already. */
const isPacked = (name: string) => /\.(png|jpe?g|webp)$/.test(name);
/** Of fflate, 1 to 9: the level beyond which meshes hardly get smaller. */
const EFFORT = 5;
/** Bytes that are held before they are handed over. */
const HELD = 4_000_000;

export class Packer {
  private readonly done: Blob[] = [];
  private held: Uint8Array<ArrayBuffer>[] = [];
  private holds = 0;
  private wrong: Error | null = null;
  private readonly zip = new Zip((error, bytes) => {
    this.wrong ??= error;
    this.held.push(bytes as Uint8Array<ArrayBuffer>);
    this.holds += bytes.length;
    if (this.holds > HELD) this.handOver();
  });

  add(name: string, bytes: Uint8Array): void {
    const file = isPacked(name) ? new ZipPassThrough(name) : new ZipDeflate(name, { level: EFFORT });
    this.zip.add(file);
    file.push(bytes, true);
    if (this.wrong) throw this.wrong;
  }

  finish(): Blob {
    this.zip.end();
    this.handOver();
    if (this.wrong) throw this.wrong;
    return new Blob(this.done, { type: "application/zip" });
  }

  private handOver(): void {
    this.done.push(new Blob(this.held));
    this.held = [];
    this.holds = 0;
  }
}
