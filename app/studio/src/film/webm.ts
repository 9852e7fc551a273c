/** WebM (Matroska's elements, RFC 9559) around pictures that the browser has compressed. */

export interface Picture {
  /** When it is shown, [ms]. */
  time: number;
  /** Whether it needs no other one. */
  isKey: boolean;
  data: Uint8Array;
}

type Part = Uint8Array;

/** A file of one track; its first picture is a key. @param duration [ms]. */
export function webm(
  codec: "V_VP8" | "V_VP9",
  width: number,
  height: number,
  duration: number,
  pictures: readonly Picture[],
): Blob {
  const head = element(
    0x1a45dfa3,
    ...[element(0x4286, number(1)), element(0x42f7, number(1)), element(0x42f2, number(4))],
    ...[element(0x42f3, number(8)), element(0x4282, ascii("webm")), element(0x4287, number(4))],
    element(0x4285, number(2)),
  );
  // Times are in units of 10⁶ ns.
  const info = element(
    0x1549a966,
    ...[element(0x2ad7b1, number(1_000_000)), element(0x4489, float(duration))],
    ...[element(0x4d80, ascii("Gelenk")), element(0x5741, ascii("Gelenk"))],
  );
  const video = element(0xe0, element(0xb0, number(width)), element(0xba, number(height)));
  const track = element(
    0xae,
    ...[element(0xd7, number(1)), element(0x73c5, number(1)), element(0x83, number(1)), element(0x9c, number(0))],
    ...[element(0x86, ascii(codec)), video],
  );
  const clusters: { time: number; parts: Part[] }[] = [];
  for (const { time, isKey, data } of pictures) {
    if (isKey) clusters.push({ time, parts: element(0xe7, number(time)) });
    const { time: start, parts } = clusters.at(-1)!;
    const after = time - start;
    parts.push(...element(0xa3, [bytes(0x81, after >> 8, after, isKey ? 0x80 : 0), data]));
  }
  const body = [...info, ...element(0x1654ae6b, track)];
  const cues: Part[] = [];
  for (const { time, parts } of clusters) {
    const place = element(0xb7, element(0xf7, number(1)), element(0xf1, number(size(body))));
    cues.push(...element(0xbb, element(0xb3, number(time)), place));
    body.push(...element(0x1f43b675, parts));
  }
  return new Blob([...head, ...element(0x18538067, body, element(0x1c53bb6b, cues))] as BlobPart[], {
    type: "video/webm",
  });
}

/** Its name, the length of its content in eight bytes, and the content. */
function element(name: number, ...content: Part[][]): Part[] {
  const inside = content.flat();
  const length = number(size(inside), 8)[0]!;
  length[0] = 1;
  return [...number(name), length, ...inside];
}

/** As few bytes as it needs, the highest first, or as many as wanted. */
function number(value: number, wanted = 0): [Part] {
  const digits: number[] = [];
  for (let rest = value; rest > 0 || digits.length < (wanted || 1); rest = Math.floor(rest / 256))
    digits.unshift(rest % 256);
  return [bytes(...digits)];
}

function float(value: number): Part[] {
  const part = new Uint8Array(8);
  new DataView(part.buffer).setFloat64(0, value);
  return [part];
}

function ascii(text: string): Part[] {
  return [bytes(...[...text].map((letter) => letter.charCodeAt(0)))];
}

function bytes(...values: number[]): Part {
  return Uint8Array.from(values);
}

function size(parts: readonly Part[]): number {
  return parts.reduce((sum, { length }) => sum + length, 0);
}
