/** Numbers as people type and read them: `0.5`, `1e-3`, `pi/2`, `-3π/4`, `90°`, and a comma where they are used to it. */

/** What a number measures, rates of it included; `number` is all that has one unit for everybody, or none. */
export type Kind = "length" | "angle" | "number";

/** The kind of what is measured in a unit of the service: `m/s²` is one of length. */
export function kindOfUnit(unit: string): Kind {
  const [, kind] = /^(m|rad)(?:\/s[²³]?)?$/.exec(unit) ?? [];
  return kind === "m" ? "length" : kind === "rad" ? "angle" : "number";
}

/** The value in metres, radians or as it stands; null for what is no number. `degrees`: whether a bare number is one of degrees. */
export function parse(text: string, kind: Kind, degrees: boolean): number | null {
  let rest = text.trim().toLowerCase().replaceAll("−", "-").replaceAll(",", ".");
  if (kind !== "angle") {
    const value = product(kind === "length" ? rest.replace(/\s*m$/, "") : rest);
    return value?.value ?? null;
  }
  let unit: "deg" | "rad" | null = null;
  if (/(°|deg)$/.test(rest)) unit = "deg";
  else if (/rad$/.test(rest)) unit = "rad";
  rest = rest.replace(/\s*(°|deg|rad)$/, "");
  const found = product(rest);
  if (!found) return null;
  const isDegrees = unit === "deg" || (unit === null && degrees && !found.hasPi);
  return isDegrees ? (found.value * Math.PI) / 180 : found.value;
}

/** What a bare number is if it is one of degrees, [rad], where as one of radians it were more than a turn; else null. */
export function ifDegrees(text: string, degrees: boolean): number | null {
  const [asRadians, asDegrees] = [parse(text, "angle", false), parse(text, "angle", true)];
  const isBare = asRadians !== asDegrees;
  return !degrees && isBare && Math.abs(asRadians!) > 2 * Math.PI ? asDegrees : null;
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
export function format(value: number, kind: Kind, degrees: boolean, decimals = 4): string {
  if (kind !== "angle") return trimmed(value, decimals);
  if (degrees) return trimmed((value * 180) / Math.PI, Math.max(decimals - 2, 1));
  return multipleOfPi(value) ?? trimmed(value, decimals);
}

/** The number to edit: nothing of it is lost. */
export function exact(value: number, kind: Kind, degrees: boolean): string {
  if (kind !== "angle") return String(value);
  return multipleOfPi(value) ?? (degrees ? String((value * 180) / Math.PI) : String(value));
}

export function unitOf(kind: Kind, degrees: boolean): string {
  return { length: "m", angle: degrees ? "°" : "rad", number: "" }[kind];
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

/** A measured number to read: three digits, with a power of ten where it is very small or large. */
export function rounded(value: number): string {
  if (value === 0) return "0";
  const size = Math.abs(value);
  const sign = value < 0 ? "−" : "";
  if (size < 1e-3 || size >= 1e5) return sign + scientific(size);
  return sign + (size >= 100 ? size.toFixed(0) : size.toPrecision(3));
}

export function subscript(i: number): string {
  return [...String(i)].map((digit) => "₀₁₂₃₄₅₆₇₈₉"[Number(digit)]).join("");
}
