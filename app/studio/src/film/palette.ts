/** 255 colours for pictures that have more: Heckbert's median cut, of how often each colour is there. */

import { Bytes } from "./bytes.ts";

const COLOURS = 255;
/** The index after them is what is not drawn. */
export const TRANSPARENT = COLOURS;
/** Bits of red, green and blue by which colours are counted as one. */
const FINE = 5;
const ROUGH = 8 - FINE;
const CELLS = 1 << (3 * FINE);

type Colour = readonly [number, number, number];

/** Colours that are counted as one: how many there are, and their mean. */
interface Cell {
  count: number;
  mean: Colour;
}

export class Palette {
  #colours: Colour[];
  /** By cell, where it has been looked up; the rest is -1. */
  #nearest = new Int16Array(CELLS).fill(-1);

  /** @param pictures some of those that are to be drawn, four bytes a pixel. */
  constructor(pictures: readonly ArrayLike<number>[]) {
    this.#colours = cut(counted(pictures)).map(mean);
  }

  /** Three bytes a colour, 256 of them. */
  bytes(): Uint8Array {
    const out = new Bytes();
    for (const colour of this.#colours) out.add(colour.map(Math.round));
    return out.add(new Uint8Array(3 * (COLOURS + 1) - out.length)).all();
  }

  /** The nearest colour to each pixel. */
  indices(rgba: ArrayLike<number>): Uint8Array {
    const out = new Uint8Array(rgba.length / 4);
    for (let i = 0; i < out.length; i += 1) {
      const [r, g, b] = [rgba[4 * i]!, rgba[4 * i + 1]!, rgba[4 * i + 2]!];
      const cell = cellOf(r, g, b);
      if (this.#nearest[cell]! < 0) this.#nearest[cell] = this.#find([r, g, b]);
      out[i] = this.#nearest[cell]!;
    }
    return out;
  }

  #find(wanted: Colour): number {
    const distances = this.#colours.map((colour) => colour.reduce((sum, part, i) => sum + (part - wanted[i]!) ** 2, 0));
    return distances.indexOf(Math.min(...distances));
  }
}

function cellOf(r: number, g: number, b: number): number {
  return ((r >> ROUGH) << (2 * FINE)) | ((g >> ROUGH) << FINE) | (b >> ROUGH);
}

function counted(pictures: readonly ArrayLike<number>[]): Cell[] {
  const counts = new Uint32Array(CELLS);
  const sums = new Float64Array(3 * CELLS);
  for (const rgba of pictures) {
    for (let i = 0; i < rgba.length; i += 4) {
      const cell = cellOf(rgba[i]!, rgba[i + 1]!, rgba[i + 2]!);
      counts[cell]! += 1;
      for (let part = 0; part < 3; part += 1) sums[3 * cell + part]! += rgba[i + part]!;
    }
  }
  const used = [...counts.keys()].filter((cell) => counts[cell]);
  return used.map((cell) => {
    const [r, g, b] = sums.subarray(3 * cell, 3 * cell + 3).map((sum) => sum / counts[cell]!);
    return { count: counts[cell]!, mean: [r!, g!, b!] };
  });
}

/** Boxes of colours: again and again the one whose colours differ most is cut in two, where half of its pixels are. */
function cut(cells: Cell[]): Cell[][] {
  const boxes = [cells];
  while (boxes.length < COLOURS) {
    const spreads = boxes.map(spread);
    const widest = spreads.reduce((best, { width }, i) => (width > spreads[best]!.width ? i : best), 0);
    if (spreads[widest]!.width === 0) break;
    const { part } = spreads[widest]!;
    const sorted = boxes[widest]!.toSorted((a, b) => a.mean[part]! - b.mean[part]!);
    const half = sorted.reduce((sum, { count }) => sum + count, 0) / 2;
    let [size, reached] = [1, sorted[0]!.count];
    while (reached < half && size < sorted.length - 1) reached += sorted[size++]!.count;
    boxes.splice(widest, 1, sorted.slice(0, size), sorted.slice(size));
  }
  return boxes;
}

/** How far apart a box's colours are, and in which of red, green and blue; 0 where there is nothing to cut. */
function spread(box: Cell[]): { part: number; width: number } {
  const widths = [0, 1, 2].map((part) => {
    const values = box.map((cell) => cell.mean[part]!);
    return values.length > 1 ? Math.max(...values) - Math.min(...values) : 0;
  });
  const width = Math.max(...widths);
  return { part: widths.indexOf(width), width };
}

function mean(box: Cell[]): Colour {
  const count = box.reduce((sum, cell) => sum + cell.count, 0);
  const part = (i: number) => box.reduce((sum, cell) => sum + cell.count * cell.mean[i]!, 0) / count;
  return [part(0), part(1), part(2)];
}
