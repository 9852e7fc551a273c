/** The second robot: brought from the service, moved as the first one is, and what the service says of the two. */

import { type Api, asProblem, Latest, type Problem } from "../../api.ts";
import { shownChain } from "../../robot/chain.ts";
import { fetchModel } from "../../robot/fetch.ts";
import type { RobotModel } from "../../robot/model.ts";
import { type ChainTable, chainTable, draftTable, tablePath } from "../../robot/table.ts";
import type { State } from "../../state.ts";
import { Store } from "../../store.ts";
import { t } from "../../texts/index.ts";
import type { CompareAnswer, Convention, DhTable, TableAnswer } from "../../types.ts";
import { UNITS } from "../../ui/quantity.ts";
import { dispose } from "../../view/stage.ts";
import { type Alignment, alignment, following, type Link, links, type Pair, pairs, type Tables } from "./pairs.ts";
import { type Verdict, type Wrong, wrong } from "./pairs.ts";
import { type Wanted, wanted, wanting } from "./wanted.ts";

export interface Facts {
  loading: boolean;
  /** Whether the service is comparing. */
  judging: boolean;
  /** Of the two chains; null where one has none. */
  tables: Tables | null;
  verdict: Verdict | null;
  /** Why there is no second robot. */
  failure: Problem | null;
  /** Why there are no tables, or no verdict. */
  refusal: Problem | null;
  /** Frames of the two, and their tips, where they are now. */
  pairs: readonly Pair[];
}

const NOTHING: Facts = {
  loading: false,
  judging: false,
  tables: null,
  verdict: null,
  failure: null,
  refusal: null,
  pairs: [],
};
const FOUND = { given: null, ends: ["base", "tool"], all: ["base", "tool", "offsets", "signs"] };

export class Second {
  /** The state of a page that shows the second robot alone. */
  readonly own: Store<State>;
  readonly facts = new Store<Facts>(NOTHING);
  #models = new Latest();
  #verdicts = new Latest();
  /** What has been asked for last: another robot or table, another verdict. */
  #asked = "";
  #judged = "";
  #stops: (() => void)[];

  constructor(
    private readonly store: Store<State>,
    private readonly api: Api,
  ) {
    const none = { model: null, draft: null, robot: "", base: null, tip: null, table: null, joint: null };
    this.own = new Store<State>({ ...store.value, ...none, positions: {}, meshes: 0 });
    this.#stops = [
      store.watch(["unit", "dark", ...UNITS], ({ unit, dark, millimetres, degrees }) =>
        this.own.set({ unit, dark, millimetres, degrees }),
      ),
      store.watch(["model", "base", "tip", "options"], () => void this.#load()),
      store.watch(["positions", "options"], () => this.#follow()),
      this.facts.watch(["verdict", "tables"], () => this.#follow()),
      this.own.watch(["positions"], () => this.#moved()),
    ];
  }

  get wanted(): Wanted {
    return wanted(this.store.value);
  }

  get alignment(): Alignment {
    const { tables, verdict } = this.facts.value;
    return alignment(tables, verdict, this.wanted.find !== "given");
  }

  /** The first number that the service finds to differ, and where it is. */
  get wrong(): Wrong | null {
    const { tables, verdict } = this.facts.value;
    return wrong(this.store.value, this.own.value, tables, verdict, this.alignment);
  }

  get links(): (Link | null)[] {
    return links(this.store.value, this.own.value, this.facts.value.verdict);
  }

  close(): void {
    for (const stop of this.#stops) stop();
    this.#models.cancel();
    this.#verdicts.cancel();
    if (this.own.value.model) dispose(this.own.value.model.root);
  }

  async #load(): Promise<void> {
    const chain = shownChain(this.store.value);
    const { with: kind, robot, table } = this.wanted;
    if (!chain) return;
    const second = { convention: null, robot, table }[kind];
    const asked = JSON.stringify([chain.model.name, this.store.value.draft, chain.ends, kind, second]);
    if (asked === this.#asked) return this.#judge();
    this.#asked = asked;
    this.#judged = "";
    this.#verdicts.cancel();
    if (second === "" || (kind === "table" && !table)) {
      this.#models.cancel();
      return this.#show(null, null, NOTHING);
    }
    this.facts.set({ loading: true });
    try {
      await this.#models.run((signal) => this.#fetch(signal));
    } catch (error) {
      this.#show(null, null, { ...NOTHING, failure: asProblem(error, t("The second robot cannot be shown")) });
    }
  }

  async #fetch(signal: AbortSignal): Promise<void> {
    const { with: kind, robot, table } = this.wanted;
    const first = chainTable(this.api, this.store.value, signal);
    if (kind === "robot") {
      const [model, tables] = await Promise.all([
        fetchModel(this.api, { robot, draft: null }, signal, {
          arrived: () => this.own.set({ meshes: this.own.value.meshes + 1 }),
        }),
        this.#ofRobot(first, robot, signal).catch((error: unknown) => asProblem(error)),
      ]);
      if (signal.aborted) return;
      const refusal = tables instanceof Error ? tables : null;
      return this.#show(model, null, { ...NOTHING, tables: refusal ? null : (tables as Tables | null), refusal });
    }
    const tables = await (kind === "table" ? this.#ofTable(first, table!, signal) : this.#ofConvention(first, signal));
    if (!tables) return;
    const { dh } = tables.second;
    const model = await fetchModel(this.api, { robot: "", draft: dh }, signal, { arrived: () => {} });
    if (!signal.aborted) this.#show(model, dh, { ...NOTHING, tables });
  }

  /** The first's table and the robot's, in the same convention. */
  async #ofRobot(first: Promise<ChainTable | null>, robot: string, signal: AbortSignal): Promise<Tables | null> {
    const ours = await first;
    if (!ours) return null;
    const answer = await this.api.get<TableAnswer>(tablePath(robot, ours.dh.convention, null, null), signal);
    return { first: ours, second: { dh: answer.dh, base: answer.base_frame } };
  }

  /** A typed table, and the first's in its convention. */
  async #ofTable(first: Promise<ChainTable | null>, table: DhTable, signal: AbortSignal): Promise<Tables | null> {
    const ours = await first;
    const dh = ours && (await this.#converted(ours.dh, table.convention, signal));
    return dh && { first: { ...ours, dh }, second: draftTable(table) };
  }

  /** The first's table, and the same in the other convention. */
  async #ofConvention(first: Promise<ChainTable | null>, signal: AbortSignal): Promise<Tables | null> {
    const ours = await first;
    if (!ours) return null;
    const other = ours.dh.convention === "standard" ? "modified" : "standard";
    return { first: ours, second: draftTable(await this.#converted(ours.dh, other, signal)) };
  }

  async #converted(dh: DhTable, convention: Convention, signal: AbortSignal): Promise<DhTable> {
    if (dh.convention === convention) return dh;
    return (await this.api.post<{ dh: DhTable }>("v1/dh/convert", { dh, convention }, signal)).dh;
  }

  #show(model: RobotModel | null, draft: DhTable | null, facts: Facts): void {
    const before = this.own.value.model;
    if (before && before !== model) dispose(before.root);
    const { link, q } = this.wanted;
    const [base, tip] = [model?.ends.base_frame ?? "", model?.ends.tip_frame ?? ""];
    const positions = model ? model.complete(link === "free" ? q : null, base, tip) : {};
    model?.place(positions);
    this.own.set({ model, draft, robot: model?.name ?? "", positions });
    this.facts.set(facts);
    this.#follow();
    void this.#judge();
  }

  /** Ask whether the one's table describes the other; one of the two has to be kept by the service. */
  async #judge(): Promise<void> {
    const { tables } = this.facts.value;
    const [chain, other] = [shownChain(this.store.value), shownChain(this.own.value)];
    if (!tables || !chain || !other) return;
    const isSwapped = chain.path === null;
    const judge = isSwapped ? other : chain;
    if (judge.path === null) return this.facts.set({ verdict: null, judging: false });
    const find = FOUND[this.wanted.find];
    const call = {
      dh: (isSwapped ? tables.first : tables.second).dh,
      robot: judge.model.name,
      ...judge.ends,
      ...(find && { find }),
      pose_format: "matrix",
    };
    const text = JSON.stringify(call);
    if (text === this.#judged) return;
    this.#judged = text;
    this.facts.set({ judging: true });
    try {
      const answer = await this.#verdicts.run((signal) => this.api.post<CompareAnswer>("v1/dh/compare", call, signal));
      if (answer) this.facts.set({ verdict: { answer, isSwapped }, refusal: null, judging: false });
    } catch (error) {
      this.facts.set({ verdict: null, refusal: asProblem(error), judging: false });
    }
  }

  /** Bring the second to where the first is, or where it has been put by itself; and see how far they are apart. */
  #follow(): void {
    const [chain, other] = [shownChain(this.store.value), shownChain(this.own.value)];
    if (!chain || !other) return this.facts.set({ pairs: [] });
    const { link, q } = this.wanted;
    const { model, base, tip } = other;
    const positions =
      link === "linked" ? following(this.store.value, this.own.value, this.links) : model.complete(q, base, tip);
    if (JSON.stringify(positions) !== JSON.stringify(this.own.value.positions)) this.own.set({ positions });
    model.place(this.own.value.positions);
    const { tables } = this.facts.value;
    this.facts.set({ pairs: pairs(this.store.value, this.own.value, tables, this.alignment) });
  }

  /** The second has been moved by itself: the link has that. */
  #moved(): void {
    const other = shownChain(this.own.value);
    if (!other || this.wanted.link === "linked" || !Object.keys(this.own.value.positions).length) return;
    const q = other.configuration.join(",");
    if (q !== this.store.value.options["compare.q"]) this.store.set(wanting(this.store.value, { q }));
  }
}
