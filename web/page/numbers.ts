/** Numbers as a person prints them. */

/** A value with its error, as the command's JSON has it. */
export interface Estimate {
  value: number;
  std: number | null;
  low: number | null;
  high: number | null;
  combined?: { std: number | null; low: number | null; high: number | null } | null;
}

const minus = (text: string) => text.replaceAll("-", "\u2212");

/** With so many significant digits. */
export function significant(value: number | null | undefined, digits = 4): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "\u2013";
  const text = value.toPrecision(digits);
  return minus(text.includes("e") ? text : String(Number(text)));
}

/** Value and half-width to two digits of the half-width: `0.0330 ± 0.0004 (1.2 %)`. */
export function uncertain(value: number, low: number | null, high: number | null): string {
  if (low === null || high === null) return significant(value);
  const half = (high - low) / 2;
  if (!(half > 0)) return significant(value);
  const place = Math.floor(Math.log10(half)) - 1;
  const digits = Math.min(Math.max(-place, 0), 100);
  const share = Math.abs(half / value);
  const percent = share < 1 ? ` (${significant(100 * share, 2)} %)` : "";
  if (place > 4 || digits > 9) return minus(`${value.toExponential(Math.max(0, Math.floor(Math.log10(Math.abs(value))) - place))} \u00b1 ${half.toExponential(1)}${percent}`);
  return minus(`${value.toFixed(digits)} \u00b1 ${half.toFixed(digits)}${percent}`);
}

/** The practical interval where there is one, else the statistical one. */
export const practical = ({ value, low, high, combined }: Estimate) => uncertain(value, combined?.low ?? low, combined?.high ?? high);
export const statistical = ({ value, low, high }: Estimate) => uncertain(value, low, high);
export const interval = ([low, high]: [number, number]) => `${significant(low, 6)} to ${significant(high, 6)}`;
