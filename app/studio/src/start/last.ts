/** Where a person was on this device: the link to it, kept by the browser. */

const NAME = "gelenk.last";

export interface Last {
  /** The address from `#` on. */
  hash: string;
  /** Of the robot. */
  title: string;
}

export function keepLast(hash: string, title: string): void {
  try {
    localStorage.setItem(NAME, JSON.stringify({ hash, title }));
  } catch {
    // A browser that keeps nothing, or not so much.
  }
}

/** What is kept; null where that is nothing, or nothing that makes sense. */
export function last(): Last | null {
  try {
    return asLast(JSON.parse(localStorage.getItem(NAME) ?? "null"));
  } catch {
    return null;
  }
}

export function asLast(given: unknown): Last | null {
  const { hash, title } = (typeof given === "object" && given !== null ? given : {}) as Partial<Last>;
  const isLink = typeof hash === "string" && hash.startsWith("#") && typeof title === "string";
  return isLink ? { hash, title } : null;
}
