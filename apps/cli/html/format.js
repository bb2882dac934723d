// Numbers and texts as views show them; the same notation as emca's other programs (libs/analysis/format.h).

/** A number of the data: what JSON has no number for are words. */
export function toNumber(value) {
  if (typeof value === "number") return value;
  if (value === "Infinity") return Infinity;
  return value === "-Infinity" ? -Infinity : NaN;
}

/** Four significant digits, exact halves to even; fixed from 1e-4 up to 9999.5, scientific beyond. */
export function formatNumber(value) {
  if (Number.isNaN(value)) return "NaN";
  if (!Number.isFinite(value)) return value > 0 ? "Infinity" : "-Infinity";
  if (value === 0) return Object.is(value, -0) ? "-0" : "0";
  // toExponential rounds exact halves away from zero.
  const long = value.toExponential(20), digits = long.replace("-", "");
  let text = value.toExponential(3);
  if (/^\d\.\d\d[02468]50{16}e/.test(digits)) text = (value < 0 ? "-" : "") + digits.slice(0, 5) + long.slice(long.indexOf("e"));
  const at = text.indexOf("e"), exponent = Number(text.slice(at + 1));
  if (exponent >= -4 && exponent < 4) return Number(text).toFixed(3 - exponent);
  const size = Math.abs(exponent);
  return text.slice(0, at) + "e" + (exponent < 0 ? "-" : "+") + (size < 10 ? "0" : "") + size;
}

/** Text of others on one line: control characters are shown, not obeyed. */
export function printable(text) {
  return String(text).replace(/[\u0000-\u001f\u007f-\u009f\u200e\u200f\u202a-\u202e\u2066-\u2069]/g, "\ufffd");
}

/** Any value of the data that is no colour, on one line. */
export function formatValue(value) {
  if (Array.isArray(value)) return "(" + value.map(formatValue).join(", ") + ")";
  if (typeof value === "number") return Number.isInteger(value) && Math.abs(value) < 1e6 ? String(value) : formatNumber(value);
  return printable(value);
}

export function luminance([r, g, b]) {
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

/** IEC 61966-2-1, to [0, 255]. */
export function toSrgb(linear) {
  const x = Math.min(Math.max(linear, 0), 1);
  return Math.round(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * Math.pow(x, 1 / 2.4) - 0.055));
}

/** A colour of the style sheet, "#rrggbb", as numbers in [0, 1]. */
export function parseColor(text) {
  const bits = parseInt(text.trim().slice(1), 16);
  return [(bits >> 16 & 255) / 255, (bits >> 8 & 255) / 255, (bits & 255) / 255];
}
