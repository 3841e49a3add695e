// The page of a run or of a study, from the data that the program put into it.
import "./style.css";
import { EmbeddedSource, type Source } from "./data";
import { h } from "./dom";
import { RemoteSource } from "./remote";
import { runPage } from "./run_page";
import { studyPage } from "./study_page";

async function start(): Promise<void> {
  const page = document.getElementById("page")!;
  try {
    const source: Source | null = RemoteSource.present() ? new RemoteSource() : EmbeddedSource.present() ? new EmbeddedSource() : null;
    if (!source) throw new Error("it holds no data; `undine report DIR` writes pages that do");
    const data = await source.data();
    await (data.kind === "study" ? studyPage(page, data, source) : runPage(page, data, source));
  } catch (error) {
    page.replaceChildren(h("p", { class: "note warning" }, `This page cannot be shown: ${(error as Error).message}`));
    throw error;
  }
}

void start();
