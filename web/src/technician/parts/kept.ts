/** Small things that outlive a reload. A browser that keeps nothing just shows the first state. */
type Place = "localStorage" | "sessionStorage";

export function kept(place: Place, name: string): string | null {
  try {
    return window[place].getItem(name);
  } catch {
    return null;
  }
}

export function keep(place: Place, name: string, text: string): void {
  try {
    window[place].setItem(name, text);
  } catch {
    // As above.
  }
}
