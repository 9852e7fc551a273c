/** Animated GIF (the specification GIF89a): one palette for all pictures, and of each only what has changed. */

import { Bytes } from "./bytes.ts";
import { Palette, TRANSPARENT } from "./palette.ts";

/** Bits of a pixel. */
const DEPTH = 8;
const CLEAR = 1 << DEPTH;
const END = CLEAR + 1;
/** Codes have at most 12 bits. */
const WIDEST = 12;
const BLOCK = 255;

export { Palette };

export class Gif {
  #out = new Bytes();
  #shown: Uint8Array | null = null;

  /** @param delay between two pictures, [1/100 s]. */
  constructor(
    private readonly width: number,
    private readonly height: number,
    private readonly delay: number,
    private readonly palette: Palette,
  ) {
    // A palette of 2⁸ colours for all pictures, no ground of its own, square pixels; then: over and over.
    this.#out.text("GIF89a").short(width).short(height).push(0xf7, 0, 0).add(palette.bytes());
    this.#out.push(0x21, 0xff, 11).text("NETSCAPE2.0").push(3, 1, 0, 0, 0);
  }

  /** @param rgba the next picture, four bytes a pixel. */
  add(rgba: ArrayLike<number>): void {
    const pixels = this.palette.indices(rgba);
    const before = this.#shown;
    const changed = before ? pixels.map((index, i) => (index === before[i] ? TRANSPARENT : index)) : pixels;
    this.#shown = pixels;
    // It stays when the next one comes, and what is transparent shows the one before.
    this.#out.push(0x21, 0xf9, 4, 0b101).short(this.delay).push(TRANSPARENT, 0);
    this.#out.push(0x2c).short(0).short(0).short(this.width).short(this.height).push(0, DEPTH);
    const packed = compressed(changed);
    for (let start = 0; start < packed.length; start += BLOCK) {
      const block = packed.subarray(start, start + BLOCK);
      this.#out.push(block.length).add(block);
    }
    this.#out.push(0);
  }

  end(): Uint8Array<ArrayBuffer> {
    return this.#out.push(0x3b).all();
  }
}

/** LZW: codes for runs of pixels that have been seen, wider as there are more, and from the start when there are 2¹². */
export function compressed(pixels: Uint8Array): Uint8Array {
  const out = new Bytes();
  let codes = new Map<number, number>();
  let [next, width, held, bits] = [END + 1, DEPTH + 1, 0, 0];
  const emit = (code: number) => {
    held |= code << bits;
    for (bits += width; bits >= 8; bits -= 8, held >>>= 8) out.push(held & 255);
  };
  emit(CLEAR);
  let run = pixels[0]!;
  for (let i = 1; i < pixels.length; i += 1) {
    const longer = (run << DEPTH) | pixels[i]!;
    const known = codes.get(longer);
    if (known !== undefined) {
      run = known;
      continue;
    }
    emit(run);
    run = pixels[i]!;
    // Whoever reads is one code behind.
    if (next === 1 << width && width < WIDEST) width += 1;
    if (next < 1 << WIDEST) {
      codes.set(longer, next++);
      continue;
    }
    emit(CLEAR);
    codes = new Map();
    [next, width] = [END + 1, DEPTH + 1];
  }
  emit(run);
  if (next === 1 << width && width < WIDEST) width += 1;
  emit(END);
  if (bits) out.push(held & 255);
  return out.all();
}
