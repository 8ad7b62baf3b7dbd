/** The page in a browser beside the command on this machine: the same numbers, whatever the log. */
import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { mkdirSync, readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { promisify } from "node:util";
import { give, job, selfosc, type Served, serve } from "./server";

const root = new URL("../../", import.meta.url).pathname;
const shots = process.env.SCREENSHOTS;
const log = (path: string) => readFileSync(root + path);

/** Relative. Both have the same elementary functions; the compilers' order of operations may differ in last digits. */
const SAME = 1e-12;

let served: Served;
before(async () => {
  served = await serve();
});
after(() => served.close());

/** The command's own document. */
async function said(args: string[]): Promise<unknown> {
  const { stdout } = await promisify(execFile)(selfosc, args, { cwd: root, maxBuffer: 1 << 28 }).catch((error: { stdout: string }) => error);
  return JSON.parse(stdout);
}

function same(page: unknown, command: unknown, at = ""): void {
  if (typeof page === "number" && typeof command === "number") {
    assert.ok(Math.abs(page - command) <= SAME * Math.abs(command), `${at}: ${page} in the page, ${command} by the command`);
  } else if (page !== null && typeof page === "object" && command !== null && typeof command === "object") {
    assert.deepEqual(Object.keys(page), Object.keys(command), at);
    for (const [key, value] of Object.entries(command)) if (key !== "file" && key !== "name") same((page as Record<string, unknown>)[key], value, `${at}.${key}`);
  } else assert.equal(page, command, at);
}

/** Pixels of a plot that have a colour of its curves. */
const drawn = (page: import("playwright-core").Page, plot: number, colour: readonly [number, number, number]): Promise<number> =>
  page.evaluate(
    ([plot, colour]) => {
      const canvas = document.querySelectorAll<HTMLCanvasElement>(".plot canvas")[plot]!;
      const { data } = canvas.getContext("2d")!.getImageData(0, 0, canvas.width, canvas.height);
      let count = 0;
      for (let at = 0; at < data.length; at += 4) if (data[at + 3] === 255 && colour.every((value, part) => Math.abs(data[at + part]! - value) < 12)) count++;
      return count;
    },
    [plot, colour] as const,
  );

/** What a button saves. */
async function saved(page: import("playwright-core").Page, label: string): Promise<string> {
  const [download] = await Promise.all([page.waitForEvent("download"), page.click(`text=${label}`)]);
  return readFileSync((await download.path())!, "utf8");
}

test("the pool log gives the command's model, its report and a controller", async () => {
  const { page, foreign, faults } = await served.open();
  await give(page, [{ name: "heading.csv", buffer: log("fixtures/pool/heading.csv") }]);
  assert.match(await page.textContent("#results .verdict") ?? "", /Good/);
  same(JSON.parse(await saved(page, "Numbers (JSON)")), await said(["identify", "fixtures/pool/heading.csv", "--json"]));
  assert.equal(await page.locator(".plot canvas").count(), 3);
  for (const [plot, colour] of [[0, [194, 65, 12]], [1, [91, 104, 117]], [2, [11, 92, 173]]] as const) {
    assert.ok((await drawn(page, plot, colour)) > 100, `plot ${plot} is empty`);
  }
  const samples = await saved(page, "Samples (CSV)");
  assert.equal(samples.trimEnd().split("\n").length, 497);
  const report = await saved(page, "Report (HTML)");
  assert.match(report, /<svg/);
  await page.click("button:text-is('Tune')");
  await page.waitForSelector("text=/at most 1\\.(799|800)/");
  await page.selectOption("#tune-format", "ardusub");
  await page.click("form:has(#tune-format) button[type=submit]");
  await page.waitForSelector("text=ATC_RAT_YAW_P");
  assert.deepEqual([foreign, faults], [[], []]);
});

test("guaranteed bounds on demand are the command's, and can be cancelled", async () => {
  const { page, faults } = await served.open();
  const buffer = log("fixtures/pool/heading.csv");
  await page.click("summary");
  await page.selectOption("#identify-drag", "mixed");
  await give(page, [{ name: "heading.csv", buffer }]);
  await page.click("text=Guaranteed bounds");
  await page.click("#cancel");
  await page.waitForSelector("text=Cancelled");
  await page.click("text=Guaranteed bounds");
  await page.waitForSelector(".consistent, .refuted, .undecided", { timeout: 120_000 });
  const command = (await said(["identify", "fixtures/pool/heading.csv", "--drag", "mixed", "--method", "bounded", "--json"])) as { bounded: { verdict: string } };
  assert.equal(await page.locator(`.verdict.${command.bounded.verdict}`).count(), 1);
  assert.deepEqual(faults, []);
});

test("a heater's relay log gives the command's gains, to be typed into a firmware", async () => {
  const { page, foreign, faults } = await served.open();
  await job(page, "autotune");
  await give(page, [{ name: "heater.csv", buffer: log("fixtures/heater.csv") }]);
  same(JSON.parse(await saved(page, "Numbers (JSON)")), await said(["autotune", "fixtures/heater.csv", "--json"]));
  await page.click("summary");
  await page.selectOption("#autotune-form", "klipper");
  await page.click("button.run");
  await page.waitForSelector("text=pid_Kp");
  assert.match(page.url(), /#job=autotune&form=klipper$/);
  assert.deepEqual([foreign, faults], [[], []]);
});

test("the remedies of damaged logs are buttons", async () => {
  const { page, faults } = await served.open();
  for (const [path, remedy, flag] of [
    ["web/tests/logs/sign.csv", "Command logged with the opposite sign", "--invert"],
    ["web/tests/logs/time-goes-back.csv", "Samples evenly spaced", "--even-stamps"],
    ["web/tests/logs/time-goes-back.csv", "Leave out rows without three numbers", "--skip-bad-rows"],
  ] as const) {
    await page.goto("about:blank");
    await page.goto(served.url);
    await give(page, [{ name: "log.csv", buffer: log(path) }]);
    const refusal = await page.textContent("#results .verdict");
    assert.match(refusal ?? "", new RegExp(flag));
    await page.click(`#results button:has-text("${remedy}")`);
    await page.waitForSelector("text=Numbers (JSON)", { timeout: 60_000 });
    same(JSON.parse(await saved(page, "Numbers (JSON)")), await said(["identify", path, flag, "--json"]));
    assert.match(page.url(), new RegExp(`${flag.slice(2)}=true`));
  }
  assert.deepEqual(faults, []);
});

test("a log whose command was written slowly gives the command's answer", async () => {
  const { page, faults } = await served.open();
  const path = "web/tests/logs/command-logged-slowly.csv";
  await give(page, [{ name: "log.csv", buffer: log(path) }]);
  same(JSON.parse(await saved(page, "Numbers (JSON)")), await said(["identify", path, "--json"]));
  assert.deepEqual(faults, []);
});

test("an oscillation is predicted and an experiment designed without a log", async () => {
  const { page, faults } = await served.open();
  await job(page, "predict");
  for (const [flag, value] of [["alpha", "1"], ["beta-quadratic", "0.5"], ["relay", "1"], ["half-width", "0.3"]] as const) await page.fill(`#predict-${flag}`, value);
  await page.click("button.run");
  await page.waitForSelector("text=5.210");
  await page.fill("#predict-alpha", "-1");
  await page.click("button.run");
  await page.waitForSelector(".doubtful:has-text('alpha')");
  await job(page, "design");
  for (const [flag, value] of [["alpha", "1"], ["beta-quadratic", "0.5"], ["delay", "0.1"], ["level", "1"], ["time", "60"], ["quantum", "0.0175"]] as const) await page.fill(`#design-${flag}`, value);
  await page.click("button.run");
  await page.waitForSelector("#results pre");
  assert.deepEqual(faults, []);
});

test("a link holds the settings and no log", async () => {
  const { page } = await served.open();
  await page.goto(`${served.url}#job=identify&delay=0.2&invert=true`);
  await page.reload();
  assert.equal(await page.inputValue("#identify-delay"), "0.2");
  assert.ok(await page.isChecked("#identify-invert"));
  await page.goto(`${served.url}#job=<img src=x onerror=alert(1)>&delay=<script>`);
  await page.reload();
  assert.equal(await page.inputValue("#identify-delay"), "<script>");
});

test("screenshots", { skip: !shots }, async () => {
  mkdirSync(shots!, { recursive: true });
  for (const colorScheme of ["light", "dark"] as const)
    for (const width of [360, 768, 1280]) {
      const { page } = await served.open({ viewport: { width, height: 900 }, colorScheme });
      await give(page, [{ name: "heading.csv", buffer: log("fixtures/pool/heading.csv") }]);
      await page.waitForTimeout(300);
      await page.screenshot({ path: `${shots}/identify-${width}-${colorScheme}.png`, fullPage: true });
      await job(page, "autotune");
      await give(page, [{ name: "heater.csv", buffer: log("fixtures/heater.csv") }]);
      await page.screenshot({ path: `${shots}/autotune-${width}-${colorScheme}.png`, fullPage: true });
      assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${width} px: the page is wider than the window`);
    }
});
