/** NumPy's own format, as the service sends it: tables of doubles, row by row. */

export interface Table {
  rows: number;
  columns: number;
  /** Row by row. */
  values: Float64Array;
}

const MAGIC = "\x93NUMPY";

/** Throws where the bytes are no table of little-endian doubles. */
export function readTable(bytes: ArrayBuffer): Table {
  const view = new DataView(bytes);
  const text = (from: number, count: number) => String.fromCharCode(...new Uint8Array(bytes, from, count));
  if (bytes.byteLength < 12 || text(0, MAGIC.length) !== MAGIC) throw new Error("this is no npy file");
  const isFirst = view.getUint8(6) === 1;
  const start = isFirst ? 10 : 12;
  const length = isFirst ? view.getUint16(8, true) : view.getUint32(8, true);
  const header = text(start, length);
  const shape = /'shape': \((\d+), (\d+)\)/.exec(header);
  if (!header.includes("'descr': '<f8'") || !header.includes("'fortran_order': False") || !shape)
    throw new Error(`this npy file is no table of doubles, row by row: ${header.trim()}`);
  const [rows, columns] = [Number(shape[1]), Number(shape[2])];
  return { rows, columns, values: new Float64Array(bytes, start + length, rows * columns) };
}
