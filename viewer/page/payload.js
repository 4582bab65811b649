// ---- payload.js: the inert blocks of the page, decoded when they are asked for.

async function unpack(block) {
  const bytes = Uint8Array.from(atob(block.textContent), (c) => c.charCodeAt(0));
  if (block.dataset.packed !== "gzip") return new Blob([bytes], { type: block.dataset.type });
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Blob([await new Response(stream).arrayBuffer()], { type: block.dataset.type });
}

async function readReport() {
  return JSON.parse(await (await unpack($("report-data"))).text());
}

// The address of an image of the page; made once.
const imageAddresses = new Map();
function imageAddress(name) {
  if (!imageAddresses.has(name)) {
    imageAddresses.set(name, unpack($(name)).then((blob) => URL.createObjectURL(blob)));
  }
  return imageAddresses.get(name);
}
function showImage(image, name) {
  image.dataset.image = name;
  imageAddress(name).then((address) => { if (image.dataset.image === name) image.src = address; });
}
