// Small helpers for elements and numbers.

type Child = Node | string | null | undefined | false;
type Attributes = Record<string, string | number | boolean | ((event: Event) => void) | undefined>;

/** An element with attributes (functions: listeners) and children. Texts are set as texts, never as HTML. */
export function h<K extends keyof HTMLElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(name, value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value !== undefined) element.setAttribute(name, String(value));
  }
  for (const child of children) if (child) element.append(child);
  return element;
}

/** A label above its control. */
export function labelled(text: string, control: HTMLElement): HTMLElement {
  return h("label", { class: "control" }, h("span", {}, text), control);
}

export function select(options: [value: string, text: string][], chosen: string, change: (value: string) => void): HTMLSelectElement {
  const element = h("select", { change: () => change(element.value) });
  for (const [value, text] of options) element.append(h("option", { value, selected: value === chosen }, text));
  return element;
}

const superscripts: Record<string, string> = { "-": "⁻", "0": "⁰", "1": "¹", "2": "²", "3": "³", "4": "⁴", "5": "⁵", "6": "⁶", "7": "⁷", "8": "⁸", "9": "⁹" };
const raised = (text: string) => [...text].map((c) => superscripts[c] ?? c).join("");

/** A number with so many digits, short. */
export function number(value: number | null | undefined, digits = 4): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e-3 && size < 1e6) {
    const text = value.toPrecision(digits);
    const plain = text.includes("e") ? String(Number(text)) : text.includes(".") ? text.replace(/\.?0+$/, "") : text;
    return plain.replace("-", "−");
  }
  const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
  return `${mantissa.includes(".") ? mantissa.replace(/\.?0+$/, "") : mantissa}·10${raised(String(Number(exponent)))}`.replace(/^-/, "−");
}

/** "kg/m^3" as it is printed. */
export const unitText = (unit: string) => unit.replace(/\^(-?\d+)/g, (_, power: string) => raised(power)).replace(/ /g, " ");

export const withUnit = (value: number | null | undefined, unit: string, digits = 4) =>
  `${number(value, digits)}${unit ? " " + unitText(unit) : ""}`;

export function duration(seconds: number): string {
  if (seconds < 100) return `${number(seconds, 3)} s`;
  if (seconds < 6000) return `${Math.floor(seconds / 60)} min ${Math.round(seconds % 60)} s`;
  return `${Math.floor(seconds / 3600)} h ${Math.round((seconds % 3600) / 60)} min`;
}

/** The value of a CSS variable on the page, which differs in dark mode. */
export const css = (name: string) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

export function onThemeChange(then: () => void): void {
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", then);
}
