// ---- main.js: puts the page together.

function showHeader(app, story) {
  const { title, summary, provenance, warning } = app.report;
  $("title").textContent = title;
  $("provenance").textContent = provenance;
  $("warning").textContent = warning;
  $("warning").hidden = !warning;
  summary.forEach((item, i) => {
    const before = i === 0 ? "" : item.filter === "analogy" ? ", " : "; ";
    $("summary").append(before, el("button", { type: "button", class: "link" + (item.failed ? " fail" : ""), text: item.text,
      on: { click: () => story.filter(item.filter) } }));
  });
}

function listenToKeys(app, search) {
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.target.closest("input, dialog")) return;
    // A button keeps space and Enter for itself.
    const button = event.target.closest("button, summary");
    const action = {
      " ": button ? null : () => app.toggle(),
      ArrowLeft: () => app.step(-1),
      ArrowRight: () => app.step(1),
      Home: () => app.go(app.frames[0]),
      End: () => app.go(app.frames[app.frames.length - 1]),
      "/": () => search.focus(),
      "?": () => $("keys").showModal(),
    }[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  });
}

function listenToTheme(app) {
  $("theme").addEventListener("click", () => {
    app.setTheme(document.documentElement.dataset.theme === "dark" ? "light" : "dark");
    app.save();
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { if (!app.theme) app.setTheme(""); });
}

async function start() {
  const report = await readReport();
  const app = new App(report);
  setTimeDecimals(report.clock.period);
  document.body.classList.remove("loading");
  if (report.film.stills.length) filmPane(app); else planPane(app);
  transportPane(app);
  const story = storyPane(app);
  objectsPane(app);
  const graph = graphPane(app);
  lanesPane(app);
  inspectorPane(app);
  showHeader(app, story);
  const search = searchPane(app, story, graph);
  listenToKeys(app, search);
  listenToTheme(app);
  $("help").addEventListener("click", () => $("keys").showModal());
  addEventListener("hashchange", () => app.restore());
  app.restore();
  document.documentElement.dataset.ready = "true";
}

start().catch((error) => {
  $("warning").textContent = "This report could not be opened: " + error.message +
    ". It needs a browser of 2024 or later (DecompressionStream, light-dark).";
  $("warning").hidden = false;
});
