/** What a calculator is: the fields of a call, what of its answer is shown as numbers, and the picture of it. */

import type { Stage } from "./stage.ts";

/** A request, or as much of one as has been typed. */
export type Inputs = Readonly<Record<string, unknown>>;

export interface Option {
  value: string;
  text: string;
}

/** A field of the form: the place in the request that it writes, and how. */
export interface Field {
  /** Of the value in the request: `limits/joint_velocity`. */
  pointer: string;
  label: string;
  /** As it is written behind the label; angles and lengths have one by their kind. */
  unit?: string;
  /** `list`: numbers in a row, or rows of numbers in brackets. */
  kind: "number" | "angle" | "length" | "list" | "text" | "choice" | "switch";
  /** Whether it may be left empty, and is then not sent. */
  optional?: boolean;
  /** What an arrow key adds; only of numbers. */
  step?: number;
  /** Of an angle: a slider below it, from −π to π. */
  slides?: boolean;
  /** Of a choice. */
  options?: readonly Option[];
  /** What is chosen, where that is not a value of the request. */
  chosen?: string;
  /** The inputs that another choice leads to, where it changes more than its own value. */
  choose?: (value: string) => Inputs;
}

/** A field for one number; an arrow key adds the step. */
export const number = (pointer: string, label: string, unit: string, optional = false, step = 0.1): Field => ({
  pointer,
  label,
  unit,
  kind: "number",
  optional,
  step,
});

/** A line of the answer; a matrix is set as one, and what is in `rad` is shown in degrees where these are wanted. */
export interface Fact {
  label: string;
  value: string | number | readonly number[] | readonly (readonly number[])[];
  unit?: string;
}

/** What is drawn, and what becomes of the inputs where a part of it is dragged. */
export interface Picture {
  nodes: readonly SVGElement[];
  height: number;
  /** What a screen reader says. */
  name: string;
  /** The inputs with the handle moved to a point of the picture; `from` is where the dragging began, and with what. */
  drag?: (handle: string, at: Point, from: { at: Point; inputs: Inputs }) => Inputs;
}

export type Point = readonly [number, number];

/** An answer's worked solution. */
export interface Step {
  title: string;
  text: string;
  latex: readonly string[];
}

export interface Calculator<Q = Inputs, A = unknown> {
  /** In the link. */
  id: string;
  title: string;
  says: string;
  /** The operation. */
  path: string;
  /** Of the handbook, with its section. */
  page: string;
  /** Whether its answer has angles where its fields have none. */
  hasAngles?: boolean;
  examples: readonly { title: string; inputs: Q }[];
  fields(inputs: Q): readonly Field[];
  /** What is asked for beside the inputs. */
  beside?(inputs: Q): Inputs;
  facts(answer: A, inputs: Q): readonly Fact[];
  /** Null for inputs that have none. */
  picture(answer: A, inputs: Q, stage: Stage): Picture | null;
  /** An editor above the fields, for what no row of fields can hold. */
  editor?(change: (inputs: Inputs) => void): Editor;
}

export interface Editor {
  host: HTMLElement;
  show(inputs: Inputs): void;
  /** Say what is wrong at a place of the request; whether it has that place. */
  fail(pointer: string, reason: string): boolean;
}

/** The value at a place of a request; undefined where there is none. */
export function valueAt(inputs: unknown, pointer: string): unknown {
  const within = (value: unknown, key: string) =>
    typeof value === "object" && value !== null ? (value as Record<string, unknown>)[key] : undefined;
  return pointer.split("/").reduce(within, inputs);
}

/** A request with another value at a place; null takes it away, and an object that is then empty. */
export function withValue(inputs: Inputs, pointer: string, value: unknown): Inputs {
  const [key, ...rest] = pointer.split("/") as [string, ...string[]];
  const { [key]: before, ...others } = inputs;
  if (Array.isArray(before) && rest.length)
    return { ...inputs, [key]: before.map((item, i) => (i === Number(rest[0]) ? replaced(item, rest, value) : item)) };
  const made = rest.length ? withValue((before ?? {}) as Inputs, rest.join("/"), value) : value;
  const isNone = made === null || (rest.length > 0 && Object.keys(made as object).length === 0);
  if (isNone) return others;
  return key in inputs ? { ...inputs, [key]: made } : { ...others, [key]: made };
}

function replaced(item: unknown, [, ...rest]: readonly string[], value: unknown): unknown {
  return rest.length ? withValue(item as Inputs, rest.join("/"), value) : value;
}
