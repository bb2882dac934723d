// Elements, made without markup: what comes from data is text, never HTML.
import { formatNumber, printable, toNumber, toSrgb } from "./format.js";

export function byId(id) {
  return document.getElementById(id);
}

/** element("td", "class", child or text, …) */
export function element(tag, className, ...children) {
  const made = document.createElement(tag);
  if (className) made.className = className;
  for (const child of children) made.append(typeof child === "object" ? child : printable(child));
  return made;
}

/** A number as text; words for what is none, in warning colour. */
export function numberElement(value, className = "") {
  const number = toNumber(value);
  return element("span", Number.isFinite(number) ? className : className + " faulty", formatNumber(number));
}

/** How a linear colour looks; with "+n" where it is brighter than the screen by n stops, "!" where it is no number. */
export function swatch(color) {
  const linear = color.map(toNumber);
  const made = element("span", "swatch");
  const shown = linear.map(toSrgb);
  made.style.background = "rgb(" + shown.map((c) => c || 0).join(",") + ")";
  made.style.color = shown[1] > 140 ? "#000" : "#fff";
  const most = Math.max(...linear);
  if (!linear.every(Number.isFinite)) {
    made.textContent = "!";
    made.classList.add("faulty");
  } else if (most > 1) made.textContent = "+" + Math.ceil(Math.log2(most));
  made.title = linear.map(formatNumber).join(", ");
  return made;
}

/** The colours of the style sheet by name, as the theme of the moment has them. */
export function themeColor(name) {
  return getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();
}
