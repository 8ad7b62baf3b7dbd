/** Which samples of a long record are drawn. */

/** More readings than these are drawn as a line, points would hide each other; and of each part of a view the extremes alone. */
export const MOST_POINTS = 3000;

/** Of the samples in view every one (`whole`), or the extremes of all curves in each of `parts`: a line through them looks the same. The
 * record's ends stay, so that a double click finds them. A value that is NaN is no extreme. */
export function inView(time: ArrayLike<number>, curves: { values: ArrayLike<number> }[], from: number, to: number, parts: number): { kept: number[]; whole: boolean } {
  const before = (limit: number) => {
    let [low, high] = [0, time.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (time[middle]! < limit) low = middle + 1;
      else high = middle;
    }
    return low;
  };
  const [first, last] = [Math.max(before(from) - 1, 0), Math.min(before(to) + 1, time.length)];
  const kept = new Set([0, first, last - 1, time.length - 1]);
  const whole = last - first <= MOST_POINTS;
  const size = whole ? 1 : (last - first) / parts;
  for (let start = first; start < last; start += size) {
    const [begin, end] = [Math.floor(start), Math.min(Math.floor(start + size), last)];
    kept.add(begin);
    for (const { values } of whole ? [] : curves) {
      let [least, most, low, high] = [begin, begin, Infinity, -Infinity];
      for (let k = begin; k < end; k++) {
        if (values[k]! < low) low = values[(least = k)]!;
        if (values[k]! > high) high = values[(most = k)]!;
      }
      kept.add(least).add(most);
    }
  }
  return { kept: [...kept].sort((a, b) => a - b), whole };
}
