/** Where a pointer is in an element, [px] of the element: what presenting enlarges has fewer than the screen. */

/** How many pixels of an element there are to one of the screen. */
export function shareOf(host: HTMLElement): number {
  return host.clientWidth / (host.getBoundingClientRect().width || 1);
}

/** From the left edge. */
export function leftIn(host: HTMLElement, { clientX }: MouseEvent): number {
  return (clientX - host.getBoundingClientRect().left) * shareOf(host);
}
