// ---- main.js: puts the page together.

function showHeader(app, story) {
  const { title, summary, provenance, warning } = app.report;
  $("title").textContent = title;
  $("provenance").textContent = provenance;
  $("warning").textContent = warning;
  $("warning").hidden = !warning;
  summary.forEach((item, i) => {
    const before = i === 0 ? "" : item.more ? ", " : "; ";
    $("summary").append(before, el("button", { type: "button", class: "link" + (item.failed ? " fail" : ""), text: item.text,
      on: { click: () => story.filter(item.filter) } }));
  });
}

// The views of the middle: tabs, of which one is shown.
function viewTabs(app) {
  const tabs = [...document.querySelectorAll("[role='tab']")];
  for (const tab of tabs) {
    tab.addEventListener("click", (event) => {
      app.setView(tab.dataset.view);
      // After a click with the mouse the arrows step through time again.
      if (event.detail > 0) tab.blur();
    });
    tab.addEventListener("keydown", (event) => {
      const by = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
      if (!by) return;
      event.preventDefault();
      event.stopPropagation();
      const next = tabs[(tabs.indexOf(tab) + by + tabs.length) % tabs.length];
      app.setView(next.dataset.view);
      next.focus();
    });
  }
  app.add({
    showView(view) {
      for (const tab of tabs) {
        const on = tab.dataset.view === view;
        tab.setAttribute("aria-selected", String(on));
        tab.tabIndex = on ? 0 : -1;
        $(tab.getAttribute("aria-controls")).hidden = !on;
      }
    },
  });
}

function listenToKeys(app, search) {
  document.addEventListener("keydown", (event) => {
    if (event.key === "F3") { event.preventDefault(); search.next(event.shiftKey ? -1 : 1); return; }
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.target.closest("input, select, dialog")) return;
    // A button keeps space and Enter for itself, a list its own scrolling.
    const button = event.target.closest("button, summary, [role='button'], [role='tab']");
    const list = event.target.closest(".events-list");
    const action = {
      " ": button || list ? null : () => app.toggle(),
      ArrowLeft: () => app.step(-1),
      ArrowRight: () => app.step(1),
      Home: list ? null : () => app.go(app.frames[0]),
      End: list ? null : () => app.go(app.frames[app.frames.length - 1]),
      "/": () => search.focus(),
      n: () => search.next(1),
      N: () => search.next(-1),
      1: () => app.setView("overview"),
      2: () => app.setView("knowledge"),
      3: () => app.setView("reasoning"),
      4: () => app.setView("events"),
      c: () => copyLink(app),
      "?": () => $("keys").showModal(),
    }[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  });
}

// The address of this moment, this selection and this view.
async function copyLink(app) {
  if (await copyAddress(location.href.split("#")[0] + app.address())) return;
  history.replaceState(null, "", app.address());
  app.known = location.hash;
}

function listenToTheme(app) {
  $("theme").addEventListener("click", () => {
    app.setTheme(document.documentElement.dataset.theme === "dark" ? "light" : "dark");
    app.save();
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { if (!app.theme) app.setTheme(""); });
}

async function start() {
  const [report, columns] = await Promise.all([blockText("report-data").then((text) => JSON.parse(text)), blockBytes("log")]);
  const log = new EventLog(report.log, columns, report.subjects.id.length);
  const app = new App(report, log);
  setTimeDecimals(report.clock.period);
  // A short run is decoded whole; of a long one what is looked at.
  if (log.chunks > 0 && log.chunks <= 4) await Promise.all(Array.from({ length: log.chunks }, (_, i) => log.sentences(i)));
  document.body.classList.remove("loading");
  viewTabs(app);
  if (report.film.stills.length) filmPane(app); else planPane(app);
  transportPane(app);
  const story = storyPane(app);
  objectsPane(app);
  overviewPane(app);
  const graph = graphPane(app);
  reasoningPane(app);
  const events = eventsPane(app);
  lanesPane(app);
  inspectorPane(app);
  showHeader(app, story);
  const search = searchPane(app, story, graph, events);
  listenToKeys(app, search);
  listenToTheme(app);
  $("help").addEventListener("click", () => $("keys").showModal());
  $("copy").addEventListener("click", () => copyLink(app));
  addEventListener("hashchange", () => app.restore());
  await app.restore();
  document.documentElement.dataset.ready = "true";
}

start().catch((error) => {
  $("warning").textContent = "This report could not be opened: " + error.message +
    ". It needs a browser of 2024 or later (DecompressionStream, light-dark).";
  $("warning").hidden = false;
});
