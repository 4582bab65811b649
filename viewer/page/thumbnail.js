// ---- thumbnail.js: a small picture of a moment, around the thing that is spoken of.

// Null where the report has no pictures.
function thumbnail(app, t, text, className) {
  const { stills, width, height } = app.report.film;
  const still = lastAt(stills, t, (s) => s.at) || stills[0];
  if (!still) return null;
  const image = el("img", { alt: "" });
  showImage(image, still.image);
  const named = text.split(/[^\p{L}\p{N}_]+/u).filter((word) => Object.hasOwn(still.objects, word)).pop();
  if (named) {
    const { outline, label } = still.objects[named];
    const middle = (first) => {
      const values = outline.filter((_, i) => i % 2 === first);
      return values.length ? (Math.min(...values) + Math.max(...values)) / 2 : label[first];
    };
    const zoom = 2.4;
    image.style.width = image.style.height = zoom * 100 + "%";
    image.style.left = clamp(50 - zoom * 100 * middle(0) / width, 100 - zoom * 100, 0) + "%";
    image.style.top = clamp(50 - zoom * 100 * middle(1) / height, 100 - zoom * 100, 0) + "%";
  }
  return el("span", { class: className || "thumb" }, image);
}
