/** A mechanism as it is edited: named links, the first of them at rest, and the pairs between them. */

import type { MobilityRequest } from "../../types.ts";
import type { Inputs } from "./calculator.ts";

export interface Pair {
  link_a: string;
  link_b: string;
  type: string;
  name?: string;
  joint?: string;
  point?: number[];
  axis?: number[];
}

type Space = NonNullable<MobilityRequest["space"]>;

/** With the letter that stands in the picture. */
export const TYPES: Record<Space, Readonly<Record<string, string>>> = {
  planar: {
    revolute: "R",
    prismatic: "P",
    rolling: "rolling",
    pin_in_slot: "slot",
    cam: "cam",
    gear: "gear",
    fixed: "fixed",
  },
  spatial: {
    revolute: "R",
    prismatic: "P",
    screw: "H",
    universal: "U",
    cylindrical: "C",
    spherical: "S",
    planar: "E",
    sphere_in_groove: "groove",
    point_contact: "point",
    fixed: "fixed",
  },
};
const LONG: Readonly<Record<string, string>> = {
  R: "revolute",
  P: "prismatic",
  H: "screw",
  U: "universal",
  C: "cylindrical",
  S: "spherical",
  E: "planar",
};
const ALONG = new Set(["prismatic", "pin_in_slot", "cam", "gear"]);
const APART = 0.4;

/** A pair's kind by its name, where the letter is given. */
export function kindOf({ type }: Pair): string {
  return LONG[type] ?? type;
}

/** The names of the links; none where the request has only their number. */
export function linksOf(inputs: Inputs): string[] {
  const { links } = inputs;
  if (!Array.isArray(links)) return [];
  return links.map((link: unknown) =>
    String(typeof link === "object" && link ? (link as { name?: unknown }).name : link),
  );
}

export function pairsOf(inputs: Inputs): Pair[] {
  const { pairs } = inputs;
  const isPair = (one: unknown): one is Pair => typeof one === "object" && one !== null && "link_a" in one;
  return Array.isArray(pairs) ? pairs.filter(isPair) : [];
}

/** Whether links and pairs are named, so that they can be edited; else there are only their numbers. */
export function isNamed(inputs: Inputs): boolean {
  return Array.isArray(inputs["links"]) && Array.isArray(inputs["pairs"]);
}

export function spaceOf(inputs: Inputs): Space {
  return inputs["space"] === "spatial" ? "spatial" : "planar";
}

/** Whether all pairs say where they are. */
export function isPlaced(inputs: Inputs): boolean {
  const pairs = pairsOf(inputs);
  return pairs.length > 0 && pairs.every(({ point }) => Array.isArray(point));
}

export function withLink(inputs: Inputs): Inputs {
  const names = linksOf(inputs);
  let number = names.length + 1;
  while (names.includes(`link ${number}`)) number += 1;
  return { ...inputs, links: [...(inputs["links"] as unknown[]), `link ${number}`] };
}

/** Without a link, and without its pairs. */
export function withoutLink(inputs: Inputs, link: string): Inputs {
  const links = (inputs["links"] as unknown[]).filter((_, i) => linksOf(inputs)[i] !== link);
  return {
    ...inputs,
    links,
    pairs: pairsOf(inputs).filter(({ link_a, link_b }) => link_a !== link && link_b !== link),
  };
}

/** A revolute pair between the last two links, beside the last pair. */
export function withPair(inputs: Inputs): Inputs {
  const [names, pairs] = [linksOf(inputs), pairsOf(inputs)];
  const made: Pair = { link_a: names.at(-2) ?? names[0]!, link_b: names.at(-1)!, type: "revolute" };
  const [x = 0, y = 0] = pairs.at(-1)?.point ?? [];
  const placed = pairs.length === 0 ? spaceOf(inputs) === "planar" : isPlaced(inputs);
  return { ...inputs, pairs: [...pairs, placed ? { ...made, point: [x + APART, y, 0] } : made] };
}

export function withoutPair(inputs: Inputs, index: number): Inputs {
  return { ...inputs, pairs: pairsOf(inputs).filter((_, i) => i !== index) };
}

/** A pair changed; one that slides in the plane gets a direction, one that turns has none. */
export function withPairChanged(inputs: Inputs, index: number, change: Partial<Pair>): Inputs {
  const pairs = pairsOf(inputs).map((pair, i) => (i === index ? dressed({ ...pair, ...change }) : pair));
  return { ...inputs, pairs };
}

function dressed(pair: Pair): Pair {
  const { axis, ...rest } = pair;
  if (!pair.point || !ALONG.has(kindOf(pair))) return rest;
  return { ...rest, axis: axis ?? [1, 0, 0] };
}

/** In the other space: pairs that it does not have become revolute; only in the plane are they somewhere. */
export function inSpace(inputs: Inputs, space: Space): Inputs {
  const pairs = pairsOf(inputs);
  const angle = (i: number) => (2 * Math.PI * i) / pairs.length;
  const round = (value: number) => Number(value.toFixed(2));
  const moved = pairs.map(({ point: _, axis: __, ...pair }, i) => {
    const type = kindOf(pair) in TYPES[space] ? pair.type : "revolute";
    const point = [round(Math.cos(angle(i))), round(Math.sin(angle(i))), 0];
    return space === "planar" ? dressed({ ...pair, type, point }) : { ...pair, type };
  });
  return { space, links: inputs["links"], pairs: moved };
}
