/** Values by key, and whoever reacts when some of them change. */

type Watcher<T> = { keys: readonly (keyof T)[]; react: () => void };

export class Store<T extends object> {
  #value: T;
  #watchers = new Set<Watcher<T>>();

  constructor(value: T) {
    this.#value = value;
  }

  get value(): Readonly<T> {
    return this.#value;
  }

  /** Change some values; whoever watches one that differs reacts before this returns. */
  set(patch: Partial<T>): void {
    const before = this.#value;
    this.#value = { ...before, ...patch };
    const changed = (Object.keys(patch) as (keyof T)[]).filter((key) => before[key] !== patch[key]);
    if (changed.length === 0) return;
    for (const watcher of [...this.#watchers]) {
      if (this.#watchers.has(watcher) && watcher.keys.some((key) => changed.includes(key))) watcher.react();
    }
  }

  /** React now, and whenever one of these values changes; returns how to stop. */
  watch(keys: readonly (keyof T)[], react: (value: Readonly<T>) => void): () => void {
    const watcher = { keys, react: () => react(this.#value) };
    this.#watchers.add(watcher);
    watcher.react();
    return () => this.#watchers.delete(watcher);
  }
}
