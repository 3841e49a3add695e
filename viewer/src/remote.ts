// Data that `undine view` sends when asked: all series at once, particles one time after the other.
import { decode, type BlockInfo, type FrameInfo, type Live, type Numbers, type PageData, type Particles, type Source, type State, type Wish } from "./data";

interface Answer {
  blocks: BlockInfo[];
  texts: string[];
}

const framesKept = 12;

async function answered(asked: Promise<Response>): Promise<Response> {
  const answer = await asked;
  if (!answer.ok) throw new Error(`${answer.status}: ${(await answer.text()).trim()}`);
  return answer;
}

export class RemoteSource implements Source {
  readonly live: Live;
  private next = 0;
  private kept = new Map<number, () => Promise<Numbers>>();
  private frames = new Map<string, { info: FrameInfo; blocks: number[] }>();
  private series: number[] = [];

  static present(): boolean {
    return document.getElementById("undine-live") !== null;
  }

  constructor() {
    const { follow } = JSON.parse(document.getElementById("undine-live")!.textContent!) as { follow: boolean };
    this.live = { follow, most: 200_000, state: () => this.ask<State>("state.json"), wish: (word) => this.wish(word) };
  }

  private async ask<T>(path: string): Promise<T> {
    return (await (await answered(fetch(path))).json()) as T;
  }

  private async wish(word: Wish): Promise<void> {
    await answered(fetch(`control?wish=${word}`, { method: "POST" }));
  }

  /** Keeps the blocks of an answer, and returns the number of its first one. */
  private keep({ blocks, texts }: Answer): number {
    const first = this.next;
    blocks.forEach((info, k) => {
      let made: Promise<Numbers> | null = null;
      this.kept.set(first + k, () => (made ??= decode(info, () => texts[k])));
    });
    this.next += blocks.length;
    return first;
  }

  async data(): Promise<PageData> {
    const data = await this.ask<PageData & Answer>("data.json");
    for (const number of this.series) this.kept.delete(number);
    const first = this.keep(data);
    this.series = data.blocks.map((_, k) => first + k);
    if (data.kind !== "run") return data;
    for (const column of [...data.energies, ...data.steps, ...data.gauges.flatMap((gauge) => gauge.columns)]) column.block += first;
    for (const { reference } of data.gauges) if (reference) [reference.times, reference.values] = [reference.times + first, reference.values + first];
    return data;
  }

  block(number: number): Promise<Numbers> {
    const made = this.kept.get(number);
    return made ? made() : Promise.reject(new Error(`block ${number} is gone`));
  }

  async frame(particles: Particles, number: number): Promise<FrameInfo> {
    const key = `${number}/${this.live.most}`;
    let found = this.frames.get(key);
    this.frames.delete(key);  // and in again below, as the newest
    if (!found) {
      const answer = await this.ask<Answer & { frame: FrameInfo }>(`frame.json?number=${number}&most=${this.live.most}`);
      const first = this.keep(answer);
      for (const part of answer.frame.parts) {
        part.ids += first;
        part.x += first;
        for (const name of Object.keys(part.fields)) part.fields[name] += first;
      }
      found = { info: answer.frame, blocks: answer.blocks.map((_, k) => first + k) };
    }
    this.frames.set(key, found);
    if (this.frames.size > framesKept) {
      const [oldest, gone] = this.frames.entries().next().value!;
      this.frames.delete(oldest);
      for (const block of gone.blocks) this.kept.delete(block);
    }
    particles.frames[number] = found.info;
    return found.info;
  }
}
