// Opens reports in headless Chromium and reads them as a person would. Called by report_test.py:
//
//   node browser_test.mjs CHROMIUM PLAN.json OUT
//
// PLAN.json: { flat, spatial, study: paths of reports, id, times }. Writes OUT/readings.json and screenshots. Fails on any
// error that a page writes to its console.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { openBrowser } from "./browser.mjs";

const [, , executablePath, planFile, out] = process.argv;
const plan = JSON.parse(readFileSync(planFile, "utf8"));
const readings = {};
const { page, complaints, close } = await openBrowser(executablePath, { offline: true });

const picture = (name) => page.screenshot({ path: join(out, `${name}.png`) });
const settled = () => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 60)))));
const canvasBytes = async () => { await settled(); return (await page.locator(".stage").screenshot()).toString("base64"); };
const legend = () => page.locator(".legend").evaluate((element) => ({ low: Number(element.dataset.low), high: Number(element.dataset.high), text: element.innerText, label: element.ariaLabel }));
const shownTime = () => page.locator(".clock").evaluate((element) => Number(element.dataset.time));
const fits = () => page.evaluate(() => document.documentElement.scrollWidth <= innerWidth);

async function open(file) {
  await page.goto(`file://${file}`);
  await page.locator("#page[data-ready=true]").waitFor();
  await settled();
}

async function timeIs(time) {
  await page.waitForFunction((wanted) => Math.abs(Number(document.querySelector(".clock").dataset.time) - wanted) < 1e-12, time);
  await settled();
}

async function chosenParticle(id) {
  await page.getByLabel("Particle", { exact: true }).fill(String(id));
  await page.keyboard.press("Enter");
  await page.locator(".values dd[data-name=x]").waitFor();
  return page.locator(".values dd[data-name]").evaluateAll((all) => Object.fromEntries(all.map((dd) => [dd.dataset.name, { values: JSON.parse(dd.dataset.value), text: dd.innerText }])));
}

try {
  // A run in a plane: numbers, slider, fields, ranges, keys, pictures.
  await open(plan.flat);
  await picture("flat");
  readings.title = await page.title();
  readings.charts = await page.locator(".chart h3").allInnerTexts();
  assert.equal(await page.locator(".u-wrap").count(), readings.charts.length, "every chart is drawn");
  assert.equal(await shownTime(), plan.times[0]);
  readings.first = await legend();
  const before = await canvasBytes();
  await page.locator(".time input").focus();
  await page.keyboard.press("End");
  await timeIs(plan.times.at(-1));
  assert.notEqual(await canvasBytes(), before, "the last time looks other than the first");
  readings.particle = await chosenParticle(plan.id);
  await page.locator("select.field").selectOption("p/0");
  await settled();
  readings.pressure = await legend();
  await page.locator("select.range").selectOption("now");
  await settled();
  readings.pressureNow = await legend();
  await page.locator("select.range").selectOption("inner");
  await settled();
  readings.pressureInner = await legend();
  await page.locator("select.field").selectOption("v/1");
  await page.locator("select.map").selectOption("blue_red");
  await settled();
  readings.signed = await legend();
  await picture("flat_signed");
  await page.getByLabel("lowest colour").fill("-1");
  await page.keyboard.press("Enter");
  await page.getByLabel("highest colour").fill("2");
  await page.keyboard.press("Enter");
  await settled();
  readings.typed = await legend();
  assert.equal(await page.locator("select.range").inputValue(), "own");

  // By keyboard alone: from the top to the particles by Tab, then keys.
  await page.evaluate(() => { document.activeElement.blur(); scrollTo(0, 0); });
  for (let k = 0; k < 60 && !(await page.evaluate(() => document.activeElement.classList.contains("stage"))); ++k) await page.keyboard.press("Tab");
  assert.ok(await page.evaluate(() => document.activeElement.classList.contains("stage")), "Tab reaches the particles");
  const straight = await canvasBytes();
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("+");
  assert.notEqual(await canvasBytes(), straight, "arrow keys and plus change the view");
  await page.keyboard.press("r");
  assert.equal(await canvasBytes(), straight, "R brings the view back");
  await page.keyboard.press(",");
  await timeIs(plan.times.at(-2));
  await page.keyboard.press(" ");
  await page.waitForFunction((at) => Number(document.querySelector(".clock").dataset.time) !== at, plan.times.at(-2));
  await page.keyboard.press(" ");
  assert.match(await page.locator(".time button").innerText(), /Play/);
  await page.keyboard.press("Tab");
  assert.ok(await page.evaluate(() => document.activeElement.matches(".time button")), "Play comes next");
  const plot = page.locator(".plot").first();
  await plot.focus();
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("ArrowRight");
  assert.notEqual(await plot.locator(".u-value").nth(0).innerText(), "--", "arrow keys read values from a chart");

  // A click chooses the particle under it.
  await page.locator(".time input").fill("0");
  await timeIs(plan.times[0]);
  await page.getByLabel("Particle", { exact: true }).fill("");
  await page.keyboard.press("Enter");
  await page.locator(".stage").evaluate((stage) => stage.scrollIntoView({ block: "center" }));
  await settled();
  const box = await page.locator(".stage > canvas").boundingBox();
  search: for (let i = 1; i < 20; ++i) for (let j = 1; j < 12; ++j) {
    await page.mouse.click(box.x + (box.width * i) / 20, box.y + (box.height * j) / 12);
    if ((await page.getByLabel("Particle", { exact: true }).inputValue()) !== "") break search;
  }
  assert.notEqual(await page.getByLabel("Particle", { exact: true }).inputValue(), "", "a click chooses a particle");

  const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "Screenshot" }).click()]);
  await download.saveAs(join(out, "flat_download.png"));

  // Other readers: dark, and narrow.
  await page.emulateMedia({ colorScheme: "dark" });
  await settled();
  await picture("flat_dark");
  assert.ok(await page.evaluate(() => /rgb\((\d+), /.exec(getComputedStyle(document.body).backgroundColor)[1] < 60), "dark paper in dark mode");
  await page.emulateMedia({ colorScheme: "light" });
  await page.setViewportSize({ width: 400, height: 800 });
  await settled();
  assert.ok(await fits(), "no sideways scrolling at 400 px");
  await page.screenshot({ path: join(out, "flat_400.png"), fullPage: true });
  await page.setViewportSize({ width: 1280, height: 900 });
  await page.screenshot({ path: join(out, "flat_full.png"), fullPage: true });

  // A run in space: turning and cutting.
  await open(plan.spatial);
  await picture("spatial");
  const whole = await canvasBytes();
  await page.locator(".stage").focus();
  await page.keyboard.press("ArrowRight");
  const turned = await canvasBytes();
  assert.notEqual(turned, whole, "arrow keys turn the view");
  await page.locator("select.clip").selectOption("1/-1");
  assert.notEqual(await canvasBytes(), turned, "cutting changes the view");
  await page.locator("select.walls").selectOption("hidden");
  await picture("spatial_cut");

  // A study.
  await open(plan.study);
  await picture("study");
  readings.rows = await page.locator("#members tbody tr").count();
  readings.links = await page.locator("#members tbody a").evaluateAll((all) => [...new Set(all.map((a) => a.getAttribute("href")))]);
  readings.verdicts = await page.locator("#members .good, #members .bad").count();
  readings.studyCharts = await page.locator(".chart h3").allInnerTexts();
  readings.orderLines = await page.locator(".u-label").evaluateAll((all) => all.map((label) => label.innerText).filter((text) => text.startsWith("order")));
  await page.setViewportSize({ width: 400, height: 800 });
  await settled();
  assert.ok(await fits(), "no sideways scrolling at 400 px");
  await page.setViewportSize({ width: 1280, height: 900 });
  await page.locator("#members tbody a").first().click();
  await page.locator("#page[data-ready=true] .stage").waitFor();

  assert.deepEqual(complaints, [], "no page complains to its console");
  writeFileSync(join(out, "readings.json"), JSON.stringify(readings, null, 1));
} catch (error) {
  await page.screenshot({ path: join(out, "failed.png") }).catch(() => {});
  console.error(error.stack, "\nconsole:", complaints);
  process.exitCode = 1;
} finally {
  await close();
}
