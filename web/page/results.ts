/** What the command's JSON documents say, for a person. */
import { copyable, h, table } from "./element";
import { type Estimate, interval, practical, significant, statistical } from "./numbers";

export interface Coded {
  code: string;
  text: string;
}

interface Reported {
  drag: string;
  trust: "good" | "widened" | "doubtful";
  reasons: Coded[];
  budget?: { source: string; size: number; unit: string; share_percent: number; remedy: string }[] | null;
  [parameter: string]: unknown;
}

export interface Identified {
  record: { samples: number; duration_s: number; cycles_used: number | null };
  reported: Reported | null;
  bounded: ({ verdict: string } & Record<string, unknown>) | null;
  warnings: Coded[];
  refused_methods: (Coded & { method: string })[];
  records: { file: string }[];
  units: Record<string, string>;
}

export interface Autotuned {
  trust: string;
  reasons: Coded[];
  models: { family: string; weight: number; parameters: Record<string, Estimate> }[];
  gains: { proportional: number; integral: number; derivative: number; filter_s: number } | null;
  /** The gains in the form asked for, to type. */
  lines: string | null;
  sensitivity: { limit: number; proved_upper: number | null };
  rules: { name: string; proportional: number; integral: number; derivative: number; sensitivity: number | null }[];
  curves: { time_s: number[]; load_step: number[]; load_step_range: [number, number][] } | null;
}

const PARAMETERS: [key: string, label: string, unit: string | null][] = [
  ["alpha", "inertia alpha", "alpha"],
  ["beta", "linear drag beta", "beta"],
  ["beta_quadratic", "quadratic drag", "beta_quadratic"],
  ["beta_cubic", "cubic drag", "beta_cubic"],
  ["skew", "drag's asymmetry", null],
  ["coulomb", "Coulomb friction", "delta"],
  ["stiffness", "stiffness", "stiffness"],
  ["memory", "fluid memory", "alpha"],
  ["memory_s", "its time (s)", null],
  ["lag_s", "lag (s)", null],
  ["ramp_s", "ramp (s)", null],
  ["filter_s", "sensor's filter (s)", null],
  ["delay_s", "delay (s)", null],
  ["delta", "constant force delta", "delta"],
];

const VERDICTS: Record<string, string> = {
  good: "Good: no test contradicts the model.",
  widened: "Usable: the intervals are wider for the reasons below.",
  doubtful: "Do not use these numbers: a test contradicts the model.",
};

export const reasons = (title: string, list: Coded[]): HTMLElement | null =>
  list.length === 0 ? null : h("section", {}, h("h3", {}, title), h("ul", {}, ...list.map(({ code, text }) => h("li", {}, h("code", {}, code), " ", text))));

export const verdict = (trust: string): HTMLElement => h("p", { class: `verdict ${trust}`, role: "status" }, VERDICTS[trust] ?? trust);

/** Verdict, parameters, budget and warnings of an identification. */
export function identified(found: Identified): (HTMLElement | null)[] {
  const { reported } = found;
  if (!reported) return [reasons("No model", found.refused_methods)];
  const rows = PARAMETERS.flatMap(([key, label, unit]) => {
    const estimate = reported[key] as Estimate | null | undefined;
    return estimate ? [[label, practical(estimate), estimate.combined ? statistical(estimate) : "", unit ? (found.units[unit] ?? "") : ""]] : [];
  });
  const combined = rows.some((row) => row[2] !== "");
  const head = combined ? ["parameter", "value, practical 95 %", "if the model is exact", "unit"] : ["parameter", "value, 95 %", "unit"];
  const budget = reported.budget ?? [];
  return [
    verdict(reported.trust),
    table(`Model with ${reported.drag} drag`, head, combined ? rows : rows.map(([name, value, , unit]) => [name!, value!, unit!])),
    budget.length > 0
      ? table("Budget: sources that the record cannot show", ["source", "size assumed", "share of alpha (%)", "what would lower it"], budget.map((row) => [row.source, `${significant(row.size, 3)} ${row.unit}`, significant(row.share_percent, 2), row.remedy]))
      : null,
    reasons("Why the answer is not simply good", reported.reasons),
    reasons("Warnings", found.warnings),
  ];
}

/** Guaranteed bounds. */
export function bounded(bounds: NonNullable<Identified["bounded"]>): HTMLElement[] {
  const rows = PARAMETERS.flatMap(([key, label]) => {
    const range = bounds[key];
    return Array.isArray(range) && range.length === 2 && range.every((end) => typeof end === "number") ? [[label, interval(range as [number, number])]] : [];
  });
  const text: Record<string, string> = {
    consistent: "Consistent: a motion of this model meets every reading; the parameters of every such motion lie in these bounds.",
    refuted: "Refuted: no motion of this model meets every reading.",
    undecided: "Undecided: the search ended before an answer.",
  };
  return [h("p", { class: `verdict ${bounds.verdict}`, role: "status" }, text[bounds.verdict] ?? bounds.verdict), table("Guaranteed bounds", ["parameter", "bounds"], rows)];
}

/** Gains to type, how sure they are, and the rules of thumb beside them. */
export function autotuned(found: Autotuned): (HTMLElement | null)[] {
  const { sensitivity, models } = found;
  const best = models[0];
  return [
    verdict(found.trust),
    found.lines === null ? h("p", {}, "No gains in this form: choose another.") : copyable("Type into your controller:", found.lines),
    sensitivity.proved_upper === null
      ? null
      : h("p", {}, `Proved: the sensitivity of every process of the confidence set is at most ${significant(sensitivity.proved_upper, 4)}. 1.4 is well damped; above 2 it rings.`),
    reasons("Why the answer is not simply good", found.reasons),
    best ? table(`Process: ${best.family}, ${significant(100 * best.weight, 3)} % of the evidence`, ["parameter", "value, 95 %"], Object.entries(best.parameters).map(([name, estimate]) => [name.replaceAll("_", " "), statistical(estimate)])) : null,
    table(
      "Rules of thumb on the likeliest process",
      ["rule", "Kp", "Ki", "Kd", "sensitivity"],
      found.rules.map((rule) => [rule.name, significant(rule.proportional), significant(rule.integral), significant(rule.derivative), significant(rule.sensitivity, 3)]),
    ),
  ];
}
