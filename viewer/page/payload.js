// ---- payload.js: the inert blocks of the page, decoded when they are asked for.

// The bytes of base64 text.
function bytesOfBase64(text) {
  const letters = atob(text);
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; ++i) bytes[i] = letters.charCodeAt(i);
  return bytes;
}

async function unpackedBytes(block) {
  const bytes = bytesOfBase64(block.textContent || "");
  if (block.dataset.packed !== "gzip") return bytes;
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// A block by its id; a page without it says so. The script begins before the whole page is read, so a block may be
// still to come.
async function blockNamed(id) {
  let block = document.getElementById(id);
  if (!block && document.readyState === "loading") {
    await new Promise((resume) => { document.addEventListener("DOMContentLoaded", resume, { once: true }); });
    block = document.getElementById(id);
  }
  if (!block) throw new Error("the part " + id + " of the report is missing");
  return block;
}
async function blockBytes(id) { return unpackedBytes(await blockNamed(id)); }
async function blockText(id) { return new TextDecoder().decode(await blockBytes(id)); }

// The address of a block's bytes as an image or a film, made once: in the page, or a file beside it.
const blockAddresses = new Map();
async function makeBlockAddress(id) {
  const block = await blockNamed(id);
  if (block.dataset.file) return block.dataset.file;
  return URL.createObjectURL(new Blob([await unpackedBytes(block)], { type: block.dataset.type || "" }));
}
function blockAddress(id) {
  if (!blockAddresses.has(id)) blockAddresses.set(id, makeBlockAddress(id));
  return blockAddresses.get(id);
}
function showImage(image, id) {
  image.dataset.image = id;
  blockAddress(id).then((address) => { if (image.dataset.image === id) image.src = address; });
}

// Columns of whole numbers as the writer's columns.h packs them.
class ColumnReader {
  constructor(bytes) { this.bytes = bytes; this.at = 0; }
  take(count) { this.at += count; return this.bytes.subarray(this.at - count, this.at); }
  unsigned() {
    const { bytes } = this;
    let byte = bytes[this.at++];
    let value = byte & 127;
    for (let unit = 128; byte > 127; unit *= 128) {
      byte = bytes[this.at++];
      value += (byte & 127) * unit;
    }
    return value;
  }
  signed() {
    const value = this.unsigned();
    return value % 2 ? -(value + 1) / 2 : value / 2;
  }
}
