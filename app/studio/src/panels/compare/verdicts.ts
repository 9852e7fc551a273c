/** What is different: the tips, the frames, and what the service says of the tables. */

import { t } from "../../texts/index.ts";
import type { CompareAnswer } from "../../types.ts";
import { Choice, element } from "../../ui/dom.ts";
import { ProblemView } from "../../ui/problem.ts";
import {
  format,
  lengthText,
  measured,
  rounded,
  subscript,
  type Units,
  UNITS,
  unitOf,
  withUnit,
} from "../../ui/quantity.ts";
import { SIGNS } from "../../view/table.ts";
import type { Studio } from "../panel.ts";
import { keep } from "../robot/keep.ts";
import type { Pair } from "./pairs.ts";
import type { Facts, Second } from "./second.ts";
import { type Wanted, wanting } from "./wanted.ts";

type Difference = NonNullable<CompareAnswer["first_difference"]>;

const FIND = t("What the service finds so that the two agree");
const FINDABLE: readonly { value: Wanted["find"]; text: string }[] = [
  { value: "given", text: t("As given") },
  { value: "ends", text: t("Base and tool") },
  { value: "all", text: t("Zeros and senses") },
];
const SYMBOLS: Readonly<Record<string, string>> = SIGNS;

export class Verdicts {
  readonly host = element("div", { class: "part compare" });
  #tips = element("p", { class: "agreement", role: "status" });
  #words = element("div", { class: "part" });
  /** Which frames meet, line by line. */
  readonly frames = element("div", { class: "part" });
  #failure = new ProblemView();
  #refusal = new ProblemView();
  #stops: (() => void)[];

  constructor(
    studio: Studio,
    private readonly second: Second,
  ) {
    const { store } = studio;
    const { facts } = second;
    const find = new Choice(FIND, FINDABLE, (value) =>
      store.set(wanting(store.value, { find: value === "given" ? null : value })),
    );
    const finding = element("div", { class: "part" }, element("p", { class: "muted small" }, FIND), find.host);
    const kept = element("div", { hidden: true }, element("p", { class: "muted small" }, UNKEPT));
    kept.append(keep(studio, () => store.value.draft));
    this.host.append(this.#failure.host, this.#tips, this.#words, finding, this.#refusal.host, kept);
    this.#stops = [
      store.watch(["options"], () => find.show(second.wanted.find)),
      facts.watch(["failure", "refusal", "loading", "judging", "verdict", "tables"], (found) => {
        this.#failure.show(found.failure);
        this.#refusal.show(found.refusal);
        kept.hidden = !(store.value.draft && found.tables && second.own.value.draft);
        finding.hidden = !found.verdict;
        this.#words.replaceChildren(...words(found, second.own.value));
      }),
      facts.watch(["pairs"], () => this.#show()),
      second.own.watch(UNITS, () => {
        this.#words.replaceChildren(...words(facts.value, second.own.value));
        this.#show();
      }),
    ];
  }

  close(): void {
    for (const stop of this.#stops) stop();
  }

  #show(): void {
    const { pairs } = this.second.facts.value;
    const units = this.second.own.value;
    const tip = pairs.at(-1);
    this.#tips.hidden = !tip;
    if (!tip) return this.frames.replaceChildren();
    const values = { position: lengthText(tip.position, units), angle: measured(tip.angle, "angle", units) };
    this.#tips.dataset["tone"] = tip.meets ? "good" : "bad";
    this.#tips.dataset["position"] = String(tip.position);
    this.#tips.dataset["angle"] = String(tip.angle);
    this.#tips.textContent = tip.meets
      ? t("The tips meet here.")
      : t("The tips are {position} and {angle} apart here.", values);
    this.frames.replaceChildren(...frames(pairs, units));
  }
}

const UNKEPT = t(
  "The service compares a table with a robot that it keeps. Add this table, and it says what is different.",
);

/** A line for each frame, and which is the first that differs. */
function frames(pairs: readonly Pair[], units: Units): HTMLElement[] {
  if (pairs.length < 2) return [];
  const first = pairs.find(({ meets, index }) => !meets && index !== null);
  const head = [t("Frame"), `${t("Distance")} ${unitOf("length", units)}`, `${t("Angle")} ${unitOf("angle", units)}`];
  const lines = pairs.map((each) =>
    element(
      "tr",
      { class: each.meets ? "" : each === first ? "bad first" : "bad" },
      element("th", { scope: "row" }, each.index === null ? t("Tip") : `${each.index}, ${each.index}′`),
      element("td", {}, format(each.position, "length", units)),
      element("td", {}, format(each.angle, "angle", units)),
      element("td", {}, each.meets ? t("one place") : each === first ? t("first to differ") : t("apart")),
    ),
  );
  const titles = [...head, t("Here")].map((title) => element("th", { scope: "col" }, title));
  return [
    element(
      "table",
      { class: "pairs" },
      element("thead", {}, element("tr", {}, ...titles)),
      element("tbody", {}, ...lines),
    ),
  ];
}

/** The verdict in words, then what it rests on. */
function words({ loading, judging, verdict }: Facts, units: Units): HTMLElement[] {
  if (judging) return [element("p", { class: "muted" }, t("Comparing …"))];
  if (loading) return [element("p", { class: "muted" }, t("Loading …"))];
  if (!verdict) return [];
  const { answer, isSwapped } = verdict;
  const { max_position_error: position, max_orientation_error: angle, samples } = answer;
  const differing = answer.first_difference;
  const apart =
    position === null || angle === null
      ? null
      : t("At {samples} random configurations the tips are at most {position} and {angle} apart.", {
          samples,
          position: lengthText(position, units),
          angle: withUnit(rounded(units.degrees ? (angle * 180) / Math.PI : angle), "angle", units),
        });
  const remarks = [
    ...(answer.equivalent
      ? []
      : answer.diagnoses.slice(0, 3).map(({ detail }) => t("Explained by: {detail}", { detail }))),
    ...(answer.found.length
      ? [t("Found: {found}.", { found: answer.found.map((word) => named(word)).join(", ") })]
      : []),
    ...(answer.unverified.length
      ? [t("Not checked, as what was found makes up for them: {list}.", { list: unverified(answer) })]
      : []),
    // Those with names of fields are for whoever reads the answer itself; the page says the same.
    ...answer.notes.filter((note) => !note.includes("`")),
  ];
  return [
    element(
      "p",
      { class: "agreement", "data-tone": answer.equivalent ? "good" : "bad" },
      judged(answer.equivalent, isSwapped),
    ),
    ...(differing ? [element("p", { class: "first-difference" }, inWords(differing, units))] : []),
    ...(apart ? [element("p", { class: "muted small" }, apart)] : []),
    element("ul", { class: "remarks small muted" }, ...remarks.map((text) => element("li", {}, text))),
  ];
}

function judged(equivalent: boolean, isSwapped: boolean): string {
  if (equivalent)
    return isSwapped
      ? t("The same arm: the first one's table describes the second.")
      : t("The same arm: the second one's table describes the first.");
  return isSwapped
    ? t("Another arm: the first one's table does not describe the second.")
    : t("Another arm: the second one's table does not describe the first.");
}

/** What differs, with its two values: `d₁`, `0.0895 m`, `0.0892 m`. */
export function valuesOf(
  { row, parameter, value, expected }: Difference,
  units: Units,
): Record<"symbol" | "value" | "expected", string> {
  const kind = parameter === "a" || parameter === "d" ? "length" : "angle";
  const isNumber = parameter in SYMBOLS;
  const text = (it: typeof value) =>
    typeof it === "number" && isNumber ? measured(it, kind, units, 5) : String(it ?? "–");
  const symbol = isNumber && row !== null ? `${SYMBOLS[parameter]}${subscript(row)}` : named(parameter, row);
  return { symbol, value: text(value), expected: text(expected) };
}

function inWords(difference: Difference, units: Units): string {
  const { joint, value, expected } = difference;
  const { symbol, ...texts } = valuesOf(difference, units);
  const values = { symbol: joint === null ? symbol : `${symbol} (${joint})`, ...texts };
  return value === null && expected === null
    ? t("First difference: {symbol}.", values)
    : t("First difference: {symbol} is {value}, {expected} is needed.", values);
}

/** Words of the service; some are of a row, numbered from 1. */
function named(word: string, row: number | null = null): string {
  const names: Readonly<Record<string, string>> = {
    base: t("the base"),
    tool: t("the tool"),
    offsets: t("zeros of the joints"),
    signs: t("senses of the joints"),
    joints: t("the number of joints"),
    type: t("the type of joint {row}", { row }),
    sign: t("the sense of joint {row}", { row }),
    mimic: t("what moves joint {row}", { row }),
  };
  return names[word] ?? word;
}

function unverified({ unverified: list }: CompareAnswer): string {
  return list.map(({ row, parameter }) => `${SYMBOLS[parameter]}${subscript(row)}`).join(", ");
}
