// ---- text_columns.js: columns of texts as the writer's text_columns.h packs them.

class TextColumnReader {
  constructor(bytes) {
    this.columns = new ColumnReader(bytes);
    const forms = new TextDecoder().decode(this.columns.take(this.columns.unsigned()));
    // The words of each form, between which its numbers go.
    this.forms = forms.split('\n').map((form) => form.split('\u0001'));
  }
  // The next column: for each row, known by its own number, a text or null.
  next(rows) {
    const {columns} = this;
    const texts = new Array(rows.length).fill(null);
    const byForm = new Map();  // form -> its rows
    for (let i = 0; i < rows.length; ++i) {
      const form = columns.unsigned();
      if (!form) continue;
      const known = byForm.get(form);
      if (known)
        known.push(i);
      else
        byForm.set(form, [i]);
    }
    for (const [form, where] of byForm) {
      const words = this.forms[form - 1];
      for (const i of where) texts[i] = words[0];
      for (let place = 1; place < words.length; ++place) {
        const how = columns.unsigned();
        const decimals = how >> 1, counted = (how & 1) === 1;
        let before = 0;
        for (const i of where) {
          before = columns.signed() + (counted ? rows[i] : before);
          texts[i] += (decimals ? decimalText(before, decimals) : before) + words[place];
        }
      }
    }
    return texts;
  }
}
// 1250 with three decimals is "1.25".
function decimalText(digits, decimals) {
  const text = String(Math.abs(digits)).padStart(decimals + 1, '0');
  const fraction = text.slice(-decimals).replace(/0+$/, '');
  return (digits < 0 ? '-' : '') + text.slice(0, -decimals) + (fraction ? '.' + fraction : '');
}
