// Opens `undine view` in headless Chromium, of a run that ended and of one that goes on. Called by view_test.py:
//
//   node view_test.mjs CHROMIUM PLAN.json OUT
//
// PLAN.json: { finished, running: addresses, last: time of the last snapshot, id: a particle }.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { openBrowser } from "./browser.mjs";

const [, , executablePath, planFile, out] = process.argv;
const plan = JSON.parse(readFileSync(planFile, "utf8"));
const readings = {};
const { page, complaints, close } = await openBrowser(executablePath, {});

const shownTime = () => page.locator(".clock").evaluate((element) => Number(element.dataset.time));
async function open(address) {
  await page.goto(address);
  await page.locator("#page[data-ready=true]").waitFor();
  await page.waitForFunction(() => document.querySelector(".clock")?.dataset.time !== undefined);
}

try {
  await open(plan.finished);
  await page.locator(".time input").focus();
  await page.keyboard.press("End");
  await page.waitForFunction((wanted) => Number(document.querySelector(".clock").dataset.time) === wanted, plan.last);
  await page.getByLabel("Particle", { exact: true }).fill(String(plan.id));
  await page.keyboard.press("Enter");
  readings.pressure = JSON.parse(await page.locator(".values dd[data-name=p]").getAttribute("data-value"));
  assert.match(await page.locator(".progress").innerText(), /^finished: t = /);
  await page.screenshot({ path: join(out, "view_finished.png") });

  await open(plan.running);
  await page.waitForFunction(() => /^running: t = /.test(document.querySelector(".progress").innerText));
  const first = await shownTime();
  await page.waitForFunction((before) => Number(document.querySelector(".clock").dataset.time) > before, first);
  const text = await page.locator(".progress").innerText();
  assert.match(text, /M particle updates\/s, .* to go/);
  assert.ok((await page.locator(".u-wrap").count()) > 3, "charts are drawn while the run goes on");
  await page.screenshot({ path: join(out, "view_running.png") });
  assert.deepEqual(complaints, [], "no page complains to its console");
  writeFileSync(join(out, "view_readings.json"), JSON.stringify(readings));
} catch (error) {
  await page.screenshot({ path: join(out, "view_failed.png") }).catch(() => {});
  console.error(error.stack, "\nconsole:", complaints);
  process.exitCode = 1;
} finally {
  await close();
}
