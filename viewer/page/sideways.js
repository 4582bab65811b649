// ---- sideways.js: says of a part that is wider than its place that it goes on to the side, and goes there.

// Buttons over the edges of `frame`, each shown while there is more of `scroll` on that side.
function showSideways(frame, scroll) {
  const button = (by, name, text, title) => el("button", { type: "button", class: "sideways " + name, text, title, "aria-label": title, hidden: true,
    on: { click: () => { scroll.scrollLeft += by * scroll.clientWidth * 0.7; } } });
  const left = button(-1, "to-left", "\u2039", "More on the left"), right = button(1, "to-right", "\u203a", "More on the right");
  frame.append(left, right);
  function update() {
    left.hidden = scroll.scrollLeft < 4;
    right.hidden = scroll.scrollWidth - scroll.clientWidth - scroll.scrollLeft < 4;
  }
  // Where it stands is asked once a frame: the answer makes the browser lay out the page.
  let waiting = 0;
  const later = () => { waiting = waiting || requestAnimationFrame(() => { waiting = 0; update(); }); };
  scroll.addEventListener("scroll", later, { passive: true });
  new ResizeObserver(later).observe(scroll);
  return later;
}
