// What the program appends to the page: one JSON text and blocks of numbers, and how to get at them.

/** A block of numbers: all the same (`constant`), or base64 of a zlib stream of their bytes, the first bytes of all first. */
export interface BlockInfo {
  type: "f32" | "f64" | "i32" | "u16";
  count: number;
  components: number;
  /** u16: 0 stands for `low`, 65534 for `high`, 65535 for a value that is not finite; by component. */
  low?: number[];
  high?: number[];
  constant?: (number | null)[];
}

export interface ColumnInfo {
  name: string;
  unit: string;
  block: number;
}

export interface Reference {
  column: string;
  times: number;
  values: number;
  points: number;
  rms: number | null;
  relative: number | null;
  peak: number | null;
  peak_time: number | null;
  reference_peak: number | null;
  reference_peak_time: number | null;
}

export interface Gauge {
  name: string;
  columns: ColumnInfo[];
  reference?: Reference;
}

export interface Field {
  name: string;
  unit: string;
  components: number;
  meaning: string;
}

export interface Part {
  group: number;
  count: number;
  ids: number;
  x: number;
  fields: Record<string, number>;
}

export interface FrameInfo {
  time: number;
  step: number;
  /** None yet where they are asked for one time after the other. */
  parts: Part[];
  /** Of all fluid particles, also of those that are not on the page: magnitude first, then each component; `inner`
   * leaves out the lowest and the highest hundredth. */
  ranges: Record<string, [low: number, high: number, innerLow: number, innerHigh: number][]>;
}

export interface Particles {
  dimensions: number;
  spacing: number;
  low: number[];
  high: number[];
  stored: number;
  shown: number;
  frames_stored: number;
  rounded: boolean;
  fields: Field[];
  frames: FrameInfo[];
}

export interface RunRecord {
  status?: string;
  case?: string;
  version?: string;
  resolved?: Record<string, string>;
  warnings?: string[];
  stages?: { name: string; reads: string; writes: string }[];
  threads?: number;
  machine?: Record<string, string | number>;
  particles?: Record<string, number>;
  time?: number;
  steps?: number;
  seconds?: Record<string, number>;
  particle_updates_per_s?: number;
  energy?: Record<string, number | null>;
}

export interface RunData {
  kind: "run";
  title: string;
  run: RunRecord;
  energies: ColumnInfo[];
  steps: ColumnInfo[];
  limiters: string[];
  gauges: Gauge[];
  particles: Particles | null;
  notes: string[];
  blocks: BlockInfo[];
  /** Of a run that goes on; its record is that of its start. */
  progress?: Progress | null;
}

export interface Verdict {
  name: string;
  rule?: string;
}

export interface Member {
  name: string;
  folder?: string;
  report?: string | null;
  axes: Record<string, number | string | boolean>;
  status: string;
  error?: string | null;
  seconds?: number | null;
  particles?: number | null;
  steps?: number | null;
  quantities: Record<string, number | null>;
  verdicts: Record<string, unknown>;
  published?: Record<string, number | string | null>;
  agrees?: Record<string, unknown>;
  reasons?: string[];
}

export interface Order {
  quantity: string;
  axis: string;
  group?: unknown;
  order: number | null;
}

export interface StudyData {
  kind: "study";
  title: string;
  study: {
    title?: string;
    file?: string;
    axes: { name: string; values: (number | string | boolean)[] }[];
    quantities: { name: string; unit?: string; meaning?: string }[];
    verdicts: Verdict[];
    members: Member[];
    orders?: Order[];
  };
  notes: string[];
  blocks: BlockInfo[];
}

export type PageData = RunData | StudyData;

/** Where the page takes its data from. */
export interface Source {
  data(): Promise<PageData>;
  block(number: number): Promise<Numbers>;
  /** A time with its parts, wherever they come from. */
  frame(particles: Particles, number: number): Promise<FrameInfo>;
  /** Where data come from a program that may tell more later. */
  live?: Live;
}

export type Numbers = Float64Array | Float32Array | Int32Array;

export interface Progress {
  time: number;
  end: number;
  step: number;
  rate: number;
  remaining_s: number;
  paused?: boolean;
}

export interface State {
  status: string;
  times: number[];
  progress: Progress | null;
  /** Whether this page may pause and stop the run. */
  control: boolean;
}

export type Wish = "run" | "pause" | "stop";

export interface Live {
  /** Whether the page goes on to each new snapshot. */
  follow: boolean;
  /** Particles of a frame at most. */
  most: number;
  state(): Promise<State>;
  wish(word: Wish): Promise<void>;
}

function bytesOf(base64: string): Uint8Array {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let k = 0; k < text.length; ++k) bytes[k] = text.charCodeAt(k);
  return bytes;
}

async function inflate(bytes: Uint8Array): Promise<Uint8Array> {
  const stream = new Blob([bytes as BlobPart]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Bytes of equal place lie together in the file; here they go back to their numbers. */
function unshuffle(bytes: Uint8Array, size: number): ArrayBuffer {
  const count = bytes.length / size;
  const out = new Uint8Array(bytes.length);
  for (let b = 0; b < size; ++b) for (let i = 0; i < count; ++i) out[i * size + b] = bytes[b * count + i];
  return out.buffer;
}

export async function decode(info: BlockInfo, text: () => string): Promise<Numbers> {
  const total = info.count * info.components;
  if (info.constant) {
    const out = info.type === "i32" ? new Int32Array(total) : info.type === "f64" ? new Float64Array(total) : new Float32Array(total);
    for (let i = 0; i < total; ++i) out[i] = info.constant[i % info.components] ?? NaN;
    return out;
  }
  const size = info.type === "f64" ? 8 : info.type === "u16" ? 2 : 4;
  const buffer = unshuffle(await inflate(bytesOf(text())), size);
  if (buffer.byteLength !== total * size) throw new Error(`a block holds ${buffer.byteLength} bytes instead of ${total * size}`);
  if (info.type === "f64") return new Float64Array(buffer);
  if (info.type === "f32") return new Float32Array(buffer);
  if (info.type === "i32") return new Int32Array(buffer);
  const codes = new Uint16Array(buffer);
  const out = new Float32Array(total);
  for (let i = 0; i < total; ++i) {
    const k = i % info.components, low = info.low![k], high = info.high![k];
    out[i] = codes[i] === 65535 ? NaN : low + ((high - low) * codes[i]) / 65534;
  }
  return out;
}

/** Data that lies in the page itself. */
export class EmbeddedSource implements Source {
  private infos: BlockInfo[] = [];
  private kept = new Map<number, Promise<Numbers>>();

  static present(): boolean {
    return document.getElementById("undine-data") !== null;
  }

  async data(): Promise<PageData> {
    const data = JSON.parse(document.getElementById("undine-data")!.textContent!) as PageData;
    this.infos = data.blocks;
    return data;
  }

  block(number: number): Promise<Numbers> {
    const old = this.kept.get(number);
    this.kept.delete(number);  // and in again below, as the newest
    const made = old ?? decode(this.infos[number], () => document.getElementById(`b${number}`)!.textContent!);
    this.kept.set(number, made);
    if (this.kept.size > 200) this.kept.delete(this.kept.keys().next().value!);
    return made;
  }

  async frame(particles: Particles, number: number): Promise<FrameInfo> {
    return particles.frames[number];
  }
}
