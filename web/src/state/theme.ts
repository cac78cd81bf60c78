import { effect, signal } from "@preact/signals";
import { oneOf, type Shape } from "./shape";
import { load, save } from "./store";

export type Theme = "light" | "dark";

const system = matchMedia("(prefers-color-scheme: dark)");
const isTheme: Shape<Theme> = oneOf("light", "dark");
const stored = load("theme");
const chosen = signal<Theme | null>(isTheme(stored) ? stored : null);
const systemTheme = signal<Theme>(system.matches ? "dark" : "light");
system.addEventListener("change", (event) => {
  systemTheme.value = event.matches ? "dark" : "light";
});

export const theme = () => chosen.value ?? systemTheme.value;

export function toggleTheme(): void {
  chosen.value = theme() === "dark" ? "light" : "dark";
  save("theme", chosen.value);
}

effect(() => {
  document.documentElement.dataset.theme = theme();
});

export const reducedMotion = signal(matchMedia("(prefers-reduced-motion: reduce)").matches);
matchMedia("(prefers-reduced-motion: reduce)").addEventListener("change", (event) => {
  reducedMotion.value = event.matches;
});
