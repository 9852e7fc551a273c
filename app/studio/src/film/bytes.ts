/** Bytes that grow: of files that are written in the page. */

export class Bytes {
  #held = new Uint8Array(1 << 12);
  #length = 0;

  get length(): number {
    return this.#length;
  }

  push(...values: number[]): this {
    this.#reserve(values.length);
    for (const value of values) this.#held[this.#length++] = value;
    return this;
  }

  add(values: ArrayLike<number>): this {
    this.#reserve(values.length);
    this.#held.set(values, this.#length);
    this.#length += values.length;
    return this;
  }

  text(ascii: string): this {
    return this.add([...ascii].map((letter) => letter.charCodeAt(0)));
  }

  /** Two bytes, the low one first. */
  short(value: number): this {
    return this.push(value & 255, value >> 8);
  }

  all(): Uint8Array<ArrayBuffer> {
    return this.#held.slice(0, this.#length);
  }

  #reserve(more: number): void {
    if (this.#length + more <= this.#held.length) return;
    const held = new Uint8Array(Math.max(2 * this.#held.length, this.#length + more));
    held.set(this.#held);
    this.#held = held;
  }
}
