// ---- film.js: the picture of the moment, still or video, with outlines and names; where there are no pictures a plan of
// positions, and where nothing has a position a table of what is known of each thing.

function filmPane(app) {
  const { film } = app.report;
  describeStills(film);
  const box = $("film");
  const image = el("img", { class: "still", alt: "", draggable: "false" });
  const over = svg("svg", { viewBox: `0 0 ${film.width || 16} ${film.height || 9}`, preserveAspectRatio: "xMidYMid slice" });
  const outlines = outlineLayer(app, over, (film.width || 800) / 800);
  const video = filmVideo(app, box);
  const cameras = [{ ...film.camera, stills: film.stills, outlines: film.outlines }, ...film.views];
  let camera = cameras[0];
  box.append(image, over);
  if (film.note) box.after(el("p", { class: "film-note", text: film.note }));

  const buttons = cameraButtons(box, cameras, (chosen) => {
    const going = app.playing;
    if (going) app.toggle();
    look(chosen);
    app.keep("cam", camera === cameras[0] ? "" : camera.id);
    app.go(app.t);
    if (going) app.toggle();
  });
  function look(chosen) {
    camera = chosen;
    for (const button of buttons) button.setAttribute("aria-pressed", String(button.dataset.camera === camera.id));
  }
  look(camera);
  // Only the first camera has a video; what it shows then is what the clock reads.
  app.player = {
    start: () => camera === cameras[0] && video !== null && video.start(),
    stop: () => { if (video) video.stop(); },
  };

  return app.add({
    showTime(t) {
      const still = lastAt(camera.stills, t, (s) => s.at) || camera.stills[0];
      const exact = still.at <= t && (t < still.until || t === still.at);
      const moving = camera === cameras[0] && video !== null && video.show(t, exact);
      box.classList.toggle("moving", moving);
      if (!moving || exact) showImage(image, still.image);
      image.alt = "The scene at " + momentText(still.at) + (camera.title ? ", camera " + camera.title : "");
      const next = camera.stills[camera.stills.indexOf(still) + 1];
      if (next) blockAddress(next.image);
      outlines.show(camera.outlines, moving ? t : exact ? t : still.at, boundObjects(app, t));
    },
    showSelection() {},
    restore(state) { look(cameras.find((one) => one.id === state.get("cam")) || cameras[0]); },
  });
}

// Gives the stills of the first camera what is in them: name -> { outline, label } in pixels; worked out when asked for.
function describeStills(film) {
  for (const still of film.stills) {
    Object.defineProperty(still, "objects", { get() {
      const { names, shapes, at } = film.outlines;
      const entry = lastAt(at, still.at, (one) => one[0]) || [];
      const objects = {};
      for (let i = 1; i < entry.length; i += 2) {
        const shape = shapes[entry[i + 1]];
        const outline = shape.slice(2);
        for (let k = 2; k < outline.length; ++k) outline[k] += outline[k - 2];
        objects[names[entry[i]]] = { outline, label: shape.slice(0, 2) };
      }
      return objects;
    } });
  }
}

// A switch of cameras, where there are several.
function cameraButtons(box, cameras, choose) {
  if (cameras.length < 2) return [];
  const buttons = cameras.map((camera) => el("button", { type: "button", "data-camera": camera.id, text: camera.title,
    title: camera === cameras[0] ? null : `${camera.stills.length} stills, no video`,
    on: { click: () => choose(camera) } }));
  box.append(el("div", { class: "cameras", role: "group", "aria-label": "Camera" }, ...buttons));
  return buttons;
}

// The video of the film: picture i shows the world at from + i * picture. It plays by itself, and the clock follows; else
// it stands at the clock's picture. Null where there is none or the browser cannot play it.
function filmVideo(app, box) {
  const about = app.report.film.video;
  if (!about) return null;
  const video = el("video", { id: "film-video", playsinline: true, preload: "auto", tabindex: "-1",
    "aria-label": "The scene in motion" });
  video.muted = true;
  if (!video.canPlayType(about.type)) return null;
  box.append(video);
  let broken = false;
  let playing = false;
  let following = false;  // the clock is being set to the video's time
  let shown = -1;         // the picture that the video stands at, once it has come
  const last = about.pictures - 1;
  const seconds = (t) => (t - about.from) / 1e6;
  const pictureAt = (t) => clamp(Math.floor((t - about.from) / about.picture), 0, last);
  const timeOf = (picture) => seconds(about.from + (picture + 0.5) * about.picture);
  video.addEventListener("error", () => { broken = true; if (playing) app.toggle(); app.go(app.t); });
  video.addEventListener("seeked", () => {
    shown = pictureAt(about.from + video.currentTime * 1e6);
    if (!playing) app.go(app.t);
  });
  // The bytes are decoded when they are first asked for.
  let loading = null;
  function load() {
    loading = loading || blockAddress(about.block).then((address) => new Promise((resolve) => {
      video.addEventListener("loadedmetadata", resolve, { once: true });
      video.src = address;
    }));
    return loading;
  }
  function follow(seconds_shown) {
    if (!playing) return;
    following = true;
    app.go(about.from + Math.round(seconds_shown * 1e6));
    following = false;
    watch();
  }
  function watch() {
    if (video.requestVideoFrameCallback) video.requestVideoFrameCallback((now, frame) => follow(frame.mediaTime));
    else requestAnimationFrame(() => follow(video.currentTime));
  }
  video.addEventListener("ended", () => {
    if (!playing) return;
    following = true;
    app.go(app.report.clock.end);
    following = false;
    app.toggle();
  });
  return {
    // Whether the video will keep time.
    start() {
      if (broken) return false;
      playing = true;
      shown = -1;
      load().then(() => {
        if (!playing) return null;
        video.currentTime = Math.max(0, seconds(app.t));
        // A minute is enough for a look at the whole, however long it took.
        video.playbackRate = clamp((last + 1) * about.picture / 60e6, 1, 16);
        watch();
        return video.play();
      }).catch(() => {
        if (!playing) return;
        // Stills move on in its place.
        broken = true;
        app.toggle();
        app.toggle();
      });
      return true;
    },
    stop() {
      if (!playing) return;
      playing = false;
      video.pause();
      if (video.ended || video.readyState === 0) return;
      // The clock stops at the picture that is seen.
      shown = pictureAt(about.from + video.currentTime * 1e6);
      app.go(about.from + shown * about.picture);
    },
    // Brings the video to this time unless a still is at hand; whether the video is what should be seen.
    show(t, still_at_hand) {
      if (broken) return false;
      if (playing) {
        if (!following) video.currentTime = Math.max(0, seconds(t));
        return true;
      }
      if (still_at_hand) return false;
      const wanted = pictureAt(t);
      if (shown === wanted) return true;
      load().then(() => { if (!playing && shown !== pictureAt(app.t)) video.currentTime = timeOf(pictureAt(app.t)); });
      return false;
    },
  };
}

// Outlines and names of things over the picture. Their elements are kept from one moment to the next, so that focus stays.
function outlineLayer(app, over, unit) {
  const shapes = new Map();  // name -> elements
  // Names lie over all outlines.
  const lines = svg("g", { "pointer-events": "none" });
  const areas = svg("g");
  over.append(lines, areas);
  const path = (shape, dx, dy) => {
    let d = "", x = dx, y = dy;
    for (let i = 2; i < shape.length; i += 2) {
      x += shape[i];
      y += shape[i + 1];
      d += (i > 2 ? "L" : "M") + Math.round(x) + " " + Math.round(y);
    }
    return d + "Z";
  };
  function elementsOf(name) {
    if (shapes.has(name)) return shapes.get(name);
    const group = thingButton(app, name);
    const parts = { group, halo: svg("path", { class: "halo", "stroke-width": 8 * unit }),
      outline: svg("path", { class: "outline", "stroke-width": 4 * unit }),
      area: svg("path", { class: "area", "stroke-width": 3 * unit }),
      label: svg("text", { class: "name", "font-size": 23 * unit, "stroke-width": 6 * unit }) };
    lines.append(parts.halo, parts.outline);
    group.append(parts.area, parts.label);
    shapes.set(name, parts);
    return parts;
  }
  // Names that would lie on each other: the lower one moves down.
  function separate(names) {
    const placed = [];
    const size = 26 * unit;
    for (const name of names.sort((a, b) => a.y - b.y)) {
      const half = widthOf(name.text, 23) * unit / 2;
      let y = name.y;
      for (const other of placed) {
        if (Math.abs(other.x - name.x) < other.half + half && Math.abs(other.y - y) < size) y = other.y + size;
      }
      name.node.setAttribute("y", y);
      placed.push({ x: name.x, y, half });
    }
  }
  // Things at a time: name -> shape, and how far to move it. What moves is between where it was and will be traced.
  function placesAt(table, t) {
    const places = new Map();
    const entry = lastAt(table.at, t, (one) => one[0]) || table.at[0];
    if (!entry) return places;
    const next = table.at[table.at.indexOf(entry) + 1];
    const part = next && t > entry[0] ? (t - entry[0]) / (next[0] - entry[0]) : 0;
    const after = new Map();
    for (let i = 1; next && i < next.length; i += 2) after.set(next[i], table.shapes[next[i + 1]]);
    for (let i = 1; i < entry.length; i += 2) {
      const shape = table.shapes[entry[i + 1]];
      const then = after.get(entry[i]) || shape;
      places.set(table.names[entry[i]], { shape, dx: (then[0] - shape[0]) * part, dy: (then[1] - shape[1]) * part });
    }
    return places;
  }
  return {
    show(table, t, bound) {
      const places = placesAt(table, t);
      for (const [name, { group, halo, outline }] of shapes) {
        if (places.has(name)) continue;
        group.remove();
        for (const part of [halo, outline]) part.setAttribute("d", "");
      }
      const names = [];
      // Bound things last, so that they lie on top.
      for (const name of [...places.keys()].sort((a, b) => Number(bound.has(a)) - Number(bound.has(b)))) {
        const { shape, dx, dy } = places.get(name);
        const { group, halo, outline, area, label } = elementsOf(name);
        const is_bound = bound.has(name);
        const d = shape.length > 2 ? path(shape, dx, dy) : "";
        for (const part of [halo, outline]) part.setAttribute("d", is_bound ? d : "");
        area.setAttribute("d", d);
        group.classList.toggle("bound", is_bound);
        label.textContent = bound.get(name) ? bound.get(name) + " = " + name : name;
        label.setAttribute("x", Math.round(shape[0] + dx));
        names.push({ node: label, text: label.textContent, x: shape[0] + dx, y: shape[1] + dy });
        // Moving an element in the document would take its focus away.
        const in_place = group.parentNode === areas && group.classList.contains("on-top") === is_bound;
        group.classList.toggle("on-top", is_bound);
        if (in_place) continue;
        if (is_bound) areas.append(group); else areas.prepend(group);
      }
      separate(names);
    },
  };
}

// What stands for a thing in the picture: a click selects the thing.
function thingButton(app, name) {
  const id = "thing:" + name;
  const known = app.subject(id) !== null;
  const choose = () => app.select(id);
  // Its name is the text in it.
  return svg("g", { class: "object", role: known ? "button" : null, tabindex: known ? 0 : null,
    on: { click: choose, keydown: (event) => {
      if (event.key !== "Enter" && event.key !== " ") return;
      event.preventDefault();
      event.stopPropagation();
      choose();
    } } });
}

// Object -> variable of the selection that it is bound to now; a selected thing is itself, without a variable.
function boundObjects(app, t) {
  const subject = app.chosen;
  const bound = new Map();
  if (subject && subject.kind === "thing") bound.set(subject.id.slice("thing:".length), "");
  for (const [variable, value] of (subject && app.bindings(subject, t)) || []) bound.set(value, variable);
  // What a goal, a prediction, a command or an event speaks of is named in its words.
  if (subject && ["goal", "prediction", "command", "event"].includes(subject.kind)) {
    const words = new Set((subject.title + " " + (subject.detail.say || "")).split(/[^\p{L}\p{N}_]+/u));
    for (const object of app.report.objects) if (words.has(object.name)) bound.set(object.name, "");
  }
  return bound;
}

// Without stills: where things are, seen from above (or along a line), from the facts alone; else what is known of each.
function planPane(app) {
  const { objects, film } = app.report;
  const box = $("film");
  const places = new Map();
  for (const object of objects) {
    const changes = object.changes.filter((change) => change.place && change.attribute === "position");
    if (changes.length) places.set(object.name, changes);
  }
  const drawn = places.size ? "Places of things, drawn from the facts. " : objects.length ? "What was seen of each thing. " : "";
  box.append(el("p", { class: "note", text: drawn + film.note }));
  if (!places.size) return thingsTable(app, box);
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
  const picture = svg("svg", { class: "plan", viewBox: `0 0 ${width} ${height}`, role: "group",
    "aria-label": "Where things are" }, ...grid());
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
  // Each thing's elements are made once, so that focus stays on them.
  const dots = new Map();
  for (const name of places.keys()) {
    const group = thingButton(app, name);
    const parts = { group, area: svg("circle", { class: "area", r: 12 }), dot: svg("circle", { r: 5 }), label: svg("text") };
    group.append(parts.area, parts.dot, parts.label);
    dots.set(name, parts);
  }
  return app.add({
    showTime(t) {
      const bound = boundObjects(app, t);
      const stacked = new Map();
      for (const [name, changes] of places) {
        const { group, area, dot, label } = dots.get(name);
        const change = lastAt(changes, t, (c) => c.at);
        if (!change) { group.remove(); continue; }
        const [x, y] = at(change.place);
        // Things at one place share a dot; their names stand above each other.
        const key = Math.round(x / 8) + " " + Math.round(y / 8);
        const level = stacked.get(key) || 0;
        stacked.set(key, level + 1);
        for (const circle of [area, dot]) { circle.setAttribute("cx", x); circle.setAttribute("cy", y); }
        label.setAttribute("x", x);
        label.setAttribute("y", y + (level ? -(11 + 13 * (level - 1)) : 19));
        label.textContent = bound.get(name) ? bound.get(name) + " = " + name : name;
        group.classList.toggle("bound", bound.has(name));
        if (!group.parentNode) picture.append(group);
      }
    },
  });
}

// What is known of each thing at the cursor, as rows that select it; those that the selection speaks of are outlined.
function thingsTable(app, box) {
  const { objects } = app.report;
  if (!objects.length) return app.add({});
  const rows = objects.map((object) => ({ object, name: el("button", { type: "button", class: "link", on: { click: () => app.select("thing:" + object.name) } }),
    known: el("td", {}), row: el("tr", {}) }));
  for (const { name, known, row } of rows) row.append(el("td", {}, name), known);
  box.prepend(el("div", { class: "things" }, el("table", {}, el("thead", {}, el("tr", {}, el("th", { text: "thing" }), el("th", { text: "at this moment" }))),
    el("tbody", {}, ...rows.map(({ row }) => row)))));
  return app.add({
    showTime(t) {
      const bound = boundObjects(app, t);
      for (const { object, name, known, row } of rows) {
        name.textContent = bound.get(object.name) ? bound.get(object.name) + " = " + object.name : object.name;
        row.classList.toggle("bound", bound.has(object.name));
        const now = [...knownOf(object, t)];
        known.replaceChildren(...(object.what ? [el("div", { class: "quiet", text: object.what })] : []),
          ...now.map(([attribute, { value }]) => el("div", {}, el("span", { class: "quiet", text: attribute + " " }), el("b", { text: value }))),
          now.length || object.what ? "" : el("span", { class: "quiet", text: "nothing yet" }));
      }
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
    showTime() {
      const frame = app.frame;
      $("frame").textContent = app.report.clock.frames.length ? `frame ${frame + 1} of ${app.frames.length}` : "no frames";
      $("time").textContent = app.clock;
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
