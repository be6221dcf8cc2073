// Creating and finding elements of the page.

// Creates an element with properties and children; null and false children are left out.
export function make(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (name === "class") element.className = value;
    else if (name in element && !name.includes("-") && name !== "list") element[name] = value;
    else element.setAttribute(name, value === true ? "" : value);
  }
  element.append(...children.flat(3).filter((child) => child !== null && child !== false && child !== undefined));
  return element;
}

export const items = (texts) => texts.map((text) => make("li", { textContent: text }));
export const definitions = (pairs) =>
  pairs.flatMap(([name, text]) => [make("dt", { textContent: name }), make("dd", { textContent: text })]);

export const place = (id) => document.getElementById(id);

// Sets text only where it differs, so that screen readers do not repeat it.
export function write(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

// Calls `act` after a pause without further calls [ms].
export function settled(act, milliseconds) {
  let clock = null;
  return (...words) => {
    clearTimeout(clock);
    clock = setTimeout(() => act(...words), milliseconds);
  };
}
