// ---- elements.js: making elements, texts and the theme; shared by all pages.

const $ = (id) => document.getElementById(id);
const SVG = "http://www.w3.org/2000/svg";

// Everything from the episode reaches the page as text or attribute value through these two, never as markup.
function build(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes || {})) {
    if (value === null || value === undefined || value === false) continue;
    if (name === "text") node.textContent = value;
    else if (name === "on") for (const [event, handler] of Object.entries(value)) node.addEventListener(event, handler);
    else node.setAttribute(name, value === true ? "" : value);
  }
  node.append(...children.flat().filter((child) => child !== null && child !== undefined && child !== ""));
  return node;
}
const el = (tag, attributes, ...children) => build(document.createElement(tag), attributes, children);
const svg = (tag, attributes, ...children) => build(document.createElementNS(SVG, tag), attributes, children);

function mark(name, more) {
  return svg("svg", { class: "mark" + (more ? " " + more : ""), "aria-hidden": "true" },
    svg("use", { href: "#m-" + name }));
}

// Text in which the names of variables are set in italics.
function withVariables(text, variables, tag) {
  const italic = (word) => (tag === "tspan" ? svg("tspan", { class: "var", "font-style": "italic", text: word })
    : el("span", { class: "var", text: word }));
  const names = new Set(variables || []);
  if (!names.size) return [text];
  return text.split(/([\p{L}\p{N}_]+)/u).map((word) => (names.has(word) ? italic(word) : word));
}

// Sentences: ids of things that can be selected are set off, code marks are taken away.
function sentence(text) {
  return text.split(/(\b(?:mdl|cst|goal|pred)_\d+\b|`[^`]*`)/).map((part) => {
    if (part.startsWith("`") && part.length > 1) return "\u201c" + part.slice(1, -1) + "\u201d";
    return /^(mdl|cst)_\d+$/.test(part) ? el("b", { text: part }) : part;
  });
}

// "light", "dark", or "" for what the system has.
function showTheme(theme) {
  const dark = theme ? theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  document.documentElement.dataset.theme = dark ? "dark" : "light";
}

// Puts an address on the clipboard and says so; false where the browser does not allow it.
async function copyAddress(address) {
  const say = (text) => { $("said").textContent = text; setTimeout(() => { $("said").textContent = ""; }, 2500); };
  try {
    await navigator.clipboard.writeText(address);
    say("Link copied");
    return true;
  } catch {
    say("The link stands in the address bar");
    return false;
  }
}
