/** Counts of what a person waits for, and accessibility. Times are printed and judged by eye: a busy machine is no fault of the page. */
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { after, before, test } from "node:test";
import { ended, give, job, selfosc, type Served, serve } from "./server";

let served: Served;
before(async () => {
  served = await serve();
});
after(() => served.close());

const good = readFileSync(new URL("../../fixtures/pool/heading.csv", import.meta.url));

test("the module packed is below 1.2 MB", () => {
  assert.ok(statSync(new URL("../dist/selfosc.wasm.br", import.meta.url)).size < 1_200_000);
});

test("paint and first model", async (t) => {
  const { page } = await served.open();
  const paint = await page.evaluate(() => performance.getEntriesByName("first-contentful-paint")[0]?.startTime);
  await give(page, [{ name: "heading.csv", buffer: good }]);
  await give(page, [{ name: "heading.csv", buffer: good }]);
  t.diagnostic(`first paint ${paint?.toFixed(0)} ms; 496 samples: ${await page.textContent("#status")}`);
});

test("the page answers while the module works", async (t) => {
  const { page } = await served.open();
  const vehicle = ["--alpha", "1", "--beta-quadratic", "0.5", "--relay", "1", "--half-width", "0.3", "--hold", "--noise", "0.01", "--cycles", "1150"];
  const folder = mkdtempSync(`${tmpdir()}/selfosc-`);
  const long = execFileSync(selfosc, ["simulate", ...vehicle], { maxBuffer: 1e8 });
  writeFileSync(`${folder}/long.csv`, long);
  await page.evaluate(() => {
    const longest = ((globalThis as unknown as { longest: number }).longest = 0);
    let last = performance.now() + longest;
    const beat = () => {
      const now = performance.now();
      const state = globalThis as unknown as { longest: number };
      state.longest = Math.max(state.longest, now - last - 4);
      last = now;
      setTimeout(beat, 0);
    };
    beat();
  });
  // By its path, as a person does: bytes from here would be unpacked by the page.
  await page.setInputFiles("#file", `${folder}/long.csv`);
  await ended(page, 300_000);
  await page.waitForFunction(() => document.querySelectorAll(".plot canvas").length === 3);
  rmSync(folder, { recursive: true });
  const longest = await page.evaluate(() => (globalThis as unknown as { longest: number }).longest);
  t.diagnostic(`${long.toString().split("\n").length - 2} samples: ${await page.textContent("#status")}; longest pause of the page ${longest.toFixed(0)} ms`);
});

test("axe finds nothing serious", async () => {
  const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
  for (const colorScheme of ["light", "dark"] as const) {
    const { page } = await served.open({ colorScheme });
    await give(page, [{ name: "heading.csv", buffer: good }]);
    for (const name of ["identify", "autotune", "predict", "design"]) {
      if (name !== "identify") await job(page, name);
      // Through the debugger: the page's own policy lets no script in.
      const found = await page.evaluate(`${axe}; axe.run()`);
      const { violations } = found as { violations: { impact: string; id: string; nodes: { html: string }[] }[] };
      const serious = violations.filter(({ impact }) => impact === "serious" || impact === "critical");
      assert.deepEqual(serious.map(({ id, nodes }) => [name, colorScheme, id, nodes[0]?.html]), []);
    }
  }
});
