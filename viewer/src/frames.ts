// One time of a run as flat arrays, the parts of its groups one after the other.
import type { Field, FrameInfo, Particles, Source } from "./data";

export interface Frame {
  info: FrameInfo;
  count: number;
  ids: Int32Array;
  position: Float32Array;
  /** 0 fluid, 1 wall. */
  group: Float32Array;
}

async function joined(source: Source, frame: FrameInfo, components: number, blockOf: (part: FrameInfo["parts"][0]) => number | undefined): Promise<Float32Array> {
  const total = frame.parts.reduce((sum, part) => sum + part.count, 0);
  const out = new Float32Array(total * components).fill(NaN);
  let at = 0;
  for (const part of frame.parts) {
    const block = blockOf(part);
    if (block !== undefined) out.set(await source.block(block), at);
    at += part.count * components;
  }
  return out;
}

export async function loadFrame(source: Source, particles: Particles, number: number): Promise<Frame> {
  const info = await source.frame(particles, number);
  const n = particles.dimensions;
  const flat = await joined(source, info, n, (part) => part.x);
  const count = flat.length / n;
  const position = new Float32Array(3 * count);
  for (let i = 0; i < count; ++i) for (let k = 0; k < n; ++k) position[3 * i + k] = flat[n * i + k];
  const ids = new Int32Array(count);
  const group = new Float32Array(count);
  let at = 0;
  for (const part of info.parts) {
    ids.set((await source.block(part.ids)) as Int32Array, at);
    group.fill(part.group, at, at + part.count);
    at += part.count;
  }
  return { info, count, ids, position, group };
}

/** All components of a field. */
export const loadField = (source: Source, frame: Frame, field: Field): Promise<Float32Array> =>
  joined(source, frame.info, field.components, (part) => part.fields[field.name]);

/** What can be shown of a field as one number: itself, or its magnitude (0) and components (1, 2, ...). */
export function scalarsOf(field: Field): { part: number; text: string }[] {
  if (field.components === 1) return [{ part: 0, text: field.name }];
  const axes = ["x", "y", "z"];
  const side = Math.sqrt(field.components);
  const name = (k: number) =>
    field.components <= 3 ? axes[k] : Number.isInteger(side) && side <= 3 ? axes[Math.floor(k / side)] + axes[k % side] : String(k + 1);
  return [{ part: 0, text: `|${field.name}|` }, ...Array.from({ length: field.components }, (_, k) => ({ part: k + 1, text: `${field.name}_${name(k)}` }))];
}

export function scalar(values: Float32Array, components: number, part: number): Float32Array {
  if (components === 1) return values;
  const out = new Float32Array(values.length / components);
  for (let i = 0; i < out.length; ++i) {
    if (part > 0) {
      out[i] = values[i * components + part - 1];
    } else {
      let sum = 0;
      for (let k = 0; k < components; ++k) sum += values[i * components + k] ** 2;
      out[i] = Math.sqrt(sum);
    }
  }
  return out;
}

/** The range over the fluid, at one time or at all; `inner`: without the lowest and the highest hundredth. */
export function rangeOf(frames: FrameInfo[], field: string, part: number, inner: boolean): [number, number] {
  let low = Infinity, high = -Infinity;
  for (const frame of frames) {
    const range = frame.ranges[field]?.[part];
    if (!range || range[0] === null) continue;
    low = Math.min(low, range[inner ? 2 : 0]);
    high = Math.max(high, range[inner ? 3 : 1]);
  }
  return low <= high ? [low, high] : [0, 1];
}
