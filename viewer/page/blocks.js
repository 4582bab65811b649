// ---- blocks.js: the inert blocks of a page, decoded when they are asked for; shared by all pages.

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
  return new Uint8Array(await busyWith(new Response(stream).arrayBuffer()));
}

// A block by its id; a page without it says so. The script begins before the whole page is read, so a block may be
// still to come, or be there in part: one is whole when something follows it.
async function blockNamed(id) {
  let block = document.getElementById(id);
  if (document.readyState === "loading" && !(block && block.nextElementSibling)) {
    await new Promise((resume) => { document.addEventListener("DOMContentLoaded", resume, { once: true }); });
    block = document.getElementById(id);
  }
  if (!block) throw new Error("the part " + id + " of the page is missing");
  return block;
}
async function blockBytes(id) { return unpackedBytes(await blockNamed(id)); }
async function blockText(id) { return new TextDecoder().decode(await blockBytes(id)); }
