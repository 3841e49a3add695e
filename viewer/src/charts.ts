// Charts by uPlot, in the page's colours, as wide as there is room, with the time on show marked.
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { css, h, number, onThemeChange, unitText } from "./dom";

export interface Line {
  name: string;
  unit?: string;
  values: (number | null)[];
  style?: "line" | "dashed" | "dots";
  /** Index of its colour; as counted where it is not given. */
  colour?: number;
}

export interface ChartSetup {
  title: string;
  x: { name: string; unit?: string; values: number[]; log?: boolean };
  y: { name: string; unit?: string; log?: boolean; texts?: string[] };
  lines: Line[];
  /** Marks the time on show, and calls back where a time is clicked. */
  onClick?: (x: number) => void;
}

const colours = ["--c0", "--c1", "--c2", "--c3", "--c4", "--c5", "--c6", "--c7"];
const axisText = (name: string, unit?: string) => (unit ? `${name} [${unitText(unit)}]` : name);

/** Logarithmic axes begin and end at one digit, a little beyond the data: uPlot counts its lines from there. */
function logRange(_: uPlot, low: number | null, high: number | null): uPlot.Range.MinMax {
  const oneDigit = (value: number, round: (value: number) => number) => {
    const size = 10 ** Math.floor(Math.log10(value));
    return round(value / size) * size;
  };
  return [oneDigit(Math.max(low ?? 1e-3, 1e-300) / 1.1, Math.floor), oneDigit(Math.max(high ?? 1, 1e-300) * 1.1, Math.ceil)];
}

export class Chart {
  readonly element: HTMLElement;
  private plot: uPlot | null = null;
  private holder = h("div", { class: "plot", tabindex: "0", role: "img" });
  private mark: number | null = null;

  constructor(private setup: ChartSetup) {
    this.holder.setAttribute("aria-label", `Chart: ${setup.title}. Left and right arrow keys move along it.`);
    this.element = h("div", { class: "chart" }, h("h3", {}, setup.title), this.holder);
    this.holder.addEventListener("keydown", (event) => this.move(event));
    new ResizeObserver(() => this.make()).observe(this.element);
    onThemeChange(() => this.make(true));
  }

  setMark(x: number): void {
    this.mark = x;
    this.plot?.redraw(false);
  }

  private move(event: KeyboardEvent): void {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (!step || !this.plot) return;
    event.preventDefault();
    const last = this.setup.x.values.length - 1;
    const index = Math.min(last, Math.max(0, (this.plot.cursor.idx ?? (step > 0 ? -1 : last + 1)) + step));
    this.plot.setCursor({ left: this.plot.valToPos(this.setup.x.values[index], "x"), top: this.plot.over.clientHeight / 2 });
  }

  private make(again = false): void {
    const width = this.element.clientWidth;
    if (width === 0 || (!again && this.plot?.width === width)) return;
    const height = Math.round(Math.min(300, Math.max(200, width * 0.5)));
    if (this.plot && !again) return this.plot.setSize({ width, height });
    this.plot?.destroy();
    const { x, y, lines } = this.setup;
    const axis = (label: string, log: boolean | undefined): uPlot.Axis => ({
      label, stroke: css("--ink"), font: "12px system-ui, sans-serif", labelFont: "12px system-ui, sans-serif", labelSize: 22, labelGap: 2,
      grid: { stroke: css("--grid"), width: 1 }, ticks: { stroke: css("--grid"), width: 1 },
      ...(log ? { filter: (_: uPlot, splits: number[]) => splits.map((value) => (/^[125]e/.test(Number(value.toPrecision(8)).toExponential()) ? value : null)) } : {}),
      values: (_, splits) => splits.map((value) => (value === null || value === undefined ? "" : number(value, 3))),
    });
    const yAxis = axis(axisText(y.name, y.unit), y.log);
    yAxis.size = 62;
    if (y.texts) {
      yAxis.splits = () => y.texts!.map((_, k) => k);
      yAxis.values = () => y.texts!;
    }
    const options: uPlot.Options = {
      width, height,
      scales: {
        x: { time: false, distr: x.log ? 3 : 1, ...(x.log ? { range: logRange } : {}) },
        y: { distr: y.log ? 3 : 1, ...(y.log ? { range: logRange } : y.texts ? { range: [-0.4, y.texts.length - 0.6] as uPlot.Range.MinMax } : {}) },
      },
      axes: [axis(axisText(x.name, x.unit), x.log), yAxis],
      series: [
        { label: x.name, value: (_, value) => number(value, 5) },
        ...lines.map((line, k): uPlot.Series => {
          const stroke = css(colours[(line.colour ?? k) % colours.length]);
          const dots = line.style === "dots";
          const many = line.values.length > 300;  // dots would run into a band
          const hollow = (line.colour ?? k) >= colours.length;  // a colour that is there already
          return {
            label: axisText(line.name, line.unit), stroke, width: dots ? 0 : 1.5, spanGaps: true,
            dash: line.style === "dashed" ? [6, 4] : undefined,
            points: { show: dots ? true : undefined, size: dots ? (many ? 2.5 : 6) : undefined, fill: hollow ? css("--paper") : stroke, stroke },
            paths: dots ? () => null : undefined,
            value: (_, value) => (y.texts && value !== null ? (y.texts[value] ?? "") : number(value, 5)),
          };
        }),
      ],
      cursor: { drag: { x: true, y: false } },
      legend: { live: true },
      hooks: {
        draw: [(plot) => this.drawMark(plot)],
        ready: [(plot) => plot.over.addEventListener("click", () => {
          const index = plot.cursor.idx;
          if (index !== null && index !== undefined) this.setup.onClick?.(plot.data[0][index]);
        })],
      },
    };
    this.plot = new uPlot(options, [x.values, ...lines.map((line) => line.values)] as uPlot.AlignedData, this.holder);
  }

  private drawMark(plot: uPlot): void {
    if (this.mark === null) return;
    const at = Math.round(plot.valToPos(this.mark, "x", true));
    if (at < plot.bbox.left || at > plot.bbox.left + plot.bbox.width) return;
    plot.ctx.save();
    plot.ctx.fillStyle = css("--mark");
    plot.ctx.fillRect(at, plot.bbox.top, Math.max(1, devicePixelRatio), plot.bbox.height);
    plot.ctx.restore();
  }
}

/** Lines over different x in one table, as uPlot wants them: all x in order, null where a line has no value. */
export function aligned(lines: { x: number[]; y: (number | null)[] }[]): { x: number[]; ys: (number | null)[][] } {
  const x = [...new Set(lines.flatMap((line) => line.x))].filter(Number.isFinite).sort((a, b) => a - b);
  const place = new Map(x.map((value, k) => [value, k]));
  const ys = lines.map((line) => {
    const out: (number | null)[] = x.map(() => null);
    line.x.forEach((value, k) => { if (place.has(value)) out[place.get(value)!] = line.y[k]; });
    return out;
  });
  return { x, ys };
}
