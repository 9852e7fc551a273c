/** A scale of colours for numbers: even steps in OKLab, in which equal distances look equally large. */

const LIGHTNESS = [0.4, 0.9] as const;
const HUE = [310, 100] as const; // from violet over teal to yellow, in degrees
const CHROMA = 0.11; // as much as sRGB has all the way

/** The colour of a share between 0 and 1, as linear sRGB. */
export function shade(share: number): [number, number, number] {
  const t = Math.min(1, Math.max(0, share));
  const between = ([from, to]: readonly [number, number]) => from + (to - from) * t;
  const hue = (between(HUE) * Math.PI) / 180;
  return fromOklab(between(LIGHTNESS), CHROMA * Math.cos(hue), CHROMA * Math.sin(hue));
}

/** Ottosson's matrices: from OKLab to the responses of the cones, and from these to linear sRGB. */
function fromOklab(L: number, a: number, b: number): [number, number, number] {
  const long = (L + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const middle = (L - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const short = (L - 0.0894841775 * a - 1.291485548 * b) ** 3;
  return [
    4.0767416621 * long - 3.3077115913 * middle + 0.2309699292 * short,
    -1.2684380046 * long + 2.6097574011 * middle - 0.3413193965 * short,
    -0.0041960863 * long - 0.7034186147 * middle + 1.707614701 * short,
  ];
}
