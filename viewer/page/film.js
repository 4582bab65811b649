// ---- film.js: the still of the moment with outlines and names, or a plan of positions where there are no stills.

function filmPane(app) {
  const { film } = app.report;
  const box = $("film");
  const image = el("img", { alt: "", draggable: "false" });
  const over = svg("svg", { viewBox: `0 0 ${film.width || 16} ${film.height || 9}`, preserveAspectRatio: "xMidYMid slice" });
  const unit = (film.width || 800) / 800;
  box.append(image, over);

  const path = (outline) => {
    let d = "";
    for (let i = 0; i < outline.length; i += 2) d += (i ? "L" : "M") + outline[i] + " " + outline[i + 1];
    return d + "Z";
  };
  function objectShape(name, object, binding) {
    const [x, y] = object.label;
    const group = thingButton(app, name, binding !== undefined);
    if (object.outline.length) {
      const d = path(object.outline);
      if (binding !== undefined) {
        group.append(svg("path", { class: "halo", d, "stroke-width": 8 * unit }),
          svg("path", { class: "outline", d, "stroke-width": 4 * unit }));
      }
      group.append(svg("path", { class: "area", d, "stroke-width": 3 * unit }));
    }
    group.append(svg("text", { class: "name", x, y, "font-size": 23 * unit, "stroke-width": 6 * unit,
      text: binding ? binding + " = " + name : name }));
    return group;
  }
  // Names that would lie on each other: the lower one moves down.
  function separate(names) {
    const placed = [];
    const size = 23 * unit;
    for (const node of names.sort((a, b) => a.getAttribute("y") - b.getAttribute("y"))) {
      const half = widthOf(node.textContent, 23) * unit / 2;
      const x = Number(node.getAttribute("x"));
      let y = Number(node.getAttribute("y"));
      for (const other of placed) {
        if (Math.abs(other.x - x) < other.half + half && Math.abs(other.y - y) < size) y = other.y + size;
      }
      node.setAttribute("y", y);
      placed.push({ x, y, half });
    }
  }
  return app.add({
    showTime(t) {
      const still = lastAt(film.stills, t, (s) => s.at) || film.stills[0];
      showImage(image, still.image);
      image.alt = "The scene at " + clockText(still.at);
      const next = film.stills[film.stills.indexOf(still) + 1];
      if (next) blockAddress(next.image);
      const bound = boundObjects(app, t);
      // Bound things last, so that they lie on top.
      const names = Object.keys(still.objects).sort((a, b) => bound.has(a) - bound.has(b));
      over.replaceChildren(...names.map((name) => objectShape(name, still.objects[name], bound.get(name))));
      separate([...over.querySelectorAll(".name")]);
    },
    showSelection() {},
  });
}

// What stands for a thing in the picture: a click selects the thing.
function thingButton(app, name, bound) {
  const id = "thing:" + name;
  const known = app.subject(id) !== null;
  return svg("g", { class: "object" + (bound ? " bound" : ""), on: { click: () => app.select(id) },
    role: known ? "button" : null, "aria-label": name });
}

// Object -> variable of the selection that it is bound to now; a selected thing is itself, without a variable.
function boundObjects(app, t) {
  const subject = app.chosen;
  const bound = new Map();
  if (subject && subject.kind === "thing") bound.set(subject.id.slice("thing:".length), "");
  for (const [variable, value] of (subject && app.bindings(subject, t)) || []) bound.set(value, variable);
  return bound;
}

// Without stills: where things are, seen from above (or along a line), from the facts alone.
function planPane(app) {
  const { objects, film } = app.report;
  const box = $("film");
  const places = new Map();
  for (const object of objects) {
    const changes = object.changes.filter((change) => change.place);
    if (changes.length) places.set(object.name, changes);
  }
  box.append(el("p", { class: "note", text: film.note }));
  if (!places.size) return app.add({});
  const all = [...places.values()].flat().map((change) => change.place);
  const flat = all.every((place) => place.length < 2);
  const width = 392, height = 220, margin = { x: 36, top: 24, bottom: 80 };
  const range = (axis) => {
    const values = all.map((place) => place[axis] ?? 0);
    const low = Math.min(...values), high = Math.max(...values);
    return high > low ? [low, high] : [low - 1, high + 1];
  };
  const [x0, x1] = range(0), [y0, y1] = flat ? [0, 0] : range(1);
  const scale = flat ? (width - 2 * margin.x) / (x1 - x0)
    : Math.min((width - 2 * margin.x) / (x1 - x0), (height - margin.top - margin.bottom) / (y1 - y0));
  const middle = { x: width / 2, y: (height + margin.top - margin.bottom) / 2 };
  const at = (place) => [middle.x + (place[0] - (x0 + x1) / 2) * scale,
    flat ? middle.y : middle.y - ((place[1] ?? 0) - (y0 + y1) / 2) * scale];
  const picture = svg("svg", { class: "plan", viewBox: `0 0 ${width} ${height}`, role: "img",
    "aria-label": "Where things are" });
  box.append(picture);

  function grid() {
    if (!flat) {
      return [svg("rect", { class: "axis", fill: "none", x: margin.x / 2, y: margin.top / 2, width: width - margin.x,
        height: height - margin.bottom + 12 })];
    }
    const lines = [svg("line", { class: "axis", x1: margin.x / 2, x2: width - margin.x / 2, y1: middle.y, y2: middle.y })];
    for (const value of [x0, (x0 + x1) / 2, x1]) {
      const x = at([value])[0];
      lines.push(svg("text", { class: "tick", x, y: middle.y + 44, text: String(Number(value.toPrecision(3))) }));
    }
    return lines;
  }
  return app.add({
    showTime(t) {
      const bound = boundObjects(app, t);
      const stacked = new Map();
      const dots = [];
      for (const [name, changes] of places) {
        const change = lastAt(changes, t, (c) => c.at);
        if (!change) continue;
        const [x, y] = at(change.place);
        // Things at one place share a dot; their names stand above each other.
        const key = Math.round(x / 8) + " " + Math.round(y / 8);
        const level = stacked.get(key) || 0;
        stacked.set(key, level + 1);
        const variable = bound.get(name);
        const thing = thingButton(app, name, variable !== undefined);
        thing.append(svg("circle", { class: "area", cx: x, cy: y, r: 12 }), svg("circle", { cx: x, cy: y, r: 5 }),
          svg("text", { x, y: y + (level ? -(11 + 13 * (level - 1)) : 19), text: variable ? variable + " = " + name : name }));
        dots.push(thing);
      }
      picture.replaceChildren(...grid(), ...dots);
    },
  });
}

function transportPane(app) {
  const button = (id, action) => $(id).addEventListener("click", action);
  const last = app.frames[app.frames.length - 1];
  button("first", () => app.go(app.frames[0]));
  button("back", () => app.step(-1));
  button("play", () => app.toggle());
  button("forward", () => app.step(1));
  button("last", () => app.go(last));
  return app.add({
    showTime(t) {
      const frame = app.frame;
      $("frame").textContent = app.report.clock.frames.length ? `frame ${frame + 1} of ${app.frames.length}` : "no frames";
      $("time").textContent = clockText(t);
      const moment = app.report.moments[frame] || "";
      if ($("moment").dataset.text !== moment) {
        $("moment").dataset.text = moment;
        $("moment").replaceChildren(...sentence(moment));
      }
    },
    showPlaying(playing) {
      $("play").setAttribute("aria-label", playing ? "Pause" : "Play");
      $("play").querySelector("use").setAttribute("href", playing ? "#i-pause" : "#i-play");
    },
  });
}
