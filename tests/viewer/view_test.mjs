// Opens `undine view` in headless Chromium: of a run that ended, of one that goes on and may be controlled, and of one with
// more particles than a page asks for. Called by view_test.py:
//
//   node view_test.mjs CHROMIUM PLAN.json OUT
//
// PLAN.json: { finished, running, large: addresses, last: time of the last snapshot, id: a particle, many: how many large has }.
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
  assert.ok(await page.locator(".run-control").isHidden(), "what has ended cannot be controlled");
  await page.screenshot({ path: join(out, "view_finished.png") });

  // A sample at first; all when asked for.
  const shown = () => page.locator(".stage").evaluate((stage) => Number(stage.dataset.count));
  await open(plan.large);
  readings.sample = await shown();
  assert.ok(Math.abs(readings.sample - 200_000) < 2_000, `${readings.sample} of ${plan.many}`);
  await page.screenshot({ path: join(out, "view_sample.png") });
  await page.locator("select.most").selectOption("1000000");
  await page.waitForFunction((many) => Number(document.querySelector(".stage").dataset.count) === many, plan.many);
  await page.screenshot({ path: join(out, "view_all.png") });

  await open(plan.running);
  await page.waitForFunction(() => /^running: t = /.test(document.querySelector(".progress").innerText));
  const first = await shownTime();
  await page.waitForFunction((before) => Number(document.querySelector(".clock").dataset.time) > before, first);
  const text = await page.locator(".progress").innerText();
  assert.match(text, /M particle updates\/s, .* to go/);
  assert.ok((await page.locator(".u-wrap").count()) > 3, "charts are drawn while the run goes on");
  await page.screenshot({ path: join(out, "view_running.png") });

  // By keyboard alone: pause, resume, stop.
  const step = async () => Number(/step (\d+)/.exec(await page.locator(".progress").innerText())[1]);
  const says = (text) => page.waitForFunction((start) => document.querySelector(".progress").innerText.startsWith(start), text);
  await page.evaluate(() => scrollTo(0, 0));
  for (let k = 0; k < 20 && !(await page.evaluate(() => document.activeElement.matches(".pause"))); ++k) await page.keyboard.press("Tab");
  assert.ok(await page.evaluate(() => document.activeElement.matches(".pause")), "Tab reaches the run's controls");
  await page.keyboard.press("Enter");
  await says("paused: t = ");
  await page.waitForFunction(() => /Resume/.test(document.querySelector(".pause").innerText));
  const held = await step();
  await page.waitForTimeout(2500);
  assert.equal(await step(), held, "a paused run takes no step");
  await page.emulateMedia({ colorScheme: "dark" });
  await page.setViewportSize({ width: 400, height: 800 });
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), "no sideways scrolling at 400 px");
  await page.screenshot({ path: join(out, "view_paused_400_dark.png") });
  await page.keyboard.press(" ");
  await says("running: t = ");
  await page.waitForFunction((before) => Number(/step (\d+)/.exec(document.querySelector(".progress").innerText)[1]) > before, held);
  const other = await page.context().newPage();
  await other.goto(plan.running);
  await other.locator(".stage[data-count]").waitFor();
  await other.close();
  await page.waitForFunction((before) => Number(/step (\d+)/.exec(document.querySelector(".progress").innerText)[1]) > before, await step());
  page.once("dialog", (dialog) => dialog.dismiss());
  await page.keyboard.press("Tab");
  await page.keyboard.press("Enter");
  await page.waitForTimeout(1500);
  await says("running: t = ");
  page.once("dialog", (dialog) => dialog.accept());
  await page.keyboard.press("Enter");
  await says("interrupted: t = ");
  assert.ok(await page.locator(".run-control").isHidden());
  assert.deepEqual(complaints, [], "no page complains to its console");
  writeFileSync(join(out, "view_readings.json"), JSON.stringify(readings));
} catch (error) {
  await page.screenshot({ path: join(out, "view_failed.png") }).catch(() => {});
  console.error(error.stack, "\nconsole:", complaints);
  process.exitCode = 1;
} finally {
  await close();
}
