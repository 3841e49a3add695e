// The particles of a run: the scene, its controls, the legend, and the values of the particle that was chosen.
import { Vector3 } from "three";
import { colourMap, colourMaps } from "./colours";
import type { Field, Particles, RunData, Source } from "./data";
import { h, labelled, number, onThemeChange, select, unitText, withUnit } from "./dom";
import { loadField, loadFrame, rangeOf, scalar, scalarsOf, type Frame } from "./frames";
import { Legend } from "./legend";
import { Scene } from "./scene";

const framesPerSecond = 8;
/** Diameter of a particle in spacings: more than one, so that a fluid has no gaps. */
const diameterOf = (dimensions: number) => (dimensions < 3 ? 1.45 : 1.15);

/** Against gravity; z, or y in a plane, where a case has none. */
function upward(data: RunData, dimensions: number): Vector3 {
  const up = new Vector3(0, dimensions < 3 ? 1 : 0, dimensions < 3 ? 0 : 1);
  const gravity = (data.run.resolved?.gravity ?? "").match(/-?[\d.]+(?:e[-+]?\d+)?/gi)?.map(Number) ?? [];
  const largest = gravity.reduce((best, value, k) => (Math.abs(value) > Math.abs(gravity[best] ?? 0) ? k : best), 0);
  if (dimensions === 3 && Math.abs(gravity[largest] ?? 0) > 0) up.set(0, 0, 0).setComponent(largest, gravity[largest] < 0 ? 1 : -1);
  return up;
}

/** The most layers that a wall has. */
function wallLayers(data: RunData): number {
  const layers = Object.entries(data.run.resolved ?? {}).filter(([key]) => /^wall\[\d+\]\.layers$/.test(key)).map(([, value]) => Number(value));
  return Math.max(1, ...layers.filter(Number.isFinite));
}

export class ParticlePanel {
  readonly element = h("figure", { class: "particles" });
  /** Called with the time on show. */
  onTime: (time: number) => void = () => {};

  private particles: Particles;
  private scene!: Scene;
  private stage = h("div", { class: "stage", tabindex: "0", role: "application",
    "aria-label": "Particles. Arrow keys turn or shift the view, plus and minus zoom, R resets, space plays, comma and full stop step through time." });
  private legend = new Legend();
  private values = h("div", { class: "values", "aria-live": "polite" });
  private slider: HTMLInputElement;
  private clock = h("output", { class: "clock" });
  private playButton = h("button", { type: "button", click: () => this.play(this.timer === 0) }, "▶ Play");
  private lowInput = this.rangeInput("lowest colour");
  private highInput = this.rangeInput("highest colour");
  private idInput: HTMLInputElement;
  private clipInput: HTMLInputElement;

  private frame: Frame | null = null;
  private at = 0;
  private wanted = 0;
  private busy = false;
  private timer = 0;
  private field: Field;
  private part = 0;
  private map = "viridis";
  private range: "all" | "now" | "inner" | "own" = "all";
  private walls: "behind" | "plain" | "hidden" | "coloured";
  private clip = { axis: -1, share: 0.5, side: 1 };
  private chosen: number | null = null;

  constructor(private data: RunData, private source: Source) {
    this.particles = data.particles!;
    const { frames, fields } = this.particles;
    this.walls = this.particles.dimensions === 3 ? "behind" : "plain";
    this.field = fields.find((field) => field.name === "v") ?? fields.find((field) => field.name === "p") ?? fields[0];
    this.slider = h("input", { type: "range", min: 0, max: frames.length - 1, step: 1, value: 0, "aria-label": "time", input: () => this.show(Number(this.slider.value)) });
    this.idInput = h("input", { type: "number", min: 0, step: 1, placeholder: "id", change: () => this.choose(this.idInput.value === "" ? null : Number(this.idInput.value)) });
    this.clipInput = h("input", { type: "range", min: 0, max: 1, step: 0.005, value: 0.5, disabled: true, "aria-label": "place of the cut", input: () => this.setClip({ share: Number(this.clipInput.value) }) });
    this.element.append(this.stage, this.legend.element, this.timeRow(), this.controls(), this.values);
    const [low, high] = [[...this.particles.low, 0, 0].slice(0, 3), [...this.particles.high, 0, 0].slice(0, 3)];
    try {
      this.scene = new Scene(this.stage, { dimensions: this.particles.dimensions, low, high, spacing: diameterOf(this.particles.dimensions) * this.particles.spacing, up: upward(data, this.particles.dimensions) });
    } catch (error) {
      this.stage.replaceChildren(h("p", { class: "note" }, `The particles cannot be drawn: this browser has no WebGL (${(error as Error).message}).`));
      return;
    }
    onThemeChange(() => this.scene.theme());
    this.listen();
    this.describeValues();
    void this.show(0);
  }

  private rangeInput(label: string): HTMLInputElement {
    const element: HTMLInputElement = h("input", { type: "number", step: "any", "aria-label": label, change: () => {
      this.range = "own";
      (this.element.querySelector("select.range") as HTMLSelectElement).value = "own";
      this.recolour();
    } });
    return element;
  }

  private timeRow(): HTMLElement {
    return h("div", { class: "time" }, this.playButton, this.slider, this.clock);
  }

  private controls(): HTMLElement {
    const choices = this.particles.fields.flatMap((field) => scalarsOf(field).map(({ part, text }): [string, string] =>
      [`${field.name}/${part}`, `${text}${field.unit ? ` [${unitText(field.unit)}]` : ""}, ${field.meaning}`]));
    const fieldSelect = select(choices, `${this.field.name}/0`, (value) => {
      const [name, part] = value.split("/");
      this.field = this.particles.fields.find((field) => field.name === name)!;
      this.part = Number(part);
      if (this.range === "own") (this.element.querySelector("select.range") as HTMLSelectElement).value = this.range = "all";
      void this.refill();
    });
    fieldSelect.classList.add("field");
    const mapSelect = select(colourMaps.map((map) => [map.name, map.name.replace("_", " to ")]), this.map, (value) => { this.map = value; this.recolour(); });
    mapSelect.classList.add("map");
    const rangeSelect = select([["all", "of all times"], ["now", "of this time"], ["inner", "of all times, inner 98 %"], ["own", "as typed"]], this.range, (value) => { this.range = value as typeof this.range; this.recolour(); });
    rangeSelect.classList.add("range");
    const wallSelect = select([...(this.particles.dimensions === 3 ? [["behind", "grey, but in front"] as [string, string]] : []), ["plain", "grey"], ["coloured", "coloured"], ["hidden", "hidden"]], this.walls, (value) => { this.walls = value as typeof this.walls; void this.refill(); });
    wallSelect.classList.add("walls");
    const axes = ["x", "y", "z"].slice(0, this.particles.dimensions);
    const cuts: [string, string][] = [["-1/1", "none"], ...axes.flatMap((axis, k): [string, string][] => [[`${k}/1`, `beyond ${axis}`], [`${k}/-1`, `before ${axis}`]])];
    const clipSelect = select(cuts, "-1/1", (value) => {
      const [axis, side] = value.split("/").map(Number);
      this.setClip({ axis, side });
    });
    clipSelect.classList.add("clip");
    const live = this.source.live;
    const thick: [string, string][] = [200_000, 1_000_000, 5_000_000].map((most) => [String(most), `${number(most)} at most`]);
    const mostSelect = live && this.particles.stored > live.most ? select([...thick, ["1000000000", "all"]], String(live.most), (value) => {
      live.most = Number(value);
      void this.show(this.at);
    }) : null;
    mostSelect?.classList.add("most");
    const size = h("input", { type: "range", min: 0.25, max: 2, step: 0.05, value: 1, "aria-label": "size of the particles", input: (event) => {
      this.scene.setDiameter(diameterOf(this.particles.dimensions) * this.particles.spacing * Number((event.target as HTMLInputElement).value));
      this.scene.render();
    } });
    return h("div", { class: "controls" },
      labelled("Colour by", fieldSelect), labelled("Colours", mapSelect), labelled("Range", rangeSelect),
      h("div", { class: "control pair" }, h("span", {}, "From, to"), h("div", {}, this.lowInput, this.highInput)),
      labelled("Walls", wallSelect), labelled("Cut away", clipSelect), labelled("Cut at", this.clipInput), labelled("Size", size),
      labelled("Particle", this.idInput), mostSelect && labelled("Particles shown", mostSelect),
      h("div", { class: "control buttons" },
        h("button", { type: "button", click: () => this.scene.reset() }, "Reset view"),
        h("button", { type: "button", click: () => this.screenshot() }, "Screenshot")));
  }

  private listen(): void {
    const keys: Record<string, () => void> = {
      ArrowLeft: () => this.scene.nudge(-1, 0), ArrowRight: () => this.scene.nudge(1, 0),
      ArrowUp: () => this.scene.nudge(0, 1), ArrowDown: () => this.scene.nudge(0, -1),
      "+": () => this.scene.zoom(1.15), "=": () => this.scene.zoom(1.15), "-": () => this.scene.zoom(1 / 1.15),
      r: () => this.scene.reset(), " ": () => this.play(this.timer === 0),
      ",": () => this.show(Math.max(0, this.at - 1)), ".": () => this.show(Math.min(this.particles.frames.length - 1, this.at + 1)),
    };
    this.stage.addEventListener("keydown", (event) => {
      const act = event.ctrlKey || event.altKey || event.metaKey ? undefined : keys[event.key];
      if (!act) return;
      event.preventDefault();
      act();
    });
    let down = [0, 0];
    this.scene.canvas.addEventListener("pointerdown", (event) => { down = [event.clientX, event.clientY]; });
    this.scene.canvas.addEventListener("pointerup", (event) => {
      if (Math.hypot(event.clientX - down[0], event.clientY - down[1]) > 4 || !this.frame) return;
      const box = this.scene.canvas.getBoundingClientRect();
      const index = this.scene.pick(event.clientX - box.left, event.clientY - box.top);
      this.choose(index < 0 ? null : this.frame.ids[index]);
    });
  }

  play(on: boolean): void {
    clearInterval(this.timer);
    this.timer = on ? window.setInterval(() => this.show((this.at + 1) % this.particles.frames.length), 1000 / framesPerSecond) : 0;
    this.playButton.textContent = on ? "❚❚ Pause" : "▶ Play";
  }

  /** Shows a time; while one is being read, the latest that was asked for comes next. */
  async show(number: number): Promise<void> {
    this.wanted = number;
    if (this.busy) return;
    this.busy = true;
    try {
      do {
        this.at = this.wanted;
        this.frame = await loadFrame(this.source, this.particles, this.at);
        await this.refill();
      } while (this.at !== this.wanted);
    } finally {
      this.busy = false;
    }
  }

  /** Takes up snapshots that were written since. */
  extend(times: number[]): void {
    const { frames } = this.particles;
    for (const time of times.slice(frames.length)) frames.push({ time, step: 0, parts: [], ranges: {} });
    this.slider.max = String(frames.length - 1);
  }

  /** Shows the newest snapshot. */
  showLast(): void {
    void this.show(this.particles.frames.length - 1);
  }

  /** Shows the stored time nearest to this one. */
  showTime(time: number): void {
    const { frames } = this.particles;
    const nearest = frames.reduce((best, frame, k) => (Math.abs(frame.time - time) < Math.abs(frames[best].time - time) ? k : best), 0);
    this.slider.value = String(nearest);
    void this.show(nearest);
  }

  private async refill(): Promise<void> {
    const frame = this.frame!;
    const value = scalar(await loadField(this.source, frame, this.field), this.field.components, this.part);
    if (frame !== this.frame) return;
    const kept = this.walls === "hidden" ? frame.position.map((x, i) => (frame.group[Math.floor(i / 3)] === 1 ? NaN : x)) : frame.position;
    this.scene.setParticles(kept, this.walls === "coloured" ? new Float32Array(frame.count) : frame.group);
    this.scene.setOpenWalls(this.walls === "behind" ? (wallLayers(this.data) - 0.5) * this.particles.spacing : 0);
    this.scene.setValues(value);
    const text = `t = ${withUnit(frame.info.time, "s", 5)}`;
    this.slider.value = String(this.at);
    this.slider.setAttribute("aria-valuetext", text);
    this.clock.textContent = `${text}, step ${frame.info.step}`;
    this.clock.dataset.time = String(frame.info.time);
    this.stage.dataset.count = String(frame.count);
    this.onTime(frame.info.time);
    this.recolour();
    await this.describeValues();
  }

  private recolour(): void {
    const frames = this.range === "now" && this.frame ? [this.frame.info] : this.particles.frames;
    let [low, high] = rangeOf(frames, this.field.name, this.part, this.range === "inner");
    if (this.range === "own") [low, high] = [Number(this.lowInput.value), Number(this.highInput.value)];
    const map = colourMap(this.map);
    if (this.range !== "own") {
      if (map.signed && low < 0 && high > 0) [low, high] = [-Math.max(-low, high), Math.max(-low, high)];
      this.lowInput.value = String(Number(low.toPrecision(6)));
      this.highInput.value = String(Number(high.toPrecision(6)));
    }
    this.scene.setColours(map, low, high);
    const title = scalarsOf(this.field).find(({ part }) => part === this.part)!.text;
    this.legend.set({ title: `${this.field.meaning} ${title}`, unit: this.field.unit, map, low, high });
    this.scene.render();
  }

  private setClip(change: Partial<ParticlePanel["clip"]>): void {
    Object.assign(this.clip, change);
    const { axis, share, side } = this.clip;
    this.clipInput.disabled = axis < 0;
    const [low, high] = axis < 0 ? [0, 0] : [this.particles.low[axis], this.particles.high[axis]];
    const at = low + (high - low) * share;
    this.clipInput.setAttribute("aria-valuetext", axis < 0 ? "no cut" : `${"xyz"[axis]} = ${withUnit(at, "m")}`);
    this.clipInput.title = this.clipInput.getAttribute("aria-valuetext")!;
    this.scene.setClip(axis, at, side);
    this.scene.render();
  }

  choose(id: number | null): void {
    this.chosen = id;
    this.idInput.value = id === null ? "" : String(id);
    void this.describeValues();
  }

  private async describeValues(): Promise<void> {
    const frame = this.frame;
    const index = this.chosen === null || !frame ? -1 : frame.ids.indexOf(this.chosen);
    this.scene.choose(index);
    this.scene.render();
    if (!frame || this.chosen === null) {
      this.values.replaceChildren(h("p", { class: "note" }, "Click a particle, or type its id, to read what is stored of it."));
      return;
    }
    if (index < 0) {
      this.values.replaceChildren(h("p", { class: "note" }, `Particle ${this.chosen} is not on this page${this.particles.shown < this.particles.stored ? ", which shows a sample of all" : ""}.`));
      return;
    }
    const n = this.particles.dimensions;
    const entries = [{ name: "x", unit: "m", values: Array.from(frame.position.subarray(3 * index, 3 * index + n)) }];
    for (const field of this.particles.fields) {
      const all = await loadField(this.source, frame, field);
      entries.push({ name: field.name, unit: field.unit, values: Array.from(all.subarray(index * field.components, (index + 1) * field.components)) });
    }
    const list = h("dl", { class: "facts" }, h("div", {}, h("dt", {}, "particle"), h("dd", {}, `${this.chosen}, ${frame.group[index] === 1 ? "wall" : "fluid"}`)));
    for (const { name, unit, values } of entries) {
      const text = values.length === 1 ? number(values[0], 6) : `(${values.map((value) => number(value, 5)).join(", ")})`;
      list.append(h("div", {}, h("dt", {}, name), h("dd", { "data-name": name, "data-value": JSON.stringify(values) }, `${text} ${unitText(unit)}`)));
    }
    this.values.replaceChildren(list);
  }

  /** The view with its legend, title and time as a PNG file. */
  private screenshot(): void {
    this.scene.draw();
    const view = this.scene.canvas;
    const picture = h("canvas", { width: view.width, height: view.height + 90 });
    const context = picture.getContext("2d")!;
    const style = getComputedStyle(document.body);
    context.fillStyle = style.backgroundColor;
    context.fillRect(0, 0, picture.width, picture.height);
    context.drawImage(view, 0, 0);
    this.legend.draw(context, 16, picture.height - 12, Math.min(460, picture.width / 2), style.color);
    context.textAlign = "right";
    context.fillText(this.data.title, picture.width - 16, picture.height - 40);
    context.fillText(`t = ${withUnit(this.frame?.info.time, "s", 5)}`, picture.width - 16, picture.height - 16);
    picture.toBlob((blob) => {
      if (!blob) return;
      const link = h("a", { href: URL.createObjectURL(blob), download: `particles_${String(this.at).padStart(4, "0")}.png` });
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
    });
  }
}
