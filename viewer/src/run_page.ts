// The page of one run.
import { aligned, Chart } from "./charts";
import { RunControl } from "./control";
import type { ColumnInfo, Gauge, Live, RunData, Source, State } from "./data";
import { duration, h, number, unitText, withUnit } from "./dom";
import { ParticlePanel } from "./panel";

const finite = (value: number) => (Number.isFinite(value) ? value : null);

async function column(source: Source, columns: ColumnInfo[], name: string): Promise<number[] | null> {
  const info = columns.find((each) => each.name === name);
  return info ? Array.from(await source.block(info.block)) : null;
}

function section(id: string, title: string, ...children: (Node | null)[]): HTMLElement {
  const element = h("section", { id }, h("h2", {}, title));
  for (const child of children) if (child) element.append(child);
  return element;
}

export function facts(entries: [string, string | undefined | null][]): HTMLElement {
  const list = h("dl", { class: "facts" });
  for (const [name, text] of entries) if (text) list.append(h("div", {}, h("dt", {}, name), h("dd", {}, text)));
  return list;
}

export function table(heads: string[], rows: (string | Node)[][], leftColumns = 1): HTMLElement {
  const cell = (tag: "th" | "td", content: string | Node, k: number) => h(tag, { class: k < leftColumns ? "left" : "" }, content);
  return h("div", { class: "scroll", tabindex: "0" }, h("table", {},
    h("thead", {}, h("tr", {}, ...heads.map((text, k) => cell("th", text, k)))),
    h("tbody", {}, ...rows.map((row) => h("tr", {}, ...row.map((content, k) => cell("td", content, k)))))));
}

function summary({ run, progress }: RunData): HTMLElement {
  const going = run.status === "running" ? (progress ?? null) : null;
  const seconds = going ? undefined : run.seconds?.total;
  const rate = going ? going.rate : run.particle_updates_per_s;
  const machine = run.machine ?? {};
  return facts([
    ["status", run.status],
    ["particles", `${run.particles?.fluid ?? 0} fluid, ${run.particles?.wall ?? 0} wall`],
    ["simulated time", withUnit(going ? going.time : run.time, "s")],
    ["steps", String((going ? going.step : run.steps) ?? "")],
    ["wall time", seconds === undefined ? null : duration(seconds)],
    ["rate", rate ? `${number(rate / 1e6, 3)} M particle updates/s` : null],
    ["threads", run.threads === undefined ? null : String(run.threads)],
    ["machine", [machine.processor, machine.cores && `${machine.cores} cores`, machine.memory_gb && `${machine.memory_gb} GB`].filter(Boolean).join(", ")],
    ["audit residual", going || run.energy?.residual_relative === undefined ? null : `${number(run.energy.residual_relative, 3)} of the initial potential energy`],
    ["case", run.case?.split("/").pop()],
    ["version", run.version],
  ]);
}

async function energyCharts(data: RunData, source: Source, onClick: (x: number) => void): Promise<Chart[]> {
  const time = await column(source, data.energies, "time");
  if (!time || time.length === 0) return [];
  const lines = async (names: string[]) => {
    const out = [];
    for (const name of names) {
      const values = await column(source, data.energies, name);
      if (values && values.some((value) => value !== 0)) out.push({ name, unit: "J", values: values.map(finite) });
    }
    return out;
  };
  const x = { name: "time", unit: "s", values: time };
  const charts = [
    new Chart({ title: "Energies", x, y: { name: "energy", unit: "J" }, lines: await lines(["kinetic", "potential", "elastic", "total"]), onClick }),
    new Chart({ title: "Taken out of them, by cause", x, y: { name: "energy", unit: "J" }, lines: await lines(["viscous", "artificial", "diffusion", "exchange", "walls", "xsph", "body"]), onClick }),
  ];
  const residual = await column(source, data.energies, "residual_relative");
  if (residual) charts.push(new Chart({ title: "Residual of the energy audit", x, y: { name: "of the initial potential energy" }, lines: [{ name: "residual", values: residual.map(finite) }], onClick }));
  return charts;
}

async function stepCharts(data: RunData, source: Source, onClick: (x: number) => void): Promise<Chart[]> {
  const columns = data.steps.length > 0 ? data.steps : data.energies;
  const time = await column(source, columns, "time");
  const dt = await column(source, columns, "dt");
  if (!time || !dt) return [];
  const x = { name: "time", unit: "s", values: time };
  const charts = [new Chart({ title: "Step size", x, y: { name: "step", unit: "s" }, lines: [{ name: "dt", unit: "s", values: dt.map(finite) }], onClick })];
  const limiter = await column(source, columns, "limiter");
  if (limiter) charts.push(new Chart({ title: "What limits the step", x, y: { name: "", texts: data.limiters }, lines: [{ name: "limiter", values: limiter.map(finite), style: "dots" }], onClick }));
  const counts = [];
  for (const name of ["fluid", "wall"]) {
    const values = await column(source, columns, name);
    if (values) counts.push({ name, values: values.map(finite) });
  }
  if (counts.length > 0) charts.push(new Chart({ title: "Particles", x, y: { name: "number" }, lines: counts, onClick }));
  return charts;
}

async function gaugeCharts(gauge: Gauge, source: Source, onClick: (x: number) => void): Promise<Chart[]> {
  const time = await column(source, gauge.columns, "time");
  if (!time) return [];
  const charts: Chart[] = [];
  const byUnit = new Map<string, ColumnInfo[]>();
  for (const info of gauge.columns.slice(1)) byUnit.set(info.unit, [...(byUnit.get(info.unit) ?? []), info]);
  for (const [unit, columns] of byUnit) {
    const lines: { name: string; unit: string; x: number[]; y: (number | null)[]; style: "line" | "dots"; colour: number }[] = [];
    const reference = gauge.reference && columns.some((info) => info.name === gauge.reference!.column) ? gauge.reference : null;
    // The reference first, so that it does not cover ours.
    if (reference) lines.push({ name: `${reference.column}, reference`, unit, x: Array.from(await source.block(reference.times)), y: Array.from(await source.block(reference.values), finite), style: "dots", colour: columns.length });
    for (const [k, info] of columns.entries()) lines.push({ name: info.name, unit, x: time, y: Array.from(await source.block(info.block), finite), style: "line", colour: k });
    const { x, ys } = aligned(lines);
    charts.push(new Chart({
      title: columns.length === 1 ? `${gauge.name}: ${columns[0].name}` : gauge.name,
      x: { name: "time", unit: "s", values: x }, y: { name: columns.map((info) => info.name).join(", "), unit },
      lines: lines.map((line, k) => ({ name: line.name, unit, values: ys[k], style: line.style, colour: line.colour })), onClick,
    }));
  }
  return charts;
}

function comparisonTable(gauges: Gauge[]): HTMLElement | null {
  const rows = gauges.filter((gauge) => gauge.reference).map((gauge) => {
    const r = gauge.reference!, unit = unitText(gauge.columns.find((info) => info.name === r.column)?.unit ?? "");
    const of = (value: number | null, time: number | null) => `${number(value)} ${unit} at ${number(time)} s`;
    return [gauge.name, r.column, String(r.points), `${number(r.rms)} ${unit}`, r.relative === null ? "–" : `${number(100 * r.relative, 3)} %`, of(r.peak, r.peak_time), of(r.reference_peak, r.reference_peak_time)];
  });
  return rows.length === 0 ? null : table(["gauge", "column", "points", "rms difference", "of the range", "peak", "peak of the reference"], rows, 2);
}

function caseSection({ run }: RunData): HTMLElement {
  const rows = Object.entries(run.resolved ?? {}).map(([key, value]) => [key, value]);
  const body = table(["key", "value"], rows, 2);
  const filter = h("input", { type: "search", placeholder: "filter keys", "aria-label": "filter keys", input: () => {
    for (const row of body.querySelectorAll("tbody tr")) (row as HTMLElement).hidden = !row.textContent!.toLowerCase().includes(filter.value.toLowerCase());
  } });
  const stages = (run.stages ?? []).map((stage) => [stage.name, stage.reads, stage.writes]);
  return section("case", "The case as it was run", filter, h("details", { open: rows.length <= 60 }, h("summary", {}, `${rows.length} keys with the values that were used`), body),
    stages.length ? h("details", {}, h("summary", {}, `${stages.length} stages of one evaluation`), table(["stage", "reads", "writes"], stages, 3)) : null);
}

function progressText(state: State): string {
  const progress = state.progress;
  if (!progress) return state.status;
  const rate = `${number(progress.rate / 1e6, 3)} M particle updates/s`;
  const paused = state.status === "running" && progress.paused;
  const rest = state.status === "running" && !paused ? `, ${duration(progress.remaining_s)} to go` : "";
  return `${paused ? "paused" : state.status}: t = ${number(progress.time, 5)} of ${number(progress.end)} s, step ${progress.step}, ${rate}${rest}`;
}

/** All charts of a run, in sections. */
class Charts {
  readonly element = h("div");
  private all: Chart[] = [];
  private mark: number | null = null;

  constructor(private source: Source, private onClick: (time: number) => void) {}

  async fill(data: RunData): Promise<void> {
    const { source, onClick } = this;
    const made: [string, string, Node | null, Chart[]][] = [
      ["gauges", "Gauges", comparisonTable(data.gauges), (await Promise.all(data.gauges.map((gauge) => gaugeCharts(gauge, source, onClick)))).flat()],
      ["energies", "Energies", null, await energyCharts(data, source, onClick)],
      ["steps", "Steps", null, await stepCharts(data, source, onClick)],
    ];
    this.all = made.flatMap(([, , , charts]) => charts);
    this.element.replaceChildren(...made.filter(([, , before, charts]) => before || charts.length > 0).map(([id, title, before, charts]) =>
      section(id, title, before, h("div", { class: "charts" }, ...charts.map((chart) => chart.element)))));
    if (this.mark !== null) this.setMark(this.mark);
  }

  setMark(time: number): void {
    this.mark = time;
    this.all.forEach((chart) => chart.setMark(time));
  }
}

/** Asks every second how far the run is, and shows it: at once where it ended, else as its files grow. */
function follow(live: Live, line: HTMLElement, control: RunControl, panel: ParticlePanel | null, reload: () => Promise<void>): void {
  let polls = 0, status = "", known = 0, shownStep = -1;
  const ask = async () => {
    try {
      const state = await live.state();
      line.textContent = progressText(state);
      control.update(state);
      if (!panel && state.times.length > 0) return location.reload();
      panel?.extend(state.times);
      if (live.follow && state.times.length > known) panel?.showLast();
      known = state.times.length;
      const step = state.progress?.step ?? 0;
      if (state.status !== status || (polls++ % 5 === 4 && step !== shownStep)) {
        await reload();
        shownStep = step;
      }
      status = state.status;
      if (status !== "running") return;
    } catch (error) {
      line.textContent = `No answer: ${(error as Error).message}`;
    }
    setTimeout(() => void ask(), 1000);
  };
  void ask();
}

export async function runPage(page: HTMLElement, data: RunData, source: Source): Promise<void> {
  document.title = `${data.title} · Undine`;
  const head = h("div", {}, summary(data));
  page.replaceChildren(h("header", {}, h("h1", {}, data.title), head));
  const line = h("p", { class: "note progress" });  // changes every second: not to be read out
  const control = source.live ? new RunControl(source.live) : null;
  if (control) page.append(line, control.element);
  for (const warning of data.run.warnings ?? []) page.append(h("p", { class: "note warning" }, warning));
  for (const note of data.notes) page.append(h("p", { class: "note" }, note));
  const panel = data.particles && data.particles.frames.length > 0 ? new ParticlePanel(data, source) : null;
  if (panel) page.append(section("particles", "Particles", panel.element));
  const charts = new Charts(source, (time) => panel?.showTime(time));
  await charts.fill(data);
  page.append(charts.element, caseSection(data));
  if (panel) panel.onTime = (time) => charts.setMark(time);
  if (source.live && control) follow(source.live, line, control, panel, async () => {
    const newer = (await source.data()) as RunData;
    head.replaceChildren(summary(newer));
    await charts.fill(newer);
  });
  page.dataset.ready = "true";
}
