/** Labels where they can be read: none covers another. */

/** A label where it belongs: its upper left corner and its size, [px]. */
export interface Box {
  x: number;
  y: number;
  width: number;
  height: number;
}

type Shift = readonly [number, number];

/** Shifts to try, in widths and heights of a label; a little more than one, so that two do not touch. */
const WIDTHS = [0, -0.55, 0.55, -1.1, 1.1];
const HEIGHTS = [0, -1.1, 1.1, -2.2, 2.2];
/** What is farther away than this would be taken for another thing's label, [px]. */
const FARTHEST = 48;
const STEPS = HEIGHTS.flatMap((dy) => WIDTHS.map((dx) => [dx, dy] as const));

/** How far each label moves so that it covers none before it, [px]: as little as will do; null where there is no room. */
export function placed(boxes: readonly Box[]): (Shift | null)[] {
  const taken: Box[] = [];
  return boxes.map((box) => {
    const all = STEPS.map(([dx, dy]): Shift => [dx * box.width, dy * box.height]);
    const shifts = all.filter((shift) => Math.hypot(...shift) <= FARTHEST);
    shifts.sort((a, b) => Math.hypot(...a) - Math.hypot(...b));
    for (const shift of shifts) {
      const moved = { ...box, x: box.x + shift[0], y: box.y + shift[1] };
      if (taken.some((other) => overlap(moved, other))) continue;
      taken.push(moved);
      return shift;
    }
    return null;
  });
}

function overlap(a: Box, b: Box): boolean {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

const SHIFTS = new WeakMap<HTMLElement, Shift>();

/** Place the labels of a host, whose transforms say where they belong: what is pointed at or differs first, then the short ones,
 * names of links last. */
export function arrange(host: HTMLElement): void {
  const labels = [...(host.children as HTMLCollectionOf<HTMLElement>)].flatMap((element) => {
    const { x, y, width, height } = element.getBoundingClientRect();
    const [dx, dy] = SHIFTS.get(element) ?? [0, 0];
    const isFirst = element.classList.contains("lit") || element.classList.contains("apart");
    const rank = Number(element.classList.contains("link")) - Number(isFirst);
    return width > 0 ? [{ element, rank, box: { x: x - dx, y: y - dy, width, height } }] : [];
  });
  labels.sort((a, b) => a.rank - b.rank || a.box.width - b.box.width);
  const shifts = placed(labels.map(({ box }) => box));
  for (const [i, { element }] of labels.entries()) {
    const shift = shifts[i] ?? [0, 0];
    SHIFTS.set(element, shift);
    element.style.translate = `${shift[0]}px ${shift[1]}px`;
    element.style.visibility = shifts[i] ? "" : "hidden";
  }
}
