/** Samples that are drawn, against a search of all. */
import assert from "node:assert/strict";
import { test } from "node:test";
import { inView, MOST_POINTS } from "../page/in_view";

const time = Float64Array.from({ length: 20_000 }, (_, k) => 0.1 * k);
const values = Float64Array.from(time, (t, k) => (k % 7 === 0 ? NaN : Math.sin(t) + 0.1 * Math.sin(77 * t)));
[values[12_344], values[12_345], values[12_346]] = [5, NaN, -7];
const extremes = (list: number[]) => [Math.min, Math.max].map((of) => of(...list.map((k) => values[k]!).filter((value) => !Number.isNaN(value))));
const all = (from: number, to: number) => [...time.keys()].filter((k) => time[k]! >= from && time[k]! <= to);

test("a far view has the extremes of every part, few samples, and the ends", () => {
  const parts = 100;
  for (const [from, to] of [[-Infinity, Infinity], [300, 1500]] as const) {
    const { kept, whole } = inView(time, [{ values }], from, to, parts);
    assert.equal(whole, false);
    assert.ok(kept.length <= 3 * parts + 7 && kept[0] === 0 && kept.at(-1) === time.length - 1);
    assert.ok(kept.every((k, index) => index === 0 || kept[index - 1]! < k));
    assert.deepEqual(extremes(kept.filter((k) => time[k]! >= from && time[k]! <= to)), extremes(all(from, to)));
  }
});

test("a close view has every sample, and one beyond on either side", () => {
  const { kept, whole } = inView(time, [{ values }], 1200, 1260, 100);
  assert.ok(whole && 600 < MOST_POINTS);
  const seen = all(1200, 1260);
  const around = [seen[0]! - 1, ...seen];
  assert.deepEqual(kept.filter((k) => k !== 0 && k !== time.length - 1).slice(0, around.length), around);
  assert.ok(kept.length <= seen.length + 4);
});
