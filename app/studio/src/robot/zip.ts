/** Looks into a zip before it is sent: its text files, as far as they can be read; the service reads it by itself. */

const END = 22;
const LONGEST_COMMENT = 0xffff;
const MOST_FILES = 200;
/** Of all text together, [bytes]. */
const MOST_BYTES = 4 * 1024 * 1024;

interface Entry {
  name: string;
  isDeflated: boolean;
  size: number;
  at: number;
}

/** Texts by path of the files whose names are wanted, in the zip's order; none if it cannot be read. */
export async function textsOf(zip: Blob, wanted: RegExp): Promise<Map<string, string>> {
  const found = new Map<string, string>();
  try {
    let left = MOST_BYTES;
    for (const entry of (await entriesOf(zip)).filter(({ name }) => wanted.test(name)).slice(0, MOST_FILES)) {
      const content = await contentOf(zip, entry, left);
      left -= content.length;
      found.set(entry.name, new TextDecoder().decode(content));
    }
  } catch {
    return new Map();
  }
  return found;
}

async function entriesOf(zip: Blob): Promise<Entry[]> {
  const tail = await view(zip, Math.max(0, zip.size - END - LONGEST_COMMENT), zip.size);
  let end = tail.byteLength - END;
  while (tail.getUint32(end, true) !== 0x06054b50) end -= 1; // throws before the beginning
  const start = tail.getUint32(end + 16, true);
  const list = await view(zip, start, start + tail.getUint32(end + 12, true));
  const found: Entry[] = [];
  for (let at = 0; at < list.byteLength;) {
    const [name, extra, comment] = [28, 30, 32].map((offset) => list.getUint16(at + offset, true)) as [
      number,
      number,
      number,
    ];
    found.push({
      name: new TextDecoder().decode(new Uint8Array(list.buffer, at + 46, name)),
      isDeflated: list.getUint16(at + 10, true) === 8,
      size: list.getUint32(at + 20, true),
      at: list.getUint32(at + 42, true),
    });
    at += 46 + name + extra + comment;
  }
  return found;
}

/** Throws if it has more than so many bytes. */
async function contentOf(zip: Blob, { isDeflated, size, at }: Entry, most: number): Promise<Uint8Array> {
  const head = await view(zip, at, at + 30);
  const start = at + 30 + head.getUint16(26, true) + head.getUint16(28, true);
  const packed = zip.slice(start, start + size);
  const content = isDeflated ? packed.stream().pipeThrough(new DecompressionStream("deflate-raw")) : packed.stream();
  const reader = content.getReader();
  const pieces: Uint8Array<ArrayBuffer>[] = [];
  let count = 0;
  for (let piece = await reader.read(); !piece.done; piece = await reader.read()) {
    count += piece.value.length;
    if (count > most) throw new RangeError();
    pieces.push(piece.value);
  }
  return new Blob(pieces).bytes();
}

async function view(zip: Blob, start: number, end: number): Promise<DataView> {
  return new DataView(await zip.slice(start, end).arrayBuffer());
}
