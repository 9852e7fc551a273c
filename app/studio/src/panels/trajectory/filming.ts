/** A planned motion as a film: WebM or animated GIF, each picture drawn at its time of the motion. */

import { asProblem } from "../../api.ts";
import { canCompress } from "../../film/able.ts";
import type { Form } from "../../film/film.ts";
import { t } from "../../texts/index.ts";
import { button, element } from "../../ui/dom.ts";
import { save } from "../../ui/files.ts";
import { ProblemView } from "../../ui/problem.ts";
import type { View } from "../../view/view.ts";

const FORMS: readonly { form: Form; text: string; title: string }[] = [
  { form: "webm", text: t("WebM"), title: t("A video of the picture, small and sharp") },
  { form: "gif", text: t("GIF"), title: t("An animated picture, for pages and mails that take no video") },
];
const UNABLE = t("This browser makes no videos here: it wants https, or the service on this computer");

/** What is filmed: how long it is, what the file is called, and how everything gets to a time and back, [s]. */
export interface Subject {
  name: string;
  duration: number;
  show(time: number): void;
  leave(): void;
}

export class Filming {
  readonly host: HTMLElement;
  #running: AbortController | null = null;
  #buttons: HTMLButtonElement[];
  #progress = element("progress", { class: "progress", value: 0, "aria-label": t("Pictures drawn"), hidden: true });
  #status = element("span", { class: "small muted", role: "status" });
  #cancel = button(t("Cancel"), () => this.stop(), { class: "button small", hidden: true });
  #problem = new ProblemView();

  constructor(
    private readonly view: View | null,
    private readonly subject: () => Subject,
  ) {
    this.#buttons = FORMS.map(({ form, text, title }) => {
      const isAble = form === "gif" || canCompress();
      const properties = { class: "button small", title: isAble ? title : UNABLE, disabled: !isAble };
      return button(text, () => void this.#film(form), properties);
    });
    this.host = element(
      "div",
      { class: "filming", role: "group", "aria-label": t("Film"), hidden: view === null },
      element(
        "div",
        { class: "bar" },
        element("span", { class: "field" }, t("Film")),
        ...this.#buttons,
        this.#progress,
        this.#cancel,
        this.#status,
      ),
      this.#problem.host,
    );
  }

  /** End it, whatever there is of it. */
  stop(): void {
    this.#running?.abort();
    this.#running = null;
  }

  /** Nothing is said of a film of another motion. */
  forget(): void {
    this.stop();
    this.#status.textContent = "";
    this.#problem.show(null);
  }

  async #film(form: Form): Promise<void> {
    const { view } = this;
    if (!view || this.#running) return;
    const running = (this.#running = new AbortController());
    const subject = this.subject();
    this.#begin();
    try {
      const { film } = await import("../../film/film.ts");
      const { clientWidth: width, clientHeight: height } = view.canvas;
      const draw = (time: number, context: CanvasRenderingContext2D) => {
        subject.show(time);
        view.paint(context);
      };
      const shot = { duration: subject.duration, width, height, draw };
      const progress = (done: number, all: number) => this.#tell(done, all);
      const { file, pictures } = await film(form, shot, progress, running.signal);
      save(`${subject.name}.${form}`, file.type, file);
      this.#status.textContent = t("{name}.{form}: {pictures} pictures, {size}", {
        name: subject.name,
        form,
        pictures,
        size: sized(file.size),
      });
    } catch (error) {
      if (running.signal.aborted) this.#status.textContent = t("Cancelled.");
      else this.#problem.show(asProblem(error, t("The film was not made")));
    } finally {
      this.#end(running);
      subject.leave();
    }
  }

  #begin(): void {
    this.#problem.show(null);
    for (const each of this.#buttons) each.setAttribute("aria-disabled", "true");
    this.#progress.value = 0;
    this.#progress.hidden = this.#cancel.hidden = false;
    this.#status.textContent = "";
  }

  #end(running: AbortController): void {
    if (this.#running === running) this.#running = null;
    for (const each of this.#buttons) each.removeAttribute("aria-disabled");
    if (document.activeElement === this.#cancel) this.#buttons.find(({ disabled }) => !disabled)?.focus();
    this.#progress.hidden = this.#cancel.hidden = true;
  }

  #tell(done: number, all: number): void {
    this.#progress.max = all;
    this.#progress.value = done;
    this.#progress.setAttribute("aria-valuetext", t("{done} of {all}", { done, all }));
  }
}

function sized(bytes: number): string {
  return bytes < 1e6 ? `${Math.max(1, Math.round(bytes / 1e3))} kB` : `${(bytes / 1e6).toFixed(1)} MB`;
}
