// Pausing, resuming and stopping a run that was started with --control.
import type { Live, State, Wish } from "./data";
import { h } from "./dom";

const patience = 5000;  // ms until a wish that had no effect may be given again

export class RunControl {
  readonly element: HTMLElement;
  private pauseButton = h("button", { type: "button", class: "pause", click: () => void this.send(this.paused ? "run" : "pause") });
  private stopButton = h("button", { type: "button", class: "stop", click: () => this.askToStop() }, "■ Stop run");
  private message = h("span", { role: "status" });
  private paused = false;
  private sent: { wish: Wish; at: number } | null = null;

  constructor(private live: Live) {
    this.element = h("div", { class: "run-control", role: "group", "aria-label": "Control of the run", hidden: true }, this.pauseButton, this.stopButton, this.message);
    this.show();
  }

  /** Takes up what the run last said. */
  update(state: State): void {
    this.element.hidden = !state.control;
    this.paused = state.progress?.paused ?? false;
    if (this.sent && (this.sent.wish === (this.paused ? "pause" : "run") || Date.now() - this.sent.at > patience)) {
      this.sent = null;
      this.message.textContent = this.paused ? "The run is paused." : "";
    }
    this.show();
  }

  private show(): void {
    const text = this.paused ? "▶ Resume run" : "❚❚ Pause run";
    if (this.pauseButton.textContent !== text) this.pauseButton.textContent = text;
    // Not `disabled`, which would take the focus away.
    for (const button of [this.pauseButton, this.stopButton]) button.setAttribute("aria-disabled", String(this.sent !== null));
  }

  private askToStop(): void {
    if (confirm("Stop the run? It writes a checkpoint and ends; undine run with --resume goes on from there.")) void this.send("stop");
  }

  private async send(wish: Wish): Promise<void> {
    if (this.sent) return;
    this.sent = { wish, at: Date.now() };
    this.message.textContent = "The run will hear of it within a step.";
    this.show();
    try {
      await this.live.wish(wish);
    } catch (error) {
      this.sent = null;
      this.message.textContent = (error as Error).message;
      this.show();
    }
  }
}
