/** The pictures of the course, drawn one after the other. */

import { type Api, asProblem } from "../../api.ts";
import type { CoursePictures, Language } from "../../types.ts";
import { element } from "../../ui/dom.ts";
import { figureOf, svgOf } from "../../ui/drawing.ts";
import { ProblemView } from "../../ui/problem.ts";
import type { Part } from "./place.ts";
import type { Texts } from "./texts.ts";

interface Drawn {
  name: string;
  title: string;
  path: string;
}

export class Gallery implements Part {
  readonly host = element("div", { class: "section" });
  #problem = new ProblemView();
  #status: HTMLElement;
  #closed = new AbortController();

  constructor(
    private readonly api: Api,
    private readonly language: Language,
    private readonly texts: Texts,
  ) {
    this.#status = element("p", { class: "muted", role: "status" }, texts.loading);
    this.host.append(this.#status, this.#problem.host);
    void this.#draw();
  }

  show(): void {}

  close(): void {
    this.#closed.abort();
  }

  async #draw(): Promise<void> {
    const { signal } = this.#closed;
    try {
      for (const { name, title, path } of await this.#list(signal)) {
        const svg = await svgOf(this.api, { method: "GET", path }, signal);
        this.#status.before(figureOf(svg, title, name, this.texts.save(title)));
      }
    } catch (error) {
      if (!signal.aborted) this.#problem.show(asProblem(error));
    }
    this.#status.remove();
  }

  async #list(signal: AbortSignal): Promise<Drawn[]> {
    const { language, texts } = this;
    const tables = Object.entries(texts.tables).map(([convention, title]) => ({
      name: `dh-${convention}`,
      title,
      path: `v1/dh/picture?convention=${convention}&language=${language}`,
    }));
    const { pictures } = await this.api.get<CoursePictures>(`v1/course/pictures?language=${language}`, signal);
    const path = (name: string) => `v1/course/pictures/${name}?language=${language}`;
    return [...tables, ...pictures.map(({ name, title }) => ({ name, title, path: path(name) }))];
  }
}
