/** Logs and names that no page should be given: each is refused by name, nothing of it is executed, and the page goes on. */
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { give, type Served, serve } from "./server";

let served: Served;
before(async () => {
  served = await serve();
});
after(() => served.close());

const good = readFileSync(new URL("../../fixtures/pool/heading.csv", import.meta.url));
const bytes = (count: number, of: (index: number) => number) => Buffer.from(Uint8Array.from({ length: count }, (_, index) => of(index) & 255));
const rows = (header: string, row: (index: number) => string, count = 200) => Buffer.from([header, ...Array.from({ length: count }, (_, index) => row(index))].join("\n"));
const script = "<script>alert(1)</script>";
const image = "<img src=x onerror=alert(1)>";

/** Contents that no identification can use. */
const contents: [string, Buffer][] = [
  ["empty", Buffer.alloc(0)],
  ["one byte", Buffer.from("a")],
  ["nulls", Buffer.alloc(10_000)],
  ["random bytes", bytes(100_000, (index) => (index * 2654435761) >> 7)],
  ["all bytes", bytes(65_536, (index) => index)],
  ["a picture's head", Buffer.concat([Buffer.from("\x89PNG\r\n\x1a\n", "latin1"), bytes(5000, (index) => index * 31)])],
  ["a module", Buffer.concat([Buffer.from("\0asm\x01\0\0\0", "latin1"), bytes(5000, (index) => index)])],
  ["markup as header", rows(`time_s,${script},${image}`, (index) => `${index},1,1`)],
  ["markup as values", rows("time_s,output,input", (index) => `${index},${script},${image}`)],
  ["markup alone", Buffer.from(script.repeat(1000))],
  ["a page", Buffer.from(`<!doctype html><body onload=alert(1)>${script}</body>`)],
  ["10000 columns", rows(Array.from({ length: 10_000 }, (_, index) => `c${index}`).join(","), () => "1,".repeat(9_999) + "1", 20)],
  ["a line of 5 MB", Buffer.from("x".repeat(5_000_000))],
  ["50 MB", Buffer.from("time_s,output,input\n" + "0,0,0\n".repeat(8_300_000))],
  ["header alone", Buffer.from("time_s,output,input\n")],
  ["one row", Buffer.from("time_s,output,input\n0,0,0\n")],
  ["text for numbers", rows("time_s,output,input", () => "a,b,c")],
  ["infinities", rows("time_s,output,input", (index) => `${index},inf,-inf`)],
  ["not a number", rows("time_s,output,input", (index) => `${index},NaN,NaN`)],
  ["huge numbers", rows("time_s,output,input", (index) => `${index},1e308,${index % 2 ? "1e308" : "-1e308"}`)],
  ["tiny numbers", rows("time_s,output,input", (index) => `${index},1e-320,${index % 2 ? "1e-320" : "-1e-320"}`)],
  ["time stands", rows("time_s,output,input", () => "0,1,1")],
  ["time goes back", rows("time_s,output,input", (index) => `${-index},1,1`)],
  ["constant command", rows("time_s,output,input", (index) => `${index},${Math.sin(index)},1`)],
  ["no answer", rows("time_s,output,input", (index) => `${index},0,${index % 20 < 10 ? 1 : -1}`)],
  ["quotes", rows('time_s,"output,input', (index) => `"${index},1`)],
  ["deep JSON", Buffer.from("[".repeat(100_000))],
  ["formulas", rows("time_s,output,input", () => "=1+1,@SUM(1),+cmd|' /C calc'!A0")],
  ["other alphabets", rows("время,выход,вход", (index) => `${index},1,1`)],
  ["marks of direction", rows("time_s,\u202eoutput\u202c,input", (index) => `${index},1,1`)],
];
/** Names of files, each with a content that can be identified. */
const names = [
  `${script}.csv`,
  `${image}.csv`,
  "--help",
  "--report=x.html",
  "-",
  "-rf",
  "..",
  ".",
  "...csv",
  "samples.csv",
  "report.html",
  "model.json",
  "a\u202evsc.csv",
  "a\tb.csv",
  "a b c.csv",
  "CON",
  "%2e%2e%2f.csv",
  "${alert(1)}.csv",
  "{{7*7}}.csv",
  "javascript:alert(1)",
  "' onmouseover=alert(1) '.csv",
  '"><svg onload=alert(1)>.csv',
  "x".repeat(240) + ".csv",
  "\u{1f4a5}.csv",
  "журнал.csv",
  "a\nb.csv",
  "a;b|c&d.csv",
  "__proto__",
  "constructor",
  "toString",
];

test("sixty hostile logs and names", { timeout: 600_000 }, async () => {
  const { page, foreign, faults } = await served.open();
  for (const [name, buffer] of contents) {
    await give(page, [{ name: "log.csv", buffer }], 120_000);
    const said = (await page.textContent("#results .verdict")) ?? "";
    assert.ok(said.length > 10, `${name}: ${said}`);
    assert.ok(!(await page.locator("text=Numbers (JSON)").count()) || /Do not use|wider/.test(said), `${name} was answered: ${said}`);
    assert.ok(!/stopped/.test(said), `${name} ended the module: ${said}`);
  }
  for (const name of names) {
    await give(page, [{ name, buffer: good }]);
    assert.match((await page.textContent("#results .verdict")) ?? "", /Good/, name);
  }
  assert.equal(contents.length + names.length, 60);
  assert.equal(await page.locator("#results script, #results img, #logs img, #logs svg, #logs script").count(), 0);
  assert.deepEqual([foreign, faults], [[], []]);
});

test("a module that stops is said and started afresh", async () => {
  served.breakModule();
  const { page } = await served.open();
  await give(page, [{ name: "log.csv", buffer: good }]);
  assert.match((await page.textContent("#results .verdict")) ?? "", /stopped and was started afresh/);
  await give(page, [{ name: "log.csv", buffer: good }]);
  assert.match((await page.textContent("#results .verdict")) ?? "", /Good/);
});
