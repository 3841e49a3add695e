// Headless Chromium with a profile of its own, and what its pages complain of.
import { mkdtempSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";

const { chromium } = createRequire(new URL("../../viewer/package.json", import.meta.url))("playwright-core");

/** `more`: options of the context. `complaints` gathers errors and warnings that pages write to their console. */
export async function openBrowser(executablePath, more) {
  const profile = mkdtempSync(join(tmpdir(), "undine_browser_"));
  const context = await chromium.launchPersistentContext(profile, {
    executablePath, headless: true, acceptDownloads: true, viewport: { width: 1280, height: 900 }, reducedMotion: "reduce",
    args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
      "--disable-component-update", "--disable-sync", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
    ...more,
  });
  const page = await context.newPage();
  page.setDefaultTimeout(150_000);  // drawing without a graphics card, on a machine that does other things too
  const complaints = [];
  // WebGL says how slow reading its pixels is; that is the screenshots' doing.
  const expected = /GPU stall|software WebGL/i;
  page.on("console", (message) => {
    if (message.type() === "error" || (message.type() === "warning" && !expected.test(message.text()))) complaints.push(message.text());
  });
  page.on("pageerror", (error) => complaints.push(String(error)));
  const close = async () => {
    await context.close();
    rmSync(profile, { recursive: true, force: true });
  };
  return { page, complaints, close };
}
