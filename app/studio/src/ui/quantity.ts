/** Numbers as people type and read them: `0.5`, `1e-3`, `pi/2`, `-3π/4`, `90°`, and a comma where they are used to it. */

/** What a number measures, rates of it included; `number` is all that has one unit for everybody, or none. */
export type Kind = "length" | "angle" | "number";

/** In what lengths and angles are shown and typed; calls, links and copies are always in metres and radians. */
export interface Units {
  millimetres: boolean;
  degrees: boolean;
}

/** Names of the units in the state, to watch. */
export const UNITS = ["millimetres", "degrees"] as const;
/** Which they are, without what else the holder of them has. */
export function chosenOf({ millimetres, degrees }: Units): Units {
  return { millimetres, degrees };
}

export function isSame(one: Units, other: Units): boolean {
  return UNITS.every((unit) => one[unit] === other[unit]);
}

/** As the service has them. */
export const SI: Units = { millimetres: false, degrees: false };

/** The kind of what is measured in a unit of the service: `m/s²` is one of length. */
export function kindOfUnit(unit: string): Kind {
  const [, kind] = /^(m|rad)(?:\/s[²³]?)?$/.exec(unit) ?? [];
  return kind === "m" ? "length" : kind === "rad" ? "angle" : "number";
}

/** The value in metres, radians or as it stands; null for what is no number. `units` are those of a bare number. */
export function parse(text: string, kind: Kind, units: Units): number | null {
  let rest = text.trim().toLowerCase().replaceAll("−", "-").replaceAll(",", ".");
  if (kind === "number") return product(rest)?.value ?? null;
  if (kind === "length") {
    const unit = /m?m$/.exec(rest)?.[0] ?? unitOf(kind, units);
    const found = product(rest.replace(/\s*m?m$/, ""))?.value ?? null;
    return found !== null && unit === "mm" ? shifted(found, -3) : found;
  }
  let unit: "deg" | "rad" | null = null;
  if (/(°|deg)$/.test(rest)) unit = "deg";
  else if (/rad$/.test(rest)) unit = "rad";
  rest = rest.replace(/\s*(°|deg|rad)$/, "");
  const found = product(rest);
  if (!found) return null;
  const isDegrees = unit === "deg" || (unit === null && units.degrees && !found.hasPi);
  return isDegrees ? (found.value * Math.PI) / 180 : found.value;
}

/** What a bare number is if it is one of degrees, [rad], where as one of radians it were more than a turn; else null. */
export function ifDegrees(text: string, units: Units): number | null {
  const [asRadians, asDegrees] = [false, true].map((degrees) => parse(text, "angle", { ...units, degrees }));
  const isBare = asRadians !== asDegrees;
  return !units.degrees && isBare && Math.abs(asRadians!) > 2 * Math.PI ? asDegrees! : null;
}

/** Numbers and π, multiplied and divided from left to right: `3*pi/4`, `3π/4`. */
function product(text: string): { value: number; hasPi: boolean } | null {
  const sign = text.startsWith("-") ? -1 : 1;
  const tokens = text.replace(/^[+-]/, "").match(/(\d+\.?\d*|\.\d+)(e[+-]?\d+)?|pi|π|[*/·]|\s+|./g);
  let value = sign;
  let operator = "*";
  let hasPi = false;
  let expectsNumber = true;
  for (const token of tokens ?? []) {
    if (/^\s+$/.test(token)) continue;
    if (/^[*/·]$/.test(token)) {
      if (expectsNumber) return null;
      operator = token;
      expectsNumber = true;
      continue;
    }
    const isPi = token === "pi" || token === "π";
    if (!expectsNumber && !isPi) return null;
    const number = isPi ? Math.PI : Number(token);
    if (!Number.isFinite(number)) return null;
    value = operator === "/" ? value / number : value * number;
    hasPi ||= isPi;
    operator = "*";
    expectsNumber = false;
  }
  return expectsNumber || !Number.isFinite(value) ? null : { value, hasPi };
}

/** The number to read, with so many decimals at most; a multiple of π as one. */
export function format(value: number, kind: Kind, units: Units, decimals = 4): string {
  const isInRadians = kind === "angle" && !units.degrees;
  const text = trimmed(inUnit(value, kind, units), decimalsIn(kind, units, decimals));
  return (isInRadians && multipleOfPi(value)) || text;
}

/** The number to edit: nothing of it is lost. */
export function exact(value: number, kind: Kind, units: Units): string {
  return (kind === "angle" && multipleOfPi(value)) || String(inUnit(value, kind, units));
}

/** The number with its unit: `0.35 m`, `30°`. */
export function measured(value: number, kind: Kind, units: Units, decimals = 4): string {
  return withUnit(format(value, kind, units, decimals), kind, units);
}

/** A written number with its unit behind it, and `/s` behind that. */
export function withUnit(text: string, kind: Kind, units: Units, per = ""): string {
  const unit = unitOf(kind, units) + per;
  return `${text}${unit === "" || unit === "°" ? "" : " "}${unit}`;
}

export function unitOf(kind: Kind, { millimetres, degrees }: Units): string {
  return { length: millimetres ? "mm" : "m", angle: degrees ? "°" : "rad", number: "" }[kind];
}

/** A unit of the service as the page has it: `m/s` is `mm/s` where lengths are in millimetres. */
export function shownUnit(unit: string, units: Units): string {
  const kind = kindOfUnit(unit);
  return kind === "number" ? unit : unit.replace(/^(m|rad)/, unitOf(kind, units));
}

/** The number in the unit that it is shown in. */
export function inUnit(value: number, kind: Kind, { millimetres, degrees }: Units): number {
  if (kind === "length" && millimetres) return shifted(value, 3);
  return kind === "angle" && degrees ? (value * 180) / Math.PI : value;
}

/** A number that is in the page's unit, as the service has it. */
export function fromUnit(value: number, kind: Kind, { millimetres, degrees }: Units): number {
  if (kind === "length" && millimetres) return shifted(value, -3);
  return kind === "angle" && degrees ? (value * Math.PI) / 180 : value;
}

/** With the point elsewhere: 0.1234 is 123.4 thousandths, which no product of doubles is exactly. */
function shifted(value: number, by: number): number {
  const [digits, exponent] = value.toExponential().split("e");
  return Number(`${digits}e${Number(exponent) + by}`);
}

/** As many decimals as show the same of a length or an angle in another unit, but one at least. */
function decimalsIn(kind: Kind, { millimetres, degrees }: Units, decimals: number): number {
  const fewer = kind === "length" && millimetres ? 3 : kind === "angle" && degrees ? 2 : 0;
  return fewer ? Math.max(decimals - fewer, 1) : decimals;
}

function trimmed(value: number, decimals: number): string {
  const text = value.toFixed(decimals).replace(/\.?0+$/, "");
  return (text === "-0" ? "0" : text).replace("-", "−");
}

/** `π/2` where the number is exactly the nearest double to it; null for other numbers and for zero. */
function multipleOfPi(value: number): string | null {
  for (const below of [1, 2, 3, 4, 6]) {
    const above = Math.round((value * below) / Math.PI);
    if (above === 0 || Math.abs(above) > 24 || (above * Math.PI) / below !== value) continue;
    const size = Math.abs(above) === 1 ? "π" : `${Math.abs(above)}π`;
    return `${above < 0 ? "−" : ""}${size}${below === 1 ? "" : `/${below}`}`;
  }
  return null;
}

/** A small number with its power of ten: `2.2·10⁻¹⁶`. */
export function scientific(value: number): string {
  if (value === 0) return "0";
  const [digits, exponent] = value.toExponential(1).split("e");
  const raised = [...exponent!.replace("+", "")].map((c) => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(c)])).join("");
  return `${digits}·10${raised}`;
}

/** A column of numbers: as many decimals each, a proper minus. */
export function fixed(value: number, decimals: number): string {
  const text = value.toFixed(decimals);
  return (Number(text) === 0 ? text.replace("-", "") : text).replace("-", "−");
}

/** A column of lengths or angles, in their unit. */
export function column(value: number, kind: Kind, units: Units, decimals: number): string {
  return fixed(inUnit(value, kind, units), decimalsIn(kind, units, decimals));
}

/** A measured number to read: three digits, with a power of ten where it is very small or large. */
export function rounded(value: number): string {
  if (value === 0) return "0";
  const size = Math.abs(value);
  const sign = value < 0 ? "−" : "";
  if (size < 1e-3 || size >= 1e5) return sign + scientific(size);
  return sign + (size >= 100 ? size.toFixed(0) : size.toPrecision(3));
}

/** A measured length to read, with its unit. */
export function lengthText(value: number, units: Units): string {
  return withUnit(rounded(inUnit(value, "length", units)), "length", units);
}

export function subscript(i: number): string {
  return [...String(i)].map((digit) => "₀₁₂₃₄₅₆₇₈₉"[Number(digit)]).join("");
}
