/** The public API, spoken like any other client does: JSON, problems, and a record of each call to show as a script. */

import type { Connection } from "./connection.ts";
import type { Key } from "./key.ts";
import { language, t } from "./texts/index.ts";

export interface Call {
  method: "GET" | "POST" | "PUT" | "DELETE";
  /** Below the service's address, without a slash in front. */
  path: string;
  body?: unknown;
  /** Fields of a form that carries files, in the place of a body, and under which name it does. */
  form?: { fields: Record<string, string>; part: "archive" | "files"; files: readonly File[] };
  /** The form of the answer that is wanted, where it is not JSON. */
  accept?: string;
}

/** An `application/problem+json`, or that there was no answer at all. */
export class Problem extends Error {
  constructor(
    readonly status: number,
    readonly title: string,
    readonly detail: string,
    readonly facts: Record<string, unknown> = {},
  ) {
    super(detail);
  }

  /** Where in the payload something is wrong, and what; JSON pointers as the service gives them. */
  get places(): { pointer: string; detail: string }[] {
    const { errors, pointer } = this.facts as { errors?: { pointer: string; detail: string }[]; pointer?: string };
    if (errors) return errors;
    return pointer ? [{ pointer, detail: this.detail }] : [];
  }
}

const UNAUTHORIZED = 401;
export const NO_ANSWER = 0;
const NOT_OF_THE_SERVICE = -1;
const OF_A_PROXY: ReadonlySet<number> = new Set([502, 503, 504]);
/** A call of these would make one thing twice, if only its answer was lost. */
const MAKES = /^v1\/(robots|scenes)$|\/workspace$/;

/** Whatever went wrong as it is shown; the title is for what is not the service's. */
export function asProblem(error: unknown, title = t("The page cannot do this")): Problem {
  return error instanceof Problem ? error : new Problem(NOT_OF_THE_SERVICE, title, String(error));
}

export class Api {
  /**
   * @param key that calls carry, and that is asked for where the service wants another one.
   * @param connection that calls wait for where nobody answers.
   */
  constructor(
    readonly root: URL,
    readonly key: Key,
    readonly connection: Connection,
    private readonly record: (call: Call) => void = () => {},
  ) {}

  /** The same API, with every call told to someone. */
  recorded(record: (call: Call) => void): Api {
    return new Api(this.root, this.key, this.connection, record);
  }

  url(path: string): string {
    return new URL(path, this.root).href;
  }

  get<T>(path: string, signal?: AbortSignal): Promise<T> {
    return this.call<T>({ method: "GET", path }, signal);
  }

  post<T>(path: string, body: unknown, signal?: AbortSignal): Promise<T> {
    return this.call<T>({ method: "POST", path, body }, signal);
  }

  text(path: string, signal?: AbortSignal): Promise<string> {
    return this.textOf({ method: "GET", path }, signal);
  }

  async textOf(call: Call, signal?: AbortSignal): Promise<string> {
    return (await this.answer(call, signal)).text();
  }

  /** An answer in another form than JSON. */
  async bytes(path: string, accept: string, signal?: AbortSignal): Promise<ArrayBuffer> {
    return (await this.answer({ method: "GET", path, accept }, signal)).arrayBuffer();
  }

  async call<T>(call: Call, signal?: AbortSignal): Promise<T> {
    const answer = await this.answer(call, signal);
    return (answer.status === 204 ? null : await answer.json()) as T;
  }

  private async answer(call: Call, signal?: AbortSignal): Promise<Response> {
    this.record(call);
    for (;;) {
      const { text } = this.key;
      const answer = await this.sent(call, signal);
      if (answer.ok) return answer;
      const refusal = await problem(answer);
      if (answer.status !== UNAUTHORIZED || !(await this.key.renew(text, refusal.detail))) throw refusal;
      signal?.throwIfAborted();
    }
  }

  /** The service's answer, however long it takes to be back; what makes something is not sent twice. */
  private async sent(call: Call, signal?: AbortSignal): Promise<Response> {
    const { body, headers } = content(call);
    for (;;) {
      const request = {
        method: call.method,
        body,
        headers: { ...headers, "Accept-Language": language, ...this.key.headers },
        signal: signal ?? null,
      };
      try {
        const answer = await fetch(this.url(call.path), request);
        if (!OF_A_PROXY.has(answer.status) || isJson(answer)) return answer;
      } catch (error) {
        if (signal?.aborted) throw error;
      }
      const back = this.connection.back(signal);
      if (call.method === "GET" || (call.method === "POST" && !MAKES.test(call.path))) {
        await back;
        continue;
      }
      back.catch(() => {});
      throw new Problem(NO_ANSWER, t("No answer"), t("The service does not answer. Is it still running?"));
    }
  }
}

function isJson(answer: Response): boolean {
  return answer.headers.get("Content-Type")?.includes("json") ?? false;
}

function content(call: Call): { body: BodyInit | null; headers: Record<string, string> } {
  const accept: Record<string, string> = call.accept === undefined ? {} : { Accept: call.accept };
  if (call.form) {
    const body = new FormData();
    for (const [name, value] of Object.entries(call.form.fields)) body.set(name, value);
    for (const file of call.form.files) body.append(call.form.part, file);
    return { body, headers: accept };
  }
  if (call.body === undefined) return { body: null, headers: accept };
  return { body: JSON.stringify(call.body), headers: { "Content-Type": "application/json", ...accept } };
}

async function problem(answer: Response): Promise<Problem> {
  const fallback = t("The service answered {status} {statusText}.", {
    status: answer.status,
    statusText: answer.statusText,
  });
  if (!isJson(answer)) return new Problem(answer.status, t("Error"), fallback);
  const { title, detail, ...facts } = (await answer.json()) as Record<string, unknown>;
  return new Problem(answer.status, String(title ?? t("Error")), String(detail ?? fallback), facts);
}

/** Runs one call at a time and drops what is overtaken: for answers that follow a slider. */
export class Latest {
  #running: AbortController | null = null;

  async run<T>(work: (signal: AbortSignal) => Promise<T>): Promise<T | undefined> {
    this.#running?.abort();
    const mine = new AbortController();
    this.#running = mine;
    try {
      const result = await work(mine.signal);
      return mine.signal.aborted ? undefined : result;
    } catch (error) {
      if (mine.signal.aborted) return undefined;
      throw error;
    }
  }

  cancel(): void {
    this.#running?.abort();
  }
}

/** Does one thing at a time, and of what is wanted meanwhile only the last: for calls at every move of a slider, which
 * are cheap for the service but cost the page more than its picture when each is begun and aborted. */
export class Paced<T> {
  #next: { wanted: T } | null = null;
  #isBusy = false;

  constructor(private readonly work: (wanted: T) => Promise<void>) {}

  want(wanted: T): void {
    this.#next = { wanted };
    if (!this.#isBusy) void this.#go();
  }

  /** Begin nothing more. */
  cancel(): void {
    this.#next = null;
  }

  async #go(): Promise<void> {
    this.#isBusy = true;
    while (this.#next) {
      const { wanted } = this.#next;
      this.#next = null;
      await this.work(wanted);
    }
    this.#isBusy = false;
  }
}
