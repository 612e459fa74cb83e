/** Numbers for people: few digits, a unit, a width that does not jump. */

/** Energy in Wh below 1 kWh, else in kWh. */
export function formatEnergy(energy_wh: number): string {
  if (energy_wh < 1000) return `${energy_wh.toFixed(0)} Wh`;
  return `${(energy_wh / 1000).toFixed(1)} kWh`;
}

/** Power in kW. */
export function formatPower(power_w: number): string {
  return `${(power_w / 1000).toFixed(1)} kW`;
}

/** Seconds as "12 s", "3:07" or "1 h 02" (minutes). */
export function formatDuration(duration_s: number): string {
  const whole = Math.max(0, Math.floor(duration_s));
  if (whole < 60) return `${String(whole)} s`;
  const two = (value: number): string => String(value).padStart(2, "0");
  const hours = Math.floor(whole / 3600);
  const minutes = Math.floor(whole / 60) % 60;
  if (hours > 0) return `${String(hours)} h ${two(minutes)}`;
  return `${String(minutes)}:${two(whole % 60)}`;
}

export function formatForce(force_n: number): string {
  return `${force_n.toFixed(0)} N`;
}

export function formatPoint(point: { x_mm: number; y_mm: number; z_mm: number }): string {
  return [point.x_mm, point.y_mm, point.z_mm].map((value) => value.toFixed(1)).join(" / ") + " mm";
}

/** Bytes as "340 kB" or "1.5 MB". */
export function formatSize(size_bytes: number): string {
  if (size_bytes < 1e6) return `${Math.ceil(size_bytes / 1000).toFixed(0)} kB`;
  return `${(size_bytes / 1e6).toFixed(1)} MB`;
}

/** Day and time as the reader's own country writes them. */
export function formatDate(date: string): string {
  return DATE.format(Date.parse(date));
}

const DATE = new Intl.DateTimeFormat(undefined, {
  day: "numeric",
  month: "short",
  hour: "2-digit",
  minute: "2-digit",
});
