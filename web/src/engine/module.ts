// The library is fetched and compiled once, in the page; every worker gets the compiled module.
import address from "../wasm/pleach_web_bg.wasm?url";

async function compile(): Promise<WebAssembly.Module> {
  const response = await fetch(address);
  if (!response.ok)
    throw new Error(`The library could not be loaded: ${response.status} ${response.statusText}.`);
  // Some static hosts do not know wasm's media type, and compileStreaming insists on it.
  const type = response.headers.get("content-type") ?? "";
  if (type.startsWith("application/wasm")) return WebAssembly.compileStreaming(response);
  return WebAssembly.compile(await response.arrayBuffer());
}

let compiled: Promise<WebAssembly.Module> | undefined;

export function wasmModule(): Promise<WebAssembly.Module> {
  compiled ??= compile().catch((error: unknown) => {
    compiled = undefined;
    throw error;
  });
  return compiled;
}
