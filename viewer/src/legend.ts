// The colour bar with its range, as elements on the page and as part of a screenshot.
import type { ColourMap } from "./colours";
import { h, number, unitText } from "./dom";

export interface LegendState {
  title: string;
  unit: string;
  map: ColourMap;
  low: number;
  high: number;
}

const mostTicks = 5;

function tickText(state: LegendState, k: number, ticks = mostTicks): string {
  const value = state.low + ((state.high - state.low) * k) / (ticks - 1);
  const digits = k === 0 || k === ticks - 1 ? 4 : 3;
  return number(Math.abs(value) < 1e-9 * Math.max(Math.abs(state.low), Math.abs(state.high)) ? 0 : value, digits);
}

const heading = (state: LegendState) => (state.unit ? `${state.title} [${unitText(state.unit)}]` : state.title);

function drawBar(context: CanvasRenderingContext2D, map: ColourMap, x: number, y: number, width: number, height: number): void {
  for (let i = 0; i < width; ++i) {
    const k = 4 * Math.round((i / Math.max(1, width - 1)) * 255);
    context.fillStyle = `rgb(${map.rgba[k]},${map.rgba[k + 1]},${map.rgba[k + 2]})`;
    context.fillRect(x + i, y, 1, height);
  }
}

export class Legend {
  readonly element = h("div", { class: "legend", role: "img" });
  private state: LegendState | null = null;

  set(state: LegendState): void {
    this.state = state;
    const bar = h("canvas", { width: 512, height: 1, "aria-hidden": "true" });
    drawBar(bar.getContext("2d")!, state.map, 0, 0, 512, 1);
    const labels = h("div", { class: "ticks" });
    for (let k = 0; k < mostTicks; ++k) labels.append(h("span", { class: k === 0 ? "low" : k === mostTicks - 1 ? "high" : "" }, tickText(state, k)));
    this.element.replaceChildren(h("div", { class: "heading" }, heading(state)), bar, labels);
    this.element.dataset.low = String(state.low);
    this.element.dataset.high = String(state.high);
    this.element.setAttribute("aria-label", `${heading(state)}, from ${number(state.low)} to ${number(state.high)}`);
  }

  /** Draws it with the lower left corner at (x, y). */
  draw(context: CanvasRenderingContext2D, x: number, y: number, width: number, ink: string): void {
    const state = this.state;
    if (!state) return;
    context.font = "14px sans-serif";
    context.fillStyle = ink;
    context.textAlign = "left";
    context.fillText(heading(state), x, y - 44);
    drawBar(context, state.map, x, y - 36, width, 14);
    context.fillStyle = ink;
    // Fewer numbers where five would run into each other.
    const needed = (ticks: number) => Array.from({ length: ticks }, (_, k) => context.measureText(tickText(state, k, ticks)).width + 10).reduce((a, b) => Math.max(a, b)) * ticks;
    const ticks = [mostTicks, 3].find((count) => needed(count) < width) ?? 2;
    for (let k = 0; k < ticks; ++k) {
      context.textAlign = k === 0 ? "left" : k === ticks - 1 ? "right" : "center";
      context.fillText(tickText(state, k, ticks), x + (width * k) / (ticks - 1), y - 4);
    }
  }
}
