// ---- payload.js: what the blocks of the report hold.

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
