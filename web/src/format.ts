/** Numbers for people: few digits, a unit, a width that does not jump, as their country writes. */
import { computed } from "@preact/signals";
import { locale } from "@/language/language";

/** A number with so many digits behind the point, or the comma. */
export function formatNumber(value: number, digits: number): string {
  return NUMBERS.value(digits).format(value);
}

/** Energy in Wh below 1 kWh, else in kWh. */
export function formatEnergy(energy_wh: number): string {
  if (energy_wh < 1000) return `${formatNumber(energy_wh, 0)}\u00a0Wh`;
  return `${formatNumber(energy_wh / 1000, 1)}\u00a0kWh`;
}

/** Money as the reader's country writes it; the currency is ISO 4217. */
export function formatMoney(amount: number, currency: string): string {
  return new Intl.NumberFormat(locale.value, { style: "currency", currency }).format(amount);
}

/** Power in kW. */
export function formatPower(power_w: number): string {
  return `${formatNumber(power_w / 1000, 1)}\u00a0kW`;
}

/** Seconds as "12 s", "3:07" or "1 h 02" (minutes). */
export function formatDuration(duration_s: number): string {
  const whole = Math.max(0, Math.floor(duration_s));
  if (whole < 60) return `${String(whole)}\u00a0s`;
  const two = (value: number): string => String(value).padStart(2, "0");
  const hours = Math.floor(whole / 3600);
  const minutes = Math.floor(whole / 60) % 60;
  if (hours > 0) return `${String(hours)}\u00a0h\u00a0${two(minutes)}`;
  return `${String(minutes)}:${two(whole % 60)}`;
}

/** A time that is still to come, as people say it: "12 s", "3 min" or "1 h 02" (minutes). */
export function formatTimeLeft(left_s: number): string {
  const seconds = Math.max(0, Math.round(left_s));
  if (seconds < 60) return formatDuration(seconds);
  const minutes = Math.round(left_s / 60);
  return minutes < 60 ? `${String(minutes)}\u00a0min` : formatDuration(minutes * 60);
}

export function formatForce(force_n: number): string {
  return `${formatNumber(force_n, 0)}\u00a0N`;
}

export function formatPoint(point: { x_mm: number; y_mm: number; z_mm: number }): string {
  const { x_mm, y_mm, z_mm } = point;
  return [x_mm, y_mm, z_mm].map((value) => formatNumber(value, 1)).join(" / ") + "\u00a0mm";
}

/** Bytes as "340 kB" or "1.5 MB". */
export function formatSize(size_bytes: number): string {
  if (size_bytes < 1e6) return `${formatNumber(Math.ceil(size_bytes / 1000), 0)}\u00a0kB`;
  return `${formatNumber(size_bytes / 1e6, 1)}\u00a0MB`;
}

/** Day and time as the reader's own country writes them. */
export function formatDate(date: string): string {
  return DATE.value.format(Date.parse(date));
}

/** The time of day as the reader's own country writes it. */
export function formatTime(date: number): string {
  return TIME.value.format(date);
}

/** Making a formatter costs far more than using it; each is kept until the language changes. */
const NUMBERS = computed(() => {
  const made = new Map<number, Intl.NumberFormat>();
  const spoken = locale.value;
  return (digits: number): Intl.NumberFormat => {
    let found = made.get(digits);
    if (found === undefined) {
      found = new Intl.NumberFormat(spoken, {
        minimumFractionDigits: digits,
        maximumFractionDigits: digits,
      });
      made.set(digits, found);
    }
    return found;
  };
});

const DATE = computed(
  () =>
    new Intl.DateTimeFormat(locale.value, {
      day: "numeric",
      month: "short",
      hour: "2-digit",
      minute: "2-digit",
    }),
);

const TIME = computed(
  () => new Intl.DateTimeFormat(locale.value, { hour: "2-digit", minute: "2-digit" }),
);
