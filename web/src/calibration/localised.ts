import { formatNumber } from "@/format";

/** A number of the server, such as 0.06, as the reader's country writes it; a word stays. */
export function localised(found: string): string {
  if (!/^[+-]?[\d.]+$/.test(found)) return found;
  const sign = found.startsWith("+") ? "+" : "";
  return sign + formatNumber(Number(found), found.split(".")[1]?.length ?? 0);
}
