/** What a person does, one act after the other: a press with the drag that follows, what is typed into one field while it
 * has the focus, a file that is dropped, a step of the browser's Back. */

const NO_TEXT: readonly string[] = ["range", "checkbox", "radio", "button", "submit", "file", "color"];
const NO_SERIES: readonly string[] = NO_TEXT.filter((type) => type !== "range");
const MODIFIERS: readonly string[] = ["Shift", "Control", "Alt", "Meta", "AltGraph"];

interface Act {
  on: EventTarget | null;
  isTyped: boolean;
  isClicked: boolean;
  isOver: boolean;
}

export class Acts {
  #act: Act | null = null;
  /** What is held, and by which pointer. */
  #held: { on: EventTarget | null; pointer: number } | null = null;
  /** The field whose text has been changed and not yet been taken. */
  #typing: EventTarget | null = null;

  /** @param begun is told that what changes from now on is of another act. That an act changes nothing is usual. */
  constructor(private readonly begun: () => void) {
    const reactions: Partial<{ [K in keyof WindowEventMap]: (event: WindowEventMap[K]) => void }> = {
      pointerdown: (event) => this.#press(event),
      pointerup: (event) => this.#release(event),
      pointercancel: (event) => this.#release(event),
      keydown: (event) => this.#key(event),
      click: (event) => this.#click(event),
      input: ({ target }) => {
        this.#goOn(target);
        if (isText(target)) this.#typing = target;
      },
      change: ({ target }) => this.#goOn(target),
      // Before the field takes what is typed into it: that is of the field, not of what was pressed instead.
      blur: ({ target }) => isSeries(target) && this.#goOn(target),
      drop: ({ target }) => this.#begin(target),
      popstate: () => this.#begin(null),
    };
    for (const [name, react] of Object.entries(reactions))
      window.addEventListener(name, react as (event: Event) => void, { capture: true });
    // After it.
    window.addEventListener("focusout", ({ target }) => {
      this.#typing = null;
      if (isSeries(target)) this.#begin(this.#held?.on ?? null);
    });
  }

  /** Whether the browser itself undoes what is being typed. */
  isTyping(target: EventTarget | null): boolean {
    return target !== null && target === this.#typing;
  }

  #begin(on: EventTarget | null, isTyped = false): void {
    this.#act = { on, isTyped, isClicked: false, isOver: false };
    this.begun();
  }

  /** The act on a field, or its beginning. */
  #goOn(on: EventTarget | null): void {
    if (this.#act?.on !== on || this.#act?.isOver) this.#begin(on, true);
  }

  #press({ target, pointerId }: PointerEvent): void {
    if (this.#held && this.#held.pointer !== pointerId) return; // another finger
    this.#held = { on: target, pointer: pointerId };
    this.#begin(target);
  }

  #release({ pointerId }: PointerEvent): void {
    if (this.#held?.pointer === pointerId) this.#held = null;
  }

  #key({ target, key, repeat }: KeyboardEvent): void {
    if (MODIFIERS.includes(key) || this.#held) return;
    const isOn = this.#act?.on === target && !this.#act?.isOver;
    if (!isOn || !(repeat || (isSeries(target) && this.#act?.isTyped))) this.#begin(target, true);
    if (key !== "Enter" || target instanceof HTMLTextAreaElement) return;
    this.#act!.isOver = true; // what is typed is taken
    this.#typing = null;
  }

  #click({ target }: MouseEvent): void {
    if (this.#act?.on !== target || this.#act?.isClicked) this.#begin(target);
    this.#act!.isClicked = true;
  }
}

/** Whether several keys in it are one act, as long as it has the focus. */
function isSeries(target: EventTarget | null): boolean {
  if (target instanceof HTMLInputElement) return !NO_SERIES.includes(target.type);
  return target instanceof HTMLTextAreaElement || target instanceof HTMLSelectElement;
}

/** Whether text is typed into it. */
function isText(target: EventTarget | null): boolean {
  if (target instanceof HTMLInputElement) return !NO_TEXT.includes(target.type);
  return target instanceof HTMLTextAreaElement;
}
